// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#include "select_scenes.h"
#include <contactx/search/finder.h>
#include <gtest/gtest.h>

using namespace contactx;
using namespace contactx::search;
using namespace contactx::tests;

namespace
{
/// What a finder selects on the fold of two segments; its facets in either
/// order.
std::optional<Projection> selected(double down, const Vector<3>& p,
                                   bool turned = false)
{
  const Scene scene = fold_2d(down);
  const std::vector<std::int32_t> nodes
      = turned ? std::vector<std::int32_t>{2, 1, 1, 0}
               : std::vector<std::int32_t>{1, 0, 2, 1};
  Finder finder({0, 2, 4}, nodes, 2);
  finder.refit(scene.x);
  return finder.find(scene.x, p, {}, 10).selected;
}

/// Point at a height over the fold's vertex, half way between its facets.
Vector<3> over(double down, double height)
{
  return {height * std::sin(down / 2), height * std::cos(down / 2), 0};
}

TEST(Bisector, IsHalfWayOverRidgesAndValleys)
{
  for (const double down : {0.1, -0.1, 0.01, -0.01})
    for (const double height : {-0.2, -1e-3, 0.0, 1e-13, 1e-3, 0.2})
      for (const bool turned : {false, true})
      {
        const auto q = selected(down, over(down, height), turned);
        ASSERT_TRUE(q);
        EXPECT_NE(q->feature, geometry::interior);
        EXPECT_LT(norm(q->normal - over(down, 1)), 1e-9);
        EXPECT_NEAR(q->gap, height, 1e-12);
        EXPECT_LT(norm(q->d - over(down, height)), 1e-12);
      }
}

TEST(Bisector, RoundingDoesNotChooseTheFacet)
{
  const double down = -0.1;
  const auto q = selected(down, over(down, 1e-3));
  for (const double off : {-1e-10, -1e-14, 1e-14, 1e-10})
  {
    const auto r = selected(down, over(down, 1e-3) + Vector<3>{off, 0, 0});
    EXPECT_EQ(r->facet, q->facet);
    EXPECT_EQ(r->feature, q->feature);
  }
}

TEST(Bisector, IsNothingBesideTheMiddle)
{
  for (const double down : {0.1, -0.1})
    for (const double off : {-1e-3, -1e-6, 1e-6, 1e-3})
    {
      const auto q = selected(down, over(down, -1e-3) + Vector<3>{off, 0, 0});
      ASSERT_TRUE(q);
      EXPECT_EQ(q->feature, geometry::interior);
    }
}

TEST(Bisector, IsNothingWhereFacetsAreInLine)
{
  for (const double height : {-0.1, 0.0, 0.1})
    EXPECT_EQ(selected(0, {0, height, 0})->feature, geometry::interior);
}

TEST(Bisector, LeavesCornersToTheirFacets)
{
  // A box that stands with its corner on that of another one
  for (const double down : {std::acos(0.0), -std::acos(0.0), 0.8, -0.8})
    for (const double height : {-1e-3, 0.0})
      EXPECT_EQ(selected(down, over(down, height))->feature,
                geometry::interior);
}

TEST(Bisector, IsNothingFarFromTheVertex)
{
  // Behind a ridge both sides may be as near
  const double down = 0.5;
  const auto q = selected(down, over(down, -0.4));
  ASSERT_TRUE(q);
  EXPECT_EQ(q->feature, geometry::interior);
}
} // namespace
