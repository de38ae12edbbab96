// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#include "thread_ranks.h"
#include <contactx/mesh/extent.h>
#include <gtest/gtest.h>

using namespace contactx;
using namespace contactx::tests;

namespace
{
class ExtentOnRanks : public testing::TestWithParam<int>
{
};
} // namespace

TEST_P(ExtentOnRanks, IsThatOfTheBox)
{
  on_ranks(
      GetParam(),
      [](ThreadRanks& ranks)
      {
        // Rank r has the points (r, -r) and (0, 1)
        const double r = ranks.rank(), last = ranks.size() - 1;
        const std::vector<double> x{r, -r, 0, 1};
        EXPECT_EQ(mesh::extent(ranks, x, 2), (Vector<3>{last, last + 1, 0}));
        // The first of them alone, and one rank has none
        std::vector<std::int32_t> nodes{0};
        if (ranks.rank() == 0 and ranks.size() > 1)
          nodes.clear();
        const double size = std::max(last - 1, 0.0);
        EXPECT_EQ(mesh::extent(ranks, nodes, x, 2), (Vector<3>{size, size, 0}));
        EXPECT_EQ(mesh::extent(ranks, std::vector<double>(), 3), Vector<3>{});
      });
}

TEST_P(ExtentOnRanks, ScalesAreTheLongestSideAndTheLargestCoordinate)
{
  on_ranks(
      GetParam(),
      [](ThreadRanks& ranks)
      {
        const double r = ranks.rank(), last = ranks.size() - 1;
        std::vector<double> x{r, -r - 7, 0, 1};
        const math::Scales found = mesh::scales(ranks, x, 2);
        EXPECT_EQ(found.length, last + 8);
        EXPECT_EQ(found.farthest, last + 7);
        EXPECT_EQ(mesh::scales(ranks, std::vector<double>(), 3).farthest, 0);
        x[0] = ranks.rank() == 0 ? std::numeric_limits<double>::infinity() : 0;
        EXPECT_EQ(mesh::scales(ranks, x, 2).farthest, 0);
        EXPECT_EQ(mesh::scales(ranks, x, 2).length, 0);
      });
}

INSTANTIATE_TEST_SUITE_P(Extent, ExtentOnRanks, testing::Values(1, 2, 3, 4));
