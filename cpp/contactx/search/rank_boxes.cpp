// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#include "rank_boxes.h"
#include "../geometry/facets.h"
#include "../geometry/middle.h"
#include "../geometry/shape.h"
#include <algorithm>
#include <cmath>
#include <limits>

using namespace contactx;
using namespace contactx::search;

namespace
{
/// In place of a sine, larger than any: all normals are in the cone
constexpr double no_cone = 2;

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

/// Axis and sine of half the angle of a cone around the facets' normals.
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
    return {{}, no_cone};
  axis = (1 / length) * axis;
  double cosine = 1;
  for (const Vector<3>& n : normals)
    cosine = std::min(cosine, dot(n, axis));
  // All normals oppose a point's unless its own is within 90 degrees less that
  // angle of the axis
  const double sine
      = cosine > 0 ? std::sqrt(std::max(0.0, 1 - cosine * cosine)) : no_cone;
  return {axis, sine + box_slack};
}
} // namespace

RankBoxes::RankBoxes(mesh::Ranks& ranks, const geometry::FacetList& own,
                     std::span<const double> x, int gdim)
    : _gdim(gdim), _num_ranks(ranks.size())
{
  const std::size_t g = gdim;
  std::vector<double> box(3 * g + 1, 0);
  const std::span mine(box);
  std::ranges::fill(mine.first(g), infinity);
  std::ranges::fill(mine.subspan(g, g), -infinity);
  for (const std::int32_t node : own.nodes)
  {
    const auto p = x.subspan(node * g, g);
    // Points that are not finite are not within reach
    if (not std::ranges::all_of(p, [](double c) { return std::isfinite(c); }))
      continue;
    for (std::size_t k = 0; k < g; ++k)
    {
      mine[k] = std::min(mine[k], p[k]);
      mine[g + k] = std::max(mine[g + k], p[k]);
    }
  }
  const auto [axis, sine] = cone(own, x);
  std::copy_n(axis.begin(), g, mine.begin() + 2 * g);
  mine[3 * g] = sine;
  _every = ranks.gather(mine);
  for (int r = 0; r < _num_ranks; ++r)
    if (there(r))
      for (std::size_t k = 0; k < g; ++k)
        _slack = std::max({_slack, box_slack * std::abs(low(r)[k]),
                           box_slack * std::abs(high(r)[k])});
}

bool RankBoxes::there(int rank) const { return low(rank)[0] <= high(rank)[0]; }

std::span<const double> RankBoxes::low(int rank) const
{
  return std::span(_every).subspan((3 * _gdim + 1) * rank, _gdim);
}

std::span<const double> RankBoxes::high(int rank) const
{
  return std::span(_every).subspan((3 * _gdim + 1) * rank + _gdim, _gdim);
}

std::span<const double> RankBoxes::axis(int rank) const
{
  return std::span(_every).subspan((3 * _gdim + 1) * rank + 2 * _gdim, _gdim);
}

double RankBoxes::sine(int rank) const
{
  return _every[(3 * _gdim + 1) * rank + 3 * _gdim];
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
  for (int r = 0; r < _num_ranks; ++r)
    if (there(r) and distance(low(r), high(r), from, to) - _slack <= most)
      near.ranks.push_back(r);
  const std::size_t m = near.ranks.size();
  near.distance.assign(n * m, infinity);
  for (std::size_t i = 0; i < n; ++i)
  {
    const auto p = points.subspan(i * g, g), normal = normals.subspan(i * g, g);
    const bool any
        = std::ranges::all_of(normal, [](double c) { return c == 0; });
    for (std::size_t j = 0; j < m; ++j)
    {
      const int r = near.ranks[j];
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

std::vector<std::int8_t>
RankBoxes::from_facets(std::span<const double> x,
                       const geometry::FacetList& slave, double reach,
                       double margin) const
{
  std::vector<std::int8_t> near(
      static_cast<std::size_t>(slave.size()) * _num_ranks, 0);
  for (std::int32_t f = 0; f < slave.size(); ++f)
  {
    const Vector<3> middle = geometry::middle(slave[f], x, _gdim);
    Vector<3> normal = geometry::corner_normals(slave[f], x).mean();
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
    for (int r = 0; r < _num_ranks; ++r)
    {
      if (!there(r))
        continue;
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
      near[static_cast<std::size_t>(f) * _num_ranks + r]
          = !std::isfinite(height)
            or (std::abs(height) <= upright + reach + wide
                and beside <= norm(half) + wide);
    }
  }
  return near;
}
