// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#include <contactx/math/scales.h>
#include <gtest/gtest.h>

using namespace contactx::math;

TEST(Scales, ATouchingGapGrowsWithTheSceneAndWithItsPlace)
{
  const double near = Scales{.length = 2, .farthest = 2}.gap_round_off();
  EXPECT_DOUBLE_EQ(near, 2e-12 + 2 * sum_round_off);
  const double far = Scales{.length = 2, .farthest = 1e6}.gap_round_off();
  EXPECT_DOUBLE_EQ(far - near, (1e6 - 2) * sum_round_off);
}

TEST(Scales, ForcesThatDeformAreStiffnessTimesLength)
{
  const Scales scales{.length = 2, .farthest = 7, .stiffness = 3};
  EXPECT_EQ(scales.deforming_force(), 6);
}

TEST(Scales, ZeroAndEqualAreRelativeInAnyUnit)
{
  for (const double unit : {1e-20, 1., 1e20})
  {
    EXPECT_TRUE(is_zero(0.9 * round_off * unit, unit));
    EXPECT_TRUE(is_zero(-0.9 * round_off * unit, unit));
    EXPECT_FALSE(is_zero(1.1 * round_off * unit, unit));
    EXPECT_FALSE(is_zero(-1.1 * round_off * unit, unit));
    EXPECT_TRUE(is_largest((1 - 0.9 * equal_rel_tol) * unit, unit));
    EXPECT_FALSE(is_largest((1 - 1.1 * equal_rel_tol) * unit, unit));
    EXPECT_DOUBLE_EQ(distance_round_off(unit, 2 * unit), 3e-12 * unit);
  }
  EXPECT_TRUE(is_zero(0, 0));
}
