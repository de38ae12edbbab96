// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#include "projections.h"

using namespace contactx;
using namespace contactx::search;

Projections contactx::search::projections(const Surface& surface,
                                          std::span<const std::int32_t> facet,
                                          std::span<const double> x,
                                          std::span<const double> points,
                                          std::span<const double> xi)
{
  const int gdim = surface.gdim();
  Projections result{{xi.begin(), xi.end()},
                     std::vector<double>(facet.size(), 0)};
  for (std::size_t i = 0; i < facet.size(); ++i)
  {
    if (facet[i] < 0)
      continue;
    Vector<3> p{};
    std::copy_n(points.begin() + gdim * i, gdim, p.begin());
    if (const auto q = extended(surface, facet[i], x, p))
    {
      std::copy(q->xi.begin(), q->xi.end(), result.xi.begin() + 2 * i);
      result.gap[i] = q->gap;
    }
  }
  return result;
}

FacetPoints contactx::search::facet_points(const Surface& surface,
                                           std::span<const std::int32_t> facet,
                                           std::span<const double> x,
                                           std::span<const double> xi)
{
  const int gdim = surface.gdim();
  FacetPoints result{std::vector<double>(facet.size() * gdim, 0),
                     std::vector<double>(facet.size() * gdim, 0)};
  for (std::size_t i = 0; i < facet.size(); ++i)
  {
    if (facet[i] < 0)
      continue;
    const SurfacePoint q
        = point_at(surface, facet[i], x, {xi[2 * i], xi[2 * i + 1]});
    std::copy_n(q.x.begin(), gdim, result.x.begin() + gdim * i);
    std::copy_n(q.normal.begin(), gdim, result.normal.begin() + gdim * i);
  }
  return result;
}
