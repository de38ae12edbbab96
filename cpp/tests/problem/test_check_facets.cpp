// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#include "blocks.h"
#include <contactx/contact/slave_nodes.h>
#include <contactx/problem/check_facets.h>
#include <contactx/problem/check_facing.h>
#include <contactx/problem/sides.h>

using namespace contactx;
using namespace contactx::tests;
using problem::check_facets;
using problem::check_folds;

namespace
{
using Points = std::vector<Vector<3>>;

const Points square{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 0}};

/// Some nodes of a facet, moved and scaled.
Points part(const Points& points, std::vector<int> which,
            const Vector<3>& scale = {1, 1, 1})
{
  Points result;
  for (const int i : which)
    result.push_back({points[i][0] * scale[0], points[i][1] * scale[1],
                      points[i][2] * scale[2]});
  return result;
}

Points moved(Points points, std::vector<std::pair<int, Vector<3>>> by)
{
  for (const auto& [i, shift] : by)
    points[i] = points[i] + shift;
  return points;
}

/// What is said of facets, each with nodes of its own.
std::string said(const std::vector<Points>& facets, double length, int gdim)
{
  Scene scene(gdim);
  for (const Points& points : facets)
  {
    std::vector<std::int32_t> nodes;
    for (const Vector<3>& p : points)
      nodes.push_back(scene.node(length * p));
    scene.facet(nodes);
  }
  const auto halo = mesh::serial_halo(scene.x, gdim);
  return refusal(
      [&] { check_facets(*halo, {"the surface", scene.facets()}, "slave"); });
}

Points shifted(Points points)
{
  for (Vector<3>& p : points)
    p = p + Vector<3>{1, 1, 1};
  return points;
}

TEST(ReferenceFacets, SoundOnes)
{
  const std::vector<int> all{0, 1, 2, 3}, three{0, 1, 2};
  for (const double length : {1e-9, 1.0, 1e9})
  {
    for (const Points& facet :
         {square, part(square, all, {1e-4, 1, 1}),
          moved(square, {{0, {0, 0, -0.5}}, {3, {0, 0, -0.5}}}),
          moved(square, {{3, {-0.45, -0.45, 0}}}), part(square, three),
          part(square, three, {1e-5, 1, 1})})
      EXPECT_EQ(said({facet, shifted(facet)}, length, 3), "");
    const Points segment = part(square, {0, 1});
    EXPECT_EQ(said({segment, shifted(segment)}, length, 2), "");
  }
}

TEST(ReferenceFacets, DegenerateOnes)
{
  const std::vector<int> all{0, 1, 2, 3}, three{0, 1, 2};
  const std::vector<Points> bad{
      part(square, {0, 1, 3, 2}),            // a bow tie
      moved(square, {{3, {-0.6, -0.6, 0}}}), // an arrow head
      moved(square, {{3, {-0.5, -0.5, 0}}}), // a straight angle
      part(square, {0, 1, 2, 2}),            //
      part(square, all, {1, 0, 0}),          //
      part(square, all, {0, 0, 0}),          //
      part(square, {0, 1, 1}),               //
      {{0, 0, 0}, {1, 1, 1}, {3, 3, 3}},     //
      part(square, three, {0, 0, 0}),        //
  };
  for (const double length : {1e-9, 1.0, 1e9})
  {
    for (const Points& facet : bad)
    {
      const Points sound
          = shifted(facet.size() == 3 ? part(square, three) : square);
      const std::string nodes = facet.size() == 3 ? "3, 4, 5" : "4, 5, 6, 7";
      const std::string text = said({sound, facet}, length, 3);
      EXPECT_TRUE(text.starts_with(
          "1 facets of the slave surface the surface are degenerate: they have "
          "no area, or are folded so that their Jacobian changes sign. The "
          "first is at ("))
          << text;
      EXPECT_TRUE(text.ends_with(" and has the nodes " + nodes
                                 + " of the mesh as it was made: repair the "
                                   "mesh there (manual: errors/refused-mesh)"))
          << text;
    }
    for (const Points& facet :
         {part(square, {1, 1}), part(square, {0, 1}, {1e-13, 1, 1})})
      EXPECT_NE(said({shifted(part(square, {0, 1})), facet}, length, 2), "");
  }
  expect_says(said({square, part(square, {0, 1, 3, 2})}, 1, 3),
              "The first is at (0.5, 0.5, 0) and");
}

