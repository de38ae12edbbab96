// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#pragma once

#include "clip.h"
#include <span>

namespace contactx::geometry
{
/// Most points of a Gauss rule
inline constexpr int max_points = 16;

/// @brief Point of a rule on [0, 1] and its weight.
struct GaussPoint
{
  double x;
  double weight;
};

/// @brief Gauss-Legendre rule on [0, 1], exact up to degree 2 n - 1.
/// @param[in] n Number of points, from 1 to `max_points`.
std::span<const GaussPoint> gauss(int n);

/// @brief Integrate over an overlap.
/// @param[in] o Overlap.
/// @param[in] degree Degree of polynomials that are integrated exactly.
/// @param[in] f Called as f(point, weight).
template <class Function>
void integrate(const Overlap<1>& o, int degree, Function&& f)
{
  if (o.size == 0)
    return;
  const double from = o.corner[0][0], length = o.corner[1][0] - from;
  for (const auto& [x, weight] : gauss(std::min(degree / 2 + 1, max_points)))
    f(Vector<1>{from + x * length}, weight * length);
}

/// @copydoc integrate
template <class Function>
void integrate(const Overlap<2>& o, int degree, Function&& f)
{
  for (int i = 2; i < o.size; ++i)
  {
    const Vector<2>& p = o.corner[0];
    const Vector<2> a = o.corner[i - 1] - p, b = o.corner[i] - p;
    const double twice = a[0] * b[1] - a[1] * b[0];
    if (not(twice > 0))
      continue;
    if (degree <= 2)
    {
      // The midpoints of the edges
      f(p + 0.5 * a, twice / 6);
      f(p + 0.5 * b, twice / 6);
      f(p + 0.5 * (a + b), twice / 6);
      continue;
    }
    // A square collapsed into the triangle raises the degree by one
    const auto rule = gauss(std::min((degree + 1) / 2 + 1, max_points));
    for (const auto& [s, ws] : rule)
      for (const auto& [t, wt] : rule)
        f(p + (s * (1 - t)) * a + (s * t) * b, ws * wt * s * twice);
  }
}
} // namespace contactx::geometry
