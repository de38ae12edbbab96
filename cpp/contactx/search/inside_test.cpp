// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#include "inside_test.h"
#include "../check.h"
#include "../geometry/middle.h"
#include <algorithm>
#include <cmath>
#include <limits>

using namespace contactx;
using namespace contactx::search;

namespace
{
/// Cosine of the angle between the mean normal of a surface and any other one,
/// below which the surface may go around a body: a ramp on the far side is
/// enough, as upright facets face it from in front of the near one
constexpr double one_sided_cosine_min = 0.99;

/// Depth below a facet, over its size, up to which a point is on it: pairs may
/// keep a facet beyond its edges, and a point may represent a whole facet
constexpr double surface_depth_max = 0.2;
} // namespace

InsideTest::InsideTest(std::shared_ptr<mesh::Halo> halo,
                       std::span<const std::int32_t> offsets,
                       std::span<const std::int32_t> nodes)
    : _halo(std::move(halo)), _probe(_halo, offsets, nodes)
{
  const int gdim = _halo->gdim();
  const std::vector<double> normals
      = geometry::middles({offsets, nodes}, _halo->reference(), gdim).normals;
  Vector<3> mean{};
  for (std::size_t i = 0; i < normals.size(); ++i)
    mean[i % gdim] += normals[i];
  if (_halo->ranks().size() > 1)
    _halo->ranks().reduce(mean, mesh::Reduction::sum);
  const double length = norm(mean);
  double cosine = 1;
  for (std::size_t i = 0; length > 0 and i < normals.size(); i += gdim)
  {
    Vector<3> normal{};
    std::copy_n(normals.begin() + i, gdim, normal.begin());
    cosine = std::min(cosine, dot(normal, mean) / length);
  }
  _is_around = length == 0
               or mesh::least(_halo->ranks(), cosine) < one_sided_cosine_min;
}

std::vector<std::int8_t> InsideTest::find(std::span<const double> x,
                                          std::span<const double> points,
                                          std::span<const double> depth,
                                          std::span<const double> size,
                                          bool within_depth)
{
  const std::size_t g = _halo->gdim(), n = points.size() / g;
  check::rows(points.size(), n, static_cast<int>(g), "points", "point");
  check::rows(depth.size(), n, 1, "depth", "point");
  check::rows(size.size(), n, 1, "size", "point");
  std::vector<std::int8_t> result(n, 0);
  if (!_is_around)
    return result;
  std::vector<std::size_t> which;
  std::vector<double> at;
  for (std::size_t i = 0; i < n; ++i)
    if (depth[i] > surface_depth_max * size[i])
    {
      which.push_back(i);
      const auto point = points.subspan(i * g, g);
      at.insert(at.end(), point.begin(), point.end());
    }
  if (!mesh::anywhere(_halo->ranks(), !which.empty()))
    return result;
  // Of any normal: what is in front of the nearest facet is outside
  const ProbeResult seen
      = _probe.query(x, at, std::vector<double>(at.size(), 0),
                     std::numeric_limits<double>::infinity());
  for (std::size_t k = 0; k < which.size(); ++k)
  {
    const std::size_t i = which[k];
    const bool is_nearer = seen.distance[k] < depth[i];
    // Beside the end of a surface that is nearer than the facet below
    result[i] = std::isnan(seen.gap[k])
                    ? is_nearer
                    : seen.gap[k] > 0 and (is_nearer or not within_depth);
  }
  return result;
}
