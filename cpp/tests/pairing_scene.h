// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#pragma once

#include "scene.h"
#include <contactx/search/pairing.h>

namespace contactx::tests
{
/// @brief A slave segment in the plane that faces down and a master polyline
/// below it, from left to right. The tests watch the segment's left node.
struct SlidingSegment
{
  std::vector<double> x; ///< left and right slave node, then the master
  search::Pairing pairing;

  explicit SlidingSegment(const std::vector<Vector<2>>& line)
      : x(4, 0), pairing({0, 2}, {0, 1}, offsets(line), nodes(line), 2)
  {
    for (const Vector<2>& p : line)
      x.insert(x.end(), p.begin(), p.end());
  }

  /// @brief Move the left node and search.
  /// @return Number of changed nodes in contact.
  std::int32_t search_at(const Vector<2>& p, bool closed, double reach = 10)
  {
    move_to(p);
    return pairing.update(x, reach,
                          std::vector<std::int8_t>{std::int8_t(closed), 0});
  }

  void move_to(const Vector<2>& p)
  {
    x[0] = p[0];
    x[1] = p[1];
    x[2] = p[0] + 0.01;
    x[3] = p[1];
  }

  std::int32_t facet() const { return pairing.facet()[0]; }
  std::int32_t feature() const { return pairing.feature()[0]; }

private:
  static std::vector<std::int32_t> offsets(const std::vector<Vector<2>>& line)
  {
    std::vector<std::int32_t> o;
    for (std::size_t i = 0; i < line.size(); ++i)
      o.push_back(2 * i);
    return o;
  }

  static std::vector<std::int32_t> nodes(const std::vector<Vector<2>>& line)
  {
    std::vector<std::int32_t> n;
    for (std::int32_t i = 1; i < std::ssize(line); ++i)
      n.insert(n.end(), {2 + i, 1 + i});
    return n;
  }
};
} // namespace contactx::tests
