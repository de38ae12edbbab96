// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#include "generator.h"
#include "scene.h"
#include <contactx/geometry/shape.h>
#include <contactx/search/finder.h>
#include <contactx/search/select.h>
#include <gtest/gtest.h>

using namespace contactx;
using namespace contactx::search;
using namespace contactx::tests;

namespace
{
/// @brief The projection that a search finds for a point of any normal.
inline std::optional<search::Projection>
paired(const Scene& scene, const Vector<3>& p, const Vector<3>& normal = {})
{
  const search::Surface surface = scene.surface();
  const search::BoxTree tree(surface.boxes(scene.x));
  const auto q = search::nearest_facet(surface, tree, scene.x, p, normal, 10);
  return q ? search::select(surface, scene.x, p, *q) : q;
}

/// @brief Two unit squares that meet at an edge on the y axis: the first is
/// x in [-1, 0] at z = 0 with the normal (0, 0, 1), the second is turned down
/// by the angle `down`, so that the edge is a ridge where it is positive and
/// a valley where it is negative.
inline Scene fold(double down, bool split)
{
  const double c = std::cos(down), s = std::sin(down);
  Scene scene(
      3, {{-1, 0, 0}, {0, 0, 0}, {-1, 1, 0}, {0, 1, 0}, {c, 0, -s}, {c, 1, -s}},
      {});
  scene.patch({0, 1, 2, 3}, split);
  scene.patch({1, 4, 3, 5}, split);
  return scene;
}

/// @brief The fold of two unit segments in the plane, with the body below.
inline Scene fold_2d(double down)
{
  return {2,
          {{-1, 0}, {0, 0}, {std::cos(down), -std::sin(down)}},
          {{1, 0}, {2, 1}}};
}

/// @brief The three faces of a box that meet at its corner (0, 0, 0), with
/// the box in the octant of negative coordinates.
inline Scene corner(bool split)
{
  Scene scene(3,
              {{0, 0, 0},
               {-1, 0, 0},
               {0, -1, 0},
               {-1, -1, 0},
               {0, 0, -1},
               {-1, 0, -1},
               {0, -1, -1}},
              {});
  scene.patch({3, 2, 1, 0}, split); // z = 0
  scene.patch({5, 1, 4, 0}, split); // y = 0
  scene.patch({6, 4, 2, 0}, split); // x = 0
  return scene;
}

/// On quadrilaterals and on the triangles that they split into.
using Select = testing::TestWithParam<bool>;
INSTANTIATE_TEST_SUITE_P(Split, Select, testing::Bool());

constexpr Vector<3> up{0, 0, 1};

TEST_P(Select, SurfaceReachesItsMarginBeyondItsCorners)
{
  const Scene scene
      = flat_grid(1, GetParam() ? Cells::triangles : Cells::quadrilaterals);
  constexpr double margin = geometry::facet_margin;
  for (double height : {-0.1, 0.0, 0.1})
  {
    EXPECT_TRUE(paired(scene, {-0.99 * margin, -0.01, height}));
    EXPECT_FALSE(paired(scene, {-1.01 * margin, -0.01, height}));
    EXPECT_TRUE(paired(scene, {0.01, 1 + 0.9 * margin, height}));
    EXPECT_FALSE(paired(scene, {0.01, 1 + 1.1 * margin, height}));
  }
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

constexpr double right_angle = 1.5707963267948966;

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

TEST(SelectFolded, FacetsWhoseNormalsCancelGiveAUnitNormal)
{
  // Both sides of one triangle, so long that the point touches its vertex
  Scene scene(3);
  scene.node(
      {-3.0081176757812501e+29, -3.01971435546875e+29, 1.525878906249698e+41});
  scene.node({1, -3.01971435546875e+29, 0});
  scene.node({0, 1, 0});
  scene.facet({0, 1, 2});
  scene.facet({0, 2, 1});
  Finder finder(scene.offsets, scene.nodes, 3);
  finder.refit(scene.x);
  const auto found = finder.find(
      scene.x, {2, -3.3216857910156249e+29, -39367.67578125}, {}, INFINITY);
  ASSERT_TRUE(found.selected.has_value());
  EXPECT_NE(found.selected->feature, geometry::interior);
  EXPECT_NEAR(norm(found.selected->normal), 1, 1e-12);
}

/// Folds of segments, and of quadrilaterals and the triangles that they split
/// into.
struct Folds : testing::TestWithParam<std::string>
{
  Scene fold(double down) const
  {
    return is_flat ? fold_2d(down) : ::fold(down, GetParam() == "triangles");
  }

  /// @brief Direction across the edge, given by x and height.
  Vector<3> way(double x, double height) const
  {
    return is_flat ? Vector<3>{x, height} : Vector<3>{x, 0, height};
  }

  /// @brief Point over or beside the edge.
  Vector<3> at(double x, double height, double y = 0.4) const
  {
    return way(x, height) + Vector<3>{0, is_flat ? 0 : y, 0};
  }

  bool is_flat = GetParam() == "segments";
};

INSTANTIATE_TEST_SUITE_P(Of, Folds,
                         testing::Values("segments", "triangles",
                                         "quadrilaterals"),
                         [](const auto& info) { return info.param; });

TEST_P(Folds, SurfaceReachesItsMarginBeyondTheOuterEdge)
{
  const Scene scene = fold(0);
  constexpr double margin = geometry::facet_margin;
  for (double height : {-0.1, 0.0, 0.1})
  {
    const auto inside = paired(scene, at(-1 - 0.99 * margin, height));
    ASSERT_TRUE(inside);
    EXPECT_EQ(inside->feature, geometry::interior);
    EXPECT_NEAR(inside->excess, 0.99 * margin, 1e-14);
    EXPECT_NEAR(inside->gap, height, 1e-15);
    EXPECT_FALSE(paired(scene, at(-1 - 1.01 * margin, height)));
    EXPECT_TRUE(paired(scene, at(1 + 0.9 * margin, height)));
    EXPECT_FALSE(paired(scene, at(1 + 1.1 * margin, height)));
  }
}

TEST_P(Folds, FlatNeighboursGiveTheirNormalEverywhere)
{
  const Scene scene = fold(0);
  for (double height : {-0.2, 0.0, 0.2})
    for (double x : {-0.5, -1e-3, -1e-13, 0.0, 1e-13, 1e-3, 0.5})
    {
      const auto q = paired(scene, at(x, height));
      ASSERT_TRUE(q);
      EXPECT_EQ(q->feature, geometry::interior);
      EXPECT_LT(norm(q->normal - way(0, 1)), 1e-15);
      EXPECT_NEAR(q->gap, height, 1e-15);
      EXPECT_LE(q->excess, geometry::facet_margin);
    }
}

TEST_P(Folds, RidgeGivesTheDirectionFromItsEdge)
{
  const Scene scene = fold(right_angle);
  const auto q = paired(scene, at(0.3, 0.4));
  ASSERT_TRUE(q);
  EXPECT_NE(q->feature, geometry::interior);
  EXPECT_LT(norm(q->normal - way(0.6, 0.8)), 1e-15);
  EXPECT_NEAR(q->gap, 0.5, 1e-15);
  // Within the margin it is a facet
  const auto flat = paired(scene, at(0.9 * geometry::facet_margin, 0.4));
  ASSERT_TRUE(flat);
  EXPECT_EQ(flat->feature, geometry::interior);
  EXPECT_LT(norm(flat->normal - way(0, 1)), 1e-15);
  EXPECT_NEAR(flat->gap, 0.4, 1e-15);
}

TEST_P(Folds, RidgeNormalIsInTheConeOfTheFacets)
{
  Generator random(1);
  int ridges = 0;
  for (int i = 0; i < 500; ++i)
  {
    const double down = random(0.2, 2.5);
    const Scene scene = fold(down);
    const double turn = random(0, down);
    const Vector<3> n = way(std::sin(turn), std::cos(turn));
    const double height = random(0.1, 2), y = random(0.1, 0.9);
    const auto q = paired(scene, at(0, 0, y) + height * n);
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

TEST_P(Folds, BehindTheEdgeOfAValleyTheDeepestFacetCounts)
{
  // A floor and the wall x = 0 that rises from it
  const Scene scene = fold(-right_angle);
  for (const Vector<3>& p : {at(0.3, -0.1), at(0.1, -0.3)})
  {
    const auto q = paired(scene, p);
    ASSERT_TRUE(q);
    EXPECT_EQ(q->feature, geometry::interior);
    EXPECT_NEAR(q->gap, -0.3, 1e-15);
  }
}

TEST_P(Folds, BesideTheEdgeOfAValleyItIsTheFacetThatIsPenetratedOrNearest)
{
  struct Case
  {
    Vector<3> p;
    double gap;
    Vector<3> normal;
  };
  const Scene scene = fold(-right_angle);
  for (const Case& c :
       {Case{at(-0.3, -0.1), -0.1, way(0, 1)}, // behind the floor
        {at(0.1, 0.3), -0.1, way(-1, 0)},      // behind the wall
        {at(-0.3, 0.1), 0.1, way(0, 1)}})      // before both
  {
    SCOPED_TRACE(testing::PrintToString(c.p));
    const auto q = paired(scene, c.p);
    ASSERT_TRUE(q);
    EXPECT_EQ(q->feature, geometry::interior);
    EXPECT_NEAR(q->gap, c.gap, 1e-15);
    EXPECT_LT(norm(q->normal - c.normal), 1e-15);
  }
}

TEST_P(Folds, GapInAValleyIsThatOfTheDeepestFacetInTheMargin)
{
  Generator random(1);
  for (int i = 0; i < 1000; ++i)
  {
    const double up = random(0.3, 2);
    const Scene scene = fold(-up);
    const double x = random(-0.3, 0.3), y = random(0.2, 0.8);
    const double floor = random(-0.3, -0.01);
    const double wall = -std::sin(up) * x + std::cos(up) * floor;
    const double beyond = -(std::cos(up) * x + std::sin(up) * floor);
    if (wall > -0.01)
      continue;
    const auto q = paired(scene, at(x, floor, y));
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
  Scene scene = fold(-right_angle, false);
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
  for (const double down : {right_angle, -right_angle, 0.9, -0.9})
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
/// A point and one that was in front of it, both of which have moved since.
TEST(View, HasAllThatWasInFrontBeforeItMoved)
{
  Generator random(11);
  for (int i = 0; i < 1000; ++i)
  {
    const Vector<3> normal = random.unit<3>(), p = random.vector<3>(-3, 3);
    Vector<3> other = p + random.vector<3>(-3, 3);
    if (dot(normal, other - p) < 0)
      other = other - (2 * dot(normal, other - p)) * normal;
    const double moved = random(0, 0.5);
    const Vector<3> now = p + random(0, moved) * random.unit<3>(),
                    turned = random.unit<3>();
    const Vector<3> sum = normal + random(0, 0.5) * turned,
                    new_normal = (1 / norm(sum)) * sum;
    Box box = Box::empty();
    box.add(other + random(0, moved) * random.unit<3>());
    const View view{0, moved, norm(new_normal - normal)};
    EXPECT_TRUE(view.has(box, now, new_normal));
  }
}

TEST(View, PassesOverWhatIsBehind)
{
  const Vector<3> up{0, 0, 1};
  const auto at = [](double z)
  {
    Box box = Box::empty();
    box.add(Vector<3>{1, 0, z});
    box.add(Vector<3>{2, 1, z - 1});
    return box;
  };
  const View view{.near = 1.2, .moved = 0.1, .level = 0.01};
  EXPECT_TRUE(view.has(at(0.3), {}, up));
  EXPECT_TRUE(view.has(at(-0.22), {}, up));
  EXPECT_TRUE(view.has(at(-0.6), {}, up)); // near
  EXPECT_FALSE(view.has(at(-0.7), {}, up));
  EXPECT_TRUE(View{}.has(at(-9), {}, up));
}
} // namespace
