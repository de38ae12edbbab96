// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#include <algorithm>
#include <contactx/problem/step_plan.h>
#include <functional>
#include <gtest/gtest.h>
#include <stdexcept>

using contactx::problem::StepPlan;

namespace
{
/// All t that are attempted, failed ones negative, until the end or the last
/// failure.
std::vector<double> walk(StepPlan plan,
                         const std::function<bool(double, double)>& fails,
                         int iterations = 5)
{
  std::vector<double> tried;
  while (not plan.finished())
  {
    const double t = plan.next();
    const bool failed = fails(plan.t(), t);
    tried.push_back(failed ? -t : t);
    if (not failed)
      plan.accept(iterations);
    else if (not plan.cut())
      break;
  }
  return tried;
}
} // namespace

TEST(StepPlan, AFailedStepIsHalvedAndGrowsBackAfterEasyOnes)
{
  const StepPlan plan(StepPlan::equal(2));
  EXPECT_EQ(walk(plan, [](double, double) { return true; }),
            (std::vector{-0.5, -0.25, -0.125, -0.0625, -0.03125, -0.015625,
                         -0.0078125}));
  const auto at_start
      = [](double start, double t) { return start == 0 and t > 0.1; };
  EXPECT_EQ(walk(plan, at_start),
            (std::vector{-0.5, -0.25, -0.125, 0.0625, 0.125, 0.25, 0.5, 1.0}));
  // Hard ones stay short
  EXPECT_EQ(walk(plan, at_start, 11).size(), 3 + 16u);
}

TEST(StepPlan, GivenTAreMetExactly)
{
  const std::vector<double> given{0.1, 0.3, 0.7};
  const auto tried = walk(StepPlan(given), [](double start, double t)
                          { return t - start > 0.07; });
  for (const double t : given)
    EXPECT_NE(std::ranges::find(tried, t), tried.end());
}

TEST(StepPlan, ASavedPlaceIsGoneOnFrom)
{
  StepPlan plan(StepPlan::equal(4));
  plan.cut();
  plan.accept(5);
  StepPlan other(StepPlan::equal(4));
  other.load(plan.given(), plan.place());
  EXPECT_EQ(other, plan);
  StepPlan finer({0.05, 0.2, 1});
  finer.load(plan.given(), plan.place());
  EXPECT_EQ(finer.t(), 0.125);
  EXPECT_EQ(finer.next(), 0.2);
  StepPlan shorter({0.1});
  EXPECT_THROW(shorter.load(plan.given(), plan.place()), std::invalid_argument);
  EXPECT_EQ(shorter.t(), 0);
}

TEST(StepPlan, WhatDoesNotFitIsRefused)
{
  EXPECT_THROW(StepPlan({}), std::invalid_argument);
  EXPECT_THROW(StepPlan({0, 1}), std::invalid_argument);
  EXPECT_THROW(StepPlan({0.5, 0.5}), std::invalid_argument);
  EXPECT_THROW(StepPlan({1}, -1), std::invalid_argument);
  EXPECT_THROW(StepPlan({1}, 41), std::invalid_argument);
  EXPECT_THROW(StepPlan({1}, 6, -1), std::invalid_argument);
  EXPECT_THROW(StepPlan::equal(0), std::invalid_argument);
}
