// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#include "blocks.h"
#include <contactx/geometry/cylinder.h>
#include <contactx/geometry/level_set.h>
#include <contactx/geometry/plane.h>
#include <contactx/geometry/sphere.h>
#include <contactx/problem/check_inside.h>
#include <contactx/problem/sides.h>

using namespace contactx;
using namespace contactx::tests;
using problem::check_nested;
using problem::check_outside;

namespace
{
using Inside = testing::TestWithParam<int>;

/// A block of size 0.4 whose bottom is at a height, in a block below zero.
struct Nested : Stacked
{
  Side bottom, top; ///< of the small one, and of the large one

  Nested(int gdim, double height, int n = 3)
      : Stacked(gdim, 0.53, height, 0.4, 1.5, n),
        bottom(upper(gdim - 1, false)), top(lower(gdim - 1, true))
  {
  }

  /// What is said of them, the small one being slave or master.
  std::string said(int ranks, bool is_slave = true) const
  {
    const auto look = [&](const RankBlocks& mine)
    {
      const geometry::Facets small = mine.own(bottom), large = mine.own(top);
      const mesh::NamedSurface a{"A", small.list()}, b{"B", large.list()};
      check_nested(mine.mesh(), is_slave ? a : b, is_slave ? b : a);
    };
    const std::string text = tests::said(blocks, ranks, look);
    EXPECT_EQ(tests::said(blocks, ranks, look, true), text);
    return text;
  }
};

/// What is said of the bottom of a block in an obstacle.
std::string said_of(const Blocks& blocks, int ranks,
                    geometry::Obstacle& obstacle)
{
  const Side bottom = blocks.side(0, blocks.gdim - 1, false);
  return tests::said(
      blocks, ranks,
      [&](const RankBlocks& mine)
      {
        const geometry::Facets own = mine.own(bottom);
        const auto slaves = problem::make_slave_nodes(mine.halo, own.list());
        std::vector<double> at;
        for (const std::int32_t node : slaves->owned())
          for (int k = 0; k < blocks.gdim; ++k)
            at.push_back(mine.halo->reference()[node * blocks.gdim + k]);
        check_outside(mine.mesh(), *slaves, "S",
                      obstacle.distance(at, blocks.gdim), obstacle);
      },
      true);
}
} // namespace

TEST_P(Inside, ABodyWhollyInAnotherOneIsRefused)
{
  for (const int gdim : {2, 3})
  {
    const Nested nested(gdim, -0.7);
    const std::string nodes = gdim == 2 ? "16" : "64";
    EXPECT_EQ(nested.said(GetParam()),
              "the body of the slave surface A lies wholly inside the body of "
              "the master surface B: all its "
                  + nodes
                  + " nodes are in cells of the other. Move the bodies apart; "
                    "they may overlap in part (manual: errors/refused-mesh)");
    EXPECT_EQ(nested.said(GetParam(), false),
              "the body of the master surface A lies wholly inside the body of "
              "the slave surface B: all its "
                  + nodes
                  + " nodes are in cells of the other. Move the bodies apart; "
                    "they may overlap in part (manual: errors/refused-mesh)");
  }
}

TEST_P(Inside, OverlapInPartIsLegal)
{
  for (const int gdim : {2, 3})
    for (const double height : {0.1, -0.05, -0.3, -0.4 + 1e-4})
    {
      EXPECT_EQ(Nested(gdim, height).said(GetParam()), "") << height;
      EXPECT_EQ(Nested(gdim, height).said(GetParam(), false), "") << height;
    }
}

TEST_P(Inside, ManyPointsAreLookedAtInParts)
{
  // 225 cells and 256 nodes, then one of them outside
  Nested nested(2, -0.7, 15);
  EXPECT_NE(nested.said(GetParam()), "");
  // A box that is in the other's, and a corner of the other that is cut off
  for (std::int32_t i = 0; i < nested.blocks.num_nodes(); ++i)
  {
    double* x = &nested.blocks.x[2 * std::size_t(i)];
    if (i >= 256 and x[0] == 0 and x[1] == -1)
      x[0] = x[1] = -0.5;
  }
  EXPECT_NE(nested.said(GetParam()), "");
  nested.blocks.x[0] = 0.05;
  nested.blocks.x[1] = -0.9;
  EXPECT_EQ(nested.said(GetParam()), "");
}

TEST_P(Inside, ABodyThatFillsAHoleIsLegal)
{
  // The middle cell of nine is another body's: its nodes are on cells
  Blocks blocks(2);
  blocks.add(3, {0, 0, 0}, {3, 3, 0});
  blocks.add(1, {1, 1, 0}, {2, 2, 0});
  const Side outer = blocks.side(0, 1, false), inner = blocks.side(1, 1, false);
  Blocks pierced = blocks;
  pierced.cells.erase(pierced.cells.begin() + 16, pierced.cells.begin() + 20);
  for (const bool is_pierced : {true, false})
  {
    // Numbers of cells up to the hole stay
    const Blocks& mesh = is_pierced ? pierced : blocks;
    Side plug = inner;
    plug.cell[0] = is_pierced ? 8 : 9;
    const std::string text = tests::said(
        mesh, GetParam(),
        [&](const RankBlocks& mine)
        {
          const geometry::Facets a = mine.own(plug), b = mine.own(outer);
          check_nested(mine.mesh(), {"A", a.list()}, {"B", b.list()});
        });
    EXPECT_EQ(text.empty(), is_pierced) << text;
  }
}

