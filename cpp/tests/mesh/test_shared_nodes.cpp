// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#include "blocks.h"
#include <contactx/mesh/shared_nodes.h>

using namespace contactx;
using namespace contactx::tests;
using mesh::check_shared;

namespace
{
using SharedNodes = testing::TestWithParam<int>;

/// Facets of a side whose first node is in a part of the plane.
Side part(const Blocks& blocks, const Side& side, double low, double high)
{
  Side result;
  for (std::int32_t f = 0; f < side.facets.list().size(); ++f)
  {
    double middle = 0;
    const auto nodes = side.facets.list()[f];
    for (const std::int32_t node : nodes)
      middle += blocks.x[std::size_t(node) * blocks.gdim]
                / static_cast<double>(nodes.size());
    if (middle > low and middle < high)
      result.add(nodes, side.cell[f]);
  }
  return result;
}

auto look(const Side& slave, const Side& master)
{
  return [&slave, &master](const RankBlocks& mine)
  {
    const geometry::Facets ours = mine.own(slave), theirs = mine.own(master);
    check_shared(*mine.halo, {"A", ours.list()}, {"B", theirs.list()});
  };
}
} // namespace

TEST_P(SharedNodes, AreThoseOfBothSurfaces)
{
  Blocks blocks(3);
  blocks.add(4, {0, 0, 0}, {1, 1, 1});
  const Side top = blocks.side(0, 2, true), side = blocks.side(0, 0, false);
  const DistributedBlocks all(blocks, GetParam(), true);
  const auto work = [&](ThreadRanks& ranks)
  {
    const RankBlocks mine(all, ranks);
    const geometry::Facets a = mine.own(top), b = mine.own(side);
    const auto shared = mesh::shared_nodes(*mine.halo, a.list(), b.list());
    const auto is_edge = mesh::edge_nodes(*mine.halo, a.list());
    ASSERT_EQ(std::ssize(shared), mine.halo->num_nodes());
    ASSERT_EQ(std::ssize(is_edge), mine.halo->num_owned());
    const auto x = mine.halo->reference();
    for (std::size_t i = 0; i < shared.size(); ++i)
      EXPECT_EQ(shared[i], x[3 * i] == 0 and x[3 * i + 2] == 1);
    const auto is_end = [](double value) { return value == 0 or value == 1; };
    for (std::size_t i = 0; i < is_edge.size(); ++i)
      EXPECT_EQ(is_edge[i], x[3 * i + 2] == 1
                                and (is_end(x[3 * i]) or is_end(x[3 * i + 1])));
  };
  on_ranks(GetParam(), work);
}

TEST_P(SharedNodes, TheTipOfACrackMayBeShared)
{
  // Two sides of a block meet at an edge
  for (const int gdim : {2, 3})
  {
    Blocks blocks(gdim);
    blocks.add(3, {0, 0, 0}, {1, 1, 1});
    const Side a = blocks.side(0, 0, true), b = blocks.side(0, gdim - 1, true);
    EXPECT_EQ(said(blocks, GetParam(), look(a, b), true), "");
    // Three sides around a corner
    const Side both = blocks.side(0, 1, true) + a;
    if (gdim == 3)
    {
      EXPECT_EQ(said(blocks, GetParam(), look(both, b), true), "");
    }
  }
}

TEST_P(SharedNodes, ATipIsAtTheEdgeOfBoth)
{
  // Segments that branch off in the middle of two others, which three cells
  // have in common
  Blocks blocks(2);
  blocks.add(2, {0, 0, 0}, {1, 1, 0});
  Side straight, branch;
  straight.add(std::vector<std::int32_t>{3, 4}, 0);
  straight.add(std::vector<std::int32_t>{4, 5}, 1);
  branch.add(std::vector<std::int32_t>{4, 7}, 2);
  Side turned;
  turned.add(std::vector<std::int32_t>{7, 4}, 2);
  EXPECT_NE(said(blocks, GetParam(), look(straight, branch)), "");
  EXPECT_NE(said(blocks, GetParam(), look(turned, straight)), "");
  Side end;
  end.add(std::vector<std::int32_t>{3, 4}, 0);
  EXPECT_EQ(said(blocks, GetParam(), look(end, branch)), "");
}

TEST_P(SharedNodes, OthersMayNot)
{
  for (const int gdim : {2, 3})
  {
    Blocks blocks(gdim);
    blocks.add(4, {0, 0, 0}, {1, 1, 1});
    const Side top = blocks.side(0, gdim - 1, true);
    const Side left = part(blocks, top, 0, 0.6),
               right = part(blocks, top, 0.4, 1),
               half = part(blocks, top, 0.5, 1);
    const std::string nodes = gdim == 2 ? "2" : "10";
    // Of the first two facets, and of the last three
    EXPECT_EQ(said(blocks, GetParam(),
                   look(part(blocks, top, 0, 0.5), part(blocks, top, 0.25, 1))),
              "slave and master overlap: A and B share " + nodes
                  + " nodes. Give each body its own nodes and each surface its "
                    "own facets: in gmsh do not fragment the bodies. Faces of "
                    "a crack may share the nodes of its tip, at the edge of "
                    "both, and no others (manual: errors/refused-mesh)");
    EXPECT_EQ(said(blocks, GetParam(), look(part(blocks, top, 0, 0.5), half)),
              "");
    EXPECT_NE(said(blocks, GetParam(), look(top, half)), "");
    EXPECT_NE(said(blocks, GetParam(), look(half, top)), "");
  }
}

TEST_P(SharedNodes, AFacetMustHaveANodeOfItsOwn)
{
  // A facet whose nodes are all on the edges of both surfaces
  Blocks blocks(2);
  blocks.add(1, {0, 0, 0}, {1, 1, 0});
  const Side top = blocks.side(0, 1, true),
             around = blocks.side(0, 0, false) + blocks.side(0, 0, true);
  EXPECT_NE(said(blocks, GetParam(), look(top, around), true), "");
  EXPECT_NE(said(blocks, GetParam(), look(around, top), true), "");
}

INSTANTIATE_TEST_SUITE_P(Ranks, SharedNodes, testing::Values(1, 2, 3, 4));
