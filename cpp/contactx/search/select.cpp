// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#include "select.h"
#include "../facet/gather.h"
#include "../facet/ridge.h"

using namespace contactx;
using namespace contactx::search;

namespace
{
/// Beyond the edge or vertex of all facets around it: a ridge or a valley.
Projection beyond_edge(std::span<const Projection> around, Projection nearest)
{
  Vec<3> mean{};
  for (const Projection& q : around)
    mean = mean + q.normal;
  const double distance = norm(nearest.d);
  const bool touching = distance <= 1e-10 * nearest.size;
  if (!touching and dot(nearest.d, mean) <= 0)
    return *std::ranges::min_element(around, {}, &Projection::gap);

  // On the ridge every normal of the cone is as good: take the middle
  nearest.normal
      = touching ? (1 / norm(mean)) * mean : (1 / distance) * nearest.d;
  nearest.gap = distance;
  return nearest;
}
} // namespace

std::optional<Projection>
contactx::search::nearest_facet(const Surface& surface, const BoxTree& tree,
                                std::span<const double> x, const Vec<3>& p,
                                const Vec<3>& normal, double reach)
{
  std::optional<Projection> best;
  double best2 = reach * reach, bound2 = best2;
  const bool any = dot(normal, normal) == 0;
  tree.nearest(
      p, bound2,
      [&best, &best2, &bound2, &surface, &p, &normal, x, any](std::int32_t f)
      {
        const auto q = closest(surface, f, x, p);
        if (!q or (!any and dot(q->normal, normal) >= 0))
          return;
        const double d2 = dot(q->d, q->d);
        if (d2 < best2 or (d2 == best2 and (!best or f < best->facet)))
        {
          best = q;
          best2 = d2;
          // Wider, so that rounding in a box's distance hides no tie
          bound2
              = std::min(bound2, (1 + 1e-6) * d2 + 1e-28 * q->size * q->size);
        }
      });
  return best;
}

std::optional<Projection> contactx::search::select(const Surface& surface,
                                                   std::span<const double> x,
                                                   const Vec<3>& p,
                                                   const Projection& nearest)
{
  if (nearest.feature == facet::interior)
    return nearest;

  std::vector<Projection> around;
  const Projection* inside = nullptr;
  for (std::int32_t f : surface.star(nearest.facet, nearest.feature))
    if (const auto q = extended(surface, f, x, p))
      around.push_back(*q);
  const bool penetrated
      = std::ranges::all_of(around, [](auto& q) { return q.gap < 0; });
  for (const Projection& q : around)
  {
    if (q.excess > margin)
      continue;
    if (!inside
        or (penetrated ? q.gap < inside->gap : q.excess < inside->excess))
      inside = &q;
  }
  if (inside)
    return *inside;
  if (around.empty() or surface.on_boundary(nearest.facet, nearest.feature))
    return std::nullopt;
  return beyond_edge(around, nearest);
}

Vec<3> contactx::search::cone_components(const Surface& surface,
                                         std::span<const double> x,
                                         const Projection& projection)
{
  const auto nodes = surface.facets()[projection.facet];
  return facet::visit(nodes.size(),
                      [&projection, nodes, x]<class F>(F)
                      {
                        facet::Local<F> xi;
                        std::copy_n(projection.xi.begin(), F::tdim, xi.begin());
                        const auto axes = facet::ridge_axes<F>(
                            facet::gather<F>(nodes, x), projection.feature, xi);
                        Vec<3> c{};
                        for (int i = 0; i < F::gdim; ++i)
                          for (int k = 0; k < F::gdim; ++k)
                            c[F::gdim == 2 and i == 1 ? 2 : i]
                                += projection.normal[k] * axes[i][k];
                        return c;
                      });
}
