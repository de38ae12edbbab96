// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#include "obstacle_scene.h"
#include "scene.h"
#include <contactx/contact/mortar_obstacle.h>
#include <contactx/geometry/nodal.h>
#include <contactx/geometry/quadrature.h>

using namespace contactx;
using namespace contactx::contact;
using namespace contactx::tests;

namespace
{
/// A surface whose outward normal points up, warped by a height; in 2D a line.
Scene surface(int gdim, Cells cells, double height)
{
  const auto z = [height](double s, double t)
  { return height * (s * s - s * t + 0.3 * t); };
  if (gdim == 3)
    return grid(3, cells, [&](double s, double t)
                { return Vector<3>{s + 0.1 * t * t, t, z(s, t)}; });
  Scene line(2);
  for (int i = 0; i <= 4; ++i)
    line.node({i / 4.0, z(i / 4.0, 0), 0});
  // The outward normal is the tangent turned clockwise
  for (int i = 0; i < 4; ++i)
    line.facet({i + 1, i});
  return line;
}

std::vector<Scene> surfaces(double height)
{
  return {surface(2, Cells::mixed, height),
          surface(3, Cells::triangles, height),
          surface(3, Cells::quadrilaterals, height),
          surface(3, Cells::mixed, height)};
}

struct Front
{
  Scene scene;
  std::int32_t n;
  std::unique_ptr<MortarObstacle> master;

  Front(Scene surface, std::shared_ptr<geometry::Obstacle> o,
        bool measures_slip = false)
      : scene(std::move(surface)),
        n(static_cast<std::int32_t>(scene.x.size()) / scene.gdim)
  {
    master = std::make_unique<MortarObstacle>(
        std::move(o),
        std::make_shared<SlaveNodes>(std::make_shared<mesh::SerialNodes>(n),
                                     scene.facets(), scene.facets()),
        scene.x, scene.gdim, infinity, measures_slip);
    master->search(scene.x, std::vector<std::int8_t>(n));
  }

  std::vector<kernel::Pairs> update(std::span<const double> x,
                                    bool frozen = false)
  {
    return master->update(x, frozen, std::vector<double>(n)).value();
  }

