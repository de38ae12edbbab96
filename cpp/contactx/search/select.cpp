// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#include "select.h"
#include "../geometry/gather.h"
#include "../geometry/ridge.h"
#include "../geometry/shape.h"
#include "../math/scales.h"
#include <cmath>

using namespace contactx;
using namespace contactx::search;

namespace
{
/// What the facets around a feature are to a point.
struct Around
{
  bool any = false;
  bool penetrated = true; ///< behind all of them
  Vector<3> mean{};       ///< sum of their normals
  std::optional<Projection> deepest;
  /// Of those whose margin holds the projection: the deepest and the one that
  /// holds it best
  std::optional<Projection> deepest_inside, inside;

  void add(const Projection& q)
  {
    any = true;
    penetrated = penetrated and q.gap < 0;
    mean = mean + q.normal;
    if (!deepest or q.gap < deepest->gap)
      deepest = q;
    if (q.excess > geometry::facet_margin)
      return;
    if (!deepest_inside or q.gap < deepest_inside->gap)
      deepest_inside = q;
    if (!inside or q.excess < inside->excess)
      inside = q;
  }
};

/// Whether a facet around a feature is nearer to a point than the feature: it
/// was passed over because it does not face the point.
bool is_passed_over(const Surface& surface, std::span<const double> x,
                    const Vector<3>& p, const Projection& nearest)
{
  const double distance = norm(nearest.d);
  const double near
      = distance - math::distance_round_off(distance, nearest.size);
  bool found = false;
  surface.for_each_around(nearest.facet, nearest.feature,
                          [&found, &surface, x, &p, near](std::int32_t f)
                          {
                            const auto q
                                = closest_within(surface, f, x, p, near * near);
                            found = found or (q and norm(q->d) < near);
                          });
  return found;
}

/// Beyond the edge or vertex of all facets around it: a ridge or a valley.
/// Nothing behind a ridge where what faces the point ends: how deep it is below
/// facets that are extended as far as to it says nothing.
std::optional<Projection> beyond_edge(const Surface& surface,
                                      std::span<const double> x,
                                      const Vector<3>& p, const Around& around,
                                      Projection nearest)
{
  const double distance = norm(nearest.d);
  const bool touching = distance <= math::solved_length_tol * nearest.size;
  if (!touching and dot(nearest.d, around.mean) <= 0)
  {
    if (is_passed_over(surface, x, p, nearest))
      return std::nullopt;
    return around.deepest;
  }

  // On the ridge every normal of the cone is as good: take the middle, or the
  // facet's own where the surface is folded on itself and has none
  const double length = norm(around.mean);
  if (!touching)
    nearest.normal = (1 / distance) * nearest.d;
  else if (length > math::round_off)
    nearest.normal = (1 / length) * around.mean;
  nearest.gap = distance;
  return nearest;
}
} // namespace

bool View::has(const Box& box, const Vector<3>& p,
               const Vector<3>& normal) const
{
  if (box.distance2(p) <= near * near)
    return true;
  double behind = 2 * moved;
  for (int k = 0; k < 3; ++k)
    behind += level * (box.upper[k] - box.lower[k]);
  const double height = box.height(p, normal);
  return height >= -behind
         or height
                >= -behind - turned * (std::sqrt(box.farthest2(p)) + 2 * moved);
}

std::optional<Projection> contactx::search::nearest_facet(
    const Surface& surface, const BoxTree& tree, std::span<const double> x,
    const Vector<3>& p, const Vector<3>& normal, double reach,
    std::int32_t hint, const Accepts& accepts, const View& view)
{
  std::optional<Projection> best;
  double best_d = reach, bound2 = reach * reach;
  const bool any = dot(normal, normal) == 0;
  const auto visit = [&best, &best_d, &bound2, &surface, &p, &normal, &accepts,
                      x, any, reach](std::int32_t f)
  {
    const auto q = closest_within(surface, f, x, p, bound2);
    if (!q or (!any and dot(q->normal, normal) >= 0))
      return;
    const double d = norm(q->d), tol = math::distance_round_off(d, q->size);
    if ((d < best_d - tol
         or (d <= best_d + tol and (!best or f < best->facet) and d <= reach))
        and (!accepts or accepts(*q)))
    {
      best = q;
      best_d = d;
      // Wider, so that round-off in a box's distance hides no facet as near
      const double wide = (1 + 1e-6) * d + 10 * tol;
      bound2 = std::min(bound2, wide * wide);
    }
  };
  if (hint >= 0)
    visit(hint);
  tree.nearest(p, bound2, visit,
               [&](const Box& box) { return any or view.has(box, p, normal); });
  return best;
}

std::optional<Projection> contactx::search::select(const Surface& surface,
                                                   std::span<const double> x,
                                                   const Vector<3>& p,
                                                   const Projection& nearest)
{
  if (nearest.feature == geometry::interior)
    return nearest;

  Around around;
  surface.for_each_around(nearest.facet, nearest.feature,
                          [&around, &surface, x, &p](std::int32_t f)
                          {
                            if (const auto q = extended(surface, f, x, p))
                              around.add(*q);
                          });
  if (around.inside)
    return around.penetrated ? around.deepest_inside : around.inside;
  if (!around.any or surface.on_boundary(nearest.facet, nearest.feature))
    return std::nullopt;
  return beyond_edge(surface, x, p, around, nearest);
}

Vector<3> contactx::search::cone_components(const Surface& surface,
                                            std::span<const double> x,
                                            const Projection& projection)
{
  const auto nodes = surface.facets()[projection.facet];
  return geometry::visit(
      nodes.size(),
      [&projection, nodes, x]<class F>(F)
      {
        geometry::Local<F> xi;
        std::copy_n(projection.xi.begin(), F::tdim, xi.begin());
        const auto axes = geometry::ridge_axes<F>(geometry::gather<F>(nodes, x),
                                                  projection.feature, xi);
        Vector<3> c{};
        for (int i = 0; i < F::gdim; ++i)
          for (int k = 0; k < F::gdim; ++k)
            c[F::gdim == 2 and i == 1 ? 2 : i]
                += projection.normal[k] * axes[i][k];
        return c;
      });
}
