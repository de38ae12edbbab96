// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#include "extent.h"
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

using namespace contactx;

namespace
{
/// Largest coordinates of points, and largest of their opposites.
class Ends
{
public:
  Ends() { _ends.fill(-std::numeric_limits<double>::infinity()); }

  void add(const double* x, int gdim)
  {
    for (int k = 0; k < gdim; ++k)
    {
      _ends[k] = std::max(_ends[k], x[k]);
      _ends[3 + k] = std::max(_ends[3 + k], -x[k]);
    }
  }

  Vector<3> extent(Ranks& ranks)
  {
    ranks.reduce(std::span<double>(_ends), Reduction::largest);
    Vector<3> size;
    for (int k = 0; k < 3; ++k)
      size[k] = std::max(_ends[k] + _ends[3 + k], 0.0);
    return size;
  }

  math::Scales scales(Ranks& ranks, int gdim)
  {
    const Vector<3> size = extent(ranks);
    math::Scales found;
    for (int k = 0; k < gdim; ++k)
    {
      for (const double end : {_ends[k], _ends[3 + k]})
        found.farthest = std::max(found.farthest, std::abs(end));
      found.length = std::max(found.length, size[k]);
    }
    return std::isfinite(found.farthest) ? found : math::Scales{};
  }

private:
  std::array<double, 6> _ends;
};
} // namespace

Vector<3> contactx::mesh::extent(Ranks& ranks, std::span<const double> x,
                                 int gdim)
{
  Ends ends;
  for (std::size_t i = 0; i + gdim <= x.size(); i += gdim)
    ends.add(&x[i], gdim);
  return ends.extent(ranks);
}

Vector<3> contactx::mesh::extent(Ranks& ranks,
                                 std::span<const std::int32_t> nodes,
                                 std::span<const double> x, int gdim)
{
  Ends ends;
  for (const std::int32_t node : nodes)
    ends.add(&x[static_cast<std::size_t>(node) * gdim], gdim);
  return ends.extent(ranks);
}

math::Scales contactx::mesh::scales(Ranks& ranks, std::span<const double> x,
                                    int gdim)
{
  Ends ends;
  for (std::size_t i = 0; i + gdim <= x.size(); i += gdim)
    ends.add(&x[i], gdim);
  return ends.scales(ranks, gdim);
}
