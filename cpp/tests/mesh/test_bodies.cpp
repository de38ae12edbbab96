// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#include "thread_ranks.h"
#include <array>
#include <atomic>
#include <contactx/mesh/bodies.h>
#include <random>
#include <set>

using namespace contactx;
using mesh::Bodies;
using tests::NumberedNodes;
using tests::on_ranks;

namespace
{
/// A random graph, and its parts by brute force.
struct Graph
{
  Graph(unsigned seed, int num_nodes, int num_cells, int width)
      : width(width), name(num_nodes)
  {
    std::mt19937 engine(seed);
    cells.resize(num_cells * width);
    for (std::int32_t& node : cells)
      node = static_cast<std::int32_t>(engine() % num_nodes);
    for (int i = 0; i < num_nodes; ++i)
      name[i] = i;
    // The smallest number goes around until nothing changes
    for (bool changed = true; changed;)
    {
      changed = false;
      for (std::size_t c = 0; c < cells.size(); c += width)
      {
        std::int64_t least = name[cells[c]];
        for (int k = 1; k < width; ++k)
          least = std::min(least, name[cells[c + k]]);
        for (int k = 0; k < width; ++k)
        {
          changed |= name[cells[c + k]] != least;
          name[cells[c + k]] = least;
        }
      }
    }
    names = {name.begin(), name.end()};
  }