TEST(ReferenceFacets, AllRanksNameTheSameFacet)
{
  Blocks blocks(3);
  blocks.add(4, {0, 0, 0}, {1, 1, 1});
  // Two nodes of the top onto their neighbours
  for (std::int32_t i = 0; i < blocks.num_nodes(); ++i)
    if (blocks.x[3 * i + 2] == 1 and blocks.x[3 * i + 1] == 0.5
        and (blocks.x[3 * i] == 0.25 or blocks.x[3 * i] == 0.75))
      blocks.x[3 * i] += 0.25;
  const Side top = blocks.side(0, 2, true), low = blocks.side(0, 2, false);
  const auto look = [&](const Side& side)
  {
    return [&side](const RankBlocks& mine)
    {
      const geometry::Facets own = mine.own(side);
      check_facets(*mine.halo, {"S", own.list()}, "master");
    };
  };
  const std::string expected = tests::said(blocks, 1, look(top));
  EXPECT_TRUE(expected.starts_with("4 facets of the master surface S are"))
      << expected;
  for (const int ranks : {1, 2, 3, 4})
    for (const bool is_scattered : {false, true})
    {
      EXPECT_EQ(tests::said(blocks, ranks, look(top), is_scattered), expected);
      EXPECT_EQ(tests::said(blocks, ranks, look(low), is_scattered), "");
    }
}

TEST(ReferenceFacets, AFoldedSurfaceHasNoNormal)
{
  // Two segments that are back to back but for an angle
  const auto folded = [](double angle)
  {
    const Scene scene(2,
                      {{0, 0}, {1, 0}, {1 - std::cos(angle), -std::sin(angle)}},
                      {{0, 1}, {1, 2}});
    const auto halo = mesh::serial_halo(scene.x, 2);
    const contact::SlaveNodes slaves(halo, scene.facets(), scene.facets());
    return refusal([&] { check_folds(*halo, slaves, "S"); });
  };
  EXPECT_EQ(folded(1e-8), "the slave surface S is folded at 1 nodes, where the "
                          "normals of its facets cancel, first at (1, 0), node "
                          "1 of the mesh as it was made: take the facets of "
                          "one side out of the surface (manual: "
                          "errors/refused-mesh)");
  EXPECT_EQ(folded(1e-5), "");
  EXPECT_EQ(folded(0.5), "");
}

TEST(ReferenceFacets, FoldsAreFoundOnAnyRanks)
{
  // The top of a block goes back below itself
  for (const int gdim : {2, 3})
  {
    Blocks blocks(gdim);
    blocks.add(3, {0, 0, 0}, {3, 1, 1});
    const Side flat = blocks.side(0, gdim - 1, false),
               folded = blocks.side(0, gdim - 1, true);
    for (std::size_t i = 0; i < blocks.x.size(); i += gdim)
      if (blocks.x[i + gdim - 1] == 1 and blocks.x[i] > 1)
        blocks.x[i] = 2 - blocks.x[i];
    const auto look = [](const Side& side)
    {
      return [&side](const RankBlocks& mine)
      {
        const geometry::Facets own = mine.own(side);
        const auto slaves = problem::make_slave_nodes(mine.halo, own.list());
        check_folds(*mine.halo, *slaves, "S");
      };
    };
    const std::string expected = tests::said(blocks, 1, look(folded));
    expect_says(expected, gdim == 2
                              ? "folded at 1 nodes, where the normals of its "
                                "facets cancel, first at (1, 1), node"
                              : "folded at 4 nodes");
    for (const int ranks : {2, 3, 4})
    {
      EXPECT_EQ(tests::said(blocks, ranks, look(folded), true), expected);
      EXPECT_EQ(tests::said(blocks, ranks, look(flat), true), "");
    }
  }
}

using FacingMaster = testing::TestWithParam<int>;

/// A block of size 1 beside, on or off another one that is 1.5 wide.
struct TwoBlocks : Stacked
{
  explicit TwoBlocks(int gdim, double low = 0.23)
      : Stacked(gdim, low, 0.1, 1, 1.5)
  {
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

TEST_P(FacingMaster, OnlyFacetsInReachCount)
{
  const TwoBlocks two(3);
  const Side slave = two.upper(0, true), master = two.lower(0, true);
  EXPECT_EQ(said_of(two.blocks, GetParam(), slave, master, 0.287), "");
  EXPECT_NE(said_of(two.blocks, GetParam(), slave, master, 0.289), "");
  // What opposes is at x = 0, and 0.1 below; the slave is at x = 1.23
  const Side both = two.lower(0, false) + master;
  EXPECT_NE(said_of(two.blocks, GetParam(), slave, both, 1.23), "");
  EXPECT_EQ(said_of(two.blocks, GetParam(), slave, both, 1.24), "");
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
} // namespace
