// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#include "expect.h"
#include "generator.h"
#include <contactx/condense/residual_weights.h>
#include <contactx/solve/accuracy.h>
#include <memory>

using namespace contactx;
using condense::residual_weight;
using solve::Accuracy;

namespace
{
constexpr double tolerance = 1e-12, forces = 0.2;

/// What the next solve may leave.
double target(Accuracy& accuracy, double residual, double changing,
              bool has_cycled = false)
{
  accuracy.set(residual, tolerance, changing, forces, has_cycled);
  return accuracy.target();
}

TEST(Accuracy, IsAPartOfTheChangesOfTheActiveSet)
{
  Accuracy accuracy(false);
  EXPECT_EQ(accuracy.target(), 0);
  // The first solve of a step is finer
  for (const double changing : {0.05, 0.9})
  {
    accuracy.begin_step();
    EXPECT_NEAR(target(accuracy, 2, changing), 6e-4, 1e-17);
  }
  EXPECT_NEAR(target(accuracy, 2, 1e-7), 6e-8, 1e-20);
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
    EXPECT_NEAR(target(accuracy, 2, 0.05), 3e-2, 1e-15);
  }
}

TEST(Accuracy, IsAPartOfTheForcesWhileTheActiveSetChanges)
{
  for (const bool has_path : {false, true})
  {
    Accuracy accuracy(has_path);
    target(accuracy, 20, 0.9);
    EXPECT_NEAR(target(accuracy, 20, 0.9), has_path ? 0.3 * forces : 0.6,
                1e-15);
    EXPECT_NEAR(target(accuracy, 2000, 0.9),
                0.3 * (has_path ? forces : 30 * forces), 1e-15);
    // Of an active set that has converged the residual's square tells
    target(accuracy, 20, 0);
    EXPECT_NEAR(target(accuracy, 20, 0), 0.6, 1e-15);
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

TEST(Accuracy, IsThatOfTheLastSolveWhereNewtonsMethodLeavesLessThanTheTolerance)
{
  // Ten times the square of 3e-7 is 9e-13, and of 4e-7 1.6e-12
  for (const bool is_below : {true, false})
  {
    const double residual = is_below ? 3e-7 : 4e-7;
    Accuracy accuracy(false);
    target(accuracy, std::sqrt(residual / 10), 0);
    EXPECT_NEAR(target(accuracy, residual, 0), is_below ? 1e-13 : 4.8e-13,
                1e-20);
    EXPECT_EQ(accuracy.is_last(), is_below);
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

/// Two bodies of three nodes in the plane
class Softness : public testing::Test
{
protected:
  static constexpr int gdim = 2;

  static mesh::Bodies bodies()
  {
    return {tests::numbered(6), 3, 2, tests::numbered<std::int64_t>(6),
            std::make_shared<mesh::SerialNodes>(6)};
  }

  /// An entry for each displacement of the bodies
  static std::vector<double> values(double first, double second)
  {
    std::vector<double> v(6 * gdim, first);
    std::fill(v.begin() + 3 * gdim, v.end(), second);
    return v;
  }

  static double part(double first, double second, double r, double s)
  {
    return residual_weight(bodies(), values(first, second), values(r, s), gdim);
  }
};

TEST_F(Softness, FallsWithTheStiffnessOfALoadedBody)
{
  EXPECT_DOUBLE_EQ(part(1, 20, 0, 4), 0.05);
  EXPECT_DOUBLE_EQ(part(1, 1e3, 0, 4), 1e-3);
  EXPECT_DOUBLE_EQ(part(1e9, 1, 5, 0), 1e-9);
  EXPECT_DOUBLE_EQ(part(1, 1e2, 3, 4), std::hypot(3, 0.04) / 5);
  // In any units
  EXPECT_DOUBLE_EQ(part(1e-9, 1e-6, 3e7, 4e7), part(1, 1e3, 3, 4));
  // One where bodies are alike, or the soft one is loaded, or none is
  EXPECT_DOUBLE_EQ(part(1, 1, 3, 4), 1);
  EXPECT_DOUBLE_EQ(part(1, 9, 0, 4), 1);
  EXPECT_DOUBLE_EQ(part(1, 1e6, 3, 0), 1);
  EXPECT_EQ(part(1, 1e3, 0, 0), 1);
  // What is prescribed is left out
  EXPECT_DOUBLE_EQ(part(0, 1, 3, 4), 1);
  EXPECT_DOUBLE_EQ(part(0, 0, 3, 4), 1);
}

TEST_F(Softness, RefusesArraysThatDoNotFit)
{
  const std::vector<double> fits(6 * gdim, 1), none;
  EXPECT_REFUSED(residual_weight(bodies(), none, fits, gdim));
  EXPECT_REFUSED(residual_weight(bodies(), fits, none, gdim));
}
} // namespace
