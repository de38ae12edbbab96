// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#include "obstacle_scene.h"
#include <contactx/contact/obstacle_tie.h>
#include <contactx/contact/touching.h>
#include <numbers>

using namespace contactx;
using namespace contactx::contact;
using namespace contactx::tests;

namespace
{
std::unique_ptr<ObstacleMaster> make(const FacingNodes& scene,
                                     std::shared_ptr<geometry::Obstacle> o,
                                     bool measures_slip = true,
                                     double reach = infinity)
{
  auto master = std::make_unique<ObstacleMaster>(
      std::move(o), scene.slaves, scene.x, scene.gdim, reach, measures_slip);
  master->search(scene.x, std::vector<std::int8_t>(scene.n));
  return master;
}

Given given(ObstacleMaster& master, const FacingNodes& scene,
            std::span<const double> x, bool frozen = false,
            std::vector<double> offset = {})
{
  offset.resize(scene.n);
  return Given(master.update(x, frozen, offset).value(), scene.gdim);
}

std::vector<double> strayed(const FacingNodes& scene, double by,
                            unsigned seed = 3)
{
  Generator random(seed);
  return scene.moved(
      [&](int, double* p)
      {
        for (int k = 0; k < scene.gdim; ++k)
          p[k] += random(-by, by);
      });
}

/// Movement of the slave nodes without its part along some normals.
std::vector<double> across(const FacingNodes& scene,
                           std::span<const double> from,
                           std::span<const double> to,
                           std::span<const double> normal)
{
  const int g = scene.gdim;
  std::vector<double> way(scene.n * g);
  for (int i = 0; i < scene.n; ++i)
  {
    double height = 0;
    for (int k = g * i; k < g * i + g; ++k)
      height += (to[k] - from[k]) * normal[k];
    for (int k = g * i; k < g * i + g; ++k)
      way[k] = to[k] - from[k] - height * normal[k];
  }
  return way;
}

TEST(Touching, IsWhereAStraightWayHasNoGap)
{
  EXPECT_EQ(touching(1, -1), 0.5);
  EXPECT_EQ(touching(3, -1), 0.75);
  EXPECT_EQ(touching(1, 0.5), 1);
  EXPECT_EQ(touching(1, 2), 0);
  EXPECT_EQ(touching(0, -1), 0);
  EXPECT_EQ(touching(-1, -2), 0);
}

/// Compare the derivative of the slip at strayed nodes with differences.
void expect_derivative(ObstacleMaster& master, const FacingNodes& scene,
                       bool frozen)
{
  const int g = scene.gdim;
  const auto x = strayed(scene, 0.2);
  const Given at = given(master, scene, x, frozen);
  // Normals turn fast beside the centre
  const double h = 1e-6, size = 1 + largest(at.derivative);
  for (int k = 0; k < g; ++k)
  {
    auto up = x, down = x;
    for (int i = 0; i < scene.n; ++i)
    {
      up[g * i + k] += h;
      down[g * i + k] -= h;
    }
    const Given plus = given(master, scene, up, frozen),
                minus = given(master, scene, down, frozen);
    for (int i = 0; i < scene.n * g; ++i)
      EXPECT_NEAR(at.derivative[g * i + k],
                  (plus.slip[i] - minus.slip[i]) / (2 * h), 1e-7 * size * size);
  }
}

/// Test obstacles of each kind, as masters of nodes that face them.
template <class Test>
void on_each_kind(int gdim, Test&& test)
{
  for (Kind kind : kinds(gdim))
  {
    SCOPED_TRACE(testing::Message() << gdim << " " << int(kind));
    const auto o = make_obstacle(kind, gdim);
    const FacingNodes scene(*o, gdim);
    test(*o, *make(scene, o), scene);
  }
}

TEST_2D_3D(ObstacleMaster, TheDerivativeIsThatOfTheSlip, gdim)
{
  for (bool frozen : {false, true})
    on_each_kind(gdim, [&](const auto&, auto& master, const FacingNodes& scene)
                 { expect_derivative(master, scene, frozen); });
}

TEST_2D_3D(ObstacleMaster, SlipIsTheTangentialPartOfTheWay, gdim)
{
  on_each_kind(gdim,
               [&](const auto&, auto& master, const FacingNodes& scene)
               {
                 const auto x = strayed(scene, 0.3);
                 const Given at = given(master, scene, x);
                 EXPECT_LE(
                     difference(at.slip, across(scene, scene.x, x, at.normal)),
                     1e-14);
                 EXPECT_LE(largest(given(master, scene, scene.x).slip), 1e-15);
               });
}

TEST_2D_3D(ObstacleMaster, FrozenTheGapIsLinear, gdim)
{
  on_each_kind(gdim,
               [&](auto& o, auto& master, const FacingNodes& scene)
               {
                 const auto x = strayed(scene, 0.3);
                 const Given at = given(master, scene, x, true);
                 const auto seen = o.evaluate(
                     std::span(scene.x).first(scene.n * gdim), gdim);
                 for (int i = 0; i < scene.n; ++i)
                 {
                   double gap = seen.gap[i];
                   for (int k = gdim * i; k < gdim * (i + 1); ++k)
                     gap += seen.gradient[k] * (x[k] - scene.x[k]);
                   EXPECT_NEAR(at.gap[i], gap, 1e-13 * (1 + std::abs(gap)));
                 }
                 EXPECT_EQ(at.normal, seen.normal);
                 // Not frozen, it is the obstacle's
                 EXPECT_EQ(given(master, scene, x).gap, master.inside(x));
               });
}

TEST(ObstacleMaster, TheNextStepStartsWhereTheLastOneEnded)
{
  const auto o = make_obstacle(Kind::sphere, 3);
  const FacingNodes scene(*o, 3);
  const auto master = make(scene, o);
  const auto x = strayed(scene, 0.1);
  master->accept(x);
  // Not before the step begins
  EXPECT_LE(largest(given(*master, scene, scene.x).slip), 1e-15);
  master->begin_step();
  EXPECT_LE(largest(given(*master, scene, x).slip), 1e-15);
  EXPECT_GE(largest(given(*master, scene, scene.x).slip), 0.01);
}

/// An obstacle that moves and turns, and the motion of its material.
struct Moving
{
  std::shared_ptr<geometry::Obstacle> o;
  std::function<void(bool)> place; ///< at its end, or at its start
  geometry::Placement from, to;

