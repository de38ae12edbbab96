// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#include "free_bodies_scene.h"
#include <contactx/solve/held_motions.h>
#include <contactx/solve/rigid_modes.h>
#include <set>

using namespace contactx;
using namespace contactx::solve;
using tests::FreeScene;
using tests::NodeContact;
using tests::Truss;

namespace
{
/// A block of n cells a side above a plane, with a gap that grows with x.
struct Block
{
  explicit Block(int gdim, double friction = 0, double slope = 0.01,
                 double gap = 0.05, mesh::Ranks* ranks = nullptr)
      : scene(make(gdim), ranks), floor(scene.add_contact(friction))
  {
    const int g = gdim;
    for (std::int32_t i = 0; i < scene.truss.num_nodes(); ++i)
      if (scene.truss.x[i * g + g - 1] < 0.01 and scene.owns(i))
      {
        std::array<double, 3> up{};
        up[g - 1] = 1;
        floor->add(scene.place[i], -1, up, gap + slope * scene.truss.x[i * g]);
        slaves.push_back(i);
      }
  }

  static Truss make(int gdim)
  {
    Truss truss{gdim, {}, {}};
    truss.add_block(3, {0, 0, 0}, 1);
    return truss;
  }

  /// All nodes slip along x, by what grows with x, under a pressure.
  void slide(double aside)
  {
    const std::size_t g = scene.truss.gdim;
    for (std::size_t i = 0; i < slaves.size(); ++i)
    {
      floor->kind[i] = law::slip;
      floor->gap[i] = 0;
      floor->traction[i * g + g - 1] = 1;
      floor->traction[i * g] = -aside;
      floor->slip[i * g] = 0.01 + 0.01 * scene.truss.x[slaves[i] * g];
    }
  }

  /// A load on each node.
  std::vector<double> load(std::vector<double> force) const
  {
    return scene.push(0, std::move(force));
  }

  Forces loads(std::vector<double> force) const
  {
    return scene.loads(load(std::move(force)));
  }

  std::set<std::int32_t> nodes(std::int8_t kind) const
  {
    std::set<std::int32_t> found;
    for (std::size_t i = 0; i < slaves.size(); ++i)
      if (floor->kind[i] == kind)
        found.insert(slaves[i]);
    return found;
  }

