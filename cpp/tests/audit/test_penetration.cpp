// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#include "expect.h"
#include "scene.h"
#include <contactx/audit/facet_sampling.h>
#include <contactx/audit/far_side.h>
#include <contactx/audit/penetration.h>
#include <contactx/geometry/sizes.h>

using namespace contactx;
using namespace contactx::audit;
using namespace contactx::tests;

namespace
{

double explained(double size, double curvature, int contact,
                 double extent = infinity)
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
    const Scene scene = regular_polygon(48, radius);
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
  const Scene scene(3, {{0, 0, 0}, {3, 0, 0}, {0, 4, 0}, {3, 4, 0}},
                    {{0, 1, 2, 3}, {0, 1, 2}});
  EXPECT_EQ(geometry::facet_sizes(scene.facets(), scene.x, 3),
            (std::vector<double>{5, 5}));
}

TEST(ExplainedDepths, AreThoseOfTheFacetsSizeCurvatureAndContact)
{
  // Away from contact what the facet does not resolve is not covered
  for (double curvature : {0., 1.12, 100.})
  {
    EXPECT_EQ(explained(1, curvature, 0), 1. / 256);
    // Half beside contact
    EXPECT_EQ(explained(1, curvature, 1), 0.075);
    EXPECT_EQ(explained(1, curvature, 2), 0.15);
  }
  // But an arc meets a node there, too
  EXPECT_EQ(explained(1, 1, 1), 0.15);
  // A facet is too coarse however the master is curved: twice the chord would
  // be a quarter of the facet
  for (int contact : {0, 1, 2})
    for (double curvature : {0.7, 0.9, 1.})
      EXPECT_EQ(explained(1, curvature, contact), 0.15);
  // A small master goes with its size
  EXPECT_EQ(explained(1, 0, 2, 0.1), 0.15 * 0.1);
  EXPECT_EQ(explained(1, 0, 0, 0.1), 0.1 / 256);
  EXPECT_EQ(explained(1, 0, 2, 3), 0.15);
  for (double unit : {1e-6, 1., 1e6})
  {
    EXPECT_NEAR(explained(2 * unit, 1 / unit, 2), 0.3 * unit, 1e-12 * unit);
    EXPECT_NEAR(explained(0.5 * unit, 1 / unit, 0), unit / 16, 2e-3 * unit);
  }
}

TEST(ExplainedDepths, CoverAnArcUntilItMeetsANodeWhereverAStepEnds)
{
  // An arc of radius 1 may be as deep as its chord between open nodes, and
  // where one of them is in contact
  for (double h : {0.01, 0.1, 0.49, 0.5, 0.6, 0.9, 1.1})
  {
    const double chord = 1 - std::sqrt(1 - h * h / 4);
    for (int contact : {0, 1, 2})
      EXPECT_GE(explained(h, 1, contact), chord);
    if (h < 0.5)
    {
      EXPECT_LT(explained(h, 1, 0), 3 * chord + 4e-3 * h);
    }
    // Up to there nothing is harm, and beyond all of it
    EXPECT_LE(chord, 0.15 * h);
  }
  EXPECT_GT(1 - std::sqrt(1 - 1.12 * 1.12 / 4), 0.15 * 1.12);
}

TEST(ExplainedDepths, RefuseArraysOfDifferentSizes)
{
  const std::vector<double> two(2), one(1);
  const std::vector<std::int8_t> flags(2);
  EXPECT_REFUSED(allowed_penetration(two, one, flags, two));
  EXPECT_REFUSED(allowed_penetration(one, one, flags, one));
}

TEST(FacetTurns, RefuseNormalsOfOtherNodes)
{
  const Scene scene = flat_grid(1, Cells::triangles);
  EXPECT_REFUSED(geometry::facet_turns(scene.facets(), scene.x,
                                       std::vector<double>(3), 3));
}

/// What is sampled of an obstacle below facets, and how many points were
/// needed.
template <class Gap>
std::pair<FacetSampling, std::size_t> sample(const Scene& scene, Gap gap,
                                             double allowed)
{
  FacetSampling sampling(scene.facets(), scene.x, scene.gdim,
                         std::vector<double>(scene.facets().size(), allowed),
                         7);
  std::size_t asked = 0;
  while (!sampling.points().empty())
  {
    std::vector<double> gaps;
    const auto points = sampling.points();
    for (std::size_t i = 0; i < points.size() / scene.gdim; ++i)
      gaps.push_back(gap(vector_at(points, i, scene.gdim)));
    asked += gaps.size();
    sampling.take(gaps);
  }
  return {sampling, asked};
}

