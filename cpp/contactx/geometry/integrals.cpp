// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#include "integrals.h"
#include "../math/matrix.h"
#include "gather.h"
#include "segment.h"
#include <algorithm>
#include <numeric>

using namespace contactx;
using namespace contactx::geometry;

namespace
{
template <int N>
using Square = Eigen::Matrix<double, N, N>;

template <int N>
using Column = Eigen::Matrix<double, N, 1>;

/// Sums over all pairs of one slave facet.
template <class S>
struct Cover
{
  Square<S::nodes> mass = Square<S::nodes>::Zero(); ///< int M_s M_t
  double total = 0;                                 ///< area
};

/// A part of a slave facet.
template <class S>
struct SlavePart
{
  Places<S> places;
  SlaveFacet<Part<S>> projected;
  Vector<S::nodes> height; ///< of the nodes w of the basis, over its plane
};

/// Add int M_t rise of a pair of smooth patches.
template <class S, class M>
void add_rise(const SlavePart<S>& slave, const Nodes<S>& own,
              const SmoothFacet& slave_patch, const Nodes<M>& master,
              const Nodes<M>& other, const SmoothFacet& master_patch,
              double* rise)
{
  integrate<S, M>(
      slave.projected, master,
      [&](const auto& s, const auto& m, double w)
      {
        const auto basis = Basis<S>::functions(s.N);
        const double up = geometry::rise<S>(own, slave_patch, s.xi)
                          + geometry::rise<M>(other, master_patch, m.xi);
        for (int t = 0; t < S::nodes; ++t)
          rise[t] += w * basis[t] * up;
      },
      1);
}

/// Add int M_t N_l and int M_t gap of a pair, and int M_t.
template <class S, class M>
void add_pair(const SlavePart<S>& slave, const Nodes<M>& xm,
              const Places<M>& places, int width, Cover<S>& cover, double* area,
              double* weight, double* gap)
{
  Vector<M::nodes> high;
  for (int l = 0; l < M::nodes; ++l)
    high[l] = slave.projected.plane.height(xm[l]);
  integrate<S, M>(slave.projected, geometry::part_of<M>(xm, places),
                  [&](const auto& s, const auto& m, double w)
                  {
                    const auto basis
                        = Basis<S>::functions(trace<S>(s, slave.places));
                    const auto column = Column<S::nodes>::Map(basis.data());
                    const auto N = trace<M>(m, places);
                    const double g = dot(N, high) - dot(basis, slave.height);
                    cover.total += w;
                    cover.mass += w * column * column.transpose();
                    for (int t = 0; t < S::nodes; ++t)
                    {
                      const double wt = w * basis[t];
                      area[t] += wt;
                      gap[t] += wt * g;
                      for (int l = 0; l < M::nodes; ++l)
                        weight[width * t + l] += wt * N[l];
                    }
                  });
}

/// Area of a facet, of a quadrilateral to first order.
template <class S>
double facet_area(const Nodes<S>& x)
{
  const double jacobian = geometry::frame<S>(x, plane_origin<S>()).jacobian;
  return S::nodes == 3 ? 0.5 * jacobian : jacobian;
}

/// Plane of a part of a slave facet, along the mean of given normals of the
/// master unless it is zero, or along that of the facet.
template <class S>
ProjectionPlane<Part<S>>
plane_of(const Nodes<Part<S>>& part, const Nodes<S>& whole,
         std::span<const std::int32_t> parts, std::span<const double> normal)
{
  Vector<S::gdim> n{};
  if (not normal.empty())
    for (const std::int32_t f : parts)
      for (int k = 0; k < S::gdim; ++k)
        n[k] -= normal[3 * f + k];
  if (n == Vector<S::gdim>{})
    return part_plane<S>(part, geometry::is_linear<S>
                                   ? Vector<S::gdim>{}
                                   : FacetNormal<S>(whole).frame.n);
  return {part, parts.size() == 1 ? n : (1 / norm(n)) * n};
}

template <class F>
Places<F> places_of(const QuadraticFacets& parents, std::int32_t part)
{
  Places<F> places;
  for (int j = 0; j < Part<F>::nodes; ++j)
    places[j] = parents.places[4 * std::size_t(part) + j];
  return places;
}

/// What is integrated: the arguments of `integrals`.
struct Given
{
  const Side &slave, &master;
  const FacetPairs& pairs;
  std::span<const double> x, reference;
  int gdim;
  std::span<const double> normal, weight;
};

/// All pairs of a whole slave facet.
/// @param[in] begin First pair of each slave facet, and the end.
template <class S>
void integrate_whole(const Given& given, std::span<const std::int32_t> parts,
                     std::span<const std::size_t> begin, Integrals& all)
{
  using P = Part<S>;
  const QuadraticFacets& parents = *given.slave.parents;
  const std::size_t n = all.width;
  const auto w = geometry::gather<S>(parents.of(parts[0]), given.x);
  Cover<S> cover;
  double whole = 0;
  for (const std::int32_t f : parts)
  {
    const auto nodes = given.slave.facets[f];
    const auto xs = geometry::gather<P>(nodes, given.x);
    const auto X = geometry::gather<P>(nodes, given.reference);
    auto factor = SlaveFacet<P>::ones();
    if (not given.weight.empty())
      std::copy_n(given.weight.begin() + given.slave.facets.offsets[f],
                  P::nodes, factor.begin());
    double mean = 0;
    for (const double value : factor)
      mean += value / P::nodes;
    whole += mean * facet_area<P>(X);
    if (begin[f] == begin[f + 1])
      continue;
    SlavePart<S> part{places_of<S>(parents, f),
                      {plane_of<S>(xs, w, parts, given.normal), xs, X, factor},
                      {}};
    Vector<S::nodes> height;
    for (int t = 0; t < S::nodes; ++t)
      height[t] = part.projected.plane.height(w[t]);
    for (int t = 0; t < S::nodes; ++t)
      part.height[t] = Basis<S>::template coefficient<double>(t, height);
    for (int k = 0; k < given.gdim; ++k)
      all.normal[3 * f + k] = -part.projected.plane.n[k];
    for (std::size_t i = begin[f]; i < begin[f + 1]; ++i)
    {
      const std::int32_t m = given.pairs.master[i];
      const auto others = given.master.parents->of(m);
      geometry::visit_whole(
          S::gdim, static_cast<int>(others.size()),
          [&]<class M>(M)
          {
            if constexpr (M::gdim == S::gdim
                          and geometry::is_linear<M> == geometry::is_linear<S>)
              add_pair<S, M>(part, geometry::gather<M>(others, given.x),
                             places_of<M>(*given.master.parents, m),
                             static_cast<int>(n), cover, &all.area[n * f],
                             &all.weight[i * n * n], &all.gap[i * n]);
            if constexpr (M::gdim == S::gdim
                          and geometry::is_linear<M> and geometry::is_linear<S>)
              if (not all.rise.empty())
                add_rise<S, M>(part, X, given.slave.smooth[f],
                               geometry::gather<M>(others, given.x),
                               geometry::gather<M>(others, given.reference),
                               given.master.smooth[m], &all.rise[i * n]);
          });
    }
  }
  Column<S::nodes> area = Column<S::nodes>::Zero();
  for (const std::int32_t f : parts)
    area += Column<S::nodes>::Map(&all.area[n * f]);
  Square<S::nodes> dual = Square<S::nodes>::Zero();
  const auto inverse = cover.total > covered_fraction_min * whole
                           ? math::positive_inverse(cover.mass)
                           : std::nullopt;
  if (inverse)
    dual = area.asDiagonal() * *inverse;
  const auto combine = [&dual](double* values, std::size_t columns)
  {
    for (std::size_t l = 0; l < columns; ++l)
    {
      Eigen::Map<Column<S::nodes>, 0, Eigen::InnerStride<>> column(
          values + l, Eigen::InnerStride<>(columns));
      column = dual * column;
    }
  };
  for (const std::int32_t f : parts)
  {
    if (not inverse)
      Column<S::nodes>::Map(&all.area[n * f]).setZero();
    for (int s = 0; s < S::nodes; ++s)
      Column<S::nodes>::Map(&all.dual[n * (n * f + s)]) = dual.row(s);
    for (std::size_t i = begin[f]; i < begin[f + 1]; ++i)
    {
      combine(&all.weight[i * n * n], n);
      combine(&all.gap[i * n], 1);
      if (not all.rise.empty())
        combine(&all.rise[i * n], 1);
    }
  }
}
} // namespace