  FreeScene scene;
  std::shared_ptr<NodeContact> floor;
  std::vector<std::int32_t> slaves; ///< in the truss
};

std::size_t num_springs(const FreeBodies& free)
{
  return std::ranges::count_if(*free.springs(), [](double k) { return k > 0; });
}

double stiffest(const FreeBodies& free)
{
  return std::ranges::max(*free.springs());
}

std::vector<double> down(int gdim, double force = 1)
{
  std::vector<double> load(gdim);
  load.back() = -force;
  return load;
}

TEST_2D_3D(FreeBodies, WithoutALoadSpringsAloneHoldABlock, g)
{
  Block block(g);
  FreeBodies free = block.scene.free_bodies();
  EXPECT_FALSE(free.stabilise(block.loads(down(g)))) << "no step has begun";
  free.begin_step();
  EXPECT_FALSE(free.stabilise(block.loads(down(g, 0))));
  EXPECT_EQ(free.free_modes(), num_modes(g));
  EXPECT_EQ(free.closed_for_balance(), 0);
  EXPECT_FALSE(free.is_unbalanced());
  // As many as modes, and weak
  EXPECT_EQ(num_springs(free), std::size_t(num_modes(g)));
  EXPECT_LE(stiffest(free),
            1e-6 * std::ranges::max(block.scene.bulk->diagonal()));
  free.begin_step();
  EXPECT_FALSE(free.springs());
}

TEST(FreeBodies, ABlockClosesTheNodesThatItMeetsFirst)
{
  // In 2D the nearest node, then the one that turning about it takes down first
  // from where it has come by then
  const auto round = [](Block& block)
  {
    for (std::size_t i = 0; i < block.slaves.size(); ++i)
    {
      const double x
          = block.scene.truss.x[block.slaves[i] * block.scene.truss.gdim];
      block.floor->gap[i] = 0.05 + 0.01 * x * x;
    }
  };
  Block block(2);
  round(block);
  FreeBodies free = block.scene.begun();
  EXPECT_TRUE(free.stabilise(block.loads(down(2))));
  EXPECT_EQ(block.nodes(law::slip), (std::set<std::int32_t>{0, 1}));
  EXPECT_EQ(free.closed_for_balance(), 2);
  EXPECT_EQ(free.free_modes(), 1);
  EXPECT_FALSE(free.is_unbalanced());
  EXPECT_EQ(num_springs(free), 1);
  // In 3D an edge, then all nodes at once, as they are in a plane
  Block solid(3);
  FreeBodies held = solid.scene.begun();
  EXPECT_TRUE(held.stabilise(solid.loads(down(3))));
  EXPECT_EQ(solid.nodes(law::slip).size(), 16u);
  EXPECT_EQ(held.free_modes(), 3);
}

TEST_2D_3D(FreeBodies, NodesThatAreAsNearCloseTogether, g)
{
  Block block(g, 0, 0);
  // But for rounding
  block.floor->gap[1] += 1e-15;
  FreeBodies free = block.scene.begun();
  EXPECT_TRUE(free.stabilise(block.loads(down(g))));
  EXPECT_EQ(free.closed_for_balance(), g == 2 ? 4 : 16);
}

TEST(FreeBodies, NodesThatPenetrateTouchAtOnce)
{
  Block block(2);
  block.floor->gap = {-0.1, -0.05, 1e-3, -0.01};
  FreeBodies free = block.scene.begun();
  EXPECT_TRUE(free.stabilise(block.loads(down(2))));
  EXPECT_EQ(block.nodes(law::slip), (std::set<std::int32_t>{0, 1, 3}));
}

TEST(FreeBodies, NodesThatCannotCloseStayOpen)
{
  Block block(2);
  block.floor->gap[0] = std::nan("");
  block.floor->found.paired[3] = 0;
  FreeBodies free = block.scene.begun();
  free.stabilise(block.loads(down(2)));
  EXPECT_EQ(block.nodes(law::slip), (std::set<std::int32_t>{1, 2}));
}

TEST(FreeBodies, APullThatNothingBalancesIsFound)
{
  for (const int g : {2, 3})
  {
    Block block(g);
    FreeBodies free = block.scene.begun();
    EXPECT_FALSE(free.stabilise(block.loads(down(g, -1))));
    EXPECT_TRUE(free.is_unbalanced());
    EXPECT_EQ(free.free_modes(), num_modes(g));
    EXPECT_EQ(num_springs(free), std::size_t(num_modes(g)));
    // A load that comes back to nothing
    EXPECT_FALSE(free.stabilise(block.loads(down(g, 0))));
    EXPECT_FALSE(free.is_unbalanced());
  }
  // A push aside that no friction holds
  Block block(2, 0, 0, 0);
  FreeBodies free = block.scene.begun();
  EXPECT_TRUE(free.stabilise(block.loads({0.1, -1})));
  EXPECT_TRUE(free.is_unbalanced());
  EXPECT_EQ(free.free_modes(), 1);
  // Forces below one in a million of the problem's count for nothing
  Block light(2);
  FreeBodies still = light.scene.begun();
  EXPECT_FALSE(still.stabilise(light.loads(down(2, -0.9e-6 / 16))));
  EXPECT_FALSE(still.is_unbalanced());
  EXPECT_FALSE(still.stabilise(light.loads(down(2, -1.1e-6 / 16))));
  EXPECT_TRUE(still.is_unbalanced());
}

/// Two blocks on each other above a plane, each nearest node to node.
struct Tower
{
  explicit Tower(int gdim, double between, double below)
      : scene(make(gdim)), upper(scene.add_contact()),
        lower(scene.add_contact())
  {
    const int g = gdim;
    std::array<double, 3> up{};
    up[g - 1] = 1;
    const int n = scene.truss.num_nodes() / 2;
    for (std::int32_t i = 0; i < n; ++i)
    {
      if (scene.truss.x[i * g + g - 1] == 0)
      {
        lower->add(i, -1, up, below);
        upper->add(n + i, i + n - (g == 2 ? 3 : 9), up, between);
      }
    }
  }

