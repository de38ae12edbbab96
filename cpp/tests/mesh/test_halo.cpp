// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#include "threads.h"
#include <contactx/mesh/ranks.h>

using namespace contactx;
using namespace contactx::mesh;
using namespace contactx::tests;

namespace
{
/// Value of a node of the mesh that no other node has
double value_of(std::int64_t original, int k)
{
  return static_cast<double>(10 * original + k) + 0.5;
}

class HaloOnRanks : public testing::TestWithParam<int>
{
protected:
  Scene scene = grid(5, tests::Cells::mixed,
                     [](double s, double t) { return Vector<3>{s, t, s * t}; });
};

/// All of a rank's nodes are those that it says they are
void check_nodes(const DistributedScene& scene, const Halo& halo)
{
  const int n = halo.num_nodes(), g = halo.gdim();
  std::vector<std::int32_t> every(n);
  std::iota(every.begin(), every.end(), 0);
  const auto numbers = halo.numbers(every);
  EXPECT_EQ(halo.find(numbers), every);
  const auto nodes = scene.mesh_nodes(halo, every);
  const auto owners = halo.owners(every);
  const auto x = halo.now()->x;
  ASSERT_EQ(std::ssize(halo.original()), n);
  ASSERT_EQ(std::ssize(x), n * g);
  for (int i = 0; i < n; ++i)
  {
    EXPECT_EQ(owners[i], scene.nodes.owner[nodes[i]]);
    EXPECT_EQ(owners[i] == halo.ranks().rank(), i < halo.num_owned());
    EXPECT_EQ(halo.original()[i], scene.nodes.original[nodes[i]]);
    for (int k = 0; k < g; ++k)
    {
      EXPECT_EQ(halo.reference()[i * g + k], scene.scene.x[nodes[i] * g + k]);
      EXPECT_EQ(x[i * g + k],
                scene.scene.x[nodes[i] * g + k] + nodes[i] * g + k);
    }
  }
}

TEST_P(HaloOnRanks, HaloGrowsAndShrinks)
{
  const DistributedScene parts(scene, GetParam(), 3, false);
  std::vector<double> u(scene.x.size());
  std::iota(u.begin(), u.end(), 0);
  const auto work = [&](ThreadRanks& ranks)
  {
    const auto halo = parts.halo(ranks, u);
    check_nodes(parts, *halo);
    const std::int32_t bulk = halo->num_bulk();
    EXPECT_EQ(halo->num_nodes(), bulk);
    const bool alone = ranks.size() == 1;
    // All nodes, twice and backwards, but for those from a number on
    const auto grow = [&](std::int64_t end, bool for_good)
    {
      std::vector<std::int64_t> numbers;
      std::vector<std::int32_t> owners;
      for (std::size_t i = 2 * parts.nodes.number.size(); i-- > 0;)
      {
        const std::size_t node = i / 2;
        if (parts.nodes.number[node] < end)
        {
          numbers.push_back(parts.nodes.number[node]);
          owners.push_back(parts.nodes.owner[node]);
        }
      }
      halo->grow(numbers, owners, for_good);
      return std::ranges::all_of(halo->find(numbers), [&](std::int32_t node)
                                 { return node < halo->num_nodes(); });
    };
    EXPECT_TRUE(grow(12, true));
    const std::int32_t kept = halo->num_nodes();
    check_nodes(parts, *halo);
    const int version = halo->version();
    EXPECT_TRUE(grow(12, false));
    EXPECT_EQ(halo->version(), version) << "nothing is new";

    const auto before = halo->now()->x;
    std::vector<std::int32_t> every(kept);
    std::iota(every.begin(), every.end(), 0);
    const auto numbers = halo->numbers(every);
    EXPECT_TRUE(grow(100, false));
    EXPECT_EQ(halo->num_nodes(), std::ssize(parts.nodes.owner));
    EXPECT_EQ(halo->version() > version, not alone);
    EXPECT_EQ(halo->numbers(every), numbers) << "nodes are appended";
    check_nodes(parts, *halo);
    EXPECT_EQ(halo->updated(before, 3, version), halo->now()->x);
    EXPECT_EQ(halo->updated(before, 3, halo->version()), before);

    // The start of the step follows the nodes
    halo->accept();
    EXPECT_EQ(halo->start(), halo->now()) << "nothing has moved";
    halo->shrink();
    EXPECT_EQ(halo->start()->x, halo->now()->x);
    EXPECT_EQ(halo->num_nodes(), kept);
    EXPECT_EQ(halo->numbers(every), numbers);
    check_nodes(parts, *halo);
    EXPECT_EQ(halo->num_bulk(), bulk);
    EXPECT_EQ(halo->updated(before, 3, version), before);
  };
  on_ranks(GetParam(), work);
}

TEST_P(HaloOnRanks, ValuesGoForwardAndBack)
{
  const DistributedScene parts(scene, GetParam(), 3, true);
  std::vector<double> count(scene.x.size() / 3, 0);
  std::mutex mutex;
  const auto work = [&](ThreadRanks& ranks)
  {
    const auto halo = parts.halo(ranks);
    const auto original = halo->original();
    std::vector<double> values(2 * original.size(), -1);
    std::vector<std::int64_t> whole(original.size(), -1);
    for (int i = 0; i < halo->num_owned(); ++i)
    {
      whole[i] = 3 * original[i];
      for (int k = 0; k < 2; ++k)
        values[2 * i + k] = value_of(original[i], k);
    }
    halo->forward(values, 2);
    halo->forward(whole, 1);
    for (int i = 0; i < halo->num_nodes(); ++i)
    {
      EXPECT_EQ(whole[i], 3 * original[i]);
      for (int k = 0; k < 2; ++k)
        EXPECT_EQ(values[2 * i + k], value_of(original[i], k));
    }
    std::vector<double> ones(original.size(), 1);
    halo->reverse(ones, 1);
    {
      const std::lock_guard lock(mutex);
      for (const std::int64_t node : original)
        ++count[node];
    }
    mesh::total(ranks, 1);
    for (int i = 0; i < halo->num_owned(); ++i)
      EXPECT_EQ(ones[i], count[original[i]]);
  };
  on_ranks(GetParam(), work);
}

TEST_P(HaloOnRanks, WrongArgumentsAreNamed)
{
  const DistributedScene parts(scene, GetParam(), 3, false);
  on_ranks(GetParam(),
           [&](ThreadRanks& ranks)
           {
             const auto halo = parts.halo(ranks);
             const std::int32_t n = halo->num_nodes();
             EXPECT_REFUSED(halo->numbers(std::vector{n}));
             EXPECT_REFUSED(halo->owners(std::vector{-1}));
             EXPECT_REFUSED(halo->find(std::vector<std::int64_t>{1000}));
             EXPECT_REFUSED(halo->grow(std::vector<std::int64_t>{0}, {}));
             std::vector<double> few(n);
             EXPECT_REFUSED(halo->forward(few, 2));
             EXPECT_REFUSED(halo->reverse(few, 2));
           });
}

TEST_P(HaloOnRanks, AllThrowWhatOneThrows)
{
  const auto work = [](ThreadRanks& ranks)
  {
    const int last = ranks.size() - 1;
    for (const bool is_argument : {true, false})
      try
      {
        ranks.agree(
            [&]
            {
              const std::string text = std::to_string(ranks.rank());
              if (ranks.rank() == last and is_argument)
                throw std::invalid_argument(text);
              if (ranks.rank() == last)
                throw std::out_of_range(text);
            });
        ADD_FAILURE();
      }
      catch (const std::exception& error)
      {
        EXPECT_EQ(error.what(), std::to_string(last));
        EXPECT_EQ(dynamic_cast<const std::invalid_argument*>(&error) != nullptr,
                  is_argument);
      }
    int count = 0;
    ranks.agree([&count] { ++count; });
    EXPECT_EQ(mesh::total(ranks, count), ranks.size());
    const auto all = mesh::gathered(
        ranks, std::span<const int>(std::vector{ranks.rank()}));
    std::vector<int> expected(ranks.size());
    std::iota(expected.begin(), expected.end(), 0);
    EXPECT_EQ(all, expected);
    // As many as the number of the rank
    const std::vector<double> mine(ranks.rank(), infinity);
    EXPECT_EQ(mesh::gathered<double>(ranks, mine).size(),
              ranks.size() * (ranks.size() - 1) / 2);
    EXPECT_EQ(mesh::total_before(ranks, 3), 3 * ranks.rank());
  };
  on_ranks(GetParam(), work);
}

TEST(Halo, TheBulksArraysMustFit)
{
  const auto make = [](std::size_t owners, std::int32_t num_owned)
  {
    return Halo({2,
                 num_owned,
                 {0, 1},
                 std::vector<std::int32_t>(owners),
                 {0, 1},
                 {0, 0, 0, 0}},
                std::make_unique<mesh::SerialBulk>(
                    std::make_shared<const std::vector<double>>(4)));
  };
  EXPECT_EQ(make(2, 2).num_nodes(), 2);
  EXPECT_REFUSED(make(1, 2));
  EXPECT_REFUSED(make(2, 3));
}

INSTANTIATE_TEST_SUITE_P(Halo, HaloOnRanks, testing::Range(1, 5));

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
  EXPECT_REFUSED(ranks.agree([] { throw std::invalid_argument("wrong"); }));
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
  EXPECT_REFUSED(unpack<double>(left, 1));
}
} // namespace
