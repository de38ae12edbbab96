// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#include "facing.h"
#include <map>

using namespace contactx;
using namespace contactx::tests;

namespace
{
/// One slave square [0, 1]^2 (in 2D the segment [0, 1]) at height zero that
/// looks down on layers of the master, each a scene.
struct Layers
{
  Facing scene;
  std::vector<std::int32_t> end; ///< facets of the layers before and with each

  Layers(int gdim, const std::vector<Scene>& layers)
      : scene(
            sheet(gdim, 1, Cells::quadrilaterals, false, 0, 1, level(gdim, 0)),
            joined(gdim, layers))
  {
    std::int32_t n = 0;
    for (const Scene& layer : layers)
      end.push_back(n += layer.facets().size());
  }

  /// Number of facets of each layer that are found.
  std::vector<int> found(double margin = 0) const
  {
    std::vector<int> numbers(end.size(), 0);
    for (const std::int32_t m : scene.find(100, margin).master)
      ++numbers[std::ranges::upper_bound(end, m) - end.begin()];
    return numbers;
  }

private:
  static Scene joined(int gdim, const std::vector<Scene>& layers)
  {
    Scene all(gdim);
    for (const Scene& layer : layers)
    {
      const auto first = static_cast<std::int32_t>(all.x.size()) / gdim;
      all.x.insert(all.x.end(), layer.x.begin(), layer.x.end());
      for (std::int32_t f = 0; f < layer.facets().size(); ++f)
      {
        const auto nodes = layer.facets()[f];
        std::vector<std::int32_t> moved(nodes.begin(), nodes.end());
        for (std::int32_t& node : moved)
          node += first;
        all.facet(moved);
      }
    }
    return all;
  }
};

/// Layer of n cells an axis from `low` to `high` along the first axis, that
/// covers the slave facet in the other direction.
Scene layer(int gdim, int n, double low, double high, auto height)
{
  return sheet(gdim, n, Cells::quadrilaterals, true, 0, 1,
               [=](double s, double t)
               {
                 const double x = low + s * (high - low);
                 return gdim == 2 ? Vector<3>{x, height(x), 0}
                                  : Vector<3>{x, t, height(x)};
               });
}

Scene layer(int gdim, int n, double low, double high, double height)
{
  return layer(gdim, n, low, high, [height](double) { return height; });
}

using Numbers = std::vector<int>;

class LayersOf : public ::testing::TestWithParam<int>
{
};

TEST_P(LayersOf, TheNearestOneCounts)
{
  const int gdim = GetParam(), facets = gdim == 2 ? 2 : 4;
  const auto at = [gdim](double a, double b)
  {
    return Layers(gdim, {layer(gdim, 2, 0, 1, a), layer(gdim, 2, 0, 1, b)})
        .found();
  };
  EXPECT_EQ(at(-0.1, -0.2), (Numbers{facets, 0}));
  EXPECT_EQ(at(-0.2, -0.1), (Numbers{0, facets}));
  // Penetrated, and with the slave facet between them
  EXPECT_EQ(at(0.1, 0.2), (Numbers{facets, 0}));
  EXPECT_EQ(at(0.2, -0.1), (Numbers{0, facets}));
  EXPECT_EQ(at(0.1, -0.2), (Numbers{facets, 0}));
}

TEST_P(LayersOf, ConnectedFacetsStayTogether)
{
  // The one layer bends away from the slave facet below the other one
  const int gdim = GetParam(), facets = gdim == 2 ? 4 : 16;
  const Layers scene(gdim, {layer(gdim, 4, 0, 1, [](double x) { return -x; }),
                            layer(gdim, 4, 0, 1, -0.5)});
  EXPECT_EQ(scene.found(), (Numbers{facets, 0}));
}

TEST_P(LayersOf, PartsSideBySideCountTogether)
{
  const int gdim = GetParam();
  const Scene left = layer(gdim, 1, 0, 0.4, -0.3);
  const Scene right = layer(gdim, 1, 0.4, 1, -0.1);
  const Scene behind = layer(gdim, 1, 0, 1, -0.5);
  EXPECT_EQ(Layers(gdim, {left, right}).found(), (Numbers{1, 1}));
  EXPECT_EQ(Layers(gdim, {behind, left, right}).found(), (Numbers{0, 1, 1}));
  // The far one does not fit into what is left beside the near one
  EXPECT_EQ(Layers(gdim, {left, behind}).found(), (Numbers{1, 0}));
}

TEST_P(LayersOf, TheNearestIsThatBeforeTheSlaveFacet)
{
  // A large facet passes just below, but its middle is far off
  const int gdim = GetParam();
  const Scene large
      = layer(gdim, 1, -1, 20, [](double x) { return -0.1 - 0.5 * x; });
  EXPECT_EQ(Layers(gdim, {large, layer(gdim, 2, 0, 1, -1.)}).found(),
            (Numbers{1, 0}));
}

TEST_P(LayersOf, WhatLiesBesideIsNotTheNearest)
{
  // The far layer rises beside the slave facet, to where it is nearer
  const int gdim = GetParam();
  const Scene near = layer(gdim, 1, 0, 1, -0.2);
  const Scene far
      = layer(gdim, 3, 0, 1.5, [](double x) { return x > 1.1 ? -0.1 : -0.5; });
  const Layers scene(gdim, {near, far});
  EXPECT_EQ(scene.found(), (Numbers{1, 0}));
  EXPECT_EQ(scene.found(0.5), (Numbers{1, 0}));
}

TEST_P(LayersOf, WhatLiesBesideGoesWithItsLayer)
{
  const int gdim = GetParam();
  const Scene near = layer(gdim, 2, 0, 2, -0.2);
  const Scene far = layer(gdim, 2, 0, 2, -0.5);
  const int before = gdim == 2 ? 1 : 2, all = gdim == 2 ? 2 : 4;
  EXPECT_EQ(Layers(gdim, {far, near}).found(), (Numbers{0, before}));
  EXPECT_EQ(Layers(gdim, {far, near}).found(0.1), (Numbers{0, all}));
}

TEST_P(LayersOf, AMarginDoesNotJoinLayers)
{
  // Both start from a common edge beside the slave facet
  const int gdim = GetParam();
  Scene fan(gdim);
  const auto row = [&](double x, double z)
  {
    const auto first
        = fan.node(gdim == 2 ? Vector<3>{x, z, 0} : Vector<3>{x, 0, z});
    if (gdim == 3)
      fan.node({x, 1, z});
    return first;
  };
  const auto strip = [&](std::int32_t a, std::int32_t b)
  {
    if (gdim == 2)
      fan.facet({b, a});
    else
      fan.facet({a, b, a + 1, b + 1});
  };
  const auto edge = row(1.2, -0.4), near1 = row(1, -0.2), near0 = row(0, -0.2),
             far1 = row(1, -0.6), far0 = row(0, -0.6);
  strip(near0, near1);
  strip(near1, edge);
  strip(far0, far1);
  strip(far1, edge);
  const Facing scene(
      sheet(gdim, 1, Cells::quadrilaterals, false, 0, 1, level(gdim, 0)), fan);
  EXPECT_EQ(scene.find(100).master, (std::vector<std::int32_t>{0}));
  EXPECT_EQ(scene.find(100, 0.2).master, (std::vector<std::int32_t>{0, 1, 3}));
}

TEST_P(LayersOf, AMarginGivesMorePairsOfAnyLayers)
{
  const int gdim = GetParam();
  Generator random(1);
  int less = 0;
  for (int i = 0; i < 300; ++i)
  {
    std::vector<Scene> layers;
    for (int k = 0; k < 4; ++k)
    {
      const double z = random(-1, 1), low = random(-1, 1),
                   slope = random(-1, 1);
      layers.push_back(layer(gdim, 1 + k % 3, low, low + random(0.2, 2),
                             [=](double x) { return z + slope * x; }));
    }
    const Layers scene(gdim, layers);
    const auto pairs = scene.scene.find(100);
    EXPECT_TRUE(search::contains(scene.scene.find(100, 0.3), pairs));
    std::size_t all = 0;
    for (const Scene& one : layers)
      all += Layers(gdim, {one}).scene.find(100).size();
    EXPECT_LE(pairs.size(), all);
    less += pairs.size() < all;
  }
  EXPECT_GT(less, 50);
}

INSTANTIATE_TEST_SUITE_P(Dimensions, LayersOf, ::testing::Values(2, 3));
} // namespace
