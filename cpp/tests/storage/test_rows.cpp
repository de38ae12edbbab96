// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#include "thread_ranks.h"
#include <contactx/storage/rows.h>
#include <numeric>
#include <random>

using namespace contactx;
using contactx::storage::Rows;

namespace
{
/// Numbers 0 to n - 1 in another order, of which each rank has some.
std::vector<std::int64_t> shuffled(std::int64_t n, const mesh::Ranks& ranks)
{
  std::vector<std::int64_t> all(n);
  std::iota(all.begin(), all.end(), 0);
  std::ranges::shuffle(all, std::mt19937(1));
  // The first rank has more than the others
  const auto end = [&](int r)
  {
    return r == ranks.size() ? n : n * (r > 0 ? r + 1 : 0) / (ranks.size() + 1);
  };
  return {all.begin() + end(ranks.rank()), all.begin() + end(ranks.rank() + 1)};
}

/// Bytes of the shares of all ranks, one after the other.
std::vector<std::byte> moved(int size, std::int64_t n, int width)
{
  std::vector<std::byte> all(n * sizeof(std::int64_t));
  const auto work = [&](mesh::Ranks& ranks)
  {
    const auto mine = shuffled(n, ranks);
    std::vector<std::int64_t> keys;
    for (const std::int64_t i : mine)
      for (int k = 0; k < width; ++k)
        keys.push_back(k == 0 ? i % 7 : i * k);
    const Rows rows(ranks, keys, width);
    EXPECT_EQ(rows.digest().count, n);
    const auto given = std::as_bytes(std::span(mine));
    const auto share = rows.to_share(given, sizeof(std::int64_t));
    ASSERT_EQ(share.size(), rows.share() * sizeof(std::int64_t));
    std::ranges::copy(share, all.begin() + rows.first() * 8);
    EXPECT_TRUE(std::ranges::equal(rows.from_share(share, 8), given));
  };
  tests::on_ranks(size, work);
  return all;
}
} // namespace

TEST(Rows, theirOrderDoesNotDependOnTheRanks)
{
  const auto one = moved(1, 1000, 2);
  std::vector<std::int64_t> order(1000);
  std::memcpy(order.data(), one.data(), one.size());
  EXPECT_FALSE(std::ranges::is_sorted(order));
  std::ranges::sort(order);
  EXPECT_EQ(order[0], 0);
  EXPECT_EQ(order[999], 999);
  for (const int size : {2, 3, 4, 7})
    EXPECT_TRUE(moved(size, 1000, 2) == one) << size << " ranks";
}

TEST(Rows, mayBeFewerThanRanks)
{
  EXPECT_TRUE(moved(5, 2, 3) == moved(1, 2, 3));
  EXPECT_TRUE(moved(3, 0, 1).empty());
}

TEST(Rows, sharesAreAsLargeAsEachOther)
{
  constexpr std::int64_t n = 100000;
  for (const int size : {2, 3, 4, 16})
    tests::on_ranks(size,
                    [&](mesh::Ranks& ranks)
                    {
                      const Rows rows(ranks, shuffled(n, ranks), 1);
                      const double part = double(rows.share()) * size / n;
                      EXPECT_NEAR(part, 1, 0.05) << size << " ranks";
                    });
}

TEST(Rows, withTheSameKeyAreRefusedOnSeveralRanks)
{
  const std::vector<std::int64_t> keys{3, 1, 3};
  const auto make = [&](mesh::Ranks& ranks)
  {
    const bool mine = ranks.rank() == ranks.size() - 1;
    const Rows rows(ranks, mine ? keys : std::vector<std::int64_t>(), 1);
    const auto given = std::as_bytes(std::span(keys));
    EXPECT_TRUE(
        std::ranges::equal(rows.from_share(rows.to_share(given, 8), 8), given));
  };
  EXPECT_EQ(tests::said_on(1, make), "");
  tests::expect_says(tests::said_on(3, make),
                     "two nodes or cells have the same number");
}

TEST(Rows, haveADigestOfTheirKeys)
{
  const auto digest = [](int size, std::int64_t n, std::int64_t shift)
  {
    storage::Digest found;
    tests::on_ranks(size,
                    [&](mesh::Ranks& ranks)
                    {
                      auto keys = shuffled(n, ranks);
                      for (std::int64_t& key : keys)
                        key += shift;
                      const auto here = storage::digest(ranks, keys, 1);
                      if (ranks.rank() == 0)
                        found = here;
                    });
    return found;
  };
  EXPECT_EQ(digest(1, 50, 0), digest(4, 50, 0));
  EXPECT_NE(digest(1, 50, 0), digest(1, 50, 1));
  EXPECT_NE(digest(1, 50, 0), digest(1, 51, 0));
}
