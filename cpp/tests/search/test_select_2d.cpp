// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#include "select_scenes.h"
#include <contactx/geometry/shape.h>
#include <gtest/gtest.h>

using namespace contactx;
using namespace contactx::search;
using namespace contactx::tests;

namespace
{
constexpr double right_angle = 1.5707963267948966;

TEST(Select2D, FlatNeighboursGiveTheirNormalEverywhere)
{
  const Scene scene = fold_2d(0);
  for (double height : {-0.2, 0.0, 0.2})
    for (double x : {-0.5, -1e-13, 0.0, 1e-13, 1e-3, 0.5})
    {
      const auto q = paired(scene, {x, height});
      ASSERT_TRUE(q);
      EXPECT_EQ(q->feature, geometry::interior);
      EXPECT_EQ(q->normal, (Vector<3>{0, 1, 0}));
      EXPECT_NEAR(q->gap, height, 1e-15);
    }
}

TEST(Select2D, SurfaceReachesItsMarginBeyondItsEnds)
{
  const Scene scene = fold_2d(0);
  for (double height : {-0.1, 0.1})
  {
    const auto q = paired(scene, {-1 - 0.9 * geometry::facet_margin, height});
    ASSERT_TRUE(q);
    EXPECT_NEAR(q->excess, 0.9 * geometry::facet_margin, 1e-14);
    EXPECT_FALSE(paired(scene, {-1 - 1.1 * geometry::facet_margin, height}));
    EXPECT_TRUE(paired(scene, {1 + 0.9 * geometry::facet_margin, height}));
    EXPECT_FALSE(paired(scene, {1 + 1.1 * geometry::facet_margin, height}));
  }
}

TEST(Select2D, RidgeGivesTheDirectionFromItsVertex)
{
  const Scene scene = fold_2d(right_angle);
  const auto q = paired(scene, {0.3, 0.4});
  ASSERT_TRUE(q);
  EXPECT_NE(q->feature, geometry::interior);
  EXPECT_LT(norm(q->normal - Vector<3>{0.6, 0.8}), 1e-15);
  EXPECT_NEAR(q->gap, 0.5, 1e-15);
  const auto flat = paired(scene, {0.9 * geometry::facet_margin, 0.4});
  ASSERT_TRUE(flat);
  EXPECT_EQ(flat->feature, geometry::interior);
  EXPECT_NEAR(flat->gap, 0.4, 1e-15);
}

TEST(Select2D, ConeComponentsGiveTheNormalBack)
{
  const Scene scene = fold_2d(right_angle);
  const auto q = paired(scene, {0.3, 0.4});
  ASSERT_TRUE(q);
  const Vector<3> c = cone_components(scene.surface(), scene.x, *q);
  EXPECT_EQ(c[1], 0);
  EXPECT_NEAR(std::abs(c[0]), 0.6, 1e-15);
  EXPECT_NEAR(c[2], 0.8, 1e-15);
}

TEST(Select2D, BehindAValleyTheDeepestFacetCounts)
{
  const Scene scene = fold_2d(-right_angle);
  for (Vector<3> p : {Vector<3>{0.3, -0.1}, {0.1, -0.3}})
  {
    const auto q = paired(scene, p);
    ASSERT_TRUE(q);
    EXPECT_EQ(q->feature, geometry::interior);
    EXPECT_NEAR(q->gap, -0.3, 1e-15);
  }
  const auto floor = paired(scene, {-0.3, -0.1});
  ASSERT_TRUE(floor);
  EXPECT_NEAR(floor->gap, -0.1, 1e-15);
}

TEST(Facing, PassesOverFacetsThatDoNotOpposeTheNormal)
{
  // Both sides of a thin plate, the upper one first
  Scene scene = fold_2d(0);
  const std::int32_t a = scene.node({-1, -0.1}), b = scene.node({1, -0.1});
  scene.facet({a, b});
  const Vector<3> p{0.5, 0.02};
  const auto upper = paired(scene, p, {0, -1});
  ASSERT_TRUE(upper);
  EXPECT_EQ(upper->facet, 1);
  const auto lower = paired(scene, p, {0, 1});
  ASSERT_TRUE(lower);
  EXPECT_EQ(lower->facet, 2);
  EXPECT_NEAR(lower->gap, -0.12, 1e-15);
  const auto any = paired(scene, p);
  ASSERT_TRUE(any);
  EXPECT_EQ(any->facet, 1);
  EXPECT_FALSE(paired(scene, p, {1, 0})); // across: does not oppose
}

TEST(Facing, ARidgeWhereFacingFacetsEndIsNoPairFromFarBehind)
{
  // A crest: the flat top does not face a point to the left of it, whose normal
  // points left; the ramp on the right does
  const Scene scene = fold_2d(0.2);
  EXPECT_FALSE(paired(scene, {-3, -0.2}, {-1, 0}));
  // Just beside the ridge it still counts
  EXPECT_TRUE(paired(scene, {-1e-3, -1e-3}, {-1, 0}));
}
} // namespace
