// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#pragma once

#include "mortar_reference.h"
#include <contactx/geometry/projection_plane.h>

namespace contactx::tests
{
/// @brief Area that two facets share as seen from the slave facet, none where
/// they do not look at one another.
/// @param[in] size What the slave facet is scaled with.
template <class S, class M>
double common_area(const geometry::Nodes<S>& xs, const geometry::Nodes<M>& xm,
                   double reach, double size = 1)
{
  const auto n = geometry::frame<S>(xs, geometry::plane_origin<S>()).n;
  if (dot(n, geometry::frame<M>(xm, geometry::plane_origin<M>()).n) > -0.1)
    return 0;
  const auto middle = position<S>(xs, geometry::plane_origin<S>());
  double low = 0, high = 0, nearest = INFINITY, farthest = -INFINITY;
  for (const auto& p : xs)
  {
    low = std::min(low, dot(n, p - middle));
    high = std::max(high, dot(n, p - middle));
  }
  for (const auto& p : xm)
  {
    nearest = std::min(nearest, dot(n, p - middle));
    farthest = std::max(farthest, dot(n, p - middle));
  }
  if (nearest > high + reach or farthest < low - reach)
    return 0;
  const Across<S::gdim> across(n);
  auto outline = across.template outline<S>(xs);
  geometry::Local<S> centre{};
  for (const auto& p : outline)
    centre = centre + (1.0 / outline.size()) * p;
  for (auto& p : outline)
    p = p + (size - 1) * (p - centre);
  return area(shared(outline, across.template outline<M>(xm)));
}

/// @brief Whether a facet is no simple polygon, or none that is convex, as seen
/// from another one.
template <class S, class M>
bool looks_folded(const geometry::Nodes<S>& xs, const geometry::Nodes<M>& xm)
{
  if constexpr (M::nodes < 4)
    return false;
  else
  {
    const Across<3> across(
        geometry::frame<S>(xs, geometry::plane_origin<S>()).n);
    const auto p = across.template outline<M>(xm);
    bool left = true;
    for (int i = 0; i < 4; ++i)
      left = left and turn(p[i], p[(i + 1) % 4], p[(i + 2) % 4]) > 0;
    return !left;
  }
}

/// @brief What must be found: 1 if they share an area, 0 if they are apart, -1
/// where rounding decides.
template <class S, class M>
int must_be_found(const geometry::Nodes<S>& xs, const geometry::Nodes<M>& xm,
                  double reach)
{
  if (looks_folded<S, M>(xs, xm))
    return 0;
  if (common_area<S, M>(xs, xm, reach) > 1e-12)
    return 1;
  return common_area<S, M>(xs, xm, reach, 1 + 1e-9) > 0 ? -1 : 0;
}
} // namespace contactx::tests
