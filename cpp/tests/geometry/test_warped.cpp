// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#include "closest_reference.h"
#include <contactx/geometry/closest_point.h>

using namespace contactx;
using namespace contactx::geometry;
using namespace contactx::tests;

namespace
{
using F = Quadrilateral;

/// Compare with the sampled distance, for random points near warped facets.
void compare(double warp, double height, unsigned seed)
{
  Generator random(seed);
  for (int i = 0; i < 300; ++i)
  {
    const auto x = random_facet<F>(random, warp);
    const Local<F> foot = random.vector<2>(-0.5, 1.5);
    const auto p
        = position<F>(x, foot)
          + random(-height, height) * frame<F>(x, random.vector<2>(0, 1)).n;
    const auto c = closest_point<F>(x, p);
    const double distance = std::sqrt(c.distance2);
    EXPECT_NEAR(distance, sampled_distance<F>(x, p), 2e-9 * (1 + distance));
    EXPECT_NEAR(norm(p - position<F>(x, c.xi)), distance, 1e-13);
    EXPECT_LE(F::excess(c.xi), 1e-12);
  }
}

TEST(WarpedQuadrilateral, SlightlyWarped) { compare(0.01, 1, 1); }

TEST(WarpedQuadrilateral, Warped) { compare(0.2, 0.5, 2); }

TEST(WarpedQuadrilateral, WarpedAndFar) { compare(0.2, 20, 3); }

TEST(WarpedQuadrilateral, TwistedByARightAngle) { compare(0.7, 1, 4); }

TEST(WarpedQuadrilateral, FeatureTellsWhereThePointIs)
{
  Generator random(5);
  for (int i = 0; i < 2000; ++i)
  {
    const auto x = random_facet<F>(random, 0.2);
    const auto p
        = position<F>(x, random.vector<2>(-0.5, 1.5)) + random.vector<3>(-1, 1);
    const auto c = closest_point<F>(x, p);
    int edges = 0; // that the point lies on
    for (double s : c.xi)
      edges += std::min(std::abs(s), std::abs(s - 1)) < 1e-12;
    const int expected = c.feature == interior       ? 0
                         : c.feature <= F::num_edges ? 1
                                                     : 2;
    EXPECT_EQ(edges, expected);
  }
}

TEST(WarpedQuadrilateral, NodeOverTheMiddleOfASaddle)
{
  const Nodes<F> x{{{0, 0, 0.1}, {1, 0, -0.1}, {0, 1, -0.1}, {1, 1, 0.1}}};
  for (double h : {-1.0, -1e-9, 0.0, 1e-9, 1.0})
  {
    const auto c = closest_point<F>(x, {0.5, 0.5, h});
    EXPECT_EQ(c.feature, interior);
    EXPECT_NEAR(std::sqrt(c.distance2), std::abs(h), 1e-15);
  }
  // Beyond the centre of curvature the middle is no minimum any more
  const auto c = closest_point<F>(x, {0.5, 0.5, 10});
  EXPECT_NE(c.feature, interior);
  EXPECT_NEAR(c.distance2, 9.9 * 9.9 + 0.5, 1e-12);
}
} // namespace
