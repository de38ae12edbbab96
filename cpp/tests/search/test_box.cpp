// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#include "generator.h"
#include <contactx/search/box.h>
#include <gtest/gtest.h>

using namespace contactx;
using namespace contactx::search;
using namespace contactx::tests;

namespace
{
TEST(Box, EmptyOneIsInfinitelyFar)
{
  EXPECT_TRUE(std::isinf(Box::empty().distance2({1, 2, 3})));
}

TEST(Box, DistanceFromEachSide)
{
  Box b = Box::empty();
  b.add(Vector<3>{0, 0, 0});
  b.add(Vector<3>{1, 2, 3});
  EXPECT_EQ(b.distance2({0.5, 1, 1}), 0);
  EXPECT_EQ(b.distance2({1, 2, 3}), 0);
  EXPECT_EQ(b.distance2({-2, 1, 1}), 4);
  EXPECT_EQ(b.distance2({3, 1, 1}), 4);
  EXPECT_EQ(b.distance2({0.5, 5, 5}), 13);
  EXPECT_EQ(b.distance2({-1, -2, -3}), 14);
}

TEST(Box, IsNoFartherThanWhatItHolds)
{
  Generator random(1);
  for (int i = 0; i < 200; ++i)
  {
    Box a = Box::empty(), b = Box::empty();
    const Vector<3> p = random.vector<3>(-1, 1), q = random.vector<3>(-1, 1);
    a.add(p);
    b.add(q);
    b.add(a);
    const Vector<3> point = random.vector<3>(-2, 2);
    EXPECT_LE(b.distance2(point), dot(p - point, p - point));
    EXPECT_LE(b.distance2(point), dot(q - point, q - point));
  }
}

TEST(Box, PassesOverPointsThatAreNotNumbers)
{
  Box b = Box::empty();
  b.add(Vector<3>{0, 0, 0});
  b.add(Vector<3>{std::nan(""), 1, 0});
  EXPECT_EQ(b.distance2({0, 2, 0}), 1);
}
} // namespace
