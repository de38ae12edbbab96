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
/// On quadrilaterals and on the triangles that they split into.
class Valley : public ::testing::TestWithParam<bool>
{
};
INSTANTIATE_TEST_SUITE_P(Split, Valley, ::testing::Bool());

TEST_P(Valley, BehindItsEdgeTheDeepestFacetCounts)
{
  // A floor and the wall x = 0 that rises from it
  const Scene scene = fold(-std::acos(0.0), GetParam());
  for (Vector<3> p : {Vector<3>{0.3, 0.5, -0.1}, {0.1, 0.5, -0.3}})
  {
    const auto q = paired(scene, p);
    ASSERT_TRUE(q);
    EXPECT_EQ(q->feature, geometry::interior);
    EXPECT_NEAR(q->gap, -0.3, 1e-15);
  }
}

TEST_P(Valley, FromInsideItIsTheFacetThatIsPenetrated)
{
  const Scene scene = fold(-std::acos(0.0), GetParam());
  const auto floor = paired(scene, {-0.3, 0.5, -0.1});
  ASSERT_TRUE(floor);
  EXPECT_NEAR(floor->gap, -0.1, 1e-15);
  EXPECT_NEAR(floor->normal[2], 1, 1e-15);
  const auto wall = paired(scene, {0.1, 0.5, 0.3});
  ASSERT_TRUE(wall);
  EXPECT_NEAR(wall->gap, -0.1, 1e-15);
  EXPECT_NEAR(wall->normal[0], -1, 1e-15);
}

TEST_P(Valley, FromOutsideItIsTheNearestFacet)
{
  const Scene scene = fold(-std::acos(0.0), GetParam());
  const auto q = paired(scene, {-0.3, 0.5, 0.1});
  ASSERT_TRUE(q);
  EXPECT_EQ(q->feature, geometry::interior);
  EXPECT_NEAR(q->gap, 0.1, 1e-15);
}

TEST_P(Valley, GapIsThatOfTheDeepestFacetInTheMargin)
{
  Generator random(1);
  for (int i = 0; i < 1000; ++i)
  {
    const double up = random(0.3, 2);
    const Scene scene = fold(-up, GetParam());
    const double x = random(-0.3, 0.3);
    const Vector<3> p{x, random(0.2, 0.8), random(-0.3, -0.01)};
    const double floor = p[2];
    const double wall = -std::sin(up) * p[0] + std::cos(up) * p[2];
    const double beyond = -(std::cos(up) * p[0] + std::sin(up) * p[2]);
    if (wall > -0.01)
      continue;
    const auto q = paired(scene, p);
    ASSERT_TRUE(q);
    EXPECT_EQ(q->feature, geometry::interior);
    // Behind both extended facets either of them may be out of reach, but
    // what counts is never less than the nearest and never another plane
    const bool on_floor = x <= geometry::facet_margin,
               on_wall = beyond <= geometry::facet_margin;
    const double expected = on_floor and !on_wall   ? floor
                            : on_wall and !on_floor ? wall
                                                    : std::min(floor, wall);
    EXPECT_NEAR(q->gap, expected, 1e-14);
  }
}

TEST(ValleyOfTwo, DeepestFacetCountsWhateverItsWidth)
{
  // The point is beyond the floor by 4 % and beyond the wide wall by 2 %, but
  // deeper in the floor
  Scene scene = fold(-std::acos(0.0), false);
  for (int node : {4, 5})
    scene.x[3 * node + 2] *= 3;
  const auto q = paired(scene, {0.04, 0.5, -0.06});
  ASSERT_TRUE(q);
  EXPECT_NEAR(q->gap, -0.06, 1e-15);
}

TEST(ValleyOfThree, CornerOfARoomFromBehind)
{
  Scene scene = corner(false);
  for (double& c : scene.x)
    c = -c; // now the faces are seen from the room that they enclose
  const auto q = paired(scene, {-0.1, -0.2, -0.3});
  ASSERT_TRUE(q);
  EXPECT_NEAR(q->gap, -0.3, 1e-15);
  EXPECT_LT(norm(q->normal - Vector<3>{0, 0, 1}), 1e-15);
}
} // namespace