  int width;
  std::vector<std::int32_t> cells;
  std::vector<std::int64_t> name; ///< of each node
  std::set<std::int64_t> names;
};

std::vector<std::int64_t> in_order(int count)
{
  std::vector<std::int64_t> numbers(count);
  for (int i = 0; i < count; ++i)
    numbers[i] = i;
  return numbers;
}

TEST(Bodies, ConnectedPartsOfRandomGraphs)
{
  for (unsigned seed = 0; seed < 60; ++seed)
  {
    const int n = 1 + static_cast<int>(seed) % 40;
    const Graph graph(seed, n, static_cast<int>(seed * 7 % 31),
                      1 + static_cast<int>(seed) % 4);
    const auto part = mesh::connected_parts(graph.cells, graph.width, n);
    EXPECT_TRUE(std::ranges::equal(part, graph.name)) << "seed " << seed;
  }
  // A chain against the order, the longest way that names can go
  std::vector<std::int32_t> chain;
  for (std::int32_t i = 1999; i > 0; --i)
    chain.insert(chain.end(), {i, i - 1});
  EXPECT_EQ(mesh::connected_parts(chain, 2, 2000),
            std::vector<std::int32_t>(2000));
}

TEST(Bodies, NamesAreThoseOfTheMeshAsItWasMade)
{
  // Two triangles and a node alone, in any order
  const std::vector<std::int32_t> cells{0, 3, 5, 1, 2, 6};
  const std::vector<std::int64_t> original{7, 9, 4, 2, 8, 5, 6};
  const Bodies bodies(cells, 3, 1, original,
                      std::make_shared<mesh::SerialNodes>(7));
  EXPECT_EQ(bodies.names(), (std::vector<std::int64_t>{2, 4, 8}));
  EXPECT_EQ(bodies.of_node(), (std::vector<std::int64_t>{2, 4, 4, 2, 8, 2, 4}));
  EXPECT_EQ(bodies.number(), (std::vector<std::int32_t>{0, 1, 1, 0, 2, 0, 1}));
  EXPECT_EQ(bodies.of_cell(), (std::vector<std::int64_t>{2, 4}));
  EXPECT_EQ(bodies.nodes(4), (std::vector<std::int32_t>{1, 2, 6}));
  EXPECT_EQ(bodies.count(2), 3);
  EXPECT_EQ(bodies.cells(2), std::vector<std::int32_t>{0});
  // A ghost
  EXPECT_TRUE(bodies.cells(4).empty());
  EXPECT_EQ(bodies.carrying(std::vector<std::int32_t>{4, 0, 3}),
            (std::vector<std::int64_t>{2, 8}));
  const std::vector<double> x{0, 0, 5, 5, 6, 4, 1, 0, 9, 9, 0, 1, 5, 7};
  EXPECT_EQ(bodies.boxes(std::vector<std::int64_t>{4, 2}, x, 2),
            (std::vector<double>{5, 4, 0, 0, 6, 7, 1, 1}));
}

TEST(Bodies, OnSeveralRanksTheyAreThoseOfOne)
{
  for (unsigned seed = 0; seed < 24; ++seed)
  {
    const int n = 30, size = 2 + static_cast<int>(seed) % 3;
    const Graph graph(seed, n, 12 + static_cast<int>(seed) % 10, 3);
    // Cells on any rank, their nodes owned by any of those that have them
    std::mt19937 engine(seed);
    std::vector<int> rank_of_cell(graph.cells.size() / 3), owner(n, -1);
    for (std::size_t c = 0; c < rank_of_cell.size(); ++c)
    {
      rank_of_cell[c] = static_cast<int>(engine() % size);
      for (int k = 0; k < 3; ++k)
        if (engine() % 2 == 0 or owner[graph.cells[3 * c + k]] < 0)
          owner[graph.cells[3 * c + k]] = rank_of_cell[c];
    }
    for (int& rank : owner)
      rank = std::max(rank, 0);
    const auto work = [&](mesh::Ranks& ranks)
    {
      std::vector<std::int64_t> numbers;
      for (int i = 0; i < n; ++i)
        if (owner[i] == ranks.rank())
          numbers.push_back(i);
      const auto num_owned = static_cast<std::int32_t>(numbers.size());
      std::vector<std::int32_t> cells;
      for (std::size_t c = 0; c < rank_of_cell.size(); ++c)
        if (rank_of_cell[c] == ranks.rank())
          for (int k = 0; k < 3; ++k)
          {
            const std::int64_t node = graph.cells[3 * c + k];
            auto at = std::ranges::find(numbers, node);
            if (at == numbers.end())
            {
              numbers.push_back(node);
              at = numbers.end() - 1;
            }
            cells.push_back(static_cast<std::int32_t>(at - numbers.begin()));
          }
      auto map = std::make_shared<NumberedNodes>(ranks, numbers, num_owned);
      Bodies bodies(cells, 3, static_cast<std::int32_t>(cells.size() / 3),
                    numbers, map);
      EXPECT_TRUE(std::ranges::equal(bodies.names(), graph.names));
      // A node that comes later
      map->set_ghosts(map->numbers().size(), std::vector<std::int64_t>{n / 2});
      for (int i = 0; i < map->num_nodes(); ++i)
      {
        EXPECT_EQ(bodies.of_node()[i], graph.name[map->numbers()[i]]);
        EXPECT_EQ(bodies.names()[bodies.number()[i]], bodies.of_node()[i]);
      }
      for (std::size_t c = 0; c < cells.size() / 3; ++c)
        EXPECT_EQ(bodies.of_cell()[c], bodies.of_node()[cells[3 * c]]);
      for (const std::int64_t body : graph.names)
        EXPECT_EQ(bodies.count(body), std::ranges::count(graph.name, body));
      // One rank alone knows of a node
      std::vector<std::int32_t> some;
      if (ranks.rank() == 1 and num_owned > 0)
        some.push_back(0);
      const auto carried = bodies.carrying(some);
      const auto known = mesh::gathered(
          ranks, std::span<const std::int64_t>(numbers).first(some.size()));
      ASSERT_EQ(carried.size(), known.size());
      for (std::size_t k = 0; k < known.size(); ++k)
        EXPECT_EQ(carried[k], graph.name[known[k]]);
      std::vector<double> x;
      for (const std::int64_t node : map->numbers())
        x.insert(x.end(), {double(node), -double(node)});
      const std::vector<std::int64_t> last{*graph.names.rbegin()};
      std::int64_t high = 0;
      for (int i = 0; i < n; ++i)
        if (graph.name[i] == last[0])
          high = i;
      const auto low = double(last[0]), top = double(high);
      EXPECT_EQ(bodies.boxes(last, x, 2),
                (std::vector<double>{low, -top, top, -low}));
    };
    on_ranks(size, work);
  }
}

TEST(Bodies, WhatDoesNotFitIsRefusedOnAllRanks)
{
  const auto nodes = std::make_shared<mesh::SerialNodes>(3);
  const auto numbers = in_order(3);
  const std::vector<std::int32_t> cells{0, 1, 2}, wrong{0, 1, 3};
  EXPECT_REFUSED(Bodies(wrong, 3, 1, numbers, nodes));
  EXPECT_REFUSED(Bodies(cells, 2, 1, numbers, nodes));
  EXPECT_REFUSED(Bodies(cells, 0, 1, numbers, nodes));
  EXPECT_REFUSED(Bodies(cells, 3, 2, numbers, nodes));
  EXPECT_REFUSED(Bodies(cells, 3, 1, in_order(2), nodes));
  const Bodies bodies(cells, 3, 1, numbers, nodes);
  EXPECT_REFUSED(bodies.carrying(std::vector<std::int32_t>{3}));
  EXPECT_REFUSED(
      bodies.boxes(std::vector<std::int64_t>{1}, std::array<double, 6>{}, 2));
  EXPECT_REFUSED(
      bodies.boxes(std::vector<std::int64_t>{0}, std::array<double, 5>{}, 2));
  EXPECT_NE(tests::said_on(
                3,
                [](mesh::Ranks& ranks)
                {
                  const std::vector<std::int32_t> cell{ranks.rank()};
                  const std::vector<std::int64_t> number{ranks.rank()};
                  Bodies(cell, 1, 1, number,
                         std::make_shared<NumberedNodes>(ranks, number, 1));
                }),
            "");
}
} // namespace
