// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#include "meeting.h"
#include "../math/scales.h"
#include <algorithm>

using namespace contactx;
using namespace contactx::geometry;

namespace
{
using Planes = std::span<const Vector<3>>;

/// The vectors along which only the distance from one plane changes; false
/// where a plane depends on the others.
bool set_dual(Planes normal, Meeting& at)
{
  const auto n = [&](int i) { return normal[at.plane[i]]; };
  if (at.count == 1)
    at.dual[0] = n(0);
  else if (at.count == 2)
  {
    const double cosine = dot(n(0), n(1)), square = 1 - cosine * cosine;
    if (square < math::negligible_part * math::negligible_part)
      return false;
    at.dual[0] = (1 / square) * (n(0) - cosine * n(1));
    at.dual[1] = (1 / square) * (n(1) - cosine * n(0));
  }
  else
  {
    const double volume = dot(n(0), cross(n(1), n(2)));
    if (std::abs(volume) < math::negligible_part)
      return false;
    for (int i = 0; i < 3; ++i)
      at.dual[i] = (1 / volume) * cross(n((i + 1) % 3), n((i + 2) % 3));
  }
  return true;
}

/// Whether the point where some planes meet is the nearest one.
bool is_nearest(Planes normal, std::span<const double> distance, double small,
                Meeting& at)
{
  if (not set_dual(normal, at))
    return false;
  at.offset = {};
  for (int i = 0; i < at.count; ++i)
    at.offset = at.offset + distance[at.plane[i]] * at.dual[i];
  for (int i = 0; i < at.count; ++i)
  {
    at.share[i] = dot(at.dual[i], at.offset);
    if (at.share[i] < -small)
      return false;
  }
  for (std::size_t i = 0; i < normal.size(); ++i)
    if (dot(normal[i], at.offset) < distance[i] - small)
      return false;
  return true;
}

/// Add the planes that pass through the nearest point as well: a movement
/// along the others leaves it there.
void add_touching(Planes normal, std::span<const double> distance, double small,
                  int gdim, Meeting& at)
{
  for (int i = 0; i < static_cast<int>(normal.size()) and at.count < gdim; ++i)
  {
    const auto end = at.plane.begin() + at.count;
    if (std::find(at.plane.begin(), end, i) != end
        or dot(normal[i], at.offset) > distance[i] + small)
      continue;
    Meeting more = at;
    more.plane[more.count++] = i;
    if (set_dual(normal, more))
      at = more;
  }
}

/// The first planes of those from `first` on that meet at the nearest point,
/// beside those that are chosen.
bool choose(Planes normal, std::span<const double> distance, double small,
            int count, int first, Meeting& at)
{
  if (at.count == count)
    return is_nearest(normal, distance, small, at);
  for (int i = first; i < static_cast<int>(normal.size()); ++i)
  {
    if (dot(normal[i], normal[i]) == 0)
      continue;
    at.plane[at.count++] = i;
    if (choose(normal, distance, small, count, i + 1, at))
      return true;
    --at.count;
  }
  return false;
}
} // namespace

std::optional<Meeting>
contactx::geometry::meeting(Planes normal, std::span<const double> distance,
                            int gdim)
{
  const double small = math::round_off * *std::ranges::max_element(distance);
  for (int count = 1; count <= gdim; ++count)
  {
    Meeting at;
    if (choose(normal, distance, small, count, 0, at))
    {
      if (count > 1)
        add_touching(normal, distance, small, gdim, at);
      return at;
    }
  }
  return std::nullopt;
}
