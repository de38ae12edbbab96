// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#include "passed_nodes.h"
#include "../geometry/smooth.h"
#include "../math/vec.h"
#include "../mesh/spread.h"
#include "passage.h"
#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <unordered_map>

using namespace contactx;
using namespace contactx::audit;

namespace
{
/// Length of the mean of the unit normals of a node's facets, by area: that of
/// two facets that meet at geometry::cosine_at_edges
const double even_enough = std::sqrt((1 + geometry::cosine_at_edges) / 2);

/// Which candidates come into the box that all facets sweep.
std::vector<std::int32_t>
near_facets(const mesh::Halo& halo, const geometry::FacetList& facets,
            std::span<const double> x0, std::span<const double> x1,
            std::span<const std::int32_t> candidates, double tolerance)
{
  const int g = halo.gdim();
  // Least coordinates, and the largest ones with the other sign
  std::vector<double> box(std::size_t(2) * g,
                          std::numeric_limits<double>::infinity());
  for (const std::int32_t node : facets.nodes)
    for (int k = 0; k < g; ++k)
    {
      const std::size_t at = std::size_t(node) * g + k;
      box[k] = std::min({box[k], x0[at], x1[at]});
      box[g + k] = std::min({box[g + k], -x0[at], -x1[at]});
    }
  halo.ranks().reduce(std::span(box), mesh::Reduction::least);
  std::vector<std::int32_t> near;
  for (const std::int32_t node : candidates)
  {
    bool is_near = true;
    for (int k = 0; k < g; ++k)
    {
      const std::size_t at = std::size_t(node) * g + k;
      is_near = is_near and std::min(x0[at], x1[at]) - tolerance <= -box[g + k]
                and std::max(x0[at], x1[at]) + tolerance >= box[k];
    }
    if (is_near)
      near.push_back(node);
  }
  return near;
}

/// Points of all ranks in the order of their numbers in the mesh as it was
/// made, which is the same on any number of ranks.
struct Points
{
  std::vector<std::int64_t> original;
  std::vector<double> start, end, normal0, normal1;

  Vector<3> first(const std::vector<double>& values, int gdim) const
  {
    Vector<3> v{};
    std::copy_n(values.begin(), gdim, v.begin());
    return v;
  }
};

Points points_of_all(const mesh::Halo& halo, const geometry::FacetList& own,
                     std::span<const double> x0, std::span<const double> x1,
                     std::span<const std::int32_t> nodes)
{
  const int g = halo.gdim();
  const std::vector<double> normal0 = normals_of_all(halo, own, x0);
  const std::vector<double> normal1 = normals_of_all(halo, own, x1);
  const std::span<const double> parts[] = {x0, x1, normal0, normal1};
  std::vector<std::int64_t> mine;
  std::vector<double> table;
  for (const std::int32_t node : nodes)
  {
    mine.push_back(halo.original()[node]);
    for (const auto& part : parts)
    {
      const auto row = part.subspan(std::size_t(node) * g, g);
      table.insert(table.end(), row.begin(), row.end());
    }
  }
  const auto original
      = mesh::gathered<std::int64_t>(halo.ranks(), std::span(mine));
  table = mesh::gathered<double>(halo.ranks(), std::span(table));
  std::vector<std::size_t> order(original.size());
  std::iota(order.begin(), order.end(), 0);
  std::ranges::sort(order, {}, [&](std::size_t i) { return original[i]; });
  Points points;
  std::vector<double>* columns[]
      = {&points.start, &points.end, &points.normal0, &points.normal1};
  for (const std::size_t i : order)
  {
    points.original.push_back(original[i]);
    auto row = table.begin() + static_cast<std::ptrdiff_t>(4 * g * i);
    for (auto* column : columns)
    {
      column->insert(column->end(), row, row + g);
      row += g;
    }
  }
  return points;
}

/// Nodes of the facets by the numbers in the mesh as it was made, -1 for
/// others.
std::vector<std::int32_t> here(const mesh::Halo& halo,
                               const geometry::FacetList& facets,
                               std::span<const std::int64_t> original)
{
  std::unordered_map<std::int64_t, std::int32_t> node_of;
  for (const std::int32_t node : facets.nodes)
    node_of[halo.original()[node]] = node;
  std::vector<std::int32_t> nodes(original.size(), -1);
  for (std::size_t i = 0; i < nodes.size(); ++i)
    if (const auto found = node_of.find(original[i]); found != node_of.end())
      nodes[i] = found->second;
  return nodes;
}
} // namespace

