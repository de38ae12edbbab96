// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#include "surface_probe.h"
#include "../check.h"
#include "rank_boxes.h"
#include <algorithm>
#include <cmath>
#include <limits>

using namespace contactx;
using namespace contactx::search;

namespace
{
/// What a rank sees from a point. It is sent as it lies in memory, and the
/// values of the facets after all of them.
struct Sight
{
  std::int32_t point, inside;
  double distance, gap, height, margin, displacement;
};
static_assert(sizeof(Sight) == 2 * sizeof(std::int32_t) + 5 * sizeof(double));

/// Vector from the place of a facet that it has moved to.
Vector<3> moved(std::span<const std::int32_t> nodes,
                std::span<const double> nodal, std::span<const double> xi,
                int gdim)
{
  return geometry::visit(
      static_cast<int>(nodes.size()),
      [&]<class F>(F)
      {
        geometry::Local<F> at;
        std::copy_n(xi.begin(), F::tdim, at.begin());
        const auto N = F::shape(at);
        Vector<3> displacement{};
        for (int l = 0; l < F::nodes; ++l)
          for (int k = 0; k < gdim; ++k)
            displacement[k]
                += N[l] * nodal[static_cast<std::size_t>(nodes[l]) * gdim + k];
        return displacement;
      });
}

/// Take a row of what another rank sees.
void take(ProbeResult& seen, std::size_t i, const Sight& s,
          std::span<const double> values)
{
  seen.distance[i] = s.distance;
  seen.gap[i] = s.gap;
  seen.height[i] = s.height;
  seen.inside[i] = static_cast<std::int8_t>(s.inside);
  seen.margin[i] = s.margin;
  seen.displacement[i] = s.displacement;
  std::ranges::copy(values,
                    seen.values.begin()
                        + static_cast<std::ptrdiff_t>(i) * std::ssize(values));
}
} // namespace

ProbeResult::ProbeResult(std::size_t n, int width)
    : width(width), distance(n, infinity),
      gap(n, std::numeric_limits<double>::quiet_NaN()), height(gap),
      inside(n, 0), margin(n, 1), displacement(n, 0), values(n * width, 0)
{
}

SurfaceProbe::SurfaceProbe(std::shared_ptr<mesh::Halo> halo,
                           std::span<const std::int32_t> offsets,
                           std::span<const std::int32_t> nodes)
    : _halo(std::move(halo)),
      _finder({offsets.begin(), offsets.end()}, {nodes.begin(), nodes.end()},
              _halo->gdim())
{
}

