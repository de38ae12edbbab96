// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#include "pairing_scene.h"
#include <contactx/geometry/shape.h>
#include <gtest/gtest.h>

using namespace contactx;
using namespace contactx::search;
using namespace contactx::tests;

namespace
{
const std::vector<Vector<2>> flat{{0, 0}, {1, 0}, {2, 0}};

TEST(Pairing, StartsWithoutPairs)
{
  const Pairing pairing({0, 3, 6}, {8, 3, 5, 5, 3, 2}, {0, 3}, {0, 1, 4}, 3);
  EXPECT_EQ(pairing.slaves(), (std::vector<std::int32_t>{2, 3, 5, 8}));
  EXPECT_EQ(pairing.facet(), std::vector<std::int32_t>(4, -1));
  EXPECT_EQ(pairing.xi().size(), 8u);
  EXPECT_EQ(pairing.cone().size(), 12u);
  EXPECT_TRUE(pairing.frozen().empty());
}

TEST(Pairing, FindsFacetAndLocalCoordinates)
{
  SlidingSegment s(flat);
  s.search_at({1.25, 0.1}, false);
  EXPECT_EQ(s.facet(), 1);
  EXPECT_EQ(s.feature(), geometry::interior);
  EXPECT_NEAR(s.pairing.xi()[0], 0.75, 1e-15); // the facet starts at x = 2
}

TEST(Pairing, KeepsAFacetInsideItsMargin)
{
  SlidingSegment s(flat);
  s.search_at({0.5, 0.1}, false);
  EXPECT_EQ(s.facet(), 0);
  s.search_at({1 + 0.9 * geometry::facet_margin, 0.1}, false);
  EXPECT_EQ(s.facet(), 0);
  EXPECT_NEAR(s.pairing.xi()[0], -0.9 * geometry::facet_margin, 1e-15);
  s.search_at({1 + 1.1 * geometry::facet_margin, 0.1}, false);
  EXPECT_EQ(s.facet(), 1);
  s.search_at({1 - 0.9 * geometry::facet_margin, 0.1}, false);
  EXPECT_EQ(s.facet(), 1);
  s.search_at({1 - 1.1 * geometry::facet_margin, 0.1}, false);
  EXPECT_EQ(s.facet(), 0);
}

TEST(Pairing, LetsGoBeyondTheOuterEdge)
{
  SlidingSegment s(flat);
  s.search_at({0.5, 0.1}, false);
  s.search_at({-0.9 * geometry::facet_margin, 0.1}, false);
  EXPECT_EQ(s.facet(), 0);
  s.search_at({-1.1 * geometry::facet_margin, 0.1}, false);
  EXPECT_EQ(s.facet(), -1);
  s.search_at({0.2, 0.1}, false);
  EXPECT_EQ(s.facet(), 0);
}

TEST(Pairing, LetsGoOfAFacetThatIsFarAway)
{
  // Above the right part rises another facet, nearer to where the node goes
  SlidingSegment s({{0, 0}, {2, 0}, {2.5, 3}, {4, 3}});
  s.search_at({1, 0.1}, false);
  EXPECT_EQ(s.facet(), 0);
  s.search_at({1.9, 1.9}, false);
  EXPECT_EQ(s.facet(), 0);
  s.search_at({1.9, 2.1}, false); // farther than the facet is long
  EXPECT_EQ(s.facet(), 1);
}

TEST(Pairing, FarFromAnEdgeOfTwoFacetsItKeepsTheOneThatItHas)
{
  SlidingSegment s(flat);
  const double far = 1.5; // longer than a facet
  s.search_at({0.99, far}, false);
  EXPECT_EQ(s.facet(), 0);
  s.search_at({1 + 0.9 * geometry::facet_margin, far}, false);
  EXPECT_EQ(s.facet(), 0);
  EXPECT_NEAR(s.pairing.xi()[0], -0.9 * geometry::facet_margin, 1e-15);
  s.search_at({1 + 1.1 * geometry::facet_margin, far}, false);
  EXPECT_EQ(s.facet(), 1);
  s.search_at({1 - 0.9 * geometry::facet_margin, far}, false);
  EXPECT_EQ(s.facet(), 1);
}

TEST(Pairing, LooksNoFartherThanItsReach)
{
  SlidingSegment s(flat);
  s.search_at({0.5, 0.3}, false, 0.25);
  EXPECT_EQ(s.facet(), -1);
  s.search_at({0.5, 0.2}, false, 0.25);
  EXPECT_EQ(s.facet(), 0);
  s.search_at({0.5, 0.3}, false, 0.25); // a pair that it has, too
  EXPECT_EQ(s.facet(), -1);
}

TEST(Pairing, CountsTheNodesInContactThatChange)
{
  SlidingSegment s(flat);
  EXPECT_EQ(s.search_at({0.5, 0.1}, false), 0);
  EXPECT_EQ(s.search_at({1.5, 0.1}, true), 1);
  EXPECT_EQ(s.search_at({1.5, 0.1}, true), 0);
  EXPECT_EQ(s.search_at({1.6, 0.1}, true), 0);
  EXPECT_EQ(s.search_at({-1, 0.1}, true), 1); // lost its facet
  EXPECT_EQ(s.search_at({-1, 0.2}, true), 0);
}

TEST(Pairing, FreezesANodeThatReturnsTwice)
{
  SlidingSegment s(flat);
  s.search_at({0.5, 0}, true);
  EXPECT_EQ(s.search_at({1.5, 0}, true), 1);
  EXPECT_EQ(s.search_at({0.5, 0}, true), 1);
  EXPECT_TRUE(s.pairing.frozen().empty());
  EXPECT_EQ(s.search_at({1.5, 0}, true), 0); // frozen
  EXPECT_EQ(s.pairing.frozen(), std::vector<std::int32_t>{0});
  EXPECT_EQ(s.facet(), 0);
  EXPECT_NEAR(s.pairing.xi()[0], -0.5, 1e-15); // on the extended facet
  EXPECT_EQ(s.search_at({1.25, 0}, true), 0);
  EXPECT_EQ(s.facet(), 0);
  EXPECT_NEAR(s.pairing.xi()[0], -0.25, 1e-15);
}

TEST(Pairing, ANewStepUnfreezes)
{
  SlidingSegment s(flat);
  for (double x : {0.5, 1.5, 0.5, 1.5})
    s.search_at({x, 0}, true);
  ASSERT_EQ(s.pairing.frozen().size(), 1u);
  s.pairing.begin_step();
  EXPECT_TRUE(s.pairing.frozen().empty());
  EXPECT_EQ(s.facet(), 0); // until the next search
  EXPECT_EQ(s.search_at({1.5, 0}, true), 1);
  EXPECT_EQ(s.facet(), 1);
}

TEST(Pairing, StepsDoNotAddUp)
{
  SlidingSegment s(flat);
  for (double x : {0.5, 1.5, 0.5, 1.5, 0.5, 1.5})
  {
    s.pairing.begin_step();
    s.search_at({x, 0}, true);
    EXPECT_EQ(s.facet(), x > 1);
  }
  EXPECT_TRUE(s.pairing.frozen().empty());
}

TEST(Pairing, OpenNodesAreNeverFrozen)
{
  SlidingSegment s(flat);
  for (int i = 0; i < 10; ++i)
    for (double x : {0.5, 1.5})
    {
      EXPECT_EQ(s.search_at({x, 0.1}, false), 0);
      EXPECT_EQ(s.facet(), x > 1);
    }
  EXPECT_TRUE(s.pairing.frozen().empty());
}

TEST(Pairing, FreezesANodeThatComesOffTheSurfaceTwice)
{
  // In contact it leaves by the outer edge, and is back in contact or open
  for (const bool closed : {true, false})
  {
    SlidingSegment s(flat);
    s.search_at({0.5, 0}, false);
    for (int k = 0; k < 2; ++k)
    {
      EXPECT_TRUE(s.pairing.frozen().empty());
      EXPECT_EQ(s.search_at({-0.5, 0}, true), 1);
      EXPECT_EQ(s.facet(), -1);
      EXPECT_EQ(s.search_at({0.5, 0}, closed), 0);
      EXPECT_EQ(s.facet(), 0);
    }
    EXPECT_EQ(s.pairing.frozen(), std::vector<std::int32_t>{0});
    EXPECT_EQ(s.search_at({-0.5, 0}, true), 0);
    EXPECT_EQ(s.facet(), 0);
  }
}

TEST(Pairing, SlidingOnIsNoReturn)
{
  std::vector<Vector<2>> line;
  for (int i = 0; i <= 10; ++i)
    line.push_back({double(i), 0});
  SlidingSegment s(line);
  for (int i = 0; i < 10; ++i)
  {
    s.search_at({i + 0.5, 0}, true);
    EXPECT_EQ(s.facet(), i);
  }
  EXPECT_TRUE(s.pairing.frozen().empty());
}

TEST(Pairing, CopiesAreIndependent)
{
  SlidingSegment s(flat);
  s.search_at({0.5, 0}, true);
  s.search_at({1.5, 0}, true);
  SlidingSegment copy = s;
  s.search_at({0.5, 0}, true);
  s.search_at({1.5, 0}, true);
  EXPECT_EQ(s.pairing.frozen().size(), 1u);
  EXPECT_TRUE(copy.pairing.frozen().empty());
  EXPECT_EQ(copy.facet(), 1);
  EXPECT_EQ(copy.search_at({0.5, 0}, true), 1);
  EXPECT_EQ(copy.facet(), 0);
  // Each has a tree of its own
  for (std::size_t i = 4; i < s.x.size(); i += 2)
    s.x[i] += 100;
  s.search_at({0.5, 0}, true);
  EXPECT_EQ(copy.search_at({1.5, 0}, false), 0);
  EXPECT_EQ(copy.facet(), 1);
}
} // namespace
