// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#include <cmath>
#include <contactx/audit/far_side.h>
#include <gtest/gtest.h>
#include <stdexcept>

using namespace contactx::audit;

namespace
{
using Row = std::vector<double>;

bool is_far(const Row& own_before, const Row& own_after, const Row& before,
            const Row& after)
{
  return far_side(own_before, own_after, before, after, 2)[0] == 1;
}

Row at(double degrees)
{
  const double t = degrees * std::acos(-1) / 180;
  return {std::cos(t), std::sin(t)};
}

TEST(FarSide, IsWhereAnObstacleWentThroughASheet)
{
  EXPECT_TRUE(is_far(at(90), at(90), at(270), at(90)));
  EXPECT_TRUE(is_far(at(90), at(80), at(225), at(60)));
}

TEST(FarSide, IsNotWhereABodyRollsOff)
{
  // Own normal and the obstacle's turn together
  EXPECT_FALSE(is_far(at(90), at(220), at(270), at(20)));
  EXPECT_FALSE(is_far(at(90), at(190), at(270), at(100)));
}

TEST(FarSide, IsNotWhereANodeSlidesAroundTheObstacle)
{
  EXPECT_FALSE(is_far(at(90), at(170), at(270), at(350)));
}

TEST(FarSide, IsNotWhereAnObstaclePassesByOverASheet)
{
  EXPECT_FALSE(is_far(at(90), at(90), at(190), at(350)));
}

TEST(FarSide, IsNotWhereANodeFacedAwayBefore)
{
  EXPECT_FALSE(is_far(at(270), at(270), at(270), at(90)));
}

TEST(FarSide, RefusesNormalsOfDifferentNumbers)
{
  EXPECT_THROW(far_side(at(0), at(0), at(0), Row(4), 2), std::invalid_argument);
}
} // namespace
