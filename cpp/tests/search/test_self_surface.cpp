// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#include "scene.h"
#include "self_scene.h"
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
  const Scene plate = flat_grid(4, Cells::quadrilaterals);
  const SelfOrder order(plate.facets(), plate.x, 3);
  // From a corner: farther along either edge is later
  EXPECT_EQ(order.along()[0] < order.along()[4],
            order.along()[5] < order.along()[9]);
  EXPECT_EQ(order.part(), std::vector<std::int32_t>(25, 0));
}

/// A surface on itself, and its pairs.
struct StripScene
{
  std::vector<double> x;
  std::shared_ptr<mesh::Halo> halo;
  SelfSurface surface;
  Pairing pairing;

  StripScene(const std::vector<double>& x, const geometry::Facets& facets,
             const std::vector<std::int64_t>& body,
             std::optional<double> excluded = {})
      : x(x), halo(mesh::serial_halo(x, 2)),
        surface(halo, facets, body, excluded),
        pairing(facets.offsets, facets.nodes, {0}, {}, 2)
  {
  }

  explicit StripScene(const Strip& strip, std::optional<double> excluded = {})
      : StripScene(strip.x, strip.facets,
                   std::vector<std::int64_t>(strip.x.size() / 2, 0), excluded)
  {
  }

  std::vector<double> moved(const std::vector<double>& u) const
  {
    std::vector<double> y = x;
    for (std::size_t i = 0; i < y.size(); ++i)
      y[i] += u[i];
    return y;
  }

  std::int32_t pair(const std::vector<double>& at, double reach = 10)
  {
    const std::vector<std::int8_t> closed(pairing.slaves().size(), 0);
    return surface.pair(pairing, {}, at, reach, closed);
  }

  std::int64_t num_paired() const
  {
    return std::ranges::count_if(pairing.facet(),
                                 [](std::int32_t f) { return f >= 0; });
  }

  /// @brief Paired nodes of the upper faces of a strip's legs.
  int num_on_legs(const Strip& strip) const
  {
    int count = 0;
    for (int i = 1; i < 25; ++i)
      for (const std::int32_t node : {strip.top(i), strip.top(strip.cells - i)})
        count += pairing.facet()[node] >= 0;
    return count;
  }

  double gap(std::size_t i, const std::vector<double>& at) const
  {
    Vector<3> p{at[2 * i], at[2 * i + 1], 0};
    return extended(pairing.master(), pairing.facet()[i], at, p)->gap;
  }
};

TEST(SelfSurface, NodesDoNotSeeThroughTheirBody)
{
  for (const double thickness : {0.02, 0.2, 1.0})
  {
    StripScene scene(Strip(20, 4, thickness));
    scene.pair(scene.x);
    EXPECT_EQ(scene.num_paired(), 0) << thickness;
  }
}

TEST(SelfSurface, WhatFoldsIsPairedOnOneSide)
{
  const Strip strip(80, 4, 0.05);
  for (const double distance : {0.02, 0.001, -0.001})
  {
    StripScene scene(strip);
    const auto at = scene.moved(strip.folded(distance));
    // Through an open fold, from which facets are seen
    scene.halo->set_start(strip.folded(0.1));
    scene.pair(at);
    int left = 0, right = 0;
    for (int i = 1; i < 25; ++i)
    {
      const std::int32_t a = strip.top(i), b = strip.top(80 - i);
      left += scene.pairing.facet()[a] >= 0;
      right += scene.pairing.facet()[b] >= 0;
      for (const std::int32_t node : {a, b})
      {
        if (scene.pairing.facet()[node] < 0)
          continue;
        EXPECT_NEAR(scene.gap(node, at), distance, 1e-12);
      }
      // Nor do nodes below
      EXPECT_LT(scene.pairing.facet()[i], 0);
    }
    EXPECT_EQ(std::min(left, right), 0) << distance;
    EXPECT_EQ(std::max(left, right), 24) << distance;
  }
}

TEST(SelfSurface, PenetrationIsSeenFromInFrontAndIfItIsShallow)
{
  const Strip strip(80, 4, 0.05);
  const auto seen = [&](double end, double start)
  {
    StripScene scene(strip);
    scene.halo->set_start(strip.folded(start));
    scene.pair(scene.moved(strip.folded(end)));
    return scene.num_on_legs(strip);
  };
  EXPECT_EQ(seen(-0.02, -0.02), 24);
  EXPECT_EQ(seen(-0.04, -0.04), 0);
  EXPECT_EQ(seen(-0.04, 0.01), 24);
}

TEST(SelfSurface, NeighboursAreExcludedWithinADistance)
{
  const Strip strip(80, 4, 0.05);
  StripScene near(strip), far(strip, 1.0);
  const auto at = near.moved(strip.folded(0.02));
  near.pair(at);
  far.pair(at);
  EXPECT_GT(near.num_paired(), 0);
  for (std::size_t i = 0; i < strip.x.size() / 2; ++i)
  {
    const std::int32_t f = far.pairing.facet()[i];
    if (f < 0)
      continue;
    for (const std::int32_t node : far.surface.facets()[f])
      EXPECT_GT(std::abs(strip.x[2 * node] - strip.x[2 * i]), 0.99);
  }
}

TEST(SelfSurface, AThinBodyHasTwoSides)
{
  // One node of each that faces another: three sheets, thinner than a facet
  Joined all;
  const Strip sheet(10, 1, 0.01);
  for (int k = 0; k < 3; ++k)
    all.add(sheet, 0, 0.012 * k, 22 * k);
  StripScene scene(all.x, all.facets, all.body);
  scene.pair(all.x);
  EXPECT_GT(scene.num_paired(), 0);
  for (std::size_t i = 0; i < all.x.size() / 2; ++i)
    if (scene.pairing.facet()[i] >= 0)
    {
      EXPECT_NEAR(scene.gap(i, all.x), 0.002, 1e-12);
      // Neither the bottom of the lowest nor the top of the highest
      EXPECT_GT(all.x[2 * i + 1], 0.001);
      EXPECT_LT(all.x[2 * i + 1], 0.033);
    }
  // No two nodes are each on a facet of the other
  for (std::size_t i = 0; i < all.x.size() / 2; ++i)
    if (const auto f = scene.pairing.facet()[i]; f >= 0)
      for (const std::int32_t node : scene.surface.facets()[f])
        if (const auto g = scene.pairing.facet()[node]; g >= 0)
        {
          const auto theirs = scene.surface.facets()[g];
          EXPECT_EQ(std::ranges::find(theirs, std::int32_t(i)), theirs.end());
        }
}

TEST(SelfSurface, SofterPartsBecomeSlaves)
{
  Joined both;
  both.add(Strip(20, 1, 0.1), 0, 0, 0);
  both.add(Strip(20, 1, 0.1), 0.01, 0.11, 42);
  for (const bool is_upper : {false, true})
  {
    StripScene scene(both.x, both.facets, both.body);
    scene.pair(both.x);
    std::vector<double> compliance(both.x.size() / 2, 1);
    for (std::size_t i = 0; i < compliance.size(); ++i)
      if ((i >= 42) == is_upper)
        compliance[i] = 10;
    scene.surface.take_compliance(compliance);
    scene.pair(both.x);
    for (std::size_t i = 0; i < compliance.size(); ++i)
    {
      const bool is_slave = scene.pairing.facet()[i] >= 0;
      EXPECT_TRUE(not is_slave or (i >= 42) == is_upper);
    }
    EXPECT_GE(scene.num_paired(), 19);
  }
}
} // namespace
