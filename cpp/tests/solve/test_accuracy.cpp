// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#include <contactx/solve/accuracy.h>
#include <gtest/gtest.h>

using contactx::solve::Accuracy;

namespace
{
constexpr double tolerance = 1e-12;

/// What the next solve may leave.
double target(Accuracy& accuracy, double residual, double changing,
              bool has_cycled = false)
{
  accuracy.set(residual, tolerance, changing, has_cycled);
  return accuracy.target();
}
} // namespace

TEST(Accuracy, IsAPartOfTheChangesOfTheActiveSet)
{
  Accuracy accuracy(false);
  EXPECT_EQ(accuracy.target(), 0);
  // The first two solves of a step are finer
  for (int k = 0; k < 2; ++k)
  {
    accuracy.begin_step();
    EXPECT_NEAR(target(accuracy, 2, 0.05), 9e-3, 1e-15);
    EXPECT_NEAR(target(accuracy, 2, 0.9), 1.8e-2, 1e-15);
  }
  EXPECT_NEAR(target(accuracy, 2, 1e-7), 6e-6, 1e-18);
  EXPECT_NEAR(target(accuracy, 2, 0.05), 3e-2, 1e-15);
  EXPECT_NEAR(target(accuracy, 2, 0.9), 6e-2, 1e-15);
  EXPECT_FALSE(accuracy.is_last());
}

TEST(Accuracy, IsThatOfExactSolvesInTheFirstIterateOfAPath)
{
  Accuracy accuracy(true);
  for (const double changing : {0., 1e-7, 0.05, 0.9})
  {
    accuracy.begin_step();
    EXPECT_NEAR(target(accuracy, 2, changing), 6e-11, 1e-24);
    EXPECT_NEAR(target(accuracy, 2, 0.05), 9e-3, 1e-15);
    EXPECT_NEAR(target(accuracy, 2, 0.05), 3e-2, 1e-15);
  }
}

TEST(Accuracy, IsAPartOfWhatNewtonsMethodLeaves)
{
  for (const bool has_path : {false, true})
  {
    Accuracy accuracy(has_path);
    target(accuracy, 2, 0.9);
    // Nothing is known yet: far below the tolerance
    const double least = has_path ? 1e-14 : 1e-13;
    EXPECT_NEAR(target(accuracy, 1e-2, 0), least, 1e-26);
    // A residual that goes with ten times the square of the last
    EXPECT_NEAR(target(accuracy, 1e-3, 0), 3e-6, 1e-18);
    EXPECT_FALSE(accuracy.is_last());
    EXPECT_NEAR(target(accuracy, 1e-5, 0), 3e-10, 1e-22);
    // At most some hundredths of the residual
    EXPECT_NEAR(target(accuracy, 1e3, 0), 3e1, 1e-12);
    // And at the end far less than the tolerance
    target(accuracy, 1e-5, 0);
    EXPECT_NEAR(target(accuracy, 1e-9, 0), least, 1e-26);
    EXPECT_TRUE(accuracy.is_last());
  }
}

TEST(Accuracy, ResidualsOfActiveSetsThatChangeSayNothingOfTheNext)
{
  Accuracy accuracy(false);
  target(accuracy, 1e-2, 0.5);
  EXPECT_NEAR(target(accuracy, 1e-3, 0), 1e-13, 1e-26);
}

TEST(Accuracy, IsThatOfASettledActiveSetOnceOneHasComeBack)
{
  Accuracy accuracy(false);
  EXPECT_NEAR(target(accuracy, 1e-2, 0.5, true), 1e-13, 1e-26);
  EXPECT_NEAR(target(accuracy, 1e-3, 0.5, true), 3e-6, 1e-18);
}

TEST(Accuracy, KeepsWhatItHasSeenForTheNextStep)
{
  Accuracy accuracy(false);
  const auto see = [&]
  {
    target(accuracy, 1e-2, 0);
    target(accuracy, 1e-3, 0);
  };
  see();
  accuracy.begin_step();
  // Not that 1e-6 comes after 1e-3
  EXPECT_NEAR(target(accuracy, 1e-6, 0), 3e-12, 1e-24);
  accuracy.reset();
  EXPECT_NEAR(target(accuracy, 1e-6, 0), 1e-13, 1e-26);
}

TEST(Accuracy, TakesNoStepForASolution)
{
  for (const bool is_solved : {true, false})
  {
    Accuracy accuracy(false);
    target(accuracy, 1e-2, 0);
    target(accuracy, 1e-3, 0);
    if (not is_solved)
      accuracy.skip();
    // A hundredth of what the square of the last residual says
    target(accuracy, 1e-7, 0);
    accuracy.begin_step();
    EXPECT_NEAR(target(accuracy, 1e-2, 0), is_solved ? 3e-6 : 3e-4, 1e-12);
  }
}
