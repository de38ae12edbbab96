// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#include "generator.h"
#include "thread_ranks.h"
#include <contactx/solve/balance_guard.h>
#include <contactx/solve/frozen_pairs.h>
#include <gtest/gtest.h>
#include <set>

using contactx::contact::HiddenGap;
using contactx::solve::BalanceGuard;
using namespace contactx::solve;
using namespace contactx::tests;
using namespace contactx;

namespace
{
/// A guard that has seen a number of unbalanced iterates with settled status.
BalanceGuard after(int count)
{
  BalanceGuard guard;
  for (int i = 0; i < count; ++i)
    EXPECT_FALSE(guard.note(true, 0));
  return guard;
}

TEST(BalanceGuard, GivesUpAfterTenIteratesWithSettledStatus)
{
  BalanceGuard guard = after(BalanceGuard::max_iterates - 1);
  // One in which nodes change their status does not count, nor start anew
  EXPECT_FALSE(guard.note(true, 1));
  EXPECT_TRUE(guard.note(true, 0));
  EXPECT_TRUE(guard.note(true, 1));
  EXPECT_EQ(BalanceGuard::max_iterates, 10);
}

TEST(BalanceGuard, CountsAnewWhereForcesBalance)
{
  BalanceGuard guard = after(BalanceGuard::max_iterates - 1);
  EXPECT_FALSE(guard.note(false, 0));
  for (int i = 1; i < BalanceGuard::max_iterates; ++i)
    EXPECT_FALSE(guard.note(true, 0));
  EXPECT_TRUE(guard.note(true, 0));
  guard.begin_step();
  EXPECT_FALSE(guard.note(true, 0));
}

TEST(FrozenPairs, HideAsMuchAsTheMeshExplains)
{
  mesh::OneRank alone;
  FrozenPairs pairs;
  EXPECT_TRUE(pairs.gaps().empty());
  const std::vector<HiddenGap> few{{-0.5, -0.029}, {0, 0}};
  EXPECT_FALSE(pairs.hide_penetration(alone, few));
  EXPECT_EQ(pairs.gaps(), (std::vector<double>{-0.5, 0}));
  // The part of an edge counts, in any of the contacts
  const std::vector<HiddenGap> deep{{-0.5, -0.029}, {-1e-3, -0.031}};
  EXPECT_TRUE(pairs.hide_penetration(alone, deep));
  EXPECT_EQ(pairs.gaps(), (std::vector<double>{-0.5, -1e-3}));
  // They are forgotten with the step
  pairs.begin_step();
  EXPECT_TRUE(pairs.gaps().empty());
  EXPECT_FALSE(pairs.hide_penetration(alone, {}));
}

TEST(FrozenPairs, OfAnyRankCount)
{
  on_ranks(3,
           [](mesh::Ranks& rank)
           {
             FrozenPairs pairs;
             std::vector<HiddenGap> found{{0, 0}, {-0.1, -0.01}};
             EXPECT_FALSE(pairs.hide_penetration(rank, found));
             if (rank.rank() == 1)
               found[0] = {-0.2, -0.04};
             EXPECT_TRUE(pairs.hide_penetration(rank, found));
             EXPECT_EQ(pairs.gaps(), (std::vector<double>{-0.2, -0.1}));
           });
}

TEST(FrozenPairs, AreReleasedTwiceInAStep)
{
  FrozenPairs pairs;
  for (int step = 0; step < 3; ++step)
  {
    pairs.begin_step();
    EXPECT_TRUE(pairs.release());
    EXPECT_TRUE(pairs.release());
    EXPECT_FALSE(pairs.release());
    EXPECT_FALSE(pairs.release());
  }
}

} // namespace
