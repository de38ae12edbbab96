// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#include "rank_boxes.h"
#include "../geometry/facets.h"
#include "../geometry/middle.h"
#include "../geometry/shape.h"
#include "../math/scales.h"
#include "../math/vec.h"
#include <algorithm>
#include <cmath>
#include <limits>

using namespace contactx;
using namespace contactx::search;

namespace
{
/// Length of the vector from a box to another one, zero where they meet.
double distance(std::span<const double> low, std::span<const double> high,
                std::span<const double> from, std::span<const double> to)
{
  double d2 = 0;
  for (std::size_t k = 0; k < low.size(); ++k)
  {
    const double d = std::max({low[k] - to[k], from[k] - high[k], 0.0});
    d2 += d * d;
  }
  return std::sqrt(d2);
}

/// Axis and sine of half the angle of a cone around the facets' normals;
/// infinite where all normals are in it.
/// Normals within a facet are positive combinations of those at its corners.
std::pair<Vector<3>, double> cone(const geometry::FacetList& facets,
                                  std::span<const double> x)
{
  Vector<3> axis{};
  std::vector<Vector<3>> normals;
  for (std::int32_t f = 0; f < facets.size(); ++f)
  {
    const geometry::CornerNormals at = geometry::corner_normals(facets[f], x);
    for (int i = 0; i < at.size; ++i)
    {
      const double length = norm(at.normal[i]);
      Vector<3> n{};
      if (length > 0)
        n = (1 / length) * at.normal[i];
      axis = axis + n;
      normals.push_back(n);
    }
  }
  const double length = norm(axis);
  if (!(length > 0))
    return {{}, infinity};
  axis = (1 / length) * axis;
  double cosine = 1;
  for (const Vector<3>& n : normals)
    cosine = std::min(cosine, dot(n, axis));
  // All normals oppose a point's unless its own is within 90 degrees less that
  // angle of the axis
  const double sine
      = cosine > 0 ? std::sqrt(std::max(0.0, 1 - cosine * cosine)) : infinity;
  // Wider, as boxes are, so that round-off hides no rank
  return {axis, sine + math::equal_rel_tol};
}
} // namespace

RankBoxes::RankBoxes(mesh::Ranks& ranks, const geometry::FacetList& own,
                     std::span<const double> x, int gdim)
    : _gdim(gdim)
{
  const std::size_t g = gdim;
  std::vector<double> box(3 * g + 2, 0);
  box.front() = ranks.rank();
  const std::span low = std::span(box).subspan(1, g),
                  high = std::span(box).subspan(1 + g, g);
  std::ranges::fill(low, infinity);
  std::ranges::fill(high, -infinity);
  for (const std::int32_t node : own.nodes)
  {
    const auto p = x.subspan(node * g, g);
    // Points that are not finite are not within reach
    if (not std::ranges::all_of(p, [](double c) { return std::isfinite(c); }))
      continue;
    for (std::size_t k = 0; k < g; ++k)
    {
      low[k] = std::min(low[k], p[k]);
      high[k] = std::max(high[k], p[k]);
    }
  }
  if (low[0] <= high[0])
  {
    const auto [axis, sine] = cone(own, x);
    std::copy_n(axis.begin(), g, box.begin() + 1 + 2 * gdim);
    box.back() = sine;
  }
  else
    box.clear();
  _boxes = mesh::gathered<double>(ranks, box);
  for (int i = 0; i < size(); ++i)
    for (const double c : row(i).subspan(1, 2 * g))
      _slack = std::max(_slack, math::equal_rel_tol * std::abs(c));
}

int RankBoxes::size() const
{
  return static_cast<int>(_boxes.size()) / (3 * _gdim + 2);
}

std::span<const double> RankBoxes::row(int i) const
{
  const std::size_t width = 3 * _gdim + 2;
  return std::span(_boxes).subspan(i * width, width);
}

RankBoxes::Near RankBoxes::from_points(std::span<const double> points,
                                       std::span<const double> normals,
                                       std::span<const double> bound) const
{
  Near near;
  const std::size_t n = bound.size(), g = _gdim;
  if (n == 0)
    return near;
  std::vector<double> from(g, infinity), to(g, -infinity);
  for (std::size_t i = 0; i < n; ++i)
    for (std::size_t k = 0; k < g; ++k)
    {
      from[k] = std::min(from[k], points[i * g + k]);
      to[k] = std::max(to[k], points[i * g + k]);
    }
  const double most = std::ranges::max(bound);
  std::vector<int> which;
  for (int r = 0; r < size(); ++r)
    if (distance(low(r), high(r), from, to) - _slack <= most)
    {
      which.push_back(r);
      near.ranks.push_back(rank(r));
    }
  const std::size_t m = which.size();
  near.distance.assign(n * m, infinity);
  for (std::size_t i = 0; i < n; ++i)
  {
    const auto p = points.subspan(i * g, g), normal = normals.subspan(i * g, g);
    const bool any
        = std::ranges::all_of(normal, [](double c) { return c == 0; });
    for (std::size_t j = 0; j < m; ++j)
    {
      const int r = which[j];
      const double d = std::max(distance(low(r), high(r), p, p) - _slack, 0.0);
      double along = 0;
      for (std::size_t k = 0; k < g; ++k)
        along += normal[k] * axis(r)[k];
      if (d <= bound[i] and (any or along < sine(r)))
        near.distance[i * m + j] = d;
    }
  }
  return near;
}

std::map<int, std::vector<std::int32_t>>
RankBoxes::from_facets(std::span<const double> x,
                       const geometry::FacetList& slave, double reach,
                       std::span<const double> along) const
{
  std::map<int, std::vector<std::int32_t>> near;
  for (std::int32_t f = 0; f < slave.size(); ++f)
  {
    const Vector<3> middle = geometry::middle(slave[f], x, _gdim);
    Vector<3> normal = geometry::corner_normals(slave[f], x).mean();
    if (not along.empty())
      if (const Vector<3> other = vector_at(along, f, 3); norm(other) > 0)
        normal = other;
    normal = (1 / norm(normal)) * normal;
    double wide = 0;
    for (const std::int32_t node : slave[f])
    {
      Vector<3> p{};
      std::copy_n(x.begin() + static_cast<std::ptrdiff_t>(node) * _gdim, _gdim,
                  p.begin());
      wide = std::max(wide, norm(p - middle));
    }
    wide *= 2 * (1 + geometry::facet_margin);
    for (int r = 0; r < size(); ++r)
    {
      Vector<3> centre{}, half{};
      double upright = 0;
      for (int k = 0; k < _gdim; ++k)
      {
        centre[k] = (low(r)[k] + high(r)[k]) / 2 - middle[k];
        half[k] = (high(r)[k] - low(r)[k]) / 2 + _slack;
        upright += std::abs(normal[k]) * half[k];
      }
      const double height = dot(normal, centre);
      // Beside the prism: the distance from its axis
      const double beside = norm(centre - height * normal);
      if (not std::isfinite(height)
          or (std::abs(height) <= upright + reach + wide
              and beside <= norm(half) + wide))
        near[rank(r)].push_back(f);
    }
  }
  return near;
}
