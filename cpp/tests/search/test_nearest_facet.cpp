// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#include "brute_force.h"
#include "random_scenes.h"
#include <contactx/search/select.h>
#include <gtest/gtest.h>

using namespace contactx;
using namespace contactx::search;
using namespace contactx::tests;

namespace
{
void expect_same(const std::optional<Projection>& found,
                 const std::optional<Projection>& expected)
{
  ASSERT_EQ(found.has_value(), expected.has_value());
  if (!found)
    return;
  EXPECT_EQ(found->facet, expected->facet);
  EXPECT_EQ(found->feature, expected->feature);
  EXPECT_EQ(found->xi, expected->xi);
  EXPECT_EQ(found->d, expected->d);
}

class NearestFacet : public ::testing::TestWithParam<Kind>
{
};

TEST_P(NearestFacet, IsTheOneThatALoopFinds)
{
  Generator random(1 + static_cast<int>(GetParam()));
  int found = 0;
  for (int set = 0; set < 100; ++set)
  {
    const Scene scene = random_scene(GetParam(), random);
    const Surface surface = scene.surface();
    const BoxTree tree(surface.boxes(scene.x));
    for (int i = 0; i < 24; ++i)
    {
      const Vector<3> p = random_query(scene, random, i);
      const Vector<3> n = i % 3 ? Vector<3>{} : random.unit<3>();
      const double reach = i % 5 ? 10 : 0.3;
      const auto q = nearest_facet(surface, tree, scene.x, p, n, reach);
      expect_same(q, brute_force(surface, scene.x, p, n, reach));
      found += q.has_value();
    }
  }
  EXPECT_EQ(found > 1000, GetParam() != Kind::empty);
}

TEST_P(NearestFacet, IsTheSameAfterARefit)
{
  Generator random(101 + static_cast<int>(GetParam()));
  for (int set = 0; set < 50; ++set)
  {
    Scene scene = random_scene(GetParam(), random);
    const Surface surface = scene.surface();
    BoxTree tree(surface.boxes(scene.x));
    for (double& c : scene.x)
      c += random(-0.5, 0.5);
    const std::vector<Box> boxes = surface.boxes(scene.x);
    tree.refit(boxes);
    const BoxTree fresh(boxes);
    for (int i = 0; i < 24; ++i)
    {
      const Vector<3> p = random_query(scene, random, i);
      expect_same(nearest_facet(surface, tree, scene.x, p, {}, 10),
                  nearest_facet(surface, fresh, scene.x, p, {}, 10));
    }
  }
}

INSTANTIATE_TEST_SUITE_P(AllKinds, NearestFacet,
                         ::testing::ValuesIn(all_kinds()));

TEST(NearestFacetOf, CoincidentFacetsIsTheFirst)
{
  Generator random(7);
  for (int set = 0; set < 100; ++set)
  {
    Scene scene(3);
    add_random_facet(scene, random, 3, 1, 1);
    const std::vector<std::int32_t> first = scene.nodes;
    for (int i = 0; i < 40; ++i)
      scene.facet(first);
    const BoxTree tree(scene.surface().boxes(scene.x));
    const auto q = nearest_facet(scene.surface(), tree, scene.x,
                                 random.vector<3>(-3, 3), {}, 10);
    ASSERT_TRUE(q);
    EXPECT_EQ(q->facet, 0);
  }
}

TEST(NearestFacetOf, APointThatIsNotANumberIsNone)
{
  Generator random(8);
  for (Kind kind : {Kind::mixed, Kind::single, Kind::segments})
  {
    const Scene scene = random_scene(kind, random);
    const BoxTree tree(scene.surface().boxes(scene.x));
    for (int k = 0; k < scene.gdim; ++k)
    {
      Vector<3> p{};
      p[k] = std::nan("");
      EXPECT_FALSE(nearest_facet(scene.surface(), tree, scene.x, p, {}, 10));
    }
  }
}

TEST(NearestFacetOf, ASurfaceWithSomeNodesThatAreNotNumbers)
{
  Generator random(9);
  for (int set = 0; set < 50; ++set)
  {
    Scene scene = random_scene(Kind::grid, random);
    scene.x[static_cast<int>(random(0, scene.x.size()))] = std::nan("");
    const Surface surface = scene.surface();
    const BoxTree tree(surface.boxes(scene.x));
    const Vector<3> p = random.vector<3>(-1, 1);
    const auto q = nearest_facet(surface, tree, scene.x, p, {}, 10);
    expect_same(q, brute_force(surface, scene.x, p, {}, 10));
  }
}

TEST(NearestFacetOf, AScaledSurfaceIsTheScaledOne)
{
  Generator random(10);
  for (double scale : {0x1p-40, 0x1p40}) // exact, so that nothing may differ
    for (int set = 0; set < 50; ++set)
    {
      Scene scene = random_scene(Kind::mixed, random);
      const Surface surface = scene.surface();
      const Vector<3> p = random.vector<3>(-1, 1);
      const auto q = nearest_facet(surface, BoxTree(surface.boxes(scene.x)),
                                   scene.x, p, {}, 10);
      for (double& c : scene.x)
        c *= scale;
      const auto scaled
          = nearest_facet(surface, BoxTree(surface.boxes(scene.x)), scene.x,
                          scale * p, {}, 10 * scale);
      ASSERT_TRUE(q and scaled);
      EXPECT_EQ(scaled->facet, q->facet);
      EXPECT_EQ(scaled->xi, q->xi);
      EXPECT_EQ(scaled->d, scale * q->d);
    }
}
} // namespace
