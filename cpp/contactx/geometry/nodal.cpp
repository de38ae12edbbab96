// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#include "nodal.h"
#include "../math/scales.h"
#include "frame.h"
#include "gather.h"
#include <algorithm>
#include <numeric>

using namespace contactx;
using namespace contactx::geometry;

namespace
{
/// Quadrature points that integrate the shape functions of F exactly, all of
/// the same weight; a bilinear facet's Jacobian is not polynomial, and the
/// 2 x 2 rule is exact where the facet is flat.
template <class F>
constexpr auto quadrature()
{
  constexpr double a = 0.21132486540518713, b = 1 - a;
  if constexpr (F::nodes == 2)
    return std::array<Vector<1>, 2>{{{a}, {b}}};
  else if constexpr (F::nodes == 3)
    return std::array<Vector<2>, 1>{{{1. / 3, 1. / 3}}};
  else
    return std::array<Vector<2>, 4>{{{a, a}, {b, a}, {a, b}, {b, b}}};
}

/// The same of products of two of them.
template <class F>
constexpr auto quadrature_of_products()
{
  if constexpr (F::nodes == 3)
    return std::array<Vector<2>, 3>{
        {{1. / 6, 1. / 6}, {2. / 3, 1. / 6}, {1. / 6, 2. / 3}}};
  else
    return quadrature<F>();
}

/// Area of each node with a weight.
void add_weighted(const FacetList& facets, std::span<const double> x,
                  std::span<const double> weight, std::vector<double>& area)
{
  for (std::int32_t i = 0; i < facets.size(); ++i)
    visit(facets[i].size(),
          [&]<class F>(F)
          {
            const Nodes<F> xf = gather<F>(facets[i], x);
            constexpr auto points = quadrature_of_products<F>();
            const double reference_area = F::nodes == 3 ? 0.5 : 1;
            for (const auto& xi : points)
            {
              const auto N = F::shape(xi);
              double w
                  = frame<F>(xf, xi).jacobian * reference_area / points.size();
              double of_point = 0;
              for (int l = 0; l < F::nodes; ++l)
                of_point += N[l] * weight[facets[i][l]];
              for (int l = 0; l < F::nodes; ++l)
                area[facets[i][l]] += N[l] * of_point * w;
            }
          });
}

/// Call f(node, area vector of the node's part of the facet) for each node of
/// each facet.
template <class Function>
void for_each_part(const FacetList& facets, std::span<const double> x,
                   Function f)
{
  for (std::int32_t i = 0; i < facets.size(); ++i)
  {
    visit(facets[i].size(),
          [&f, &facets, x, i]<class F>(F)
          {
            const Nodes<F> xf = gather<F>(facets[i], x);
            constexpr auto points = quadrature<F>();
            const double reference_area = F::nodes == 3 ? 0.5 : 1;
            for (const auto& xi : points)
            {
              const auto fr = frame<F>(xf, xi);
              const auto N = F::shape(xi);
              const double w = fr.jacobian * reference_area / points.size();
              if (w > 0)
                for (int l = 0; l < F::nodes; ++l)
                  f(facets[i][l], N[l] * w, fr.n);
            }
          });
  }
}
} // namespace

std::vector<double>
contactx::geometry::nodal_areas(const FacetList& facets,
                                std::span<const double> x, int gdim,
                                std::span<const double> weight)
{
  std::vector<double> area(x.size() / gdim, 0);
  if (not weight.empty())
  {
    add_weighted(facets, x, weight, area);
    return area;
  }
  for_each_part(facets, x, [&area](std::int32_t node, double w, const auto&)
                { area[node] += w; });
  return area;
}

std::vector<double>
contactx::geometry::at_corners(const FacetList& facets,
                               std::span<const double> values, int width)
{
  std::vector<double> corners(facets.nodes.size() * width);
  for (std::size_t c = 0; c < facets.nodes.size(); ++c)
    std::copy_n(values.begin()
                    + static_cast<std::size_t>(facets.nodes[c]) * width,
                width, corners.begin() + c * width);
  return corners;
}

std::vector<double> contactx::geometry::corner_areas(const FacetList& facets,
                                                     std::span<const double> x,
                                                     int gdim,
                                                     const Shares& shares)
{
  // Each corner of each facet as a node of its own
  std::vector<std::int32_t> own(facets.nodes.size());
  std::iota(own.begin(), own.end(), 0);
  const FacetList corners{facets.offsets, own};
  const std::vector<double> at = at_corners(facets, x, gdim);
  const std::vector<double> weight = shares.weight.empty()
                                         ? std::vector<double>()
                                         : at_corners(facets, shares.weight, 1);
  if (shares.level.empty())
    return nodal_areas(corners, at, gdim, weight);
  std::vector<double> area = nodal_areas(corners, at, gdim);
  for (std::int32_t f = 0; f < facets.size(); ++f)
  {
    const auto nodes = facets[f];
    const std::span part(area.data() + facets.offsets[f], nodes.size());
    const bool is_corner = std::ranges::any_of(
        nodes, [&](std::int32_t node) { return shares.level[node] == 0; });
    // Of what is beside a vertex, a quarter of the facet
    const double of_vertex = shares.of_basis ? 8. / 15 : 0;
    const auto share = [&](std::int32_t node) -> double
    {
      const std::int8_t level = shares.level[node];
      if (nodes.size() != 3)
        return 1 << level;
      if (not is_corner)
        return 1;
      return level == 0 ? of_vertex : (1 - of_vertex) / 2;
    };
    double whole = 0, sum = 0;
    for (std::size_t i = 0; i < nodes.size(); ++i)
    {
      whole += part[i];
      sum += share(nodes[i]);
    }
    for (std::size_t i = 0; i < nodes.size(); ++i)
      part[i] = whole * share(nodes[i]) / sum
                * (weight.empty() ? 1 : weight[facets.offsets[f] + i]);
  }
  return area;
}

std::vector<double>
contactx::geometry::nodal_area_vectors(const FacetList& facets,
                                       std::span<const double> x, int gdim)
{
  std::vector<double> vector(x.size(), 0);
  for_each_part(facets, x,
                [&vector, gdim](std::int32_t node, double w, const auto& n)
                {
                  for (int k = 0; k < gdim; ++k)
                    vector[static_cast<std::size_t>(node) * gdim + k]
                        += w * n[k];
                });
  return vector;
}

std::vector<double>
contactx::geometry::unit_normals(std::span<const double> vector,
                                 std::span<const double> area, int gdim)
{
  std::vector<double> normal(vector.begin(), vector.end());
  for (std::size_t i = 0; i < area.size(); ++i)
  {
    const std::span n(normal.data() + i * gdim, gdim);
    double l2 = 0;
    for (double c : n)
      l2 += c * c;
    // Normals that cancel leave rounding errors, which have no direction
    const double length = std::sqrt(l2);
    for (double& c : n)
      c = length > math::round_off * area[i] ? c / length : 0;
  }
  return normal;
}

std::vector<double> contactx::geometry::nodal_normals(const FacetList& facets,
                                                      std::span<const double> x,
                                                      int gdim)
{
  return unit_normals(nodal_area_vectors(facets, x, gdim),
                      nodal_areas(facets, x, gdim), gdim);
}
