// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#include <contactx/geometry/closest_point.h>
#include <gtest/gtest.h>

using namespace contactx;
using namespace contactx::geometry;

namespace
{
TEST(Sliver, KeepsItsWidthHoweverLongItIs)
{
  // The second node is one from the third, which is the point itself
  for (const double length : {1e4, 1e6, 2e7, 1e9})
  {
    const Nodes<Triangle> x{{{0.75, 0.75, length}, {0, -1, -1}, {-1, -1, -1}}};
    const auto c = closest_point<Triangle>(x, x[2]);
    EXPECT_LT(std::sqrt(c.distance2), 1e-15 * length);
  }
}
} // namespace
