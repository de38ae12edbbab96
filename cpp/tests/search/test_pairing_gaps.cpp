// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#include "pairing_scene.h"
#include "random_scenes.h"
#include <contactx/facet/shape.h>
#include <gtest/gtest.h>

using namespace contactx;
using namespace contactx::search;
using namespace contactx::tests;

namespace
{
using Indices = std::vector<std::int32_t>;

TEST(PairingGaps, AreThoseOfASearchWithoutMemory)
{
  // A valley whose right side the node gets to on the left facet's extension
  SlidingSegment s({{0, 0}, {1, 0}, {2, 1}});
  s.search_at({0.9, 0.1}, true);
  s.move_to({1.04, 0.01});
  const auto before = s.pairing.facet();
  const auto gaps = s.pairing.natural_gaps(s.x, 10, Indices{0, 1, 0});
  ASSERT_EQ(gaps.size(), 3u);
  EXPECT_NEAR(gaps[0], -0.03 / std::sqrt(2), 1e-15);
  EXPECT_NEAR(gaps[1], -0.04 / std::sqrt(2), 1e-15);
  EXPECT_EQ(gaps[2], gaps[0]);
  EXPECT_EQ(s.pairing.facet(), before);
}

TEST(PairingGaps, AreNotNumbersOutOfReach)
{
  SlidingSegment s({{0, 0}, {1, 0}});
  s.move_to({0.5, 0.3});
  EXPECT_TRUE(std::isnan(s.pairing.natural_gaps(s.x, 0.2, Indices{0})[0]));
  EXPECT_NEAR(s.pairing.natural_gaps(s.x, 0.4, Indices{0})[0], 0.3, 1e-15);
  EXPECT_TRUE(s.pairing.natural_gaps(s.x, 0.4, Indices{}).empty());
  EXPECT_THROW(s.pairing.natural_gaps(s.x, 0.4, Indices{2}), std::out_of_range);
}

TEST(PairingDistance, IsThatOfTheNearestNode)
{
  SlidingSegment s({{0, 0}, {1, 0}, {2, 0}});
  s.move_to({0.5, 0.3});
  EXPECT_NEAR(s.pairing.distance(s.x), 0.3, 1e-15);
  s.move_to({-0.31, 0.4}); // the right node is at -0.3
  EXPECT_NEAR(s.pairing.distance(s.x), 0.5, 1e-15);
  s.move_to({1, -2}); // on the wrong side: it knows no sides
  EXPECT_NEAR(s.pairing.distance(s.x), 2, 1e-15);
}

TEST(PairingDistance, OfNothingIsInfinite)
{
  Pairing pairing({0, 2}, {0, 1}, {0}, {}, 2);
  const std::vector<double> x{0, 0, 1, 0};
  EXPECT_TRUE(std::isinf(pairing.distance(x)));
  EXPECT_EQ(pairing.update(x, 1, std::vector<std::int8_t>{1, 1}), 0);
  EXPECT_EQ(pairing.facet(), (Indices{-1, -1}));
}

/// Random slaves above a grid of triangles and quadrilaterals.
struct OverAGrid
{
  Scene scene
      = grid(6, Cells::mixed, [](double s, double t)
             { return Vec<3>{s, t, 0.1 * std::sin(4 * s) * std::cos(3 * t)}; });
  std::vector<std::int32_t> offsets{0}, nodes;

  explicit OverAGrid(Generator& random)
  {
    for (int i = 0; i < 30; ++i)
    {
      const Vec<3> p{random(0.1, 0.9), random(0.1, 0.9), random(-0.1, 0.3)};
      for (Vec<3> d : {Vec<3>{0, 0, 0}, {0, 0.01, 0}, {0.01, 0, 0}})
        nodes.push_back(scene.node(p + d));
      offsets.push_back(nodes.size());
    }
  }

  Pairing pairing() const
  {
    return {offsets, nodes, scene.offsets, scene.nodes, 3};
  }
};

TEST(PairingDistance, IsThatOfALoop)
{
  Generator random(1);
  for (int i = 0; i < 20; ++i)
  {
    const OverAGrid s(random);
    const Surface surface = s.scene.surface();
    double expected = 1e9;
    for (std::int32_t node : s.nodes)
      for (std::int32_t f = 0; f < surface.facets().size(); ++f)
        expected = std::min(
            expected,
            norm(closest(surface, f, s.scene.x, s.scene.point(node))->d));
    EXPECT_DOUBLE_EQ(s.pairing().distance(s.scene.x), expected);
  }
}

TEST(PairingOnMixedFacets, ProjectsOnTheFacetThatItNames)
{
  Generator random(2);
  for (int i = 0; i < 20; ++i)
  {
    const OverAGrid s(random);
    const Surface surface = s.scene.surface();
    Pairing pairing = s.pairing();
    pairing.update(s.scene.x, 1, std::vector<std::int8_t>(90, 0));
    std::vector<std::int32_t> all(90);
    for (int k = 0; k < 90; ++k)
      all[k] = k;
    const auto gaps = pairing.natural_gaps(s.scene.x, 1, all);
    int interior = 0;
    for (int k : all)
    {
      ASSERT_GE(pairing.facet()[k], 0);
      if (pairing.feature()[k] != facet::interior)
        continue;
      ++interior;
      const auto q = extended(surface, pairing.facet()[k], s.scene.x,
                              s.scene.point(pairing.slaves()[k]));
      ASSERT_TRUE(q);
      EXPECT_NEAR(q->xi[0], pairing.xi()[2 * k], 1e-13);
      EXPECT_NEAR(q->xi[1], pairing.xi()[2 * k + 1], 1e-13);
      // Behind a valley a pair may be farther out
      EXPECT_TRUE(q->excess <= margin or q->gap < 0);
      EXPECT_NEAR(q->gap, gaps[k], 1e-15);
    }
    EXPECT_GT(interior, 60);
    // What a second search finds is what there is
    const auto facets = pairing.facet();
    EXPECT_EQ(pairing.update(s.scene.x, 1, std::vector<std::int8_t>(90, 1)), 0);
    EXPECT_EQ(pairing.facet(), facets);
  }
}
} // namespace