TEST_P(Inside, AnyUnitAndPlace)
{
  for (const int gdim : {2, 3})
    for (const double length : {1e-8, 1e6})
      for (const double height : {-0.4 + 1e-4, -0.7})
      {
        Nested nested(gdim, height);
        std::vector<double>& x = nested.blocks.x;
        const double c = std::cos(0.7), s = std::sin(0.7);
        for (std::size_t i = 0; i < x.size(); i += gdim)
        {
          const double a = x[i], b = x[i + gdim - 1];
          x[i] = c * a - s * b;
          x[i + gdim - 1] = s * a + c * b;
          for (int k = 0; k < gdim; ++k)
            x[i + k] = length * (x[i + k] + 3);
        }
        EXPECT_EQ(nested.said(GetParam()).empty(), height > -0.5);
      }
}

TEST_P(Inside, AFinerBodyInTheSamePlace)
{
  // Its outer nodes are on the surface of the other, but for rounding
  for (const int gdim : {2, 3})
    for (const double angle : {0.0, 0.3, 0.7, 1.2})
    {
      Blocks blocks(gdim);
      blocks.add(5, {}, {1, 1, 1});
      const std::size_t fine = blocks.x.size();
      blocks.add(3, {}, {1, 1, 1});
      const double c = std::cos(angle), s = std::sin(angle);
      for (std::size_t i = 0; i < blocks.x.size(); i += gdim)
      {
        double *x = &blocks.x[i], *y = x + gdim - 1;
        const double a = *x, b = *y;
        *x = c * a - s * b;
        *y = s * a + c * b;
        for (int k = 0; k < gdim; ++k)
          x[k] = 1e-4 * (x[k] + 1e3);
        // Rounding of a mesh generator
        if (i < fine)
          for (int k = 0; k < gdim; ++k)
            x[k] += 1e-10 * (x[k] - 0.1);
      }
      const Side a = blocks.side(0, 0, true), b = blocks.side(1, 0, true);
      EXPECT_TRUE(tests::said(blocks, GetParam(),
                              [&](const RankBlocks& mine)
                              {
                                const geometry::Facets own = mine.own(a),
                                                       other = mine.own(b);
                                check_nested(mine.mesh(), {"A", own.list()},
                                             {"B", other.list()});
                              })
                      .starts_with("the body of the slave surface A lies"));
    }
}

TEST_P(Inside, ABodyInAnObstacleIsRefused)
{
  Blocks blocks(3);
  blocks.add(2, {0.23, 0.23, 0}, {1.23, 1.23, 1});
  const std::vector<double> centre{0.73, 0.73, 0.5}, below{0, 0, -4},
      axis{0, 1, 0}, down{0, 0, -1};
  const auto check = [&](geometry::Obstacle& obstacle, const std::string& kind)
  {
    EXPECT_EQ(said_of(blocks, GetParam(), obstacle),
              "the body of the slave surface S lies wholly inside the rigid "
              "obstacle: all its 27 nodes are inside the "
                  + kind + ". " + obstacle.usual_mistake()
                  + ", or the body is in the wrong place (manual: "
                    "errors/refused-mesh)");
  };
  // Its bottom touches the plane from within
  geometry::Plane touching({0, 0, 0}, down), deep({0, 0, -3}, down);
  check(touching, "Plane");
  check(deep, "Plane");
  geometry::Sphere sphere(centre, 2), bowl(below, 2, true);
  check(sphere, "Sphere");
  check(bowl, "Sphere");
  geometry::Cylinder cylinder(centre, axis, 2), pipe(below, axis, 2, true);
  check(cylinder, "Cylinder");
  check(pipe, "Cylinder");
  geometry::LevelSet level(
      [](std::span<const double> x, int, int)
      {
        geometry::LevelValues at;
        for (std::size_t i = 0; i < x.size(); i += 3)
        {
          at.value.push_back(-1 - x[i + 2]);
          at.gradient.insert(at.gradient.end(), {0, 0, -1});
        }
        return at;
      });
  check(level, "LevelSet");
}

TEST_P(Inside, ABodyDeepInAnObstacleIsLegal)
{
  Blocks blocks(3);
  blocks.add(2, {0.23, 0.23, 0}, {1.23, 1.23, 1});
  const std::vector<double> centre{0.73, 0.73, 0.5};
  geometry::Plane plane({0, 0, 0.99}, {0, 0, 1});
  geometry::Sphere sphere(centre, 0.8), bowl(centre, 0.8, true);
  geometry::Cylinder cylinder(centre, {0, 1, 0}, 0.6);
  for (geometry::Obstacle* o : std::initializer_list<geometry::Obstacle*>{
           &plane, &sphere, &bowl, &cylinder})
    EXPECT_EQ(said_of(blocks, GetParam(), *o), "");
}

TEST_P(Inside, WhatAnObstacleThrowsOnSomeRanksAllThrow)
{
  Blocks blocks(2);
  blocks.add(4, {0, 0, 0}, {1, 1, 0});
  // Of one node alone
  geometry::LevelSet level(
      [](std::span<const double> x, int, int)
      {
        geometry::LevelValues at;
        for (std::size_t i = 0; i < x.size(); i += 2)
        {
          if (x[i] == 1 and x[i + 1] == 1)
            throw std::invalid_argument("too high");
          at.value.push_back(-1 - x[i + 1]);
          at.gradient.insert(at.gradient.end(), {0, -1});
        }
        return at;
      });
  EXPECT_EQ(said_of(blocks, GetParam(), level), "too high");
}

INSTANTIATE_TEST_SUITE_P(Ranks, Inside, testing::Values(1, 2, 3, 4));
