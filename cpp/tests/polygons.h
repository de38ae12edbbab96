// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#pragma once

#include "facets.h"
#include <contactx/geometry/quadrature.h>

namespace contactx::tests
{
/// @brief Corners of a convex polygon, or both ends of an interval.
template <int D>
using Polygon = std::vector<Vector<D>>;

/// @brief Twice the area of the triangle a, b, c; positive if counterclockwise.
inline double turn(const Vector<2>& a, const Vector<2>& b, const Vector<2>& c)
{
  return (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
}

/// @brief Area of a polygon that is traversed counterclockwise.
inline double area(const Polygon<2>& p)
{
  double sum = 0;
  for (std::size_t i = 2; i < p.size(); ++i)
    sum += 0.5 * turn(p[0], p[i - 1], p[i]);
  return sum;
}

inline double area(const Polygon<1>& p)
{
  return p.empty() ? 0 : std::abs(p[1][0] - p[0][0]);
}

/// @brief Convex hull, counterclockwise. A. M. Andrew, Inf. Process. Lett. 9,
/// 1979.
inline Polygon<2> hull(Polygon<2> points)
{
  std::ranges::sort(points);
  Polygon<2> h;
  for (int pass = 0; pass < 2; ++pass)
  {
    const std::size_t first = h.size();
    for (const auto& p : points)
    {
      while (h.size() >= first + 2 and not(turn(h.end()[-2], h.back(), p) > 0))
        h.pop_back();
      h.push_back(p);
    }
    if (!h.empty())
      h.pop_back(); // the other pass begins with it
    std::ranges::reverse(points);
  }
  return h;
}

/// @brief Whether a convex polygon, counterclockwise, holds a point, but for
/// `slack`.
inline bool holds(const Polygon<2>& a, const Vector<2>& p, double slack)
{
  for (std::size_t i = 0; i < a.size(); ++i)
  {
    const Vector<2>&from = a[i], &to = a[(i + 1) % a.size()];
    if (turn(from, to, p) < -slack * norm(to - from))
      return false;
  }
  return true;
}

/// @brief What two convex polygons share: the hull of the corners of each that
/// lie in the other and of the points where edges cross.
inline Polygon<2> shared(const Polygon<2>& a, const Polygon<2>& b)
{
  constexpr double slack = 1e-14;
  Polygon<2> points;
  for (const auto& p : a)
    if (holds(b, p, slack))
      points.push_back(p);
  for (const auto& p : b)
    if (holds(a, p, slack))
      points.push_back(p);
  for (std::size_t i = 0; i < a.size(); ++i)
    for (std::size_t j = 0; j < b.size(); ++j)
    {
      const Vector<2>&p = a[i], e = a[(i + 1) % a.size()] - p;
      const Vector<2>&q = b[j], f = b[(j + 1) % b.size()] - q;
      const double det = e[0] * f[1] - e[1] * f[0];
      const Vector<2> d = q - p;
      const double s = (d[0] * f[1] - d[1] * f[0]) / det;
      const double t = (d[0] * e[1] - d[1] * e[0]) / det;
      if (s >= 0 and s <= 1 and t >= 0 and t <= 1)
        points.push_back(p + s * e);
    }
  return hull(points);
}

inline Polygon<1> shared(Polygon<1> a, Polygon<1> b)
{
  std::ranges::sort(a);
  std::ranges::sort(b);
  const double low = std::max(a[0][0], b[0][0]);
  const double high = std::min(a[1][0], b[1][0]);
  return low < high ? Polygon<1>{{low}, {high}} : Polygon<1>{};
}

/// @brief Call f(point, weight) at the points of a rule over a polygon, of
/// degree 30.
template <class Function>
void sample(const Polygon<2>& polygon, Function&& f)
{
  for (std::size_t i = 2; i < polygon.size(); ++i)
  {
    const Vector<2>&a = polygon[0], &b = polygon[i - 1], &c = polygon[i];
    for (const auto& [s, ws] : geometry::gauss(geometry::max_points))
      for (const auto& [t, wt] : geometry::gauss(geometry::max_points))
        f(a + s * ((1 - t) * (b - a) + t * (c - a)),
          s * ws * wt * turn(a, b, c));
  }
}

/// @brief Call f(point, weight) at the points of a rule over an interval.
template <class Function>
void sample(const Polygon<1>& interval, Function&& f)
{
  if (interval.empty())
    return;
  for (const auto& [s, w] : geometry::gauss(geometry::max_points))
    f(interval[0] + s * (interval[1] - interval[0]), w * area(interval));
}
} // namespace contactx::tests
