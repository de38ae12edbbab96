// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#include "scene.h"
#include <cmath>
#include <contactx/audit/facet_sampling.h>
#include <gtest/gtest.h>
#include <limits>

using namespace contactx;
using namespace contactx::audit;
using namespace contactx::tests;

namespace
{
/// Smallest gaps below facets of an obstacle, and how many points were needed.
template <class Gap>
std::pair<std::vector<double>, std::size_t> sample(const Scene& scene, Gap gap,
                                                   double allowed, int levels)
{
  FacetSampling sampling(scene.facets(), scene.x, scene.gdim,
                         std::vector<double>(scene.facets().size(), allowed),
                         levels);
  std::size_t asked = 0;
  while (!sampling.points().empty())
  {
    std::vector<double> gaps;
    const auto points = sampling.points();
    for (std::size_t i = 0; i < points.size(); i += scene.gdim)
    {
      Vector<3> p{};
      std::copy_n(points.begin() + i, scene.gdim, p.begin());
      gaps.push_back(gap(p));
    }
    asked += gaps.size();
    sampling.take(gaps);
  }
  return {sampling.gaps(), asked};
}

auto ball(const Vector<3>& centre, double radius)
{
  return [centre, radius](const Vector<3>& p)
  { return norm(p - centre) - radius; };
}

Scene triangle()
{
  Scene scene(3);
  for (const Vector<3>& p : {Vector<3>{0, 0, 0}, {1, 0, 0}, {0, 1, 0}})
    scene.node(p);
  scene.facet({0, 1, 2});
  return scene;
}

Scene segment()
{
  Scene scene(2);
  scene.node({0, 0});
  scene.node({1, 0});
  scene.facet({0, 1});
  return scene;
}

TEST(FacetSampling, SeesASmallBallAnywhereInAFacet)
{
  for (const Scene& scene :
       {segment(), triangle(), flat_grid(1, Cells::quadrilaterals)})
  {
    Generator random(3);
    for (int k = 0; k < 200; ++k)
    {
      double s = random(0.01, 0.99), t = random(0.01, 0.99);
      if (scene.gdim == 2)
        t = 0;
      else if (scene.facets()[0].size() == 3 and s + t > 1)
        s = 1 - s, t = 1 - t;
      const auto [gaps, asked] = sample(scene, ball({s, t, 0}, 0.01), 1e-3, 7);
      EXPECT_LT(gaps[0], -1e-3);
      // Not everywhere: only towards the ball
      EXPECT_LT(asked, 400u);
    }
  }
}

TEST(FacetSampling, RemembersTheDeepestPlace)
{
  const Scene scene = triangle();
  FacetSampling sampling(scene.facets(), scene.x, 3, {1e-3}, 7);
  EXPECT_TRUE(std::isnan(sampling.deepest()[0]));
  const auto gap = ball({0.3, 0.4, 0}, 0.01);
  while (!sampling.points().empty())
  {
    std::vector<double> gaps;
    const auto points = sampling.points();
    for (std::size_t i = 0; i < points.size(); i += 3)
      gaps.push_back(gap({points[i], points[i + 1], points[i + 2]}));
    sampling.take(gaps);
  }
  const auto& p = sampling.deepest();
  EXPECT_EQ(gap({p[0], p[1], p[2]}), sampling.gaps()[0]);
}

TEST(FacetSampling, AsksOnceWhereTheObstacleIsFar)
{
  const auto [gaps, asked]
      = sample(flat_grid(8, Cells::mixed), ball({0.5, 0.5, 9}, 1), 1e-3, 7);
  EXPECT_EQ(asked, gaps.size());
}

TEST(FacetSampling, LooksNoCloserThanTheDepthThatIsAllowed)
{
  const Scene scene = triangle();
  const auto wide = sample(scene, ball({0.3, 0.3, -5}, 5), 0.2, 7).second;
  const auto close = sample(scene, ball({0.3, 0.3, -5}, 5), 0.01, 7).second;
  EXPECT_LT(wide, 30u);
  EXPECT_GT(close, 4 * wide);
}

TEST(FacetSampling, WhatIsNotANumberIsFar)
{
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const auto [gaps, asked]
      = sample(segment(), [nan](const Vector<3>&) { return nan; }, 1e-3, 7);
  EXPECT_EQ(asked, 1u);
  EXPECT_TRUE(std::isinf(gaps[0]));
}

TEST(FacetSampling, RefusesWhatDoesNotFit)
{
  const Scene scene = segment();
  EXPECT_THROW(FacetSampling(scene.facets(), scene.x, 2, {1, 1}, 3),
               std::invalid_argument);
  FacetSampling sampling(scene.facets(), scene.x, 2, {1}, 3);
  EXPECT_THROW(sampling.take(std::vector<double>(2)), std::invalid_argument);
}
} // namespace