AreaVectors contactx::audit::area_vectors_of_all(const mesh::Halo& halo,
                                                 const geometry::FacetList& own,
                                                 std::span<const double> x)
{
  const int g = halo.gdim();
  AreaVectors found{geometry::nodal_area_vectors(own, x, g),
                    geometry::nodal_areas(own, x, g)};
  halo.reverse(std::span(found.vectors), g);
  halo.reverse(std::span(found.areas), 1);
  const auto n = std::size_t(halo.num_owned());
  found.vectors.resize(n * g);
  found.areas.resize(n);
  return found;
}

std::vector<double>
contactx::audit::normals_of_all(const mesh::Halo& halo,
                                const geometry::FacetList& own,
                                std::span<const double> x)
{
  const auto [vectors, areas] = area_vectors_of_all(halo, own, x);
  return geometry::unit_normals(vectors, areas, halo.gdim());
}

std::vector<double>
contactx::audit::even_normals(const mesh::Halo& halo,
                              const geometry::FacetList& own,
                              std::span<const double> x)
{
  const int g = halo.gdim();
  auto [normal, area] = area_vectors_of_all(halo, own, x);
  for (std::size_t i = 0; i < area.size(); ++i)
  {
    double* n = &normal[i * g];
    const double size = std::sqrt(dot(n, n, g));
    const bool is_even = size > 0 and size >= even_enough * area[i];
    for (int k = 0; k < g; ++k)
      n[k] = is_even ? n[k] / size : 0;
  }
  return mesh::spread(halo, normal, g);
}

FoundNodes contactx::audit::passed_nodes(
    const mesh::Halo& halo, const geometry::FacetList& own,
    const geometry::FacetList& facets, std::span<const double> x0,
    std::span<const double> x1, std::span<const std::int32_t> candidates,
    double tolerance)
{
  mesh::Ranks& ranks = halo.ranks();
  if (not mesh::anywhere(ranks, not candidates.empty()))
    return {};
  const auto near = near_facets(halo, facets, x0, x1, candidates, tolerance);
  if (not mesh::anywhere(ranks, not near.empty()))
    return {};
  const int g = halo.gdim();
  const Points points = points_of_all(halo, own, x0, x1, near);
  const Vector<3> origin0 = points.first(points.start, g);
  const Vector<3> origin1 = points.first(points.end, g);
  geometry::Moments sums
      = geometry::moments(facets, x0, x1, g, origin0, origin1);
  ranks.reduce(std::span<double>(sums), mesh::Reduction::sum);
  const std::vector<double> allowed(points.original.size(), tolerance);
  const auto nodes = here(halo, facets, points.original);
  const auto mine = crossings(facets, x0, x1, g,
                              geometry::rigid_motion(sums, g, origin0, origin1),
                              {points.start, points.end, points.normal0,
                               points.normal1, allowed, nodes});
  const auto which
      = passed(mesh::gathered<Crossing>(ranks, std::span(mine)), allowed);
  FoundNodes found;
  for (std::size_t i = 0; i < which.size(); ++i)
  {
    if (which[i] < 0)
      continue;
    if (found.count == 0)
    {
      found.first = points.original[i];
      const auto at = std::span(points.end).subspan(g * i, g);
      found.at.assign(at.begin(), at.end());
    }
    ++found.count;
  }
  return found;
}
