// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#pragma once

#include <contactx/search/surface.h>

namespace contactx::tests
{
/// @brief The search without a tree: the first of the closest facets.
inline std::optional<search::Projection>
brute_force(const search::Surface& surface, std::span<const double> x,
            const Vector<3>& p, const Vector<3>& normal, double reach)
{
  std::optional<search::Projection> best;
  for (std::int32_t f = 0; f < surface.facets().size(); ++f)
  {
    const auto q = search::closest(surface, f, x, p);
    // Of facets that are as near but for rounding the first one counts
    if (q and norm(q->d) <= reach
        and (norm(normal) == 0 or dot(q->normal, normal) < 0)
        and (!best
             or norm(q->d) < norm(best->d) - 1e-12 * (norm(q->d) + q->size)))
      best = q;
  }
  return best;
}
} // namespace contactx::tests
