// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#include "pairing_scene.h"
#include <contactx/geometry/shape.h>
#include <gtest/gtest.h>

using namespace contactx;
using namespace contactx::search;
using namespace contactx::tests;

namespace
{
/// A roof with its ridge at the origin.
const std::vector<Vector<2>> roof{{-1, -1}, {0, 0}, {1, -1}};
/// A sharper one.
const std::vector<Vector<2>> spike{{-0.2, -1}, {0, 0}, {0.2, -1}};

Vector<3> cone(const SlidingSegment& s)
{
  Vector<3> c;
  std::copy_n(s.pairing.cone().begin(), 3, c.begin());
  return c;
}

TEST(PairingOnRidge, HasAUnitNormal)
{
  SlidingSegment s(roof);
  s.search_at({0.1, 0.5}, false);
  EXPECT_NE(s.feature(), geometry::interior);
  EXPECT_NEAR(norm(cone(s)), 1, 1e-15);
  // The left facet's normal is (-1, 1) / sqrt(2)
  const Vector<2> n = (1 / std::hypot(0.1, 0.5)) * Vector<2>{0.1, 0.5};
  EXPECT_NEAR(cone(s)[2], (n[1] - n[0]) / std::sqrt(2), 1e-15);
}

TEST(PairingOnRidge, KeepsItsNormalWhileInContact)
{
  SlidingSegment s(spike);
  s.search_at({0.02, 0.1}, false);
  const Vector<3> first = cone(s);
  EXPECT_EQ(s.search_at({-0.005, 0.09}, true), 0);
  EXPECT_EQ(cone(s), first);
  EXPECT_EQ(s.search_at({0.03, 0.09}, true), 0);
  EXPECT_EQ(cone(s), first);
  s.search_at({0.03, 0.09}, false); // open: the normal follows the node
  EXPECT_NE(cone(s), first);
}

TEST(PairingOnRidge, TakesAnotherNormalBesideTheRidge)
{
  // By the margin of a facet across the normal, at any height. Where bodies
  // deform in between, the first normal may be none of the ridge any more, and
  // the node touch along it from afar
  const double size = std::hypot(0.2, 1);
  const Vector<2> n{0.6, 0.8}, across{-0.8, 0.6};
  for (const double height : {0.1, 0.5})
    for (const double part : {0.9, 1.1})
    {
      SlidingSegment s(spike);
      s.search_at(0.2 * n, false);
      const Vector<3> first = cone(s);
      EXPECT_EQ(s.search_at(height * n
                                + part * geometry::facet_margin * size * across,
                            true),
                0);
      EXPECT_NE(s.feature(), geometry::interior);
      EXPECT_EQ(cone(s) == first, part < 1) << height;
    }
}

TEST(PairingOnRidge, LeavesItForAFacet)
{
  SlidingSegment s(roof);
  s.search_at({0.1, 0.5}, false);
  EXPECT_EQ(s.search_at({0.5, -0.4}, true), 1);
  EXPECT_EQ(s.facet(), 1);
  EXPECT_EQ(s.feature(), geometry::interior);
  EXPECT_EQ(cone(s), Vector<3>{});
}

TEST(PairingOnRidge, DoesNotFlipBetweenItsFacets)
{
  // Along the ridge of a roof that is turned somehow: its two facets are
  // equally far, and rounding must not choose
  Generator random(1);
  for (int set = 0; set < 20; ++set)
  {
    const Motion<3> motion(random, 3);
    Scene scene(3);
    for (Vector<3> p : {Vector<3>{0, 0, 0},
                        {0, 1, 0},
                        {-1, 0.5, -1},
                        {1, 0.5, -1},
                        {0, 0, 0},
                        {0, 0.01, 0},
                        {0.01, 0, 0}})
      scene.node(motion(p));
    Pairing pairing({0, 3}, {4, 5, 6}, {0, 3, 6}, {0, 1, 2, 1, 0, 3}, 3);
    const std::vector<std::int8_t> closed{1, 0, 0};
    for (int i = 0; i < 50; ++i)
    {
      const Vector<3> p{random(-0.05, 0.05), random(0.1, 0.9), 0.5};
      for (int k : {0, 1, 2})
      {
        Vector<3> q = p;
        if (k > 0)
          q[2 - k] += 0.01;
        // Facing down: (0, 1, 0) x (1, 0, 0)
        q = motion(q);
        std::copy(q.begin(), q.end(), scene.x.begin() + 3 * (4 + k));
      }
      EXPECT_EQ(pairing.update(scene.x, 10, closed), i == 0);
      EXPECT_EQ(pairing.facet()[0], 0);
      EXPECT_EQ(pairing.feature()[0], 1);
    }
  }
}
} // namespace
