// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#include <array>
#include <cmath>
#include <contactx/math/vec.h>
#include <contactx/solve/soft_path.h>
#include <contactx/solve/step_length.h>
#include <functional>
#include <gtest/gtest.h>
#include <limits>

using namespace contactx;
using namespace contactx::solve;

namespace
{
/// Number of trials of a step, judged by a function of its part.
int count_trials(StepLength& length,
                 const std::function<double(double)>& next_size)
{
  int count = 0;
  for (; length.has_trial() and count < 100; ++count)
    length.judge(next_size(length.part()));
  return count;
}

TEST(StepLength, OfUndampedStepsIsThatOfCells)
{
  StepLength length;
  length.begin_step(false, 1.0);
  for (double part : {1., 0.3, 1., 0.7})
  {
    length.begin(2, part);
    EXPECT_FALSE(length.has_trial());
    EXPECT_EQ(length.part(), part);
  }
  EXPECT_EQ(length.limited(), 2);
  EXPECT_EQ(length.damped(), 0);
}

TEST(StepLength, AStepAfterWhichTheNextIsShorterIsTaken)
{
  StepLength length;
  length.begin_step(true, 1.0);
  for (double part : {1., 0.4})
  {
    length.begin(2, part);
    EXPECT_EQ(count_trials(length, [](double t) { return (1 - t / 4) * 2; }),
              1);
    EXPECT_EQ(length.part(), part);
  }
  EXPECT_EQ(length.damped(), 0);
  EXPECT_EQ(length.limited(), 1);
}

TEST(StepLength, FollowsTheCurvatureOfTheWay)
{
  // The next correction is (1 - t) + h t^2 / 2 of this one (Deuflhard 2004,
  // lemma 3.7), which says 1 / h
  for (double h : {2.5, 4., 8.})
  {
    StepLength length;
    length.begin_step(true, 1.0);
    length.begin(3, 1);
    const int count = count_trials(length, [h](double t)
                                   { return 3 * (1 - t + h * t * t / 2); });
    EXPECT_EQ(count, 2);
    EXPECT_NEAR(length.part(), 1 / h, 1e-14);
    EXPECT_EQ(length.damped(), 1);
  }
}

TEST(StepLength, ShortensByAHalfAtLeastAndATenthAtMost)
{
  StepLength length;
  length.begin_step(true, 1.0);
  length.begin(1, 1);
  length.judge(1e6);
  EXPECT_NEAR(length.part(), 0.1, 1e-15);
  // A residual that is not finite there says nothing else
  length.judge(infinity);
  EXPECT_NEAR(length.part(), 0.01, 1e-15);
  // Barely too long
  length.judge(1 - 0.01 / 4 + 1e-6);
  EXPECT_NEAR(length.part(), 0.005, 1e-15);
  EXPECT_TRUE(length.has_trial());
}

TEST(StepLength, TakesWhatIsLeftAfterSixTrials)
{
  StepLength length;
  length.begin_step(true, 1.0);
  length.begin(1, 0.5);
  EXPECT_EQ(count_trials(length, [](double) { return infinity; }), 6);
  EXPECT_NEAR(length.part(), 0.5e-6, 1e-18);
  EXPECT_EQ(length.limited(), 1);
  EXPECT_EQ(length.damped(), 1);
}

TEST(StepLength, AStepThatIsNotFiniteOrNothingIsTakenInFull)
{
  StepLength length;
  length.begin_step(true, 1.0);
  length.begin(0, 1);
  EXPECT_FALSE(length.has_trial());
  EXPECT_EQ(length.part(), 1);
  for (double size : {infinity, std::nan("")})
  {
    length.begin(size, 0.1);
    EXPECT_FALSE(length.has_trial());
    EXPECT_EQ(length.part(), 1);
  }
  EXPECT_EQ(length.limited(), 0);
}

TEST(StepLength, StepsOfRoundingErrorsAreTakenInFull)
{
  // The next is no shorter, whatever part of this one is taken
  StepLength length;
  length.begin_step(true, 1e3);
  length.begin(0.9e-7, 1);
  EXPECT_FALSE(length.has_trial());
  EXPECT_EQ(length.part(), 1);
  length.begin(1.1e-7, 1);
  EXPECT_TRUE(length.has_trial());
  // While contacts change, multipliers may move where displacements do not
  length.note(true);
  length.begin(0.9e-7, 1);
  EXPECT_TRUE(length.has_trial());
  length.note(false);
  length.begin(0.9e-7, 1);
  EXPECT_FALSE(length.has_trial());
}

TEST(StepLength, IsStuckAfterThreeInTurnThatLeadNowhere)
{
  StepLength length;
  length.begin_step(false, 1.0);
  const auto step = [&length](double part)
  {
    length.begin(1, part);
    return length.is_stuck();
  };
  EXPECT_FALSE(step(0.9e-3));
  EXPECT_FALSE(step(0.9e-3));
  EXPECT_FALSE(step(1.1e-3));
  EXPECT_FALSE(step(0));
  EXPECT_FALSE(step(0.9e-3));
  EXPECT_TRUE(step(0.9e-3));
  EXPECT_TRUE(step(0));
  EXPECT_EQ(length.limited(), 7);
  length.begin_step(false, 1.0);
  EXPECT_FALSE(length.is_stuck());
  EXPECT_EQ(length.limited(), 0);
  EXPECT_EQ(length.part(), 1);
}

TEST(StepLength, NewtonOnTheArcTangentConverges)
{
  // Full steps diverge from beyond 1.39
  StepLength length;
  length.begin_step(true, 1.0);
  double x = 30;
  int iterations = 0;
  for (; std::abs(x) > 1e-12 and iterations < 50; ++iterations)
  {
    const double slope = 1 / (1 + x * x);
    const double step = std::atan(x) / slope;
    length.begin(std::abs(step), 1);
    count_trials(length, [&](double t)
                 { return std::abs(std::atan(x - t * step) / slope); });
    x -= length.part() * step;
  }
  EXPECT_LT(iterations, 15);
  EXPECT_GT(length.damped(), 0);
  EXPECT_FALSE(length.is_stuck());
}

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
  // A stiffness is needed
  const double nan = std::nan("");
  for (const auto& [work, local] :
       {std::pair{0., 1.}, {1e-3, 0.}, {nan, 1.}, {1e-3, nan}})
    EXPECT_FALSE(SoftPath().begins({work, local, 100, 50})) << work;
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

TEST(SoftPath, WaitsForFullStepsAndHardContactStaysHard)
{
  SoftPath path;
  path.advance(50, 100, true);
  EXPECT_EQ(path.compliance(), 0);
  path.begins(opening(1e-3));
  path.advance(0, 100, true);
  for (int i = 0; i < 10; ++i)
    path.advance(0, 100, false);
  EXPECT_DOUBLE_EQ(path.compliance(), 1000);
}

} // namespace
