// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#include <contactx/mesh/ranks.h>
#include <gtest/gtest.h>
#include <numeric>
#include <stdexcept>

using namespace contactx::mesh;

TEST(Ranks, OneRankAlone)
{
  OneRank ranks;
  EXPECT_EQ(total(ranks, 3.5), 3.5);
  EXPECT_EQ(largest(ranks, -2), -2);
  EXPECT_TRUE(anywhere(ranks, true));
  EXPECT_FALSE(everywhere(ranks, false));
  const std::vector<int> few{3, 1, 2};
  EXPECT_EQ(gathered(ranks, std::span<const int>(few)), few);
}

TEST(Ranks, AnErrorOfOneRankComesThrough)
{
  OneRank ranks;
  EXPECT_THROW(ranks.agree([] { throw std::invalid_argument("wrong"); }),
               std::invalid_argument);
  int count = 0;
  ranks.agree([&] { ++count; });
  EXPECT_EQ(count, 1);
}

TEST(Ranks, PackedValuesComeBack)
{
  const std::vector<double> a{1.5, -2.0};
  const std::vector<std::int32_t> b{7};
  std::vector<std::byte> bytes;
  pack(bytes, std::span<const double>(a));
  pack(bytes, std::span<const std::int32_t>(b));
  std::span<const std::byte> left = bytes;
  EXPECT_EQ(unpack<double>(left, 2), a);
  EXPECT_EQ(unpack<std::int32_t>(left, 1), b);
  EXPECT_THROW(unpack<double>(left, 1), std::invalid_argument);
}
