// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#include "blocks.h"
#include <contactx/problem/check_facing.h>
#include <contactx/problem/sides.h>
#include <functional>
#include <gtest/gtest.h>

using namespace contactx;
using namespace contactx::tests;

namespace
{
class FacingMaster : public testing::TestWithParam<int>
{
};

/// A block of size 1 beside, on or off another one that is 1.5 wide.
struct TwoBlocks
{
  Blocks blocks;

  explicit TwoBlocks(int gdim, double x0 = 0.23) : blocks(gdim)
  {
    Vector<3> low{0.23, 0.23, 0.23}, high{1.23, 1.23, 1.23}, zero{};
    low[0] = x0;
    high[0] = x0 + 1;
    low[gdim - 1] = 0.1;
    high[gdim - 1] = 1.1;
    Vector<3> end{1.5, 1.5, 1.5};
    zero[gdim - 1] = -1;
    end[gdim - 1] = 0;
    blocks.add(3, low, high);
    blocks.add(4, zero, end);
  }

  Side upper(int axis, bool is_upper) const
  {
    return blocks.side(0, axis, is_upper);
  }
  Side lower(int axis, bool is_upper) const
  {
    return blocks.side(1, axis, is_upper);
  }
};

/// What is said of surfaces whose pairs are searched for, or not.
std::string said_of(const Blocks& blocks, int ranks, const Side& slave,
                    const Side& master, double reach,
                    const std::function<Vector<2>(Vector<2>)>& moved = {})
{
  return said(
      blocks, ranks,
      [&](const RankBlocks& mine)
      {
        const geometry::Facets own = mine.own(slave), other = mine.own(master);
        const auto slaves = problem::make_slave_nodes(mine.halo, own.list());
        const auto pairs = problem::make_master(
            mine.mesh(), slaves, "A", {"B", other.list()}, law::Frictionless(),
            {problem::Method::node_to_surface, contact::Sliding::finite,
             reach});
        std::vector<double> x(mine.halo->reference().begin(),
                              mine.halo->reference().end());
        if (moved)
          for (std::size_t i = 0; i < x.size(); i += 2)
          {
            const Vector<2> to = moved({x[i], x[i + 1]});
            std::ranges::copy(to, x.begin() + i);
          }
        pairs->search(x, std::vector<std::int8_t>(slaves->owned().size(), 0));
        problem::check_facing(*mine.halo, *slaves, "A", *pairs, "B");
      },
      true);
}
} // namespace

TEST_P(FacingMaster, AwayIsRefused)
{
  for (const int gdim : {2, 3})
  {
    const TwoBlocks two(gdim);
    // Sides that look into the same direction, 0.27 and 0.1 apart
    const Side slave = two.upper(0, true), master = two.lower(0, true);
    const std::string text = said_of(two.blocks, GetParam(), slave, master, 5);
    EXPECT_EQ(text,
              "the slave surface A faces away from its master B: no slave "
              "node has a normal that opposes that of a master facet "
              "within the search distance 5, although the nearest is "
              "0.288 away. Check the tags: the surfaces must face each "
              "other (manual: errors/refused-mesh)");
    // The far side of a body
    EXPECT_NE(said_of(two.blocks, GetParam(), two.upper(gdim - 1, true),
                      two.lower(gdim - 1, true), 5),
              "");
  }
}

TEST_P(FacingMaster, OutOfReachIsLegal)
{
  const TwoBlocks two(3);
  const Side slave = two.upper(0, true), master = two.lower(0, true);
  EXPECT_EQ(said_of(two.blocks, GetParam(), slave, master, 0.287), "");
  EXPECT_NE(said_of(two.blocks, GetParam(), slave, master, 0.289), "");
}

TEST_P(FacingMaster, OnlyFacetsInReachCount)
{
  const TwoBlocks two(3);
  const Side slave = two.upper(0, true),
             master = two.lower(0, false) + two.lower(0, true);
  // What opposes is at x = 0, and 0.1 below; the slave is at x = 1.23
  EXPECT_NE(said_of(two.blocks, GetParam(), slave, master, 1.23), "");
  EXPECT_EQ(said_of(two.blocks, GetParam(), slave, master, 1.24), "");
}

TEST_P(FacingMaster, BeyondTheOuterEdgeIsLegal)
{
  for (const int gdim : {2, 3})
  {
    const TwoBlocks two(gdim, 1.6);
    EXPECT_EQ(said_of(two.blocks, GetParam(), two.upper(gdim - 1, false),
                      two.lower(gdim - 1, true), 5),
              "");
  }
}

TEST_P(FacingMaster, WherePairsAreNothingIsLookedAt)
{
  // Pairs are those of another place, where the slave is turned over and one of
  // its nodes, which one rank owns, is in front of the master
  const TwoBlocks two(2);
  const Side slave = two.upper(0, true), master = two.lower(0, true);
  const auto turned = [](double up)
  {
    return [up](Vector<2> x)
    { return x[1] < 0.05 ? x : Vector<2>{x[0] + 0.7, up - x[1]}; };
  };
  EXPECT_EQ(said_of(two.blocks, GetParam(), slave, master, 5, turned(1)), "");
  EXPECT_NE(said_of(two.blocks, GetParam(), slave, master, 5, turned(4)), "");
}

INSTANTIATE_TEST_SUITE_P(Ranks, FacingMaster, testing::Values(1, 2, 3, 4));