  /// Integrals of one kind at the slave nodes, `width` values each.
  std::vector<double> sums(const std::vector<kernel::Pairs>& groups,
                           int kernel::RigidMortarLayout::* part,
                           int width) const
  {
    std::vector<double> sum(n * width, 0);
    for (const kernel::Pairs& p : groups)
    {
      const kernel::RigidMortarLayout at(p.num_slaves, scene.gdim);
      for (std::size_t f = 0; f < p.size(); ++f)
        for (int s = 0; s < p.num_slaves; ++s)
          for (int i = 0; i < width; ++i)
            sum[width * p.slaves[p.num_slaves * f + s] + i]
                += p.data[f * p.data_size + at.*part + width * s + i];
    }
    return sum;
  }
};

/// A ceiling above, whose outward normal points down.
std::shared_ptr<geometry::Obstacle> ceiling(int gdim, double z)
{
  std::vector<double> point(gdim, 0), down(gdim, 0);
  point[gdim - 1] = z;
  down[gdim - 1] = -1;
  return std::make_shared<geometry::Plane>(point, down);
}

std::shared_ptr<geometry::Obstacle> ball(int gdim)
{
  std::vector<double> centre(gdim, 0.45);
  centre[gdim - 1] = 3;
  return std::make_shared<geometry::Sphere>(centre, 2.5);
}

TEST(MortarObstacle, AUniformGapGivesTheArea)
{
  for (const Scene& scene : surfaces(0))
  {
    Front front(scene, ceiling(scene.gdim, 0.25));
    const auto groups = front.master->pairs();
    const auto area
        = geometry::nodal_areas(scene.facets(), scene.x, scene.gdim);
    auto gaps = area;
    for (double& g : gaps)
      g *= 0.25;
    using Layout = kernel::RigidMortarLayout;
    EXPECT_LE(difference(front.sums(groups, &Layout::area, 1), area), 1e-14);
    EXPECT_LE(difference(front.sums(groups, &Layout::gap, 1), gaps), 1e-14);
    const auto normal = front.sums(groups, &Layout::normal, scene.gdim);
    for (int i = 0; i < front.n; ++i)
      EXPECT_NEAR(normal[scene.gdim * (i + 1) - 1], -area[i], 1e-14);
    EXPECT_EQ(front.master->paired(), std::vector<std::int8_t>(front.n, 1));
  }
}

TEST(MortarObstacle, WhatIsLinearOnFacetsIsWeighedAtTheNodes)
{
  // Dual functions are orthogonal to the shape functions of other nodes, on
  // facets of any shape
  for (const Scene& scene : surfaces(0.1))
  {
    auto plane = std::make_shared<geometry::Plane>(
        scene.gdim == 2 ? std::vector<double>{0, 1}
                        : std::vector<double>{0, 0, 1},
        scene.gdim == 2 ? std::vector<double>{0.2, -1}
                        : std::vector<double>{0.2, -0.1, -1});
    Front front(scene, plane);
    const auto groups = front.master->pairs();
    using Layout = kernel::RigidMortarLayout;
    auto expected = front.sums(groups, &Layout::area, 1);
    const auto gap = plane->distance(scene.x, scene.gdim);
    for (int i = 0; i < front.n; ++i)
      expected[i] *= gap[i];
    EXPECT_LE(difference(front.sums(groups, &Layout::gap, 1), expected), 1e-14);
  }
}

/// int g D_s over a flat triangle in the plane z = 0, by many points: D_s are
/// the dual functions 4 N_s - 1 of a triangle, times the mean of N_s over the
/// area, which is that of nodal areas.
TEST(MortarObstacle, IntegratesAGapOfDegreeTwoExactly)
{
  auto set = std::make_shared<geometry::LevelSet>(
      [](std::span<const double> x, int, int)
      {
        // Its gradient has length one: g = f
        geometry::LevelValues at;
        for (std::size_t i = 0; i < x.size(); i += 3)
        {
          at.value.push_back(2 + x[i] * x[i] - 0.5 * x[i] * x[i + 1]
                             - x[i + 1]);
          at.gradient.insert(at.gradient.end(), {0, 0, -1});
          at.hessian.insert(at.hessian.end(), 9, 0.0);
        }
        return at;
      });
  Scene scene(3);
  const Vector<3> corner[3] = {{0.1, 0, 0}, {1, 0.2, 0}, {0.3, 0.8, 0}};
  for (const auto& p : corner)
    scene.node(p);
  scene.facet({0, 1, 2});
  Front front(scene, set);
  const auto groups = front.master->pairs();
  ASSERT_EQ(groups.size(), 1u);
  const double area = norm(cross(corner[1] - corner[0], corner[2] - corner[0]));
  Vector<3> expected{};
  for (const auto& [s, ws] : geometry::gauss(8))
    for (const auto& [t, wt] : geometry::gauss(8))
    {
      const Vector<3> N{1 - s, s * (1 - t), s * t};
      const Vector<3> p
          = N[0] * corner[0] + N[1] * corner[1] + N[2] * corner[2];
      const double g = 2 + p[0] * p[0] - 0.5 * p[0] * p[1] - p[1];
      for (int i = 0; i < 3; ++i)
        expected[i] += ws * wt * s * area * g * (4 * N[i] - 1);
    }
  for (int i = 0; i < 3; ++i)
    EXPECT_NEAR(groups[0].data[kernel::RigidMortarLayout(3, 3).gap + i],
                expected[i], 1e-14);
}

TEST(MortarObstacle, DerivativesAreThoseByDifferences)
{
  using Layout = kernel::RigidMortarLayout;
  for (const Scene& scene : surfaces(0.1))
  {
    const int g = scene.gdim;
    Front front(scene, ball(g));
    const auto groups = front.master->pairs();
    // To the accuracy of the rule
    EXPECT_LE(difference(front.sums(groups, &Layout::area, 1),
                         geometry::nodal_areas(scene.facets(), scene.x, g)),
              1e-6);
    const double h = 1e-6;
    for (std::size_t node = 0; node < scene.x.size() / g; ++node)
      for (int k = 0; k < g; ++k)
      {
        auto up = scene.x, down = scene.x;
        up[g * node + k] += h;
        down[g * node + k] -= h;
        const auto plus = front.update(up), minus = front.update(down);
        // Rows of the derivatives that this node has
        std::vector<double> gap(front.n, 0), normal(front.n * g, 0);
        for (const kernel::Pairs& p : groups)
        {
          const int s = p.num_slaves;
          const Layout at(s, g);
          for (std::size_t f = 0; f < p.size(); ++f)
            for (int t = 0; t < s; ++t)
            {
              if (p.nodes[s * f + t] != std::int32_t(node))
                continue;
              const double* row = &p.data[f * p.data_size];
              for (int i = 0; i < s; ++i)
              {
                const std::int32_t slave = p.slaves[s * f + i];
                gap[slave] += row[at.gradient + g * (s * i + t) + k];
                for (int j = 0; j < g; ++j)
                  normal[g * slave + j]
                      += row[at.curvature + g * (g * (s * i + t) + j) + k];
              }
            }
        }
        const auto check = [&](int Layout::* part, int width,
                               const std::vector<double>& derivative)
        {
          auto by = front.sums(plus, part, width);
          const auto low = front.sums(minus, part, width);
          for (std::size_t i = 0; i < by.size(); ++i)
            by[i] = (by[i] - low[i]) / (2 * h);
          EXPECT_LE(difference(by, derivative), 1e-9);
        };
        check(&Layout::gap, 1, gap);
        check(&Layout::normal, g, normal);
      }
  }
}

TEST(MortarObstacle, FrozenTheGapIsLinear)
{
  using Layout = kernel::RigidMortarLayout;
  for (const Scene& scene : surfaces(0.1))
  {
    const int g = scene.gdim;
    Front front(scene, ball(g));
    Generator random(4);
    std::vector<double> d = random.numbers(scene.x.size(), -1, 1);
    const auto moved = [&](double by)
    {
      auto x = scene.x;
      for (std::size_t i = 0; i < x.size(); ++i)
        x[i] += by * d[i];
      return x;
    };
    const auto gaps = [&](double by, bool frozen)
    { return front.sums(front.update(moved(by), frozen), &Layout::gap, 1); };
    const auto zero = gaps(0, true), one = gaps(1, true), two = gaps(2, true);
    EXPECT_EQ(zero, gaps(0, false));
    const double h = 1e-6;
    const auto plus = gaps(h, false), minus = gaps(-h, false);
    for (int i = 0; i < front.n; ++i)
    {
      EXPECT_NEAR(two[i] - one[i], one[i] - zero[i], 1e-14);
      EXPECT_NEAR(one[i] - zero[i], (plus[i] - minus[i]) / (2 * h), 1e-9);
    }
    for (const kernel::Pairs& p : front.update(moved(1), true))
    {
      const Layout at(p.num_slaves, g);
      for (std::size_t f = 0; f < p.size(); ++f)
        for (int i = at.curvature; i < at.size; ++i)
          EXPECT_EQ(p.data[f * p.data_size + i], 0);
    }
  }
}

TEST(MortarObstacle, WhatDoesNotFaceItIsNotIntegrated)
{
  using Layout = kernel::RigidMortarLayout;
  const Scene scene = surface(2, Cells::mixed, 0);
  Front front(scene, ceiling(2, 0.5));
  ASSERT_EQ(front.master->pairs().at(0).size(), 4u);
  // Of the second facet one corner, of the last one none
  const std::vector<std::int8_t> faces{1, 1, 1, 0, 1, 1, 0, 0};
  front.master->set_front_facets(faces);
  const auto groups = front.master->pairs();
  ASSERT_EQ(groups.at(0).size(), 3u);
  const auto area = front.sums(groups, &Layout::area, 1);
  EXPECT_LE(difference(area, {0.125, 0.125, 0.25, 0.125, 0}), 1e-15);
  const auto gap = front.sums(groups, &Layout::gap, 1);
  EXPECT_LE(difference(gap, {0.0625, 0.0625, 0.125, 0.0625, 0}), 1e-15);
  EXPECT_REFUSED(front.master->set_front_facets(std::vector<std::int8_t>(3)));
}

TEST(MortarObstacle, FacetsBelongToWhereTheirNodesAreOwned)
{
  Scene scene = surface(2, Cells::mixed, 0);
  // The ends of the line are owned
  const std::array<std::int32_t, 5> number{0, 2, 3, 4, 1};
  const std::vector<double> x = scene.x;
  for (std::int32_t i = 0; i < 5; ++i)
    std::copy_n(x.begin() + 2 * i, 2, scene.x.begin() + 2 * number[i]);
  for (std::int32_t& node : scene.nodes)
    node = number[node];
  MortarObstacle master(
      ceiling(2, 0.5),
      std::make_shared<SlaveNodes>(std::make_shared<PartOfNodes>(2, 5),
                                   scene.facets(), scene.facets()),
      scene.x, 2, infinity, true);
  master.search(scene.x, std::vector<std::int8_t>(2));
  const auto groups = master.pairs();
  // Owned slave nodes come first, then the others in order
  EXPECT_EQ(groups.at(0).nodes, (std::vector<std::int32_t>{2, 0, 1, 4}));
  EXPECT_EQ(groups.at(0).slaves, (std::vector<std::int32_t>{2, 0, 1, 4}));
  EXPECT_EQ(groups.at(0).slip_size, 0);
  EXPECT_EQ(master.normals(), (std::vector<double>{0, -1, 0, 0, -1, 0}));
}

TEST(MortarObstacle, TakesOffWhereTheObstacleCarriesItsPoints)
{
  auto plane = std::make_shared<geometry::Plane>(std::vector<double>{0, 1},
                                                 std::vector<double>{0, -1});
  Front front(surface(2, Cells::mixed, 0), plane, true);
  plane->place({0.5, 0.75}, {0, -1});
  auto expected = front.scene.x;
  for (std::size_t i = 0; i < expected.size(); i += 2)
  {
    expected[i] += 0.5;
    expected[i + 1] -= 0.25;
  }
  EXPECT_LE(difference(front.master->origin(), expected), 1e-15);
  EXPECT_TRUE(Front(front.scene, plane).master->origin().empty());
}

TEST(MortarObstacle, IsAsItWasAfterLoading)
{
  const Scene scene = surface(3, Cells::mixed, 0.1);
  Front first(scene, ball(3), true), second(scene, ball(3), true);
  auto x = scene.x;
  for (std::size_t i = 0; i < x.size(); ++i)
    x[i] += 0.01 * std::sin(double(i));
  first.master->accept(x);
  first.master->begin_step();
  first.master->search(x, std::vector<std::int8_t>(first.n));
  const auto saved = first.master->save();
  second.master->load(saved);
  const auto again = second.master->save();
  ASSERT_EQ(again.size(), saved.size());
  for (std::size_t i = 0; i < saved.size(); ++i)
    EXPECT_EQ(again[i].values, saved[i].values) << saved[i].name;
  EXPECT_EQ(saved.back().rows, RowKind::node);
  for (bool frozen : {false, true})
  {
    const auto a = first.update(scene.x, frozen),
               b = second.update(scene.x, frozen);
    ASSERT_EQ(a.size(), b.size());
    for (std::size_t i = 0; i < a.size(); ++i)
      EXPECT_EQ(a[i].data, b[i].data);
  }
}

TEST(MortarObstacle, ANodeHeldAcrossItsNormalMoves)
{
  // A plane, with the surface in it: along the surface a held node has no
  // friction, and across the normal facets move with the nodes beside it
  for (const double slope : {0.0, 0.02, 0.5})
  {
    Scene line = surface(2, Cells::mixed, 0);
    for (std::size_t k = 0; k < line.x.size(); k += 2)
      line.x[k + 1] = slope * line.x[k];
    const Front front(std::move(line), std::make_shared<geometry::Plane>(
                                           std::vector<double>{0, 0},
                                           std::vector<double>{slope, -1}));
    std::vector<std::int8_t> free(front.scene.x.size(), 1);
    free[0] = 0;
    const Mobility found = front.master->mobility(free);
    EXPECT_EQ(found.each[0], slope > 0.1 ? 1 : 0);
    EXPECT_EQ(found.each[1], 1);
  }
}

TEST(MortarObstacle, RefusesAFacetWithoutArea)
{
  Scene scene(2);
  scene.node({0, 0, 0});
  scene.node({0, 0, 0});
  scene.facet({0, 1});
  EXPECT_REFUSED(Front(scene, ceiling(2, 1)));
}
} // namespace
