// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#include "integrals.h"
#include "../facet/gather.h"
#include "segment.h"
#include "square.h"

using namespace contactx;
using namespace contactx::mortar;

namespace
{
/// Sums over all pairs of one slave facet.
template <class S>
struct Cover
{
  Square<S::nodes> mass{}; ///< int N_s N_t
  Vector<S::nodes> area{}; ///< int N_s
  double total = 0;        ///< area
};

/// Add int N_t N_l and int N_t gap of a pair.
template <class S, class M>
void add_pair(const SlaveFacet<S>& slave, const facet::Nodes<S>& xs,
              const facet::Nodes<M>& xm, Cover<S>& cover, double* weight,
              double* gap)
{
  Vector<S::nodes> low;
  Vector<M::nodes> high;
  for (int t = 0; t < S::nodes; ++t)
    low[t] = slave.plane.height(xs[t]);
  for (int l = 0; l < M::nodes; ++l)
    high[l] = slave.plane.height(xm[l]);
  integrate<M>(slave, xm,
               [&](const Shape<S>& s, const Shape<M>& m, double w)
               {
                 const double g = dot(m.N, high) - dot(s.N, low);
                 cover.total += w;
                 for (int t = 0; t < S::nodes; ++t)
                 {
                   const double wt = w * s.N[t];
                   cover.area[t] += wt;
                   cover.mass[t] = cover.mass[t] + wt * s.N;
                   gap[t] += wt * g;
                   for (int l = 0; l < M::nodes; ++l)
                     weight[most_nodes * t + l] += wt * m.N[l];
                 }
               });
}

/// Area of a facet, of a quadrilateral to first order.
template <class S>
double facet_area(const facet::Nodes<S>& x)
{
  const double jacobian = facet::frame<S>(x, plane_origin<S>()).jacobian;
  return S::nodes == 3 ? 0.5 * jacobian : jacobian;
}

/// Plane of a slave facet, projected along a given normal of the master.
template <class S>
Plane<S> plane_of(const facet::Nodes<S>& x, std::int32_t f,
                  std::span<const double> normal)
{
  if (normal.empty())
    return Plane<S>(x);
  Vector<S::gdim> n;
  for (int k = 0; k < S::gdim; ++k)
    n[k] = -normal[3 * f + k];
  return {x, n};
}

/// Rows combined with the coefficients of the dual functions.
template <class S>
void combine_rows(const Square<S::nodes>& dual, double* rows, int width)
{
  for (int l = 0; l < width; ++l)
  {
    Vector<S::nodes> column{};
    for (int s = 0; s < S::nodes; ++s)
      for (int t = 0; t < S::nodes; ++t)
        column[s] += dual[s][t] * rows[width * t + l];
    for (int s = 0; s < S::nodes; ++s)
      rows[width * s + l] = column[s];
  }
}
} // namespace

Integrals contactx::mortar::integrals(const facet::FacetList& slave,
                                      const facet::FacetList& master,
                                      const FacetPairs& pairs,
                                      std::span<const double> x,
                                      std::span<const double> reference,
                                      int gdim, std::span<const double> normal,
                                      std::span<const double> weight)
{
  constexpr int n = most_nodes;
  Integrals all;
  all.weight.assign(pairs.size() * n * n, 0);
  all.gap.assign(pairs.size() * n, 0);
  all.dual.assign(static_cast<std::size_t>(slave.size()) * n * n, 0);
  all.area.assign(static_cast<std::size_t>(slave.size()) * n, 0);
  all.normal.assign(static_cast<std::size_t>(slave.size()) * 3, 0);
  std::size_t first = 0;
  while (first < pairs.size())
  {
    const std::int32_t f = pairs.slave[first];
    std::size_t last = first;
    while (last < pairs.size() and pairs.slave[last] == f)
      ++last;
    facet::visit(static_cast<int>(slave[f].size()),
                 [&](auto kind)
                 {
                   using S = decltype(kind);
                   const auto xs = facet::gather<S>(slave[f], x);
                   const auto X = facet::gather<S>(slave[f], reference);
                   auto factor = SlaveFacet<S>::ones();
                   if (not weight.empty())
                     std::copy_n(weight.begin() + slave.offsets[f], S::nodes,
                                 factor.begin());
                   const SlaveFacet<S> projected(plane_of<S>(xs, f, normal), xs,
                                                 X, factor);
                   for (int k = 0; k < gdim; ++k)
                     all.normal[3 * f + k] = -projected.plane.n[k];
                   Cover<S> cover;
                   for (std::size_t i = first; i < last; ++i)
                   {
                     const auto nodes = master[pairs.master[i]];
                     mortar::visit(S::nodes, static_cast<int>(nodes.size()),
                                   [&](auto, auto other)
                                   {
                                     using M = decltype(other);
                                     if constexpr (M::gdim == S::gdim)
                                       add_pair<S, M>(
                                           projected, xs,
                                           facet::gather<M>(nodes, x), cover,
                                           &all.weight[i * n * n],
                                           &all.gap[i * n]);
                                   });
                   }
                   Square<S::nodes> dual{};
                   double mean = 0;
                   for (const double w : factor)
                     mean += w / S::nodes;
                   const bool covered
                       = cover.total > least_cover * mean * facet_area<S>(X)
                         and invert<S::nodes>(cover.mass, dual);
                   for (int s = 0; s < S::nodes; ++s)
                   {
                     dual[s] = (covered ? cover.area[s] : 0) * dual[s];
                     all.area[n * f + s] = covered ? cover.area[s] : 0;
                     std::copy(dual[s].begin(), dual[s].end(),
                               &all.dual[n * n * f + n * s]);
                   }
                   for (std::size_t i = first; i < last; ++i)
                   {
                     combine_rows<S>(dual, &all.weight[i * n * n], n);
                     combine_rows<S>(dual, &all.gap[i * n], 1);
                   }
                 });
    first = last;
  }
  return all;
}
