// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#include "expect.h"
#include "facing.h"
#include <map>

using namespace contactx;
using namespace contactx::tests;
using geometry::most_nodes;

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
      all.join(layer);
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

using LayersOf = testing::TestWithParam<int>;

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
    auto before = pairs;
    for (const double margin : {0.1, 0.3, 1.})
    {
      const auto more = scene.scene.find(100, margin);
      EXPECT_TRUE(search::contains(more, before));
      before = more;
    }
    EXPECT_EQ(search::contains(pairs, before), pairs == before);
    std::size_t all = 0;
    for (const Scene& one : layers)
      all += Layers(gdim, {one}).scene.find(100).size();
    EXPECT_LE(pairs.size(), all);
    less += pairs.size() < all;
  }
  EXPECT_GT(less, 50);
}

INSTANTIATE_TEST_SUITE_P(Dimensions, LayersOf, testing::Values(2, 3));

/// A dimension, what the slave is made of and what the master is made of.
using Surfaces = std::tuple<int, Cells, Cells>;

class MortarSurfaces : public testing::TestWithParam<Surfaces>
{
protected:
  int gdim() const { return std::get<0>(GetParam()); }
  Cells slave_cells() const { return std::get<1>(GetParam()); }
  Cells master_cells() const { return std::get<2>(GetParam()); }

  /// A map of the plane that bends straight lines and leaves the edge.
  static Vector<3> bent(double s, double t)
  {
    const double c = 0.02 * std::sin(7 * s) * std::sin(5 * t);
    return {s + c, t - 2 * c, 0};
  }

  /// Flat surfaces of distorted facets, the slave over [0, 1]^2 at height 0.2.
  Facing flat(double low, double high) const
  {
    const auto at = [this](double height)
    {
      return [this, height](double s, double t)
      {
        Vector<3> p = bent(s, gdim() == 2 ? 0.3 : t);
        p[gdim() - 1] = height;
        return p;
      };
    };
    return {sheet(gdim(), 3, slave_cells(), false, 0, 1, at(0.2)),
            sheet(gdim(), 4, master_cells(), true, low, high, at(0))};
  }

  /// The same, but wavy.
  Facing wavy(double low, double high) const
  {
    Facing scene = flat(low, high);
    scene.move(
        [this](Vector<3> p)
        {
          p[gdim() - 1] += 0.05 * std::sin(4 * p[0]);
          return p;
        });
    return scene;
  }

  /// Values int Phi_s f of each node of each slave facet, f linear along an
  /// edge of each master facet.
  std::vector<double> applied(const Facing& scene,
                              const geometry::FacetPairs& pairs,
                              const geometry::Integrals& found, auto&& f) const
  {
    std::vector<double> sum(found.area.size());
    for (std::size_t i = 0; i < pairs.size(); ++i)
    {
      const auto nodes = scene.master.facets()[pairs.master[i]];
      for (int s = 0; s < most_nodes; ++s)
        for (std::size_t l = 0; l < nodes.size(); ++l)
          sum[most_nodes * pairs.slave[i] + s]
              += weight(found, i, s, l) * f(scene.point(nodes[l]));
    }
    return sum;
  }

  /// Master positions give the slave nodes, wherever a facet is covered.
  /// @return Number of covered facets.
  int expect_linear(const Facing& scene, double tolerance) const
  {
    const auto pairs = scene.find();
    const auto found = scene.integrals(pairs);
    int covered = 0;
    for (int k = 0; k < gdim(); ++k)
    {
      const auto sums = applied(scene, pairs, found,
                                [k](const Vector<3>& p) { return p[k]; });
      for (std::int32_t f = 0; f < scene.slave.facets().size(); ++f)
      {
        const auto nodes = scene.slave.facets()[f];
        for (std::size_t s = 0; s < nodes.size(); ++s)
        {
          const std::size_t i = most_nodes * f + s;
          const double expected
              = k == gdim() - 1 ? 0 : scene.point(nodes[s])[k];
          EXPECT_NEAR(sums[i], found.area[i] * expected, tolerance);
        }
        covered += k == 0 and found.area[most_nodes * f] > 0;
      }
    }
    return covered;
  }
};

TEST_P(MortarSurfaces, ReproduceLinearFields)
{
  const Facing scene = flat(-0.1, 1.2);
  EXPECT_EQ(expect_linear(scene, 1e-12), scene.slave.facets().size());
}

TEST_P(MortarSurfaces, ReproduceLinearFieldsWhereTheyArePartlyCovered)
{
  const Facing scene = flat(0.12, 0.87);
  EXPECT_EQ(expect_linear(scene, 1e-11), scene.slave.facets().size());
  const Facing small = flat(0.4, 0.6);
  EXPECT_LT(expect_linear(small, 1e-11), small.slave.facets().size());
}

