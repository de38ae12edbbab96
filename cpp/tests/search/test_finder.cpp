// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#include "pairing_scene.h"
#include "random_scenes.h"
#include <contactx/geometry/nodal.h>
#include <contactx/geometry/shape.h>
#include <gtest/gtest.h>

using namespace contactx;
using namespace contactx::search;
using namespace contactx::tests;

namespace
{
using Indices = std::vector<std::int32_t>;

Finder finder_of(const Pairing& pairing, const std::vector<double>& x)
{
  const auto facets = pairing.master().facets();
  Finder finder({facets.offsets.begin(), facets.offsets.end()},
                {facets.nodes.begin(), facets.nodes.end()},
                pairing.master().gdim());
  finder.refit(x);
  return finder;
}

TEST(Finder, HasNoMemory)
{
  // A valley whose right side the node gets to on the left facet's extension
  SlidingSegment s({{0, 0}, {1, 0}, {2, 1}});
  s.search_at({0.9, 0.1}, true);
  s.move_to({1.04, 0.01});
  const Finder finder = finder_of(s.pairing, s.x);
  const Vector<3> p{1.04, 0.01, 0}, down{0, -1, 0};
  const FoundPlace found = finder.find(s.x, p, down, 10);
  EXPECT_NEAR(found.selected->gap, -0.03 / std::sqrt(2), 1e-15);
  EXPECT_EQ(finder.find(s.x, p, down, 10, 0).selected->gap,
            found.selected->gap);
}

TEST(Finder, FindsNothingOutOfReach)
{
  SlidingSegment s({{0, 0}, {1, 0}});
  const Finder finder = finder_of(s.pairing, s.x);
  const Vector<3> p{0.5, 0.3, 0}, down{0, -1, 0};
  EXPECT_FALSE(finder.find(s.x, p, down, 0.2).nearest);
  EXPECT_NEAR(finder.find(s.x, p, down, 0.4).selected->gap, 0.3, 1e-15);
  EXPECT_FALSE(finder.find(s.x, p, {0, 1, 0}, 0.4).nearest);
}

TEST(Finder, WithoutNormalKnowsNoSides)
{
  SlidingSegment s({{0, 0}, {1, 0}, {2, 0}});
  const Finder finder = finder_of(s.pairing, s.x);
  EXPECT_NEAR(norm(finder.find(s.x, {1, -2, 0}, {}, infinity).nearest->d), 2,
              1e-15);
}

TEST(Finder, NearestMayLieBeyondTheEdge)
{
  SlidingSegment s({{0, 0}, {1, 0}, {2, 0}});
  const Finder finder = finder_of(s.pairing, s.x);
  const FoundPlace found = finder.find(s.x, {-0.3, 0.4, 0}, {0, -1, 0}, 1);
  EXPECT_NEAR(norm(found.nearest->d), 0.5, 1e-15);
  EXPECT_FALSE(found.selected);
}

TEST(Finder, OfNothingFindsNothing)
{
  Finder finder({0}, {}, 2);
  const std::vector<double> x{0, 0, 1, 0};
  finder.refit(x);
  EXPECT_FALSE(finder.find(x, {}, {}, 1).nearest);
  Pairing pairing({0, 2}, {0, 1}, {0}, {}, 2);
  EXPECT_EQ(pairing.update(x, 1, std::vector<std::int8_t>{1, 1}), 0);
  EXPECT_EQ(pairing.facet(), (Indices{-1, -1}));
}

TEST(PairingInHalves, IsPairing)
{
  // What seek leaves and settle takes is what update does by itself
  const Scene scene = grid(6, Cells::mixed, [](double s, double t)
                           { return Vector<3>{s, t, 0.1 * std::sin(4 * s)}; });
  Generator random(3);
  std::vector<double> x = scene.x;
  std::vector<std::int32_t> offsets{0}, nodes;
  for (int i = 0; i < 40; ++i)
  {
    for (int k = 0; k < 3; ++k)
    {
      nodes.push_back(static_cast<std::int32_t>(x.size() / 3));
      x.insert(x.end(), {random(0, 1) + 0.01 * (k == 2),
                         random(0, 1) + 0.01 * (k == 1), random(-0.1, 0.2)});
    }
    offsets.push_back(nodes.size());
  }
  Pairing whole(offsets, nodes, scene.offsets, scene.nodes, 3);
  Pairing halves(offsets, nodes, scene.offsets, scene.nodes, 3);
  const std::vector<std::int8_t> closed(whole.slaves().size(), 1);
  for (int step = 0; step < 6; ++step)
  {
    const Finder finder = finder_of(halves, x);
    const auto normals = geometry::nodal_normals({offsets, nodes}, x, 3);
    std::int32_t changed = 0;
    for (const std::int32_t i : halves.seek(x, 1))
    {
      const auto slave = halves.slaves()[i];
      const auto found = finder.find(x, vector_at(x, slave, 3),
                                     vector_at(normals, slave, 3), 1);
      changed += halves.accept_projection(i, found.selected, x, 1, true);
    }
    EXPECT_EQ(whole.update(x, 1, closed), changed);
    EXPECT_EQ(whole.facet(), halves.facet());
    EXPECT_EQ(whole.feature(), halves.feature());
    EXPECT_EQ(whole.xi(), halves.xi());
    EXPECT_EQ(whole.frozen(), halves.frozen());
    for (const std::int32_t slave : whole.slaves())
      for (int k = 0; k < 3; ++k)
        x[3 * slave + k] += random(-0.1, 0.1);
  }
}

TEST(Pairing, LeavesNodesOfOthers)
{
  SlidingSegment s({{0, 0}, {1, 0}, {2, 0}});
  const auto all = s.pairing.slaves();
  ASSERT_GT(all.size(), 1u);
  const auto facets = s.pairing.master().facets();
  Pairing some({0, 2}, {all[0], all[1]}, {0, 2},
               {facets[0].begin(), facets[0].end()}, 2, all[1]);
  EXPECT_EQ(some.slaves(), (Indices{all[0]}));
  EXPECT_EQ(some.seek(s.x, 10), (Indices{0}));
}

TEST(Pairing, GoesOnWithALongerListOfFacets)
{
  SlidingSegment s({{0, 0}, {1, 0}, {2, 0}});
  s.search_at({0.5, 0.1}, true);
  ASSERT_EQ(s.pairing.facet()[0], 0);
  const auto facets = s.pairing.master().facets();
  const std::vector<std::int32_t> first(facets[0].begin(), facets[0].end());
  s.pairing.set_master({0, 2}, first);
  s.move_to({0.6, 0.1});
  EXPECT_EQ(std::ranges::count(s.pairing.seek(s.x, 10), 0), 0);
  // Facets go from right to left
  EXPECT_NEAR(s.pairing.xi()[0], 0.4, 1e-15);
}

/// Random slaves above a grid of triangles and quadrilaterals.
struct OverAGrid
{
  Scene scene = grid(
      6, Cells::mixed, [](double s, double t)
      { return Vector<3>{s, t, 0.1 * std::sin(4 * s) * std::cos(3 * t)}; });
  std::vector<std::int32_t> offsets{0}, nodes;

