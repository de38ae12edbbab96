// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#include "bisector.h"
#include "../geometry/shape.h"
#include "../geometry/smooth.h"
#include "../math/scales.h"
#include "select.h"
#include <cmath>

using namespace contactx;
using namespace contactx::search;
using geometry::Segment;

std::optional<Projection> contactx::search::bisector(const Surface& surface,
                                                     std::span<const double> x,
                                                     const Vector<3>& p,
                                                     const Projection& q)
{
  if (surface.gdim() != 2)
    return std::nullopt;
  const int end = q.xi[0] > 0.5 ? 1 : 0;
  if (!(std::abs(q.xi[0] - end) <= geometry::facet_margin))
    return std::nullopt;

  std::int32_t first = -1;
  int count = 0;
  Vector<3> sum{};
  surface.for_each_around(
      q.facet, 1 + Segment::num_edges + end,
      [&](std::int32_t f)
      {
        const auto r = extended(surface, f, x, p);
        if (!r or !(std::abs(r->gap - q.gap) <= math::equal_rel_tol * q.size))
          return;
        first = first < 0 ? f : first;
        ++count;
        sum = sum + r->normal;
      });
  if (count != 2 or !(dot(sum, sum) > 2 + 2 * geometry::cosine_at_edges))
    return std::nullopt;
  const Vector<3> n = (1 / norm(sum)) * sum;
  if (norm(n - q.normal) <= math::negligible_part)
    return std::nullopt;

  // Of the first facet, whichever of them round-off has led to
  const std::int32_t node = surface.facets()[q.facet][end];
  const int vertex = surface.facets()[first][0] == node ? 0 : 1;
  const Vector<2> xi{static_cast<double>(vertex), 0};
  const Vector<3> d = p - point_at(surface, first, x, xi).x;
  return Projection{
      first, 1 + Segment::num_edges + vertex, xi, d, n, dot(n, d), 0, q.size};
}
