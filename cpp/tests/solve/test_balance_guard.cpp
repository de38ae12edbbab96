// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#include <contactx/solve/balance_guard.h>
#include <gtest/gtest.h>

using contactx::solve::BalanceGuard;

namespace
{
/// A guard that has seen a number of unbalanced iterates with settled status.
BalanceGuard after(int count)
{
  BalanceGuard guard;
  for (int i = 0; i < count; ++i)
    EXPECT_FALSE(guard.note(true, 0, 1.0));
  return guard;
}
} // namespace

TEST(BalanceGuard, GivesUpAfterTenIteratesWithSettledStatus)
{
  BalanceGuard guard = after(BalanceGuard::max_iterates - 1);
  // One in which nodes change their status does not count, nor start anew
  EXPECT_FALSE(guard.note(true, 1, 1.0));
  EXPECT_TRUE(guard.note(true, 0, 1.0));
  EXPECT_TRUE(guard.note(true, 1, 1.0));
  EXPECT_EQ(BalanceGuard::max_iterates, 10);
}

TEST(BalanceGuard, CountsAnewWhereForcesBalance)
{
  BalanceGuard guard = after(BalanceGuard::max_iterates - 1);
  EXPECT_FALSE(guard.note(false, 0, 1.0));
  for (int i = 1; i < BalanceGuard::max_iterates; ++i)
    EXPECT_FALSE(guard.note(true, 0, 1.0));
  EXPECT_TRUE(guard.note(true, 0, 1.0));
  guard.begin_step();
  EXPECT_FALSE(guard.note(true, 0, 1.0));
}

TEST(BalanceGuard, WaitsWhileTheResidualFalls)
{
  BalanceGuard guard = after(BalanceGuard::max_iterates - 1);
  // From one iterate to the next
  EXPECT_FALSE(guard.note(true, 0, 0.69));
  EXPECT_FALSE(guard.note(true, 0, 0.69 * 0.69));
  EXPECT_TRUE(guard.note(true, 0, 0.71 * 0.69 * 0.69));
}

TEST(BalanceGuard, IteratesFarAboveTheFirstResidualHaveGoneAstray)
{
  for (const double factor : {0.99, 1.01})
  {
    BalanceGuard guard = after(1);
    // Where forces balance, or nodes change, a residual may be anything
    EXPECT_FALSE(guard.note(false, 0, 1e3));
    EXPECT_FALSE(guard.note(true, 1, 1e3));
    EXPECT_FALSE(guard.has_diverged());
    guard.note(true, 0, factor * BalanceGuard::divergence_ratio);
    guard.note(true, 0, 1);
    EXPECT_EQ(guard.has_diverged(), factor > 1);
    guard.begin_step();
    EXPECT_FALSE(guard.has_diverged());
  }
}
