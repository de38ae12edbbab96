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
class Select : public ::testing::TestWithParam<bool>
{
};
INSTANTIATE_TEST_SUITE_P(Split, Select, ::testing::Bool());

constexpr Vector<3> up{0, 0, 1};

TEST_P(Select, FlatNeighboursGiveTheirNormalEverywhere)
{
  const Scene scene = fold(0, GetParam());
  for (double height : {-0.2, 0.0, 0.2})
    for (double x : {-0.5, -1e-3, -1e-13, 0.0, 1e-13, 1e-3, 0.5})
    {
      const auto q = paired(scene, {x, 0.4, height});
      ASSERT_TRUE(q);
      EXPECT_EQ(q->feature, geometry::interior);
      EXPECT_LT(norm(q->normal - up), 1e-15);
      EXPECT_NEAR(q->gap, height, 1e-15);
      EXPECT_LE(q->excess, geometry::facet_margin);
    }
}

TEST_P(Select, SurfaceReachesItsMarginBeyondTheOuterEdge)
{
  const Scene scene
      = flat_grid(1, GetParam() ? Cells::triangles : Cells::quadrilaterals);
  for (double height : {-0.1, 0.0, 0.1})
  {
    const auto inside
        = paired(scene, {-0.99 * geometry::facet_margin, 0.5, height});
    ASSERT_TRUE(inside);
    EXPECT_EQ(inside->feature, geometry::interior);
    EXPECT_NEAR(inside->excess, 0.99 * geometry::facet_margin, 1e-14);
    EXPECT_NEAR(inside->gap, height, 1e-15);
    EXPECT_FALSE(paired(scene, {-1.01 * geometry::facet_margin, 0.5, height}));
    // Beyond the corners, too
    EXPECT_TRUE(paired(scene, {-0.99 * geometry::facet_margin, -0.01, height}));
    EXPECT_FALSE(
        paired(scene, {-1.01 * geometry::facet_margin, -0.01, height}));
    EXPECT_TRUE(
        paired(scene, {0.01, 1 + 0.9 * geometry::facet_margin, height}));
    EXPECT_FALSE(
        paired(scene, {0.01, 1 + 1.1 * geometry::facet_margin, height}));
  }
}

TEST_P(Select, RidgeGivesTheDirectionFromItsEdge)
{
  const Scene scene = fold(std::acos(0.0), GetParam());
  const auto q = paired(scene, {0.3, 0.4, 0.4});
  ASSERT_TRUE(q);
  EXPECT_NE(q->feature, geometry::interior);
  EXPECT_LT(norm(q->normal - Vector<3>{0.6, 0, 0.8}), 1e-15);
  EXPECT_NEAR(q->gap, 0.5, 1e-15);
  // Within the margin it is a facet
  const auto flat = paired(scene, {0.9 * geometry::facet_margin, 0.4, 0.4});
  ASSERT_TRUE(flat);
  EXPECT_EQ(flat->feature, geometry::interior);
  EXPECT_LT(norm(flat->normal - up), 1e-15);
  EXPECT_NEAR(flat->gap, 0.4, 1e-15);
}

TEST_P(Select, RidgeNormalIsInTheConeOfTheFacets)
{
  Generator random(1);
  int ridges = 0;
  for (int i = 0; i < 500; ++i)
  {
    const double down = random(0.2, 2.5);
    const Scene scene = fold(down, GetParam());
    const double turn = random(0, down);
    const Vector<3> n{std::sin(turn), 0, std::cos(turn)};
    const double height = random(0.1, 2), y = random(0.1, 0.9);
    const auto q = paired(scene, Vector<3>{0, y, 0} + height * n);
    ASSERT_TRUE(q);
    const bool within = height * std::sin(std::min(turn, down - turn))
                        < geometry::facet_margin;
    if (within)
    {
      EXPECT_EQ(q->feature, geometry::interior);
      continue;
    }
    ++ridges;
    EXPECT_NE(q->feature, geometry::interior);
    EXPECT_LT(norm(q->normal - n), 1e-14); // across the edge, in the cone
    EXPECT_NEAR(q->gap, height, 1e-14);
  }
  EXPECT_GT(ridges, 200);
}

TEST_P(Select, RidgeHasOneFacetWhateverTheRounding)
{
  Generator random(2);
  for (int i = 0; i < 300; ++i)
  {
    Scene scene = fold(1.2, GetParam());
    const Motion<3> motion(random, 3);
    for (int l = 0; l < 6; ++l)
    {
      const Vector<3> p = motion(scene.point(l));
      std::copy(p.begin(), p.end(), scene.x.begin() + 3 * l);
    }
    const double turn = random(0.4, 0.8);
    const auto q = paired(
        scene, motion({std::sin(turn), random(0.1, 0.9), std::cos(turn)}));
    ASSERT_TRUE(q);
    EXPECT_EQ(q->facet, 0 + GetParam()); // the first at the edge
  }
}

TEST_P(Select, CornerGivesTheDirectionFromItsVertex)
{
  const Scene scene = corner(GetParam());
  const Vector<3> p{0.2, 0.3, 0.6};
  const auto q = paired(scene, p);
  ASSERT_TRUE(q);
  EXPECT_EQ(scene.nodes[scene.offsets[q->facet]
                        + (q->feature - 1 - (GetParam() ? 3 : 4))],
            0);
  EXPECT_NEAR(q->gap, 0.7, 1e-15);
  EXPECT_LT(norm(q->normal - (1 / 0.7) * p), 1e-15);
  // Over an edge, over a face
  const auto edge = paired(scene, {-0.5, 0.3, 0.4});
  ASSERT_TRUE(edge);
  EXPECT_LT(norm(edge->normal - Vector<3>{0, 0.6, 0.8}), 1e-15);
  const auto face = paired(scene, {-0.4, -0.5, 0.4});
  ASSERT_TRUE(face);
  EXPECT_LT(norm(face->normal - up), 1e-15);
}

TEST_P(Select, PenetratedRidgeGivesTheNearestFace)
{
  const auto q = paired(corner(GetParam()), {-0.1, -0.2, -0.3});
  ASSERT_TRUE(q);
  EXPECT_EQ(q->feature, geometry::interior);
  EXPECT_NEAR(q->gap, -0.1, 1e-15);
  EXPECT_LT(norm(q->normal - Vector<3>{1, 0, 0}), 1e-15);
}

TEST_P(Select, ConeComponentsGiveTheNormalBack)
{
  const Scene scene = corner(GetParam());
  for (Vector<3> p : {Vector<3>{0.2, 0.3, 0.6}, {-0.5, 0.3, 0.4}})
  {
    const auto q = paired(scene, p);
    ASSERT_TRUE(q);
    const Vector<3> c = cone_components(scene.surface(), scene.x, *q);
    EXPECT_NEAR(norm(c), 1, 1e-15);
    // The last axis is the facet's normal
    const auto e = extended(scene.surface(), q->facet, scene.x, p);
    ASSERT_TRUE(e);
    EXPECT_NEAR(c[2], dot(q->normal, e->normal), 1e-15);
  }
}
} // namespace