Integrals contactx::geometry::integrals(
    const Side& slave, const Side& master, const FacetPairs& pairs,
    std::span<const double> x, std::span<const double> reference, int gdim,
    std::span<const double> normal, std::span<const double> weight)
{
  const QuadraticFacets& parents = *slave.parents;
  Integrals all;
  all.width = std::max(parents.width, master.parents->width);
  const std::size_t n = all.width, count = slave.facets.size();
  all.weight.assign(pairs.size() * n * n, 0);
  all.gap.assign(pairs.size() * n, 0);
  if (not slave.smooth.empty())
    all.rise.assign(pairs.size() * n, 0);
  all.dual.assign(count * n * n, 0);
  all.area.assign(count * n, 0);
  all.normal.assign(count * 3, 0);
  std::vector<std::size_t> begin(count + 1, 0);
  for (const std::int32_t f : pairs.slave)
    ++begin[f + 1];
  std::partial_sum(begin.begin(), begin.end(), begin.begin());
  const Given given{slave, master, pairs, x, reference, gdim, normal, weight};
  for (std::int32_t k = 0; k < parents.size(); ++k)
  {
    const std::span parts
        = std::span(parents.parts)
              .subspan(parents.offsets[k],
                       parents.offsets[k + 1] - parents.offsets[k]);
    if (std::ranges::all_of(parts, [&begin](std::int32_t f)
                            { return begin[f] == begin[f + 1]; }))
      continue;
    geometry::visit_whole(gdim, parents.sizes[parts[0]], [&]<class S>(S)
                          { integrate_whole<S>(given, parts, begin, all); });
  }
  return all;
}

Integrals contactx::geometry::integrals(
    const FacetList& slave, const FacetList& master, const FacetPairs& pairs,
    std::span<const double> x, std::span<const double> reference, int gdim,
    std::span<const double> normal, std::span<const double> weight)
{
  const QuadraticFacets ours = geometry::quadratic_facets(slave, {});
  const QuadraticFacets theirs = geometry::quadratic_facets(master, {});
  return integrals({slave, &ours}, {master, &theirs}, pairs, x, reference, gdim,
                   normal, weight);
}