  static Truss make(int gdim)
  {
    Truss truss{gdim, {}, {}};
    truss.add_block(2, {0, 0, 0}, 1);
    std::array<double, 3> above{};
    above[gdim - 1] = 1;
    truss.add_block(2, above, 1);
    return truss;
  }

  FreeScene scene;
  std::shared_ptr<NodeContact> upper, lower;
};

TEST(FreeBodies, ForcesInsideTheConesBalanceABlockOrNot)
{
  const auto balances = [](int g, double friction, std::vector<double> push,
                           mesh::Ranks* ranks = nullptr, double reach = 1)
  {
    Block block(g, friction, 0.01, 0.05, ranks);
    push.resize(g);
    push.back() = -1;
    const FreeBodies free = block.scene.begun();
    return free.may_balance(block.loads(push), reach);
  };
  for (const int g : {2, 3})
  {
    // It slides beyond 0.5, and tips over its edge beyond 1
    EXPECT_TRUE(balances(g, 0.5, {0.49}));
    EXPECT_FALSE(balances(g, 0.5, {0.51}));
    EXPECT_TRUE(balances(g, 2, {-0.99}));
    EXPECT_FALSE(balances(g, 2, {-1.01}));
    EXPECT_TRUE(balances(g, 0, {}));
    EXPECT_FALSE(balances(g, 0, {0.01}));
    // Gaps are 0.05 on one side and 0.06 on the other
    EXPECT_FALSE(balances(g, 0.5, {}, nullptr, 0.049));
    EXPECT_FALSE(balances(g, 0.5, {}, nullptr, 0.055));
    EXPECT_TRUE(balances(g, 0.5, {}, nullptr, 0.061));
  }
  // The cone is round
  EXPECT_TRUE(balances(3, 0.5, {0.35, 0.35}));
  EXPECT_FALSE(balances(3, 0.5, {0.36, 0.36}));
  on_ranks(2,
           [&](mesh::Ranks& ranks)
           {
             EXPECT_TRUE(balances(3, 0.5, {0.49}, &ranks));
             EXPECT_FALSE(balances(3, 0.5, {0.51}, &ranks));
           });
}

TEST(FreeBodies, ATowerOfTwoBlocksComesToRest)
{
  for (const int g : {2, 3})
    for (const double between : {0.0, 0.1})
    {
      // The load is on the upper one alone, and goes through the lower one
      Tower tower(g, between, 0.3);
      const int n = tower.scene.truss.num_nodes() / 2;
      FreeBodies free = tower.scene.begun();
      EXPECT_TRUE(
          free.stabilise(tower.scene.loads(tower.scene.push(n, down(g)))));
      EXPECT_FALSE(free.is_unbalanced());
      for (const auto& contact : {tower.upper, tower.lower})
        EXPECT_EQ(std::ranges::count(contact->kind, law::slip), g == 2 ? 3 : 9);
      // Each slides, and turns about the height
      EXPECT_EQ(free.free_modes(), 2 * (g == 2 ? 1 : 3));
      EXPECT_EQ(num_springs(free), std::size_t(free.free_modes()));
    }
  // Loads that pull them apart
  Tower tower(2, 0, 0);
  std::vector<double> load = tower.scene.push(0, down(2));
  for (std::size_t i = load.size() / 2; i < load.size(); ++i)
    load[i] *= -1;
  FreeBodies free = tower.scene.begun();
  EXPECT_TRUE(free.stabilise(tower.scene.loads(load)));
  EXPECT_TRUE(free.is_unbalanced());
  EXPECT_EQ(std::ranges::count(tower.lower->kind, law::slip), 3);
  EXPECT_EQ(std::ranges::count(tower.upper->kind, law::slip), 0);
}

TEST(FreeBodies, ABlockSticksFirstWhereSlipReverses)
{
  for (const int g : {2, 3})
  {
    // Pushed back where it slips along x: the least slip is at the smallest x
    Block block(g, 0.3);
    block.slide(0.02);
    FreeBodies free = block.scene.begun();
    std::vector<double> back(g);
    back[0] = -0.01;
    EXPECT_TRUE(free.stabilise(block.loads(back)));
    EXPECT_EQ(free.closed_for_balance(), 0);
    EXPECT_EQ(free.free_modes(), 0);
    EXPECT_FALSE(free.springs());
    const std::set<std::int32_t> first
        = g == 2 ? std::set<std::int32_t>{0}
                 : std::set<std::int32_t>{0, 4, 8, 12};
    EXPECT_EQ(block.nodes(law::stick), first);
    // With the traction of slip, on the cone
    for (std::size_t i = 0; i < block.slaves.size(); ++i)
    {
      const bool sticks = block.floor->kind[i] == law::stick;
      EXPECT_NEAR(block.floor->traction[i * g], sticks ? -0.3 : -0.02, 1e-15);
      EXPECT_EQ(block.floor->traction[i * g + g - 1], 1);
    }
  }
  // Without a bound of friction nothing sticks
  Block bare(2, 0.3);
  bare.slide(0.02);
  bare.floor->traction[0] = bare.floor->traction[1] = 0;
  bare.floor->gap[0] = -0.1;
  FreeBodies next = bare.scene.begun();
  EXPECT_TRUE(next.stabilise(bare.loads({-0.01, 0})));
  EXPECT_EQ(bare.nodes(law::stick), std::set<std::int32_t>{1});
  // A push on along the slip reverses nothing
  Block block(2, 0.3);
  block.slide(0.02);
  FreeBodies free = block.scene.begun();
  EXPECT_FALSE(free.stabilise(block.loads({0.5, 0})));
  EXPECT_TRUE(free.is_unbalanced());
}

TEST(FreeBodies, WhatSlipLacksToTheConeCountsInTheBalance)
{
  // Four nodes of area 0.1 push back by 0.3 - 0.02 more than their tractions
  const double whole = 4 * 0.1 * (0.3 - 0.02) / 16;
  for (const double part : {1.0, 0.9})
  {
    Block block(2, 0.3);
    block.slide(0.02);
    // The moment of the load about the floor goes to pressures
    FreeBodies free = block.scene.begun();
    EXPECT_EQ(free.stabilise(block.loads({part * whole, 0})), part < 1);
    EXPECT_FALSE(free.is_unbalanced());
    EXPECT_EQ(free.free_modes(), part < 1 ? 0 : 1);
  }
}

TEST(FreeBodies, In3DTractionsOfTheIterateCountAlone)
{
  Block block(3, 0.3);
  block.slide(0.02);
  FreeBodies free = block.scene.begun();
  const double whole = 16 * 0.1 * (0.3 - 0.02) / 64;
  EXPECT_FALSE(free.stabilise(block.loads({whole, 0, 0})));
  EXPECT_TRUE(free.is_unbalanced());
}

/// A disc on a plane, with the lowest node of its rim closed.
struct Disc
{
  Disc() : scene(make()), floor(scene.add_contact())
  {
    for (std::int32_t i = 1; i < scene.truss.num_nodes(); ++i)
      floor->add(i, -1, {0, 1, 0}, scene.truss.x[2 * i + 1]);
  }