  explicit OverAGrid(Generator& random)
  {
    for (int i = 0; i < 30; ++i)
    {
      const Vector<3> p{random(0.1, 0.9), random(0.1, 0.9), random(-0.1, 0.3)};
      for (Vector<3> d : {Vector<3>{0, 0, 0}, {0, 0.01, 0}, {0.01, 0, 0}})
        nodes.push_back(scene.node(p + d));
      offsets.push_back(nodes.size());
    }
  }

  Pairing pairing() const
  {
    return {offsets, nodes, scene.offsets, scene.nodes, 3};
  }
};

TEST(PairingOnMixedFacets, ProjectsOnTheFacetThatItNames)
{
  Generator random(2);
  for (int i = 0; i < 20; ++i)
  {
    const OverAGrid s(random);
    const Surface surface = s.scene.surface();
    Pairing pairing = s.pairing();
    pairing.update(s.scene.x, 1, std::vector<std::int8_t>(90, 0));
    const Finder finder = finder_of(pairing, s.scene.x);
    const auto normals
        = geometry::nodal_normals({s.offsets, s.nodes}, s.scene.x, 3);
    int interior = 0;
    for (int k = 0; k < 90; ++k)
    {
      ASSERT_GE(pairing.facet()[k], 0);
      if (pairing.feature()[k] != geometry::interior)
        continue;
      ++interior;
      const auto q = extended(surface, pairing.facet()[k], s.scene.x,
                              s.scene.point(pairing.slaves()[k]));
      ASSERT_TRUE(q);
      EXPECT_NEAR(q->xi[0], pairing.xi()[2 * k], 1e-13);
      EXPECT_NEAR(q->xi[1], pairing.xi()[2 * k + 1], 1e-13);
      // Behind a valley a pair may be farther out
      EXPECT_TRUE(q->excess <= geometry::facet_margin or q->gap < 0);
      const std::int32_t slave = pairing.slaves()[k];
      const FoundPlace found = finder.find(s.scene.x, s.scene.point(slave),
                                           vector_at(normals, slave, 3), 1);
      EXPECT_NEAR(q->gap, found.selected->gap, 1e-15);
    }
    EXPECT_GT(interior, 60);
    // What a second search finds is what there is
    const auto facets = pairing.facet();
    EXPECT_EQ(pairing.update(s.scene.x, 1, std::vector<std::int8_t>(90, 1)), 0);
    EXPECT_EQ(pairing.facet(), facets);
  }
}
} // namespace
