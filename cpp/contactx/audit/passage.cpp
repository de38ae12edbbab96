// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#include "passage.h"
#include <algorithm>
#include <numeric>
#include <tuple>

using namespace contactx;
using namespace contactx::audit;

namespace
{
/// What a point has gone through and not come back from: facets that it entered
/// from the front, and others that it left on the other side.
class PathThrough
{
public:
  PathThrough(std::span<const Crossing> crossings, double tolerance)
      : _crossings(crossings), _tolerance(tolerance)
  {
  }

  void add(std::int32_t k)
  {
    const Crossing& c = _crossings[k];
    if (c.entering)
      enter(k, c.cosine);
    else if (!_way.empty())
      leave(k, c.cosine);
  }

  /// Crossing by which it entered what it has passed through, -1 for none.
  std::int32_t passed() const
  {
    for (const std::int32_t k : _way)
      if (!_crossings[k].entering)
        return _way[0];
    for (const std::int32_t k : _way)
      if (_crossings[k].after < -_tolerance)
        return k;
    return -1;
  }

private:
  bool inside() const { return _crossings[_way.back()].entering; }

  void enter(std::int32_t k, double cosine)
  {
    if (cosine < -oblique_cosine)
      _way.push_back(k);
    else if (cosine > oblique_cosine and !_way.empty() and !inside())
      _way.pop_back();
  }

  void leave(std::int32_t k, double cosine)
  {
    if (cosine > oblique_cosine)
      _way.push_back(k);
    else if (inside())
    {
      const bool slid_off = _crossings[_way.back()].before <= _tolerance;
      if (cosine < -oblique_cosine or slid_off)
        _way.pop_back();
      else
        _way.push_back(k);
    }
  }

  std::span<const Crossing> _crossings;
  double _tolerance;
  std::vector<std::int32_t> _way;
};
} // namespace

std::vector<std::int32_t>
contactx::audit::passed(std::span<const Crossing> crossings,
                        std::span<const double> tolerance)
{
  std::vector<std::int32_t> order(crossings.size());
  std::iota(order.begin(), order.end(), 0);
  std::ranges::stable_sort(order, {},
                           [crossings](std::int32_t k)
                           {
                             const Crossing& c = crossings[k];
                             return std::tuple(c.point, c.time, !c.entering);
                           });
  std::vector<std::int32_t> result(tolerance.size(), -1);
  for (std::size_t i = 0; i < order.size();)
  {
    const std::int32_t point = crossings[order[i]].point;
    PathThrough path(crossings, tolerance[point]);
    for (; i < order.size() and crossings[order[i]].point == point; ++i)
      path.add(order[i]);
    result[point] = path.passed();
  }
  return result;
}

Passages contactx::audit::passages(const geometry::FacetList& facets,
                                   std::span<const double> x0,
                                   std::span<const double> x1, int gdim,
                                   const MovedPoints& points)
{
  const std::size_t n = points.tolerance.size();
  Passages result{std::vector<std::int32_t>(n, -1), std::vector<double>(n, 0)};
  if (n == 0 or facets.size() == 0)
    return result;
  Vector<3> origin0{}, origin1{};
  const std::size_t first = static_cast<std::size_t>(facets.nodes[0]) * gdim;
  std::copy_n(x0.begin() + first, gdim, origin0.begin());
  std::copy_n(x1.begin() + first, gdim, origin1.begin());
  const auto motion = geometry::rigid_motion(
      geometry::moments(facets, x0, x1, gdim, origin0, origin1), gdim, origin0,
      origin1);
  const auto found = crossings(facets, x0, x1, gdim, motion, points);
  const auto which = passed(found, points.tolerance);
  for (std::size_t i = 0; i < n; ++i)
    if (which[i] >= 0)
    {
      result.facet[i] = found[which[i]].facet;
      result.time[i] = found[which[i]].time;
    }
  return result;
}
