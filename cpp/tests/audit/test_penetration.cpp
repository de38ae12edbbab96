// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#include "scene.h"
#include <contactx/audit/penetration.h>
#include <contactx/geometry/sizes.h>
#include <gtest/gtest.h>
#include <limits>
#include <numbers>

using namespace contactx;
using namespace contactx::audit;
using namespace contactx::tests;

namespace
{
Scene polygon(int n, double radius)
{
  Scene scene(2);
  for (int i = 0; i < n; ++i)
  {
    const double t = 2 * std::numbers::pi * i / n;
    scene.node({radius * std::cos(t), radius * std::sin(t)});
  }
  for (int i = 0; i < n; ++i)
    scene.facet({i, (i + 1) % n});
  return scene;
}

double explained(double size, double curvature, int contact,
                 double extent = std::numeric_limits<double>::infinity())
{
  const std::int8_t flag = contact;
  return allowed_penetration(std::span(&size, 1), std::span(&curvature, 1),
                             std::span(&flag, 1), std::span(&extent, 1))[0];
}

std::vector<double> curvatures(const Scene& scene)
{
  return geometry::nodal_curvatures(
      scene.facets(), scene.x,
      geometry::nodal_normals(scene.facets(), scene.x, scene.gdim), scene.gdim);
}

TEST(NodalCurvatures, OfACircle)
{
  for (double radius : {0.01, 1., 300.})
  {
    const Scene scene = polygon(48, radius);
    for (double k : curvatures(scene))
      EXPECT_NEAR(k * radius, 1, 1e-12);
  }
}

TEST(NodalCurvatures, OfAPlaneAreNone)
{
  const Scene scene = flat_grid(4, Cells::mixed);
  for (double k : curvatures(scene))
    EXPECT_NEAR(k, 0, 1e-12);
}

TEST(NodalCurvatures, OfAnEdgeGrowWithTheMesh)
{
  // The foot of a punch: its corner is no curvature that a mesh resolves
  double before = 0;
  for (int n : {2, 4, 8})
  {
    Scene scene(2);
    for (int i = 0; i <= n; ++i)
      scene.node({double(i) / n, 0});
    for (int i = 1; i <= n; ++i)
      scene.node({1, double(i) / n});
    for (int i = 0; i < 2 * n; ++i)
      scene.facet({i, i + 1});
    const double k = curvatures(scene)[n];
    EXPECT_NEAR(k, 2 * std::sin(std::numbers::pi / 8) * n, 1e-12);
    EXPECT_GT(k, 1.9 * before);
    before = k;
  }
}

TEST(FacetSizes, AreTheLongestDistances)
{
  Scene scene(3);
  for (const Vector<3>& p :
       {Vector<3>{0, 0, 0}, {3, 0, 0}, {0, 4, 0}, {3, 4, 0}})
    scene.node(p);
  scene.facet({0, 1, 2, 3});
  scene.facet({0, 1, 2});
  EXPECT_EQ(geometry::facet_sizes(scene.facets(), scene.x, 3),
            (std::vector<double>{5, 5}));
}

TEST(ExplainedDepths, CoverTheChordOfACircle)
{
  for (double h : {0.01, 0.1, 0.49})
  {
    const double chord = 1 - std::sqrt(1 - h * h / 4);
    EXPECT_GT(explained(h, 1, 0), chord);
    EXPECT_LT(explained(h, 1, 0), 3 * chord + 4e-3 * h);
  }
}

TEST(ExplainedDepths, DoNotCoverWhatTheFacetDoesNotResolve)
{
  EXPECT_EQ(explained(1, 1.12, 0), 1. / 256);
  EXPECT_EQ(explained(1, 100, 0), 1. / 256);
  EXPECT_EQ(explained(1, 0, 0), 1. / 256);
}

TEST(ExplainedDepths, ScaleWithTheUnits)
{
  for (double unit : {1e-6, 1., 1e6})
  {
    EXPECT_NEAR(explained(2 * unit, 1 / unit, 2), 0.3 * unit, 1e-12 * unit);
    EXPECT_NEAR(explained(0.5 * unit, 1 / unit, 0), unit / 16, 2e-3 * unit);
  }
}

TEST(ExplainedDepths, AreHalfBesideContact)
{
  for (double curvature : {0., 1.12, 100.})
  {
    EXPECT_EQ(explained(1, curvature, 1), 0.075);
    EXPECT_EQ(explained(1, curvature, 2), 0.15);
  }
  // But an arc meets a node there, too
  EXPECT_EQ(explained(1, 1, 1), 0.15);
}

TEST(ExplainedDepths, CoverAnArcUntilItMeetsANodeWhereverAStepEnds)
{
  // An arc of radius 1 may be as deep as its chord between open nodes, and
  // where one of them is in contact
  for (double h : {0.1, 0.5, 0.6, 0.9, 1.1})
  {
    const double chord = 1 - std::sqrt(1 - h * h / 4);
    for (int contact : {0, 1, 2})
      EXPECT_GE(explained(h, 1, contact), chord);
    // Up to there nothing is harm, and beyond all of it
    EXPECT_LE(chord, 0.15 * h);
  }
  EXPECT_GT(1 - std::sqrt(1 - 1.12 * 1.12 / 4), 0.15 * 1.12);
}

TEST(ExplainedDepths, EndWhereAFacetIsTooCoarseHoweverTheMasterIsCurved)
{
  // Twice the chord would be a quarter of the facet
  for (int contact : {0, 1, 2})
    for (double curvature : {0.7, 0.9, 1.})
      EXPECT_EQ(explained(1, curvature, contact), 0.15);
}

TEST(ExplainedDepths, OfASmallMasterGoWithItsSize)
{
  EXPECT_EQ(explained(1, 0, 2, 0.1), 0.15 * 0.1);
  EXPECT_EQ(explained(1, 0, 0, 0.1), 0.1 / 256);
  EXPECT_EQ(explained(1, 0, 2, 3), 0.15);
}

TEST(ExplainedDepths, RefuseArraysOfDifferentSizes)
{
  const std::vector<double> two(2), one(1);
  const std::vector<std::int8_t> flags(2);
  EXPECT_THROW(allowed_penetration(two, one, flags, two),
               std::invalid_argument);
  EXPECT_THROW(allowed_penetration(one, one, flags, one),
               std::invalid_argument);
}

TEST(FacetTurns, RefuseNormalsOfOtherNodes)
{
  const Scene scene = flat_grid(1, Cells::triangles);
  EXPECT_THROW(
      geometry::facet_turns(scene.facets(), scene.x, std::vector<double>(3), 3),
      std::invalid_argument);
}
} // namespace