auto ball(const Vector<3>& centre, double radius)
{
  return [centre, radius](const Vector<3>& p)
  { return norm(p - centre) - radius; };
}

const Scene triangle(3, {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{0, 1, 2}});
const Scene segment(2, {{0, 0}, {1, 0}}, {{0, 1}});

TEST(FacetSampling, SeesASmallBallAnywhereInAFacet)
{
  for (const Scene& scene :
       {segment, triangle, flat_grid(1, Cells::quadrilaterals)})
  {
    Generator random(3);
    for (int k = 0; k < 200; ++k)
    {
      double s = random(0.01, 0.99), t = random(0.01, 0.99);
      if (scene.gdim == 2)
        t = 0;
      else if (scene.facets()[0].size() == 3 and s + t > 1)
        s = 1 - s, t = 1 - t;
      const auto [sampling, asked] = sample(scene, ball({s, t, 0}, 0.01), 1e-3);
      EXPECT_LT(sampling.gaps()[0], -1e-3);
      // Not everywhere: only towards the ball
      EXPECT_LT(asked, 400u);
    }
  }
}

TEST(FacetSampling, RemembersTheDeepestPlace)
{
  const FacetSampling fresh(triangle.facets(), triangle.x, 3, {1e-3}, 7);
  EXPECT_TRUE(std::isnan(fresh.deepest()[0]));
  const auto gap = ball({0.3, 0.4, 0}, 0.01);
  const auto sampling = sample(triangle, gap, 1e-3).first;
  EXPECT_EQ(gap(vector_at(sampling.deepest(), 0, 3)), sampling.gaps()[0]);
}

TEST(FacetSampling, AsksOnceWhereTheObstacleIsFar)
{
  const auto [sampling, asked]
      = sample(flat_grid(8, Cells::mixed), ball({0.5, 0.5, 9}, 1), 1e-3);
  EXPECT_EQ(asked, sampling.gaps().size());
}

TEST(FacetSampling, LooksNoCloserThanTheDepthThatIsAllowed)
{
  const Scene& scene = triangle;
  const auto wide = sample(scene, ball({0.3, 0.3, -5}, 5), 0.2).second;
  const auto close = sample(scene, ball({0.3, 0.3, -5}, 5), 0.01).second;
  EXPECT_LT(wide, 30u);
  EXPECT_GT(close, 4 * wide);
}

TEST(FacetSampling, WhatIsNotANumberIsFar)
{
  const double nan = std::nan("");
  const auto [sampling, asked]
      = sample(segment, [nan](const Vector<3>&) { return nan; }, 1e-3);
  EXPECT_EQ(asked, 1u);
  EXPECT_TRUE(std::isinf(sampling.gaps()[0]));
}

TEST(FacetSampling, RefusesWhatDoesNotFit)
{
  const Scene& scene = segment;
  EXPECT_REFUSED(FacetSampling(scene.facets(), scene.x, 2, {1, 1}, 3));
  FacetSampling sampling(scene.facets(), scene.x, 2, {1}, 3);
  EXPECT_REFUSED(sampling.take(std::vector<double>(2)));
}

using Row = std::vector<double>;

bool is_far(const Row& own_before, const Row& own_after, const Row& before,
            const Row& after)
{
  return far_side(own_before, own_after, before, after, 2)[0] == 1;
}

Row at(double degrees)
{
  const double t = degrees * std::acos(-1) / 180;
  return {std::cos(t), std::sin(t)};
}

TEST(FarSide, IsWhereAnObstacleWentThroughASheet)
{
  EXPECT_TRUE(is_far(at(90), at(90), at(270), at(90)));
  EXPECT_TRUE(is_far(at(90), at(80), at(225), at(60)));
  // A body rolls off: own normal and the obstacle's turn together
  EXPECT_FALSE(is_far(at(90), at(220), at(270), at(20)));
  EXPECT_FALSE(is_far(at(90), at(190), at(270), at(100)));
  // A node slides around the obstacle
  EXPECT_FALSE(is_far(at(90), at(170), at(270), at(350)));
  // An obstacle passes by over a sheet
  EXPECT_FALSE(is_far(at(90), at(90), at(190), at(350)));
  // A node faced away before
  EXPECT_FALSE(is_far(at(270), at(270), at(270), at(90)));
  EXPECT_REFUSED(far_side(at(0), at(0), at(0), Row(4), 2));
}

} // namespace
