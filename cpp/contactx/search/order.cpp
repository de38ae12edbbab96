// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#include "order.h"
#include "box.h"
#include <utility>

using namespace contactx;
using namespace contactx::search;

namespace
{
constexpr int bits = 21; // an axis, three of them in a 64-bit key

/// The bits of `a` with two zeros after each.
std::uint64_t spread(std::uint64_t a)
{
  a = (a | a << 32) & 0x1f00000000ffff;
  a = (a | a << 16) & 0x1f0000ff0000ff;
  a = (a | a << 8) & 0x100f00f00f00f00f;
  a = (a | a << 4) & 0x10c30c30c30c30c3;
  return (a | a << 2) & 0x1249249249249249;
}
} // namespace

std::vector<std::int32_t>
contactx::search::spatial_order(std::span<const std::int32_t> nodes,
                                std::span<const double> x, int gdim)
{
  Box box = Box::empty();
  const auto point = [x, gdim](std::int32_t node)
  {
    Vector<3> p{};
    for (int k = 0; k < gdim; ++k)
      p[k] = x[static_cast<std::size_t>(node) * gdim + k];
    return p;
  };
  for (std::int32_t node : nodes)
    box.add(point(node));
  const Vector<3> extent = box.upper - box.lower;
  // One scale for all axes: cells are cubes
  const double size = std::max({extent[0], extent[1], extent[2]});
  const double scale = size > 0 ? ((1 << bits) - 1) / size : 0;

  std::vector<std::pair<std::uint64_t, std::int32_t>> keys(nodes.size());
  for (std::size_t i = 0; i < nodes.size(); ++i)
  {
    const Vector<3> p = scale * (point(nodes[i]) - box.lower);
    std::uint64_t key = 0;
    for (int k = 0; k < 3; ++k)
      // A coordinate that is no number has no place; any will do
      if (p[k] >= 0 and p[k] < (1 << bits))
        key |= spread(static_cast<std::uint64_t>(p[k])) << k;
    keys[i] = {key, static_cast<std::int32_t>(i)};
  }
  std::ranges::sort(keys);
  std::vector<std::int32_t> order(nodes.size());
  for (std::size_t i = 0; i < keys.size(); ++i)
    order[i] = keys[i].second;
  return order;
}