  Moving(Kind kind, int gdim)
  {
    std::vector<double> start(gdim, 0.1), end, a, b{2, -0.5, 1.5};
    for (int k = 0; k < gdim; ++k)
    {
      end.push_back(-0.3 + k * 0.5);
      a.push_back(1 + k);
    }
    b.resize(gdim);
    if (kind == Kind::plane)
    {
      auto plane = std::make_shared<geometry::Plane>(start, a);
      place = [=](bool is_end)
      { plane->place(is_end ? end : start, is_end ? b : a); };
      o = plane;
    }
    else if (kind == Kind::sphere)
    {
      auto sphere = std::make_shared<geometry::Sphere>(start, 0.8);
      place = [=](bool is_end) { sphere->place(is_end ? end : start, 0.8); };
      o = sphere;
    }
    else
    {
      auto cylinder = std::make_shared<geometry::Cylinder>(start, a, 0.8);
      place = [=](bool is_end)
      { cylinder->place(is_end ? end : start, is_end ? b : a, 0.8); };
      o = cylinder;
    }
    from = o->placement(gdim);
    move();
    to = o->placement(gdim);
    place(false);
  }

  void move() const { place(true); }

  std::vector<double> carried(const FacingNodes& scene) const
  {
    return from.carry(scene.x, to);
  }
};

const std::vector<std::pair<Kind, int>> movable{{Kind::plane, 2},
                                                {Kind::plane, 3},
                                                {Kind::sphere, 2},
                                                {Kind::sphere, 3},
                                                {Kind::cylinder, 3}};

TEST(ObstacleMaster, WhatAnObstacleCarriesDoesNotSlip)
{
  for (const auto& [kind, gdim] : movable)
  {
    Moving moving(kind, gdim);
    const FacingNodes scene(*moving.o, gdim);
    const auto master = make(scene, moving.o);
    const Given before = given(*master, scene, scene.x);
    moving.move();
    expect_derivative(*master, scene, false);
    const auto x = moving.carried(scene);
    const Given at = given(*master, scene, x);
    EXPECT_LE(largest(at.slip), 1e-14);
    EXPECT_LE(difference(at.gap, before.gap), 1e-14);
    // A node that stays behind slips the other way
    const Given stayed = given(*master, scene, scene.x);
    const auto way = across(scene, x, scene.x, stayed.normal);
    EXPECT_LE(difference(stayed.slip, way), 1e-14);
    EXPECT_GE(largest(way), 0.1);
    // Tractions turn with it
    const auto turn = master->turn(scene.x).value();
    const auto one = moving.from.turn(moving.to);
    ASSERT_EQ(turn.size(), scene.n * one.size());
    EXPECT_TRUE(std::equal(one.begin(), one.end(), turn.end() - one.size()));
    // The next step starts from there
    master->accept(x);
    master->begin_step();
    EXPECT_LE(largest(given(*master, scene, x).slip), 1e-14);
    EXPECT_LE(largest(master->turn(x).value()), 1);
  }
}

TEST(ObstacleMaster, FirstTouchIsWhereTheWayMeetsThePlane)
{
  // Seen from the plane, which comes up to the nodes and moves aside meanwhile
  for (int gdim : {2, 3})
  {
    const int n = 12, z = gdim - 1;
    std::vector<double> up(gdim, 0), start(gdim, 0), points(n * gdim, 0);
    up[z] = 1;
    for (int i = 0; i < n; ++i)
    {
      points[gdim * i] = 0.1 * i;
      points[gdim * i + z] = 0.1 + 0.5 * i / (n - 1);
    }
    auto plane = std::make_shared<geometry::Plane>(start, up);
    const FacingNodes scene(*plane, gdim, points);
    const auto master = make(scene, plane);
    start[z] = 0.25;
    start[0] += 0.1;
    plane->place(start, up);
    const auto x = scene.moved(
        [z](int, double* p)
        {
          p[0] += 0.5;
          p[z] -= 0.5;
        });
    const std::vector<double> offset(n, 0.05);
    std::vector<std::int8_t> which(n);
    for (int i = 0; i < n; i += 2)
      which[i] = 1;
    master->touch(which, x, {}, offset);
    const Given at = given(*master, scene, x);
    for (int i = 0; i < n; ++i)
    {
      // Gaps go from z - 0.05 to z - 0.8; relative to the plane the way aside
      // is 0.4
      const double left = 1 - (scene.x[gdim * i + z] - 0.05) / 0.75;
      EXPECT_NEAR(at.slip[gdim * i], which[i] ? 0.4 * left : 0.4, 1e-14);
      for (int k = 1; k < gdim; ++k)
        EXPECT_NEAR(at.slip[gdim * i + k], 0, 1e-14);
    }
  }
}

TEST(ObstacleMaster, NothingIsTangentialWithoutFriction)
{
  const auto o = make_obstacle(Kind::plane, 3);
  const FacingNodes scene(*o, 3);
  const auto master = make(scene, o, false);
  const auto pairs
      = master->update(scene.x, false, std::vector<double>(scene.n)).value();
  EXPECT_EQ(pairs.at(0).slip_size, 0);
  EXPECT_TRUE(pairs.at(0).slip.empty());
  // No slip, where it starts and what moves the obstacle
  EXPECT_EQ(master->save().size(), 5u);
  EXPECT_FALSE(master->turn(scene.x));
}

TEST(ObstacleMaster, PairsNodesThatFaceItWithinReach)
{
  auto plane = std::make_shared<geometry::Plane>(std::vector<double>{0, 0},
                                                 std::vector<double>{0, 1});
  // Nodes 1, 2 and 4 are those of facets that face away, node 3 is out of reach
  const std::vector<double> x{0,   0.1, 1,    0.1, 2,    0.1, 3,
                              0.9, 4,   -0.2, 5,   -0.6, 6,   0.1};
  const std::vector<std::int32_t> offsets{0, 2, 4, 6, 8},
      nodes{0, 6, 2, 1, 3, 5, 6, 4};
  const auto slaves = std::make_shared<SlaveNodes>(
      std::make_shared<PartOfNodes>(6, 7), geometry::FacetList{offsets, nodes},
      geometry::FacetList{offsets, nodes});
  ObstacleMaster master(plane, slaves, x, 2, 0.5, false);
  EXPECT_EQ(master.paired(), std::vector<std::int8_t>(6));
  EXPECT_TRUE(master.pairs().empty());
  master.search(x, std::vector<std::int8_t>(6));
  // The tangent from left to right has its outward normal below
  EXPECT_EQ(master.paired(), (std::vector<std::int8_t>{1, 0, 0, 0, 0, 0}));
  const auto pairs = master.pairs();
  ASSERT_EQ(pairs.size(), 1u);
  EXPECT_EQ(pairs[0].slaves, (std::vector<std::int32_t>{0}));
  EXPECT_EQ(pairs[0].nodes, (std::vector<std::int32_t>{0}));
  EXPECT_EQ(pairs[0].num_nodes, 0);
  const auto normals = master.normals();
  EXPECT_EQ(normals[1], 1);
  EXPECT_EQ(largest({normals.begin() + 3, normals.end()}), 0);
  const kernel::Weights weights = master.weights();
  EXPECT_EQ(weights.values, (std::vector<double>{1}));
  EXPECT_EQ(master.distance(x), 0.1);
  EXPECT_EQ(master.compliance(x), std::vector<double>(6));
  EXPECT_TRUE(master.is_rigid());
}

TEST(ObstacleMaster, MobilityIsThatOfTheFreeComponents)
{
  auto plane = std::make_shared<geometry::Plane>(std::vector<double>{0, 0},
                                                 std::vector<double>{3, 4});
  const FacingNodes scene(*plane, 2, std::vector<double>{0, 1, 1, 1, 2, 1});
  const auto master = make(scene, plane);
  std::vector<std::int8_t> free(scene.x.size(), 1);
  free[2] = 0;
  free[4] = free[5] = 0;
  const Mobility m = master->mobility(free);
  EXPECT_LE(difference(m.normal, {1, 0.8, 0}), 1e-15);
  EXPECT_EQ(m.each, (std::vector<double>{1, 1, 0, 1, 0, 0}));
}

TEST(ObstacleMaster, ALevelSetThatMovesTellsNothing)
{
  double height = 0;
  auto set = std::make_shared<geometry::LevelSet>(
      [&](std::span<const double> x, int, int)
      {
        geometry::LevelValues at;
        for (std::size_t i = 0; i < x.size(); i += 2)
        {
          at.value.push_back(x[i + 1] - height);
          at.gradient.insert(at.gradient.end(), {0, 1});
        }
        return at;
      });
  const FacingNodes scene(*set, 2);
  const auto master = make(scene, set);
  EXPECT_FALSE(master->has_unknown_motion(1e-6));
  height = 1e-3;
  EXPECT_TRUE(master->has_unknown_motion(1e-6));
  EXPECT_FALSE(master->has_unknown_motion(1e-2));
  EXPECT_FALSE(make(scene, set, false)->has_unknown_motion(0));
  // Along its surface only parameters tell
  double shift = 0;
  auto told = std::make_shared<geometry::LevelSet>(
      [&](std::span<const double> x, int g, int) { return bump(x, g, true); },
      [&](int) { return std::vector<double>{shift}; });
  const auto second = make(FacingNodes(*told, 2), told);
  EXPECT_FALSE(second->has_unknown_motion(1e-6));
  shift = 1;
  EXPECT_TRUE(second->has_unknown_motion(1e-6));
  Moving moving(Kind::plane, 2);
  const auto third = make(FacingNodes(*moving.o, 2), moving.o);
  moving.move();
  EXPECT_FALSE(third->has_unknown_motion(0));
}

TEST(ObstacleMaster, IsAsItWasAfterLoading)
{
  Moving moving(Kind::cylinder, 3);
  const FacingNodes scene(*moving.o, 3);
  const auto first = make(scene, moving.o), second = make(scene, moving.o);
  const auto x = strayed(scene, 0.1, 5), y = strayed(scene, 0.2, 6);
  moving.move();
  first->accept(x);
  first->begin_step();
  first->search(y, std::vector<std::int8_t>(scene.n));
  first->touch(std::vector<std::int8_t>(scene.n, 1), y, {},
               std::vector<double>(scene.n));
  const auto saved = first->save();
  second->load(saved);
  const auto again = second->save();
  ASSERT_EQ(again.size(), saved.size());
  for (std::size_t i = 0; i < saved.size(); ++i)
  {
    EXPECT_EQ(again[i].name, saved[i].name);
    EXPECT_EQ(again[i].values, saved[i].values) << saved[i].name;
  }
  EXPECT_EQ(second->pairs()[0].slip, first->pairs()[0].slip);
  EXPECT_EQ(given(*second, scene, x).slip, given(*first, scene, x).slip);
  // What does not fit changes nothing
  const auto before = first->save();
  auto bad = saved;
  std::get<std::vector<double>>(bad[5].values).pop_back();
  EXPECT_REFUSED(first->load(bad));
  for (std::size_t i = 0; i < before.size(); ++i)
    EXPECT_EQ(first->save()[i].values, before[i].values);
}

TEST(ObstacleMaster, RefusesWhatDoesNotFit)
{
  const auto o = make_obstacle(Kind::plane, 2);
  const FacingNodes s(*o, 2);
  const auto made = [&](std::vector<double> x, int gdim)
  { ObstacleMaster(o, s.slaves, x, gdim, infinity, true); };
  EXPECT_NO_THROW(made(s.x, 2));
  EXPECT_REFUSED(made({0, 1}, 2));
  // Facets of two nodes are none in 3D
  EXPECT_REFUSED(made(s.x, 3));
  EXPECT_REFUSED(made(s.x, 4));
  EXPECT_REFUSED(ObstacleMaster(o, nullptr, s.x, 2, infinity, true));
  EXPECT_REFUSED(make(s, o)->search(std::vector<double>{0, 1}, {}));
}

std::unique_ptr<ObstacleTie> tied(const FacingNodes& scene,
                                  std::shared_ptr<geometry::Obstacle> o)
{
  auto tie = std::make_unique<ObstacleTie>(std::move(o), scene.slaves, scene.x,
                                           scene.gdim, infinity);
  tie->search(scene.x, std::vector<std::int8_t>(scene.n));
  return tie;
}

TEST_2D_3D(ObstacleTie, MovesWithItsObstacleOverSteps, gdim)
{
  Moving moving(Kind::plane, gdim);
  const FacingNodes scene(*moving.o, gdim);
  const auto tie = tied(scene, moving.o);
  EXPECT_LE(largest(given(*tie, scene, scene.x).slip), 1e-15);
  moving.move();
  auto x = moving.carried(scene);
  std::vector<double> d;
  for (std::size_t i = 0; i < x.size(); ++i)
  {
    x[i] += 0.1 + 0.1 * (i % gdim);
    if (i < std::size_t(scene.n * gdim))
      d.push_back(0.1 + 0.1 * (i % gdim));
  }
  const Given at = given(*tie, scene, x);
  EXPECT_LE(difference(at.slip, d), 1e-14);
  for (int i = 0; i < scene.n * gdim; ++i)
    for (int k = 0; k < gdim; ++k)
      EXPECT_EQ(at.derivative[gdim * i + k], i % gdim == k);
  tie->accept(x);
  tie->begin_step();
  // The tie's place is that of the reference for ever
  tie->search(x, std::vector<std::int8_t>(scene.n));
  EXPECT_LE(difference(given(*tie, scene, x).slip, d), 1e-14);
  // Another one goes on from what was saved
  const auto other = tied(scene, moving.o);
  EXPECT_GE(difference(given(*other, scene, x).slip, d), 0.1);
  other->load(tie->save());
  other->search(x, std::vector<std::int8_t>(scene.n));
  EXPECT_EQ(given(*other, scene, x).slip, given(*tie, scene, x).slip);
}

/// A floor whose material goes along with a velocity that changes.
struct Belt
{
  double time = 0, speed = 1;
  std::shared_ptr<geometry::LevelSet> o = std::make_shared<geometry::LevelSet>(
      [](std::span<const double> x, int g, int)
      {
        geometry::LevelValues at;
        for (std::size_t i = 0; i < x.size(); i += g)
        {
          at.value.push_back(x[i + 1] + 10);
          at.gradient.insert(at.gradient.end(), {0, 1});
        }
        return at;
      },
      geometry::LevelSet::Parameters{},
      geometry::LevelSet::Velocity{[this](std::span<const double> x, int g)
                                   {
                                     std::vector<double> v(x.size(), 0);
                                     for (std::size_t i = 0; i < x.size();
                                          i += g)
                                       v[i] = speed;
                                     return v;
                                   },
                                   [this] { return time; }});
};

TEST(ObstacleMaster, ABeltDragsByItsVelocity)
{
  Belt belt;
  const FacingNodes scene(*belt.o, 2);
  const auto master = make(scene, belt.o);
  const auto tie = tied(scene, belt.o);
  double way = 0;
  for (double speed : {1.0, -3.0})
  {
    belt.speed = speed;
    belt.time += 0.25;
    way += 0.25 * speed;
    const Given slips = given(*master, scene, scene.x);
    const Given pulls = given(*tie, scene, scene.x);
    for (int i = 0; i < scene.n; ++i)
    {
      EXPECT_NEAR(slips.slip[2 * i], -0.25 * speed, 1e-14);
      EXPECT_NEAR(slips.slip[2 * i + 1], 0, 1e-14);
      // A tie is pulled by all of it
      EXPECT_NEAR(pulls.slip[2 * i], -way, 1e-14);
    }
    for (ObstacleMaster* each :
         {master.get(), static_cast<ObstacleMaster*>(tie.get())})
    {
      each->accept(scene.x);
      each->begin_step();
    }
  }
  EXPECT_FALSE(master->has_unknown_motion(0));
  // The time is saved with the step's start
  const auto other = make(scene, belt.o);
  belt.time += 0.5;
  const auto late = make(scene, belt.o);
  late->load(master->save());
  EXPECT_EQ(given(*late, scene, scene.x).slip,
            given(*master, scene, scene.x).slip);
  EXPECT_NEAR(given(*late, scene, scene.x).slip[0], 1.5, 1e-14);
}

TEST_2D_3D(ObstacleTie, AnOffsetMakesItLongerAlongTheNormalThatTurns, gdim)
{
  Moving moving(Kind::plane, gdim);
  const FacingNodes scene(*moving.o, gdim);
  const auto tie = tied(scene, moving.o);
  std::vector<double> offset;
  for (int i = 0; i < scene.n; ++i)
    offset.push_back(-0.2 + 0.05 * i);
  moving.move();
  auto x = moving.carried(scene);
  const Given at = given(*tie, scene, x);
  for (int i = 0; i < scene.n * gdim; ++i)
    x[i] += offset[i / gdim] * at.normal[i];
  EXPECT_LE(largest(given(*tie, scene, x, false, offset).slip), 1e-14);
  EXPECT_GE(largest(given(*tie, scene, x).slip), 0.1);
}
} // namespace
