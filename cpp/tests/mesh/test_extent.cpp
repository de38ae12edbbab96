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

INSTANTIATE_TEST_SUITE_P(Extent, ExtentOnRanks, testing::Values(1, 2, 3, 4));
