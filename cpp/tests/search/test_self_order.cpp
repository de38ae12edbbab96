// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#include "../self_scene.h"
#include <gtest/gtest.h>

using namespace contactx;
using namespace contactx::search;
using namespace contactx::tests;

namespace
{
bool is_after(const SelfOrder& order, const geometry::Facets& facets,
              std::int32_t node, std::int32_t facet)
{
  const std::array weights{0.5, 0.5};
  return order.is_after(node, facets.list()[facet], weights);
}
} // namespace

TEST(SelfOrder, OfTwoPlacesThatFaceEachOtherOneIsAfter)
{
  const Strip strip(20, 4, 0.2);
  const SelfOrder order(strip.facets.list(), strip.x, 2);
  // Where the top is folded about its middle all of one side is after the other
  const bool first = is_after(order, strip.facets, strip.top(1), strip.top(19));
  for (int i = 1; i < 9; ++i)
  {
    EXPECT_EQ(is_after(order, strip.facets, strip.top(i), strip.top(20 - i)),
              first);
    EXPECT_NE(
        is_after(order, strip.facets, strip.top(20 - i), strip.top(i + 1)),
        first);
  }
}

TEST(SelfOrder, SmallerAndSofterFacetsAreAfter)
{
  Joined both;
  both.add(Strip(20, 4, 0.2), 0, 0, 0);
  both.add(Strip(5, 4, 0.2), 0, 0.2, 42);
  SelfOrder order(both.facets.list(), both.x, 2);
  EXPECT_TRUE(is_after(order, both.facets, 0, 45));
  EXPECT_FALSE(is_after(order, both.facets, 45, 0));
  // The larger ones are a hundred times softer
  std::vector<double> compliance(both.x.size() / 2, 1);
  for (std::size_t i = 42; i < compliance.size(); ++i)
    compliance[i] = 100;
  order.take_compliance(compliance);
  EXPECT_FALSE(is_after(order, both.facets, 0, 45));
  EXPECT_TRUE(is_after(order, both.facets, 45, 0));
}

TEST(SelfOrder, RoundingDoesNotDecideBetweenPartsThatAreAlike)
{
  Joined both;
  both.add(Strip(20, 4, 0.2), 0, 0, 0);
  both.add(Strip(20, 4, 0.2), 1e-9, 0.2, 42);
  SelfOrder order(both.facets.list(), both.x, 2);
  EXPECT_EQ(order.rank(), (std::vector<std::int32_t>{0, 1}));
  std::vector<double> compliance(both.x.size() / 2, 1);
  compliance[3] = 1 + 1e-9;
  order.take_compliance(compliance);
  EXPECT_EQ(order.rank(), (std::vector<std::int32_t>{0, 1}));
}

TEST(SelfOrder, OfASurfaceInSpaceItGoesAlongEdges)
{
  // A flat plate of 4 x 4 quadrilaterals
  std::vector<double> x;
  geometry::Facets facets;
  for (int j = 0; j <= 4; ++j)
    for (int i = 0; i <= 4; ++i)
      x.insert(x.end(), {i / 4.0, j / 4.0, 0});
  for (std::int32_t j = 0; j < 4; ++j)
    for (std::int32_t i = 0; i < 4; ++i)
    {
      const std::int32_t a = 5 * j + i;
      for (const std::int32_t node : {a, a + 1, a + 5, a + 6})
        facets.nodes.push_back(node);
      facets.offsets.push_back(std::ssize(facets.nodes));
    }
  const SelfOrder order(facets.list(), x, 3);
  // From a corner: farther along either edge is later
  EXPECT_EQ(order.along()[0] < order.along()[4],
            order.along()[5] < order.along()[9]);
  EXPECT_EQ(order.part(), std::vector<std::int32_t>(25, 0));
}
