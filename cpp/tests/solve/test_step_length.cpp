// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#include <contactx/math/vec.h>
#include <contactx/solve/step_length.h>
#include <functional>
#include <gtest/gtest.h>

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
  EXPECT_FALSE(step(0.9e-2));
  EXPECT_FALSE(step(0.9e-2));
  EXPECT_FALSE(step(1.1e-2));
  EXPECT_FALSE(step(0));
  EXPECT_FALSE(step(0.9e-2));
  EXPECT_TRUE(step(0.9e-2));
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

} // namespace