  static Truss make()
  {
    Truss truss{2, {}, {}};
    truss.add_disc(12, {0, 1}, 1);
    return truss;
  }

  FreeScene scene;
  std::shared_ptr<NodeContact> floor;
};

TEST(FreeBodies, SpringsOfADiscThatMayRollCarryNoForce)
{
  Disc disc;
  FreeBodies free = disc.scene.begun();
  // Its middle is pressed down
  std::vector<double> load(26);
  load[1] = -1;
  EXPECT_TRUE(free.stabilise(disc.scene.loads(load)));
  EXPECT_EQ(std::ranges::count(disc.floor->kind, law::slip), 1);
  EXPECT_EQ(disc.floor->kind[0], law::slip);
  EXPECT_EQ(free.free_modes(), 2);
  EXPECT_EQ(num_springs(free), 2);
  // What the step solves: bars and springs, the closed node held along y
  Eigen::MatrixXd K(26, 26);
  std::vector<double> unit(26);
  for (std::size_t j = 0; j < 26; ++j)
  {
    unit[j] = 1;
    K.col(j) = math::column(disc.scene.bulk->product(unit));
    K(j, j) += (*free.springs())[j];
    unit[j] = 0;
  }
  for (std::size_t j = 0; j < 26; ++j)
    K(3, j) = K(j, 3) = j == 3;
  const std::vector<double> u = tests::solution(K, load);
  EXPECT_LT(u[1], -0.1);
  for (std::size_t i = 0; i < 26; ++i)
    EXPECT_NEAR((*free.springs())[i] * u[i], 0, 1e-9);
}

TEST(FreeBodies, ADiscThatIsTurnedIsUnbalanced)
{
  // It has one node alone that can touch
  Disc disc;
  disc.floor->found.paired.assign(12, 0);
  disc.floor->found.paired[0] = 1;
  FreeBodies free = disc.scene.begun();
  std::vector<double> load(26);
  load[1] = -1;
  // A pair of forces at the rim
  load[2] = -0.1;
  load[2 * 7] = 0.1;
  free.stabilise(disc.scene.loads(load));
  EXPECT_TRUE(free.is_unbalanced());
}

TEST(FreeBodies, ABlockOnWeakSpringsDoesNotPassThroughThePlane)
{
  for (const double k : {1e-3, 1e-6, 1e-9})
    for (const bool meets : {true, false})
    {
      Block block(2);
      for (double& spring : block.scene.bulk->ground)
        spring = k;
      FreeBodies free = block.scene.begun();
      // The springs let the load move it by more than the gap, or by less
      const double force = k * 0.05 * (meets ? 1.01 : 0.99);
      EXPECT_EQ(free.stabilise(block.loads(down(2, force))), meets);
      EXPECT_EQ(block.nodes(law::slip).contains(0), meets);
      // What the springs hold needs no others
      EXPECT_EQ(free.free_modes(), 0);
      EXPECT_FALSE(free.springs());
      // Later iterates are Newton's
      block.floor->kind[0] = law::open;
      EXPECT_FALSE(free.stabilise(block.loads(down(2, 10 * k))));
    }
}

TEST_2D_3D(FreeBodies, DriftIsTheRigidPartOfAStep, g)
{
  Block block(g, 0, 0, 0);
  FreeBodies free = block.scene.free_bodies();
  EXPECT_FALSE(free.drift());
  free.begin_step();
  free.stabilise(block.loads(down(g)));
  // It slides along, and the plane keeps it from what is not free
  auto& u = *block.scene.bulk->u;
  const auto drift = [&](auto way)
  {
    for (std::size_t i = 0; i < u.size(); ++i)
      u[i] = way(i);
    return free.drift().value();
  };
  const std::size_t last = g - 1;
  auto found = drift([g](std::size_t i) { return i % g == 0 ? 0.3 : 0; });
  tests::expect_near(found, u, 1e-13);
  found = drift([&](std::size_t i) { return i % g == last ? 0.3 : 0; });
  tests::expect_near(found, std::vector<double>(u.size()), 1e-13);
  // What is left of any step has no part along the motions
  found = drift([](std::size_t i) { return std::sin(double(3 * i)); });
  double along = 0, moved = 0;
  for (std::size_t i = 0; i < u.size(); i += g)
  {
    along += u[i] - found[i];
    moved += found[i];
  }
  EXPECT_NEAR(along, 0, 1e-12);
  EXPECT_GT(std::abs(moved), 1e-3);
}

TEST(FreeBodies, NothingDriftsWhereFrictionOrForcesAskForAMotion)
{
  Block rough(2, 0.3, 0, 0);
  FreeBodies free = rough.scene.begun();
  free.stabilise(rough.loads({0, 0}));
  EXPECT_EQ(free.free_modes(), 3);
  EXPECT_FALSE(free.drift());
  Block pulled(2);
  FreeBodies away = pulled.scene.begun();
  away.stabilise(pulled.loads({0, 1}));
  EXPECT_TRUE(away.is_unbalanced());
  EXPECT_FALSE(away.drift());
}

TEST(FreeBodies, WhatOnlyCornersResistIsHeld)
{
  for (const double friction : {0.0, 0.3})
    for (const double pull : {0.001, 0.1})
    {
      Block block(2, friction, 0, 0);
      auto& normals = block.floor->found.normals;
      for (std::size_t i = 0; i < block.slaves.size(); ++i)
      {
        block.floor->kind[i] = law::slip;
        normals[3 * i] = i % 2 == 0 ? 1e-3 : -1e-3;
      }
      FreeBodies free = block.scene.begun();
      const auto stabilise = [&]
      {
        free.stabilise(
            block.scene.loads(block.load({pull, 0}), block.load({0, -1})));
      };
      // Contact bears the weight, and is pulled along the floor
      stabilise();
      EXPECT_FALSE(free.held());
      const std::vector<double> near = block.load({0.09, 0}),
                                far = block.load({0.2, 0});
      EXPECT_FALSE(free.runs_along(near));
      const bool is_held = friction == 0 and pull < 0.01;
      EXPECT_EQ(free.runs_along(far), is_held);
      if (not is_held)
        continue;
      free.hold();
      ASSERT_TRUE(free.held());
      EXPECT_EQ(num_springs(free), 1u);
      EXPECT_GE(stiffest(free), 1);
      EXPECT_EQ(free.free_modes(), 1);
      std::vector<double> residual = block.load({pull, 0});
      free.held()->take_off(residual);
      double along = 0;
      for (std::size_t i = 0; i < residual.size(); i += 2)
        along += residual[i];
      // The motion has a part across the floor, of the normals
      const auto size = double(residual.size()) / 2;
      EXPECT_NEAR(along, 0, 1e-3 * pull * size);
      // Of nodes with a force along the floor and one across
      EXPECT_NEAR(free.held_force(), pull * std::sqrt(size),
                  1e-3 * pull * size);
      // It lasts, until the bodies are let go, once
      stabilise();
      free.held()->take_off(residual = block.load({pull, 0}));
      EXPECT_TRUE(free.let_go());
      stabilise();
      EXPECT_FALSE(free.held());
      EXPECT_TRUE(free.runs_along(far));
      free.hold();
      free.held()->take_off(residual = block.load({pull, 0}));
      EXPECT_FALSE(free.let_go());
    }
}

TEST(FreeBodies, ABodyThatIsPenetratedGivesWayToTheNextOne)
{
  for (const double clearance : {0.03, 0.06})
  {
    Block block(2, 0, 0, -0.05);
    std::ranges::fill(block.floor->kind, law::slip);
    const auto ceiling = block.scene.add_contact();
    for (std::int32_t i = 0; i < block.scene.truss.num_nodes(); ++i)
      if (block.scene.truss.x[2 * i + 1] > 0.99)
        ceiling->add(i, -1, {0, -1, 0}, clearance);
    FreeBodies free = block.scene.begun();
    const Forces none = block.loads({0, 0});
    free.stabilise(none);
    EXPECT_EQ(std::ranges::count(ceiling->kind, law::open),
              std::ssize(ceiling->kind));
    // Springs of as many nodes below and above let it rise by 0.04
    EXPECT_EQ(free.stabilise(none), clearance < 0.04);
    EXPECT_EQ(std::ranges::count(ceiling->kind, law::open),
              clearance < 0.04 ? 0 : std::ssize(ceiling->kind));
  }
}

TEST(FreeBodies, BodiesThatNoForceActsOnGetOutOfWhatPenetratesThem)
{
  for (const int g : {2, 3})
  {
    Block block(g, 0.3, 0.02, -0.05);
    FreeBodies free = block.scene.begun();
    const auto found = free.escape(block.loads(std::vector<double>(g)), true);
    ASSERT_TRUE(found);
    EXPECT_DOUBLE_EQ(found->depth, 0.05);
    // The gap grows by 0.02 along x, so that it turns; nothing is closed
    for (std::size_t i = 0; i < block.slaves.size(); ++i)
    {
      const double x = block.scene.truss.x[block.slaves[i] * g];
      EXPECT_NEAR(found->increment[block.slaves[i] * g + g - 1],
                  0.05 - 0.02 * x, 2e-4);
      EXPECT_EQ(block.floor->kind[i], law::open);
    }
    // A force on it is for contact to balance
    EXPECT_FALSE(free.escape(block.loads(down(g)), true));
  }
  // What only touches stays
  Block resting(2, 0, 0, 0);
  FreeBodies free = resting.scene.begun();
  EXPECT_FALSE(free.escape(resting.loads({0, 0}), true));
  // and once bodies go they leave a gap
  const auto found = free.escape(resting.loads({0, 0}), false);
  ASSERT_TRUE(found);
  EXPECT_NEAR(found->increment[1], found->depth, 1e-3 * found->depth);
  EXPECT_LT(found->depth, 1e-8);
}

TEST(FreeBodies, WhereAllIsLinearMotionsAreAboutTheReference)
{
  // Turned by a right angle, a block rolls off its nodes as they are now
  for (const bool small : {true, false})
  {
    Block block(2, 0, 0, 0);
    block.scene.bulk->linear = true;
    block.floor->small = small;
    FreeBodies free = block.scene.begun();
    const auto& x = block.scene.truss.x;
    auto& u = *block.scene.bulk->u;
    for (std::size_t i = 0; i < u.size(); i += 2)
    {
      u[i] = -x[i + 1] - x[i];
      u[i + 1] = x[i] - x[i + 1];
    }
    // Pressed at the node at the far end of the floor
    std::vector<double> load(u.size());
    load[2 * 3 + 1] = -1;
    free.stabilise(block.scene.loads(load));
    // The nodes are above each other now: none holds it against turning
    EXPECT_EQ(free.free_modes(), small ? 1 : 2);
  }
}

TEST(FreeBodies, NoDecisionDependsOnTheAxes)
{
  const double c = std::cos(0.7), s = std::sin(0.7);
  Block block(2);
  Truss truss = block.scene.truss;
  for (std::size_t i = 0; i < truss.x.size(); i += 2)
  {
    const double x = truss.x[i], y = truss.x[i + 1];
    truss.x[i] = c * x - s * y;
    truss.x[i + 1] = s * x + c * y;
  }
  FreeScene scene(truss);
  const auto slope = scene.add_contact();
  for (int i = 0; i < 4; ++i)
    slope->add(i, -1, {-s, c, 0}, 0.05 + 0.01 * i / 3);
  FreeBodies straight = block.scene.begun(), skew = scene.begun();
  straight.stabilise(block.loads({0, -1}));
  skew.stabilise(scene.loads(scene.push(0, {s, -c})));
  EXPECT_EQ(slope->kind, block.floor->kind);
  EXPECT_EQ(skew.free_modes(), straight.free_modes());
}

TEST(FreeBodies, OnSeveralRanksTheyAreThoseOfOne)
{
  struct Outcome
  {
    bool changed = false, unbalanced = false;
    std::int64_t free = 0, closed = 0;
    std::map<std::int32_t, std::int8_t> status;
    std::vector<double> springs;
    bool operator==(const Outcome&) const = default;
  };
  struct Case
  {
    double friction, slope;
    std::vector<double> load;
  };
  for (const int g : {2, 3})
    for (const Case& c : {Case{0, 0.01, down(g, 0)}, Case{0, 0.01, down(g)},
                          Case{0, 0, down(g)}, Case{0, 0.01, down(g, -1)},
                          Case{0.3, 0.01, std::vector{-0.01, 0.0, 0.0}}})
    {
      const auto run = [&](mesh::Ranks* ranks)
      {
        Block block(g, c.friction, c.slope, 0.05, ranks);
        if (c.friction > 0)
          block.slide(0.02);
        FreeBodies free = block.scene.begun();
        Outcome outcome;
        std::vector<double> force = c.load;
        force.resize(g);
        outcome.changed = free.stabilise(block.loads(force));
        outcome.unbalanced = free.is_unbalanced();
        outcome.free = free.free_modes();
        outcome.closed = free.closed_for_balance();
        for (std::size_t i = 0; i < block.slaves.size(); ++i)
          outcome.status[block.slaves[i]] = block.floor->kind[i];
        const std::size_t n = block.scene.truss.x.size();
        if (free.springs())
        {
          outcome.springs.resize(n);
          std::vector<double>& springs = outcome.springs;
          for (std::int32_t i = 0; i < block.scene.num_owned; ++i)
            for (int k = 0; k < g; ++k)
              springs[block.scene.number[i] * g + k]
                  = (*free.springs())[i * g + k];
          if (ranks)
            ranks->reduce(std::span(springs), mesh::Reduction::sum);
        }
        const auto drift = free.drift();
        EXPECT_EQ(drift.has_value(), outcome.free > 0 and c.friction == 0
                                         and not outcome.unbalanced);
        return outcome;
      };
      const Outcome one = run(nullptr);
      for (const int size : {2, 3, 4})
        tests::on_ranks(size,
                        [&](mesh::Ranks& ranks)
                        {
                          Outcome here = run(&ranks);
                          for (const auto& [node, kind] : here.status)
                            EXPECT_EQ(kind, one.status.at(node));
                          here.status = one.status;
                          EXPECT_EQ(here, one);
                        });
    }
}

TEST(FreeBodies, WhatDoesNotFitIsRefused)
{
  Block block(2);
  FreeBodies free = block.scene.begun();
  auto forces = block.loads({0, -1});
  auto few = forces;
  few.residual = [] { return std::vector<double>(3); };
  EXPECT_REFUSED(free.stabilise(few));
  block.floor->found.weights.nodes[0] = 99;
  EXPECT_REFUSED(free.stabilise(forces));
  block.floor->found.weights.nodes[0] = 0;
  block.floor->gap.pop_back();
  EXPECT_REFUSED(free.stabilise(forces));
  block.floor->gap.push_back(0.06);
  EXPECT_TRUE(free.stabilise(forces));
  // A spoilt stiffness leaves the step without modes
  free.reset();
  block.scene.bulk->throws = true;
  EXPECT_THROW(free.begin_step(), std::runtime_error);
  EXPECT_FALSE(free.stabilise(forces));
}

TEST(FreeBodies, TurnsOfABodyThatIsALineAreRefused)
{
  // A bar in space: nothing turns about its own axis
  FreeScene scene(Truss{3, {0, 0, 0, 1, 0, 0}, {0, 1}});
  scene.bulk->linear = true;
  FreeBodies free = scene.begun();
  EXPECT_THROW(free.turned(), std::domain_error);
}
} // namespace
