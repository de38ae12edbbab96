// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#pragma once

#include "frame.h"

namespace contactx::geometry
{
/// @brief Point of a facet that is closest to a given point.
template <class F>
struct ClosestPoint
{
  Local<F> xi;       ///< local coordinates
  int feature;       ///< interior, an edge or a vertex
  double distance2;  ///< squared distance
  Vector<F::gdim> d; ///< vector from the closest point to the given one
};

/// @brief Components of the projection of `d` on the plane of the tangents.
///
/// The second tangent is made orthogonal to the first, and so is `d`: the
/// determinant of the metric would lose a sliver's digits.
template <std::size_t D, std::size_t N>
std::array<double, N> tangential(const std::array<std::array<double, D>, N>& t,
                                 const std::array<double, D>& d)
{
  const double m = dot(t[0], t[0]);
  const double r = dot(d, t[0]) / m;
  if constexpr (N == 1)
    return {r};
  else
  {
    const double s = dot(t[0], t[1]) / m;
    const std::array<double, D> u = t[1] - s * t[0];
    const double y = dot(d - r * t[0], u) / dot(u, u);
    return {r - s * y, y};
  }
}

/// @brief Orthogonal projection on the facet's surface, extended beyond its
/// edges: (p - x(xi)) . t_a(xi) = 0. Newton's method on the bilinear facet,
/// one exact step on the flat ones.
/// @param[in] x Node coordinates.
/// @param[in] p Point to project.
/// @param[in,out] xi Start of the iteration; the projection on return.
/// @return False where the iteration found no projection.
template <class F>
bool project(const Nodes<F>& x, const Vector<F::gdim>& p, Local<F>& xi)
{
  // Relative to a node, so that no digits go to the distance from the origin
  Nodes<F> y;
  for (int l = 0; l < F::nodes; ++l)
    y[l] = x[l] - x[0];
  const Vector<F::gdim> q = p - x[0];

  constexpr int max_iterations = F::flat ? 1 : 30;
  double last = 0;
  for (int it = 0; it < max_iterations; ++it)
  {
    const auto t = tangents<F>(y, xi);
    const Vector<F::gdim> d = q - combine<F>(F::shape(xi), y);
    Local<F> step;
    if constexpr (F::flat)
      step = tangential(t, d);
    else
    {
      // Far from the facet the Hessian of the squared distance is not
      // positive; the metric alone still gives a descent direction
      Vector<3> H = metric(t);
      const double h = H[1] - dot(d, combine<F>(F::mixed_derivative, y));
      if (H[0] * H[2] - h * h > 0.1 * (H[0] * H[2] - H[1] * H[1]))
        H[1] = h;
      step = solve(H, Local<F>{dot(d, t[0]), dot(d, t[1])});
    }
    xi = xi + step;
    double size = 0;
    double scale = 1;
    for (int a = 0; a < F::tdim; ++a)
    {
      size += std::abs(step[a]);
      scale += std::abs(xi[a]);
    }
    if (!std::isfinite(size))
      return false;
    // The next step would be size^2 / last or less
    if (F::flat or size < 1e-15 * scale or size * size < 1e-16 * scale * last)
      return true;
    if (it > 0 and size >= last and size < 1e-6 * scale)
      return true; // only round-off is left
    last = size;
  }
  return false;
}

/// @brief Closest point on the edge from `a` to `b`.
/// @return Coordinate along the edge, in [0, 1].
template <std::size_t D>
double project_on_edge(const std::array<double, D>& a,
                       const std::array<double, D>& b,
                       const std::array<double, D>& p)
{
  const auto e = b - a;
  const double l2 = dot(e, e);
  return l2 > 0 ? std::clamp(dot(p - a, e) / l2, 0.0, 1.0) : 0.0;
}

/// @brief Start for the projection: the nearest of a coarse grid of points,
/// which keeps Newton's method on the right branch of a warped facet.
template <class F>
Local<F> projection_start(const Nodes<F>& x, const Vector<F::gdim>& p)
{
  Local<F> start{};
  if constexpr (!F::flat)
  {
    double best = infinity;
    for (double s : {1. / 6, 0.5, 5. / 6})
      for (double t : {1. / 6, 0.5, 5. / 6})
      {
        const auto d = p - combine<F>(F::shape({s, t}), x);
        if (const double d2 = dot(d, d); d2 < best)
        {
          best = d2;
          start = {s, t};
        }
      }
  }
  return start;
}

/// @brief Closest point of a facet, with the Voronoi region that `p` is in.
/// @param[in] x Node coordinates.
/// @param[in] p Point.
template <class F>
ClosestPoint<F> closest_point(const Nodes<F>& x, const Vector<F::gdim>& p)
{
  ClosestPoint<F> c{{}, interior, infinity, {}};
  Local<F> xi = projection_start<F>(x, p);
  if (project<F>(x, p, xi) and F::excess(xi) <= 1e-12)
  {
    const auto d = p - combine<F>(F::shape(xi), x);
    c = {xi, interior, dot(d, d), d};
    if constexpr (F::flat)
      return c;
  }

  for (std::size_t e = 0; e < F::edges.size(); ++e)
  {
    // From the lower end, so that the facets at an edge agree on the last bit
    const bool turned = x[F::edges[e].second] < x[F::edges[e].first];
    const int i = turned ? F::edges[e].second : F::edges[e].first;
    const int j = turned ? F::edges[e].first : F::edges[e].second;
    const double s = project_on_edge(x[i], x[j], p);
    const auto d = p - ((1 - s) * x[i] + s * x[j]);
    if (const double d2 = dot(d, d); d2 < c.distance2)
    {
      c.xi = (1 - s) * F::vertices[i] + s * F::vertices[j];
      c.distance2 = d2;
      c.d = d;
      if (s > 0 and s < 1)
        c.feature = 1 + e;
      else
        c.feature = 1 + F::num_edges + (s > 0 ? j : i);
    }
  }
  return c;
}
} // namespace contactx::geometry
