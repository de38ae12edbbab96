// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#include "random_scenes.h"
#include <contactx/search/bisector.h>
#include <contactx/search/order.h>
#include <contactx/search/pairing.h>
#include <contactx/search/select.h>
#include <contactx/search/surface.h>
#include <gtest/gtest.h>

using namespace contactx;
using namespace contactx::search;
using namespace contactx::tests;

namespace
{
/// @brief The search without a tree: the first of the closest facets.
inline std::optional<search::Projection>
brute_force(const search::Surface& surface, std::span<const double> x,
            const Vector<3>& p, const Vector<3>& normal, double reach)
{
  std::optional<search::Projection> best;
  for (std::int32_t f = 0; f < surface.facets().size(); ++f)
  {
    const auto q = search::closest(surface, f, x, p);
    // Of facets that are as near but for rounding the first one counts
    if (q and norm(q->d) <= reach
        and (norm(normal) == 0 or dot(q->normal, normal) < 0)
        and (!best
             or norm(q->d) < norm(best->d) - 1e-12 * (norm(q->d) + q->size)))
      best = q;
  }
  return best;
}

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

using NearestFacet = testing::TestWithParam<Kind>;
INSTANTIATE_TEST_SUITE_P(AllKinds, NearestFacet,
                         testing::ValuesIn(all_kinds()));

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

std::vector<std::int32_t> numbers(std::int32_t n)
{
  std::vector<std::int32_t> all(n);
  std::iota(all.begin(), all.end(), 0);
  return all;
}

TEST(SpatialOrder, HoldsEachPlaceOnce)
{
  Generator random(1);
  for (int gdim : {2, 3})
  {
    std::vector<double> x = random.numbers(gdim * 500, -3, 7);
    x[gdim * 7] = std::nan("");
    auto order = spatial_order(numbers(500), x, gdim);
    std::ranges::sort(order);
    EXPECT_EQ(order, numbers(500));
  }
  EXPECT_TRUE(spatial_order({}, {}, 3).empty());
}

TEST(SpatialOrder, ShortensTheWay)
{
  Generator random(2);
  std::vector<double> x = random.numbers(3 * 4096, 0, 1);
  const auto length = [&x](const std::vector<std::int32_t>& order)
  {
    double sum = 0;
    for (std::size_t i = 1; i < order.size(); ++i)
    {
      Vector<3> d;
      for (int k = 0; k < 3; ++k)
        d[k] = x[3 * order[i] + k] - x[3 * order[i - 1] + k];
      sum += norm(d);
    }
    return sum;
  };
  EXPECT_LT(length(spatial_order(numbers(4096), x, 3)),
            0.2 * length(numbers(4096)));
}

TEST(SpatialOrder, TakesPointsInOnePlace)
{
  EXPECT_EQ(spatial_order(numbers(3), std::vector<double>(6, 4.0), 2),
            numbers(3));
}

TEST(NearestFacetOf, AFlatGridIsTheSameFromEveryHint)
{
  Generator random(3);
  for (Cells cells : {Cells::triangles, Cells::quadrilaterals, Cells::mixed})
  {
    const Scene scene = flat_grid(4, cells);
    const Surface surface = scene.surface();
    const BoxTree tree(surface.boxes(scene.x));
    for (int i = 0; i < 20; ++i)
    {
      // Half of them over a node, where facets tie
      Vector<3> p = random.vector<3>(-0.2, 1.2);
      if (i % 2 == 0)
        p = {0.25 * (i % 5), 0.5, 0.125};
      const auto expected
          = nearest_facet(surface, tree, scene.x, p, {0, 0, -1}, 0.5);
      for (std::int32_t hint = 0; hint < surface.facets().size(); ++hint)
      {
        const auto found
            = nearest_facet(surface, tree, scene.x, p, {0, 0, -1}, 0.5, hint);
        ASSERT_EQ(found.has_value(), expected.has_value());
        if (!found)
          continue;
        EXPECT_EQ(found->facet, expected->facet);
        EXPECT_EQ(found->xi, expected->xi);
        EXPECT_EQ(found->gap, expected->gap);
      }
    }
  }
}

TEST_P(NearestFacet, GivesFirstPairsThatAreThoseOfALoop)
{
  Generator random(401 + static_cast<int>(GetParam()));
  int paired = 0;
  for (int set = 0; set < 100; ++set)
  {
    Scene scene = random_scene(GetParam(), random);
    const Surface surface = scene.surface();
    // Slave facets whose nodes are where the search may find it hard
    Scene slaves(scene.gdim);
    for (int i = 0; i < 8; ++i)
    {
      std::vector<std::int32_t> nodes;
      for (int k = 0; k < scene.gdim; ++k)
        nodes.push_back(scene.node(random_query(scene, random, i + k)));
      slaves.facet(nodes);
    }
    const std::vector<double> normals
        = geometry::nodal_normals(slaves.facets(), scene.x, scene.gdim);
    const double reach = set % 3 ? 10 : 0.3;

    Pairing pairing(slaves.offsets, slaves.nodes, scene.offsets, scene.nodes,
                    scene.gdim);
    const std::vector<std::int8_t> open(pairing.slaves().size(), 0);
    EXPECT_EQ(pairing.update(scene.x, reach, open), 0);
    for (std::size_t i = 0; i < open.size(); ++i)
    {
      const std::int32_t node = pairing.slaves()[i];
      const Vector<3> p = scene.point(node),
                      normal = vector_at(normals, node, scene.gdim);
      auto expected = brute_force(surface, scene.x, p, normal, reach);
      if (expected)
        expected = select(surface, scene.x, p, *expected);
      if (expected and expected->feature == geometry::interior)
        if (const auto q = bisector(surface, scene.x, p, *expected))
          expected = q;
      ASSERT_EQ(pairing.facet()[i], expected ? expected->facet : -1);
      if (!expected)
        continue;
      ++paired;
      EXPECT_EQ(pairing.feature()[i], expected->feature);
      for (int k = 0; k < 2; ++k)
        EXPECT_EQ(pairing.xi()[2 * i + k], expected->xi[k]);
      for (int k = 0; k < 3; ++k)
        EXPECT_EQ(pairing.normal()[3 * i + k], expected->normal[k]);
    }
  }
  EXPECT_EQ(paired > 100, GetParam() != Kind::empty);
}

} // namespace
