// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#include "thread_ranks.h"
#include <contactx/solve/frozen_pairs.h>
#include <gtest/gtest.h>

using namespace contactx;
using namespace contactx::solve;
using namespace contactx::tests;
using contactx::contact::HiddenGap;

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

TEST(FrozenPairs, ForgetTheirGapsWithTheStep)
{
  mesh::OneRank alone;
  FrozenPairs pairs;
  const std::vector<HiddenGap> found{{-0.5, -0.029}};
  pairs.hide_penetration(alone, found);
  pairs.begin_step();
  EXPECT_TRUE(pairs.gaps().empty());
}
