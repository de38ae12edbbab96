// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#include "scene.h"
#include <contactx/geometry/facing.h>
#include <gtest/gtest.h>
#include <numbers>

using namespace contactx;
using namespace contactx::geometry;
using namespace contactx::tests;

namespace
{
/// Normals at all nodes that are the same.
std::vector<double> everywhere(const Scene& scene, const Vector<3>& n)
{
  std::vector<double> normal;
  for (std::size_t i = 0; i < scene.x.size() / scene.gdim; ++i)
    normal.insert(normal.end(), n.begin(), n.begin() + scene.gdim);
  return normal;
}

/// Boundary of the unit square, turned by an angle, counterclockwise: nodes 0
/// to 3 at the corners, 4 amid the bottom.
Scene square(double angle = 0)
{
  Scene scene(2);
  const double c = std::cos(angle), s = std::sin(angle);
  for (const auto& [x, y] :
       {std::pair{0., 0.}, {1., 0.}, {1., 1.}, {0., 1.}, {0.5, 0.}})
    scene.node({c * x - s * y, s * x + c * y});
  scene.facet({0, 4});
  scene.facet({4, 1});
  scene.facet({1, 2});
  scene.facet({2, 3});
  scene.facet({3, 0});
  return scene;
}

std::vector<double> areas(const Scene& scene, const Vector<3>& normal)
{
  const auto corners = geometry::facing_areas(
      scene.facets(), scene.x, scene.x, everywhere(scene, normal), scene.gdim);
  std::vector<double> sums(scene.x.size() / scene.gdim, 0);
  for (std::size_t c = 0; c < corners.size(); ++c)
    sums[scene.nodes[c]] += corners[c];
  return sums;
}

TEST(FacingNodes, OfABoxAreThoseBelow)
{
  const Scene scene = square();
  const auto faces = geometry::facing_nodes(scene.facets(), scene.x,
                                            everywhere(scene, {0, 1}), 2);
  EXPECT_EQ(faces, (std::vector<std::int8_t>{1, 1, 0, 0, 1}));
}

TEST(FacingNodes, NoneFaceWhereTheMasterHasNoNormal)
{
  const Scene scene = flat_grid(2, Cells::mixed);
  const auto faces = geometry::facing_nodes(scene.facets(), scene.x,
                                            everywhere(scene, {0, 0, 0}), 3);
  EXPECT_EQ(faces, std::vector<std::int8_t>(9, 0));
}

TEST(FacingNodes, ASheetPushedBeyondTheMiddleOfABallDoesNotFaceIt)
{
  const Scene scene = flat_grid(2, Cells::triangles);
  const auto at = [&scene](double z)
  {
    // Normals of a ball below the middle of the sheet, or above it
    std::vector<double> normal;
    for (int i = 0; i < 9; ++i)
    {
      const Vector<3> d = scene.point(i) - Vector<3>{0.5, 0.5, z};
      const Vector<3> n = (1 / norm(d)) * d;
      normal.insert(normal.end(), n.begin(), n.end());
    }
    return geometry::facing_nodes(scene.facets(), scene.x, normal, 3);
  };
  EXPECT_EQ(at(0.1), std::vector<std::int8_t>(9, 1));
  EXPECT_EQ(at(-0.1), std::vector<std::int8_t>(9, 0));
}

TEST(FacingAreas, LeaveOutTheSidesOfABox)
{
  for (double angle : {0., 0.3, -0.4})
  {
    const Scene scene = square(angle);
    const auto area = areas(scene, {0, 1});
    EXPECT_NEAR(area[0], 0.25, 1e-14);
    EXPECT_NEAR(area[1], 0.25, 1e-14);
    EXPECT_NEAR(area[4], 0.5, 1e-14);
  }
  // Nothing of those above faces the master: they keep all
  EXPECT_NEAR(areas(square(), {0, 1})[2], 1, 1e-14);
}

TEST(FacingAreas, OfABoxOnItsEdgeAreThoseOfBothSides)
{
  const double quarter = std::numbers::pi / 4;
  const auto area = areas(square(quarter), {0, 1});
  EXPECT_NEAR(area[0], 0.25 + 0.5, 1e-14);
}

TEST(FacingAreas, OfARoundBodyAreWhole)
{
  Scene scene(2);
  const int n = 12;
  for (int i = 0; i < n; ++i)
  {
    const double t = 2 * std::numbers::pi * i / n;
    scene.node({std::cos(t), std::sin(t)});
  }
  for (int i = 0; i < n; ++i)
    scene.facet({i, (i + 1) % n});
  const auto whole = geometry::nodal_areas(scene.facets(), scene.x, 2);
  const auto area = areas(scene, {0.1, std::sqrt(0.99)});
  for (int i : {8, 9, 10})
    EXPECT_NEAR(area[i], whole[i], 1e-14);
}

TEST(FacingAreas, AreThoseOfTheReference)
{
  const Scene scene = flat_grid(3, Cells::quadrilaterals);
  auto x = scene.x;
  for (double& c : x)
    c *= 3;
  const auto corners = geometry::facing_areas(scene.facets(), scene.x, x,
                                              everywhere(scene, {0, 0, -1}), 3);
  double sum = 0;
  for (double a : corners)
    sum += a;
  EXPECT_NEAR(sum, 1, 1e-13);
}

TEST(FacingAreas, RefuseNormalsOfOtherNodes)
{
  const Scene scene = flat_grid(1, Cells::quadrilaterals);
  const std::vector<double> few(3);
  EXPECT_THROW(geometry::facing_areas(scene.facets(), scene.x, scene.x, few, 3),
               std::invalid_argument);
  EXPECT_THROW(geometry::facing_areas(scene.facets(), few, scene.x, scene.x, 3),
               std::invalid_argument);
  EXPECT_THROW(geometry::facing_nodes(scene.facets(), scene.x, few, 3),
               std::invalid_argument);
}
} // namespace
