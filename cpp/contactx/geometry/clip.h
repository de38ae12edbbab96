// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#pragma once

#include "../math/scales.h"
#include "projection_plane.h"

namespace contactx::geometry
{
/// @brief Convex part of a plane that two facets share: an interval, or a
/// polygon traversed counterclockwise.
template <int D>
struct Overlap
{
  static constexpr int most = D == 1 ? 2 : 8; ///< corners of two quadrilaterals
  std::array<Vector<D>, most + 1> corner;
  int size = 0; ///< number of corners, 0 where nothing is shared

  void push(const Vector<D>& p)
  {
    if (size <= most)
      corner[size++] = p;
  }
};

/// @brief Corners of a facet in a plane, in order and counterclockwise; none of
/// a facet whose position is no number.
/// @param[in] r Nodes in the plane.
template <class F>
Overlap<F::tdim> outline(const Flat<F>& r)
{
  Overlap<F::tdim> p;
  if constexpr (F::tdim == 1)
  {
    const bool turned = r[0][0] > r[1][0];
    p.push(r[turned]);
    p.push(r[!turned]);
    if (!std::isfinite(r[1][0] - r[0][0]))
      p.size = 0;
  }
  else
  {
    for (const auto& edge : F::edges)
      p.push(r[edge.first]);
    double area = 0;
    for (int i = 0; i < p.size; ++i)
    {
      const auto &a = p.corner[i], &b = p.corner[(i + 1) % p.size];
      area += a[0] * b[1] - a[1] * b[0];
    }
    if (area < 0)
      std::reverse(p.corner.begin(), p.corner.begin() + p.size);
    if (!std::isfinite(area))
      p.size = 0;
  }
  return p;
}

/// @brief True if a facet is convex in a plane. A quadrilateral that is not has
/// no inverse map: it is folded, if only as seen along the projection.
/// @param[in] r Nodes in the plane.
template <class F>
bool is_convex(const Flat<F>& r)
{
  if constexpr (!F::flat)
  {
    double least = 0, most = 0;
    for (int i = 0; i < F::nodes; ++i)
    {
      const auto& [from, to] = F::edges[i];
      const auto e = r[to] - r[from];
      const auto f = r[F::edges[(i + 1) % F::nodes].second] - r[to];
      const double turn = e[0] * f[1] - e[1] * f[0];
      least = std::min(least, turn);
      most = std::max(most, turn);
    }
    // Three nodes on a line are no fold
    return std::min(-least, most)
           <= math::equal_rel_tol * std::max(-least, most);
  }
  return true;
}

/// @brief Intersection of two intervals.
inline Overlap<1> clip(const Overlap<1>& a, const Overlap<1>& b)
{
  Overlap<1> c;
  if (a.size == 0 or b.size == 0)
    return c;
  const double low = std::max(a.corner[0][0], b.corner[0][0]);
  const double high = std::min(a.corner[1][0], b.corner[1][0]);
  if (low < high)
  {
    c.push({low});
    c.push({high});
  }
  return c;
}

/// @brief Edges of a convex polygon that cut.
///
/// Where round-off turns a corner clockwise, the shorter of its edges would cut
/// the wrong side away: nodes that coincide but for round-off, or three on a
/// line.
class CuttingEdges
{
public:
  explicit CuttingEdges(const Overlap<2>& p) : _size(p.size)
  {
    for (int i = 0; i < _size; ++i)
      _edge[i] = p.corner[(i + 1) % _size] - p.corner[i];
    for (int i = 0; i < _size; ++i)
    {
      const Vector<2>&before = _edge[previous(i)], &after = _edge[i];
      _turn[i] = before[0] * after[1] - before[1] * after[0];
      _most = std::max(_most, std::abs(_turn[i]));
    }
  }

  const Vector<2>& operator[](int i) const { return _edge[i]; }

  bool cuts(int i) const
  {
    const Vector<2>& e = _edge[i];
    if (e[0] == 0 and e[1] == 0)
      return false;
    const int next = (i + 1) % _size;
    return not(is_rounding(i) and is_shorter(i, previous(i), true))
           and not(is_rounding(next) and is_shorter(i, next, false));
  }

private:
  int previous(int i) const { return (i + _size - 1) % _size; }

  bool is_rounding(int corner) const
  {
    return _turn[corner] < 0 and _turn[corner] >= -math::equal_rel_tol * _most;
  }

  bool is_shorter(int i, int j, bool or_equal) const
  {
    const double a = dot(_edge[i], _edge[i]), b = dot(_edge[j], _edge[j]);
    return a < b or (or_equal and a == b);
  }

  std::array<Vector<2>, Overlap<2>::most + 1> _edge;
  std::array<double, Overlap<2>::most + 1> _turn; // at the start of each edge
  double _most = 0;
  int _size;
};

/// @brief Intersection of two convex polygons: the one is cut with each edge of
/// the other. I. E. Sutherland and G. W. Hodgman, Commun. ACM 17, 1974.
inline Overlap<2> clip(Overlap<2> a, const Overlap<2>& b)
{
  int edges = 0;
  const CuttingEdges cutting(b);
  for (int i = 0; i < b.size and a.size > 0; ++i)
  {
    if (!cutting.cuts(i))
      continue;
    const Vector<2>& p = b.corner[i];
    const Vector<2>& e = cutting[i];
    ++edges;
    // Positive on the left of the edge
    const auto side = [&p, &e](const Vector<2>& q)
    { return e[0] * (q[1] - p[1]) - e[1] * (q[0] - p[0]); };
    Overlap<2> cut;
    double before = side(a.corner[a.size - 1]);
    for (int j = 0; j < a.size; ++j)
    {
      const Vector<2>& from = a.corner[(j + a.size - 1) % a.size];
      const Vector<2>& to = a.corner[j];
      const double now = side(to);
      if ((before > 0 and now < 0) or (before < 0 and now > 0))
        cut.push(from + (before / (before - now)) * (to - from));
      if (now >= 0)
        cut.push(to);
      before = now;
    }
    a = cut;
  }
  if (a.size < 3 or edges < 3)
    a.size = 0;
  return a;
}
} // namespace contactx::geometry