TEST_P(MortarSurfaces, ShareTheirArea)
{
  for (const Facing& scene : {flat(-0.1, 1.2), wavy(-0.1, 1.2)})
  {
    const auto pairs = scene.find();
    const auto found = scene.integrals(pairs);
    // Sums of weights are the nodes' areas
    expect_near(
        applied(scene, pairs, found, [](const Vector<3>&) { return 1; }),
        found.area, 1e-13);
    // As it is covered, they are those of the whole surface
    const auto facets = scene.slave.facets();
    std::vector<double> nodal(scene.x.size() / gdim());
    for (std::int32_t f = 0; f < facets.size(); ++f)
      for (std::size_t s = 0; s < facets[f].size(); ++s)
        nodal[facets[f][s]] += found.area[most_nodes * f + s];
    const auto expected = geometry::nodal_areas(facets, scene.x, gdim());
    // nodal_areas integrates warped facets by a rule of low degree
    for (std::size_t i = 0; i < nodal.size(); ++i)
      EXPECT_NEAR(nodal[i], expected[i], 1e-5 * expected[i]);
  }
}

TEST_P(MortarSurfaces, TakeTheAreaOfTheReference)
{
  const Facing scene = flat(-0.1, 1.2);
  Facing wide = scene;
  wide.move([](Vector<3> p) { return Vector<3>{3 * p[0], p[1], p[2]}; });
  const auto pairs = scene.find();
  const auto found = scene.integrals(pairs);
  const auto more = scene.integrals(pairs, wide.x);
  const auto expect = [](const auto& one, auto other, double by, double most)
  {
    for (double& value : other)
      value *= by;
    expect_near(one, other, most);
  };
  expect(more.area, found.area, 3, 1e-13);
  expect(more.weight, found.weight, 3, 1e-12);
  expect(more.dual, found.dual, 1, 1e-10);
}

TEST_P(MortarSurfaces, GiveZerosToPairsThatShareNothing)
{
  const Facing scene = wavy(0.12, 0.87);
  const auto pairs = scene.find(), all = scene.all_pairs();
  ASSERT_LT(pairs.size(), all.size());
  const auto some = scene.integrals(pairs), found = scene.integrals(all);
  EXPECT_EQ(found.area, some.area);
  EXPECT_EQ(found.dual, some.dual);
  std::size_t j = 0;
  for (std::size_t i = 0; i < all.size(); ++i)
  {
    const bool shares = j < pairs.size() and all.slave[i] == pairs.slave[j]
                        and all.master[i] == pairs.master[j];
    for (int s = 0; s < most_nodes; ++s)
    {
      for (int l = 0; l < most_nodes; ++l)
        EXPECT_EQ(weight(found, i, s, l), shares ? weight(some, j, s, l) : 0);
      EXPECT_EQ(found.gap[most_nodes * i + s],
                shares ? some.gap[most_nodes * j + s] : 0);
    }
    j += shares;
  }
  EXPECT_EQ(j, pairs.size());
}

TEST_P(MortarSurfaces, DoNotDependOnTheOrderOfMasterFacets)
{
  const Facing scene = wavy(0.12, 0.87);
  const auto pairs = scene.find();
  auto back = pairs;
  const auto of = [&pairs](std::size_t i) { return pairs.slave[i]; };
  std::vector<std::size_t> place(pairs.size());
  for (std::size_t first = 0, last = 0; first < pairs.size(); first = last)
  {
    while (last < pairs.size() and of(last) == of(first))
      ++last;
    for (std::size_t i = first; i < last; ++i)
    {
      place[i] = first + last - 1 - i;
      back.master[place[i]] = pairs.master[i];
    }
  }
  const auto found = scene.integrals(pairs), other = scene.integrals(back);
  expect_near(other.area, found.area, 1e-15);
  for (std::size_t i = 0; i < pairs.size(); ++i)
    for (int s = 0; s < most_nodes; ++s)
    {
      for (int l = 0; l < most_nodes; ++l)
        EXPECT_NEAR(weight(other, place[i], s, l), weight(found, i, s, l),
                    1e-13);
      EXPECT_NEAR(other.gap[most_nodes * place[i] + s],
                  found.gap[most_nodes * i + s], 1e-14);
    }
}

INSTANTIATE_TEST_SUITE_P(
    AllKinds, MortarSurfaces,
    testing::Values(Surfaces{2, Cells::triangles, Cells::triangles},
                    Surfaces{3, Cells::triangles, Cells::triangles},
                    Surfaces{3, Cells::triangles, Cells::quadrilaterals},
                    Surfaces{3, Cells::quadrilaterals, Cells::triangles},
                    Surfaces{3, Cells::quadrilaterals, Cells::quadrilaterals},
                    Surfaces{3, Cells::mixed, Cells::mixed}));
} // namespace