ProbeResult
SurfaceProbe::query(std::span<const double> x, std::span<const double> points,
                    std::span<const double> normals, double reach,
                    std::span<const double> values, int width,
                    const std::optional<Displacements>& displacements)
{
  const int gdim = _halo->gdim();
  const std::size_t n = points.size() / gdim;
  check::positions(x.size(), _finder.surface().num_nodes(), gdim);
  check::positions(points.size(), 0, gdim, "points");
  check::rows(normals.size(), n, gdim, "normals", "point");
  check::rows(values.size(), num_facets(), width, "values", "facet");
  if (displacements)
  {
    check::positions(displacements->nodes.size(), _finder.surface().num_nodes(),
                     gdim, "ways");
    check::rows(displacements->points.size(), n, gdim, "ways", "point");
  }
  const std::span nodal
      = displacements ? displacements->nodes : std::span<const double>();
  const std::span own
      = displacements ? displacements->points : std::span<const double>();
  _finder.refit(x);
  mesh::Ranks& ranks = _halo->ranks();
  if (ranks.size() == 1)
    return see(x, points, normals, reach, values, width, own, nodal);

  const RankBoxes::Near near
      = RankBoxes(ranks, _finder.surface().facets(), x, gdim)
            .from_points(points, normals, std::vector<double>(n, reach));
  std::map<int, std::vector<std::int32_t>> asked;
  const std::size_t m = near.ranks.size();
  for (std::size_t i = 0; i < n; ++i)
    for (std::size_t j = 0; j < m; ++j)
      if (near.distance[i * m + j] < infinity)
        asked[near.ranks[j]].push_back(static_cast<std::int32_t>(i));
  mesh::Messages questions;
  for (const auto& [rank, which] : asked)
    for (const auto& table : {points, normals, own})
      if (!table.empty())
        for (const std::int32_t i : which)
          mesh::pack(questions[rank],
                     table.subspan(static_cast<std::size_t>(i) * gdim,
                                   static_cast<std::size_t>(gdim)));
  mesh::Messages answers;
  const int tables = displacements ? 3 : 2;
  for (const auto& [rank, bytes] : ranks.exchange(questions))
  {
    std::span<const std::byte> left = bytes;
    const std::size_t size = bytes.size() / sizeof(double) / tables;
    const auto p = mesh::unpack<double>(left, size);
    const auto normal = mesh::unpack<double>(left, size);
    const auto displacement
        = mesh::unpack<double>(left, displacements ? size : 0);
    const ProbeResult seen
        = see(x, p, normal, reach, values, width, displacement, nodal);
    std::vector<Sight> sights;
    std::vector<double> rows;
    for (std::size_t i = 0; i < seen.distance.size(); ++i)
    {
      if (not(seen.distance[i] < infinity))
        continue;
      sights.push_back({static_cast<std::int32_t>(i), seen.inside[i],
                        seen.distance[i], seen.gap[i], seen.height[i],
                        seen.margin[i], seen.displacement[i]});
      const auto row
          = seen.values.begin() + static_cast<std::ptrdiff_t>(i) * width;
      rows.insert(rows.end(), row, row + width);
    }
    mesh::pack<Sight>(answers[rank], sights);
    mesh::pack<double>(answers[rank], rows);
  }
  ProbeResult best(n, width);
  // By rank, so that of facets as near the same one is taken in every run
  for (const auto& [rank, bytes] : ranks.exchange(answers))
  {
    std::span<const std::byte> left = bytes;
    const std::size_t size
        = bytes.size() / (sizeof(Sight) + width * sizeof(double));
    const auto sights = mesh::unpack<Sight>(left, size);
    const auto rows = mesh::unpack<double>(left, size * width);
    for (std::size_t k = 0; k < size; ++k)
    {
      const std::size_t i = asked.at(rank)[sights[k].point];
      if (sights[k].distance < best.distance[i])
        take(best, i, sights[k], std::span(rows).subspan(k * width, width));
    }
  }
  return best;
}

ProbeResult SurfaceProbe::see(std::span<const double> x,
                              std::span<const double> points,
                              std::span<const double> normals, double reach,
                              std::span<const double> values, int width,
                              std::span<const double> displacements,
                              std::span<const double> nodal) const
{
  const int gdim = _halo->gdim();
  const std::size_t n = points.size() / gdim;
  const Surface& surface = _finder.surface();
  const FoundNearest found
      = _finder.find(x, points, normals, std::vector<double>(n, reach));
  ProbeResult seen(n, width);
  seen.distance = found.distance;
  for (std::size_t i = 0; i < n; ++i)
  {
    const std::int32_t f = found.facet[i];
    if (f < 0)
      continue;
    const std::span xi = std::span(found.xi).subspan(2 * i, 2);
    seen.gap[i] = seen.height[i] = found.gap[i];
    seen.inside[i] = found.feature[i] == geometry::interior;
    seen.margin[i] = outer_margin(surface, f, {xi[0], xi[1]});
    if (!displacements.empty())
    {
      Vector<3> displacement{}, normal{};
      std::copy_n(displacements.begin() + i * gdim, gdim, displacement.begin());
      std::copy_n(found.normal.begin() + 3 * i, 3, normal.begin());
      displacement = displacement - moved(surface.facets()[f], nodal, xi, gdim);
      seen.gap[i] += dot(normal, displacement);
      seen.displacement[i] = norm(displacement);
    }
    std::copy_n(values.begin() + static_cast<std::ptrdiff_t>(f) * width, width,
                seen.values.begin() + static_cast<std::ptrdiff_t>(i) * width);
  }
  return seen;
}
