// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#include "facing.h"

using namespace contactx;
using namespace contactx::tests;
using geometry::most_nodes;

namespace
{
/// A dimension, what the slave is made of and what the master is made of.
using Surfaces = std::tuple<int, Cells, Cells>;

class MortarSurfaces : public ::testing::TestWithParam<Surfaces>
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
    const auto sums
        = applied(scene, pairs, found, [](const Vector<3>&) { return 1; });
    for (std::size_t i = 0; i < sums.size(); ++i)
      EXPECT_NEAR(sums[i], found.area[i], 1e-13);
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
  for (std::size_t i = 0; i < found.area.size(); ++i)
    EXPECT_NEAR(more.area[i], 3 * found.area[i], 1e-13);
  for (std::size_t i = 0; i < found.weight.size(); ++i)
    EXPECT_NEAR(more.weight[i], 3 * found.weight[i], 1e-12);
  for (std::size_t i = 0; i < found.dual.size(); ++i)
    EXPECT_NEAR(more.dual[i], found.dual[i], 1e-10);
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
  for (std::size_t i = 0; i < found.area.size(); ++i)
    EXPECT_NEAR(other.area[i], found.area[i], 1e-15);
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
    ::testing::Values(Surfaces{2, Cells::triangles, Cells::triangles},
                      Surfaces{3, Cells::triangles, Cells::triangles},
                      Surfaces{3, Cells::triangles, Cells::quadrilaterals},
                      Surfaces{3, Cells::quadrilaterals, Cells::triangles},
                      Surfaces{3, Cells::quadrilaterals, Cells::quadrilaterals},
                      Surfaces{3, Cells::mixed, Cells::mixed}));
} // namespace
