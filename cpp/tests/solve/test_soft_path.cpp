// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#include <array>
#include <cmath>
#include <contactx/solve/soft_path.h>
#include <gtest/gtest.h>

using namespace contactx;
using namespace contactx::solve;

namespace
{
/// A step that opens half of the nodes of bodies of a stiffness over c.
HardStep opening(double stiffness) { return {-stiffness, 1, 100, 50}; }

TEST(LookAtStep, SumsOverClosedNodes)
{
  const std::array p{1.0, 2.0, 3.0, 4.0}, c{2.0, 2.0, 2.0, 2.0};
  const std::array g{-0.5, 0.25, std::nan(""), 1.0};
  const std::array area{1.0, 2.0, 3.0, 4.0}, change{1.0, -3.0, -9.0, -9.0};
  const std::array<std::int8_t, 4> status{law::slip, law::stick, law::open,
                                          law::open};
  const HardStep step = look_at_step({p, g, c}, area, status, change);
  EXPECT_EQ(step.work, -0.5 * 1 + 2 * 0.25 * -3);
  EXPECT_EQ(step.local, 2 * 0.25 + 2 * 2 * 0.0625);
  EXPECT_EQ(step.closed, 2);
  EXPECT_EQ(step.opening, 1);
}

TEST(SoftPath, BeginsWhereManyNodesOfSoftBodiesAreAboutToOpen)
{
  EXPECT_TRUE(SoftPath().begins(opening(0.0049)));
  EXPECT_FALSE(SoftPath().begins(opening(0.0051)));
  EXPECT_FALSE(SoftPath().begins({0.004, 1, 1000, 40}));
  EXPECT_TRUE(SoftPath().begins({0.004, 1, 1000, 41}));
  // Fewer are enough where they are very soft
  EXPECT_FALSE(SoftPath().begins({1e-3, 1, 1000, 10}));
  EXPECT_TRUE(SoftPath().begins({1e-3, 1, 1000, 11}));
  // Few nodes are found one by one
  EXPECT_FALSE(SoftPath().begins({1e-3, 1, 5, 5}));
  EXPECT_TRUE(SoftPath().begins({1e-3, 1, 6, 6}));
}

TEST(SoftPath, NeedsAStiffness)
{
  const double nan = std::nan("");
  EXPECT_FALSE(SoftPath().begins({0, 1, 100, 50}));
  EXPECT_FALSE(SoftPath().begins({1e-3, 0, 100, 50}));
  EXPECT_FALSE(SoftPath().begins({nan, 1, 100, 50}));
  EXPECT_FALSE(SoftPath().begins({1e-3, nan, 100, 50}));
}

TEST(SoftPath, IsAsSoftAsTheSoftestThatItHasSeen)
{
  SoftPath path;
  EXPECT_FALSE(path.begins({-1e-4, 1, 100, 0}));
  EXPECT_EQ(path.compliance(), 0);
  EXPECT_TRUE(path.begins(opening(0.001)));
  EXPECT_DOUBLE_EQ(path.compliance(), 1e4);
}

TEST(SoftPath, BeginsOnceAStep)
{
  SoftPath path;
  EXPECT_TRUE(path.begins(opening(0.001)));
  EXPECT_FALSE(path.begins(opening(0.001)));
  path.harden();
  EXPECT_EQ(path.compliance(), 0);
  EXPECT_FALSE(path.begins(opening(0.001)));
  path.begin_step();
  EXPECT_TRUE(path.begins(opening(0.002)));
  EXPECT_DOUBLE_EQ(path.compliance(), 500);
}

TEST(SoftPath, StaysAtALevelForThreeIterations)
{
  SoftPath path;
  path.begins(opening(1e-3));
  // The iterate where it begins is no iteration
  path.advance(0, 100, true);
  for (const double compliance : {1000., 50., 2.5})
    for (int i = 0; i < 3; ++i)
    {
      EXPECT_DOUBLE_EQ(path.compliance(), compliance);
      path.advance(50, 100, true);
    }
  EXPECT_EQ(path.compliance(), 0);
}

TEST(SoftPath, LeavesALevelThatHasSettled)
{
  SoftPath path;
  path.begins(opening(1e-3));
  path.advance(50, 100, true);
  path.advance(3, 100, true);
  EXPECT_DOUBLE_EQ(path.compliance(), 1000);
  path.advance(2, 100, true);
  EXPECT_DOUBLE_EQ(path.compliance(), 50);
  path.advance(1, 10, true);
  EXPECT_DOUBLE_EQ(path.compliance(), 2.5);
}

TEST(SoftPath, WaitsForFullSteps)
{
  SoftPath path;
  path.begins(opening(1e-3));
  path.advance(0, 100, true);
  for (int i = 0; i < 10; ++i)
    path.advance(0, 100, false);
  EXPECT_DOUBLE_EQ(path.compliance(), 1000);
}

TEST(SoftPath, HardContactStaysHard)
{
  SoftPath path;
  path.advance(50, 100, true);
  EXPECT_EQ(path.compliance(), 0);
}
} // namespace
