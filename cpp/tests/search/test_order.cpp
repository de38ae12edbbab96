// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#include "generator.h"
#include "scene.h"
#include <contactx/search/order.h>
#include <contactx/search/select.h>
#include <gtest/gtest.h>
#include <limits>
#include <numeric>

using namespace contactx;
using namespace contactx::search;
using namespace contactx::tests;

namespace
{
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
    std::vector<double> x(gdim * 500);
    for (double& c : x)
      c = random(-3, 7);
    x[gdim * 7] = std::numeric_limits<double>::quiet_NaN();
    auto order = spatial_order(numbers(500), x, gdim);
    std::ranges::sort(order);
    EXPECT_EQ(order, numbers(500));
  }
  EXPECT_TRUE(spatial_order({}, {}, 3).empty());
}

TEST(SpatialOrder, ShortensTheWay)
{
  Generator random(2);
  std::vector<double> x(3 * 4096);
  for (double& c : x)
    c = random(0, 1);
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

TEST(NearestFacet, IsTheSameFromEveryHint)
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
} // namespace
