// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#include "free_bodies_scene.h"
#include "hiding_pairs.h"

using namespace contactx;
using namespace contactx::contact;
using namespace contactx::solve;
using namespace contactx::tests;

namespace
{
/// Bodies of springs, and Newton's method with dense algebra around an active
/// set alone.
struct Springs : SpringBodies
{
  std::shared_ptr<ActiveSet> set;
  Forces none{[] { return std::vector<double>(); },
              [] { return std::vector<double>(); }, [] { return 1.0; }};

  explicit Springs(int dim) : SpringBodies(dim) {}

  template <class M>
  void add(std::shared_ptr<law::Law> law
           = std::make_shared<law::Frictionless>(),
           Sliding sliding = Sliding::finite)
  {
    SpringBodies::add<M>(std::move(law), sliding);
    set = std::make_shared<ActiveSet>(scene.halo, contacts);
  }

  /// Begin a step with factors c of one; the nodes.
  law::NodeState& begin()
  {
    set->begin_step();
    law::NodeState& nodes = *contacts[0]->nodes();
    std::ranges::fill(nodes.c, 1.0);
    set->update(none, true);
    return nodes;
  }

  /// Solve; the number of iterations, or -1.
  int solve()
  {
    const auto system = this->system();
    std::vector<double> compliance(scene.sheets.num_nodes(),
                                   1 / bulk->ground[0]);
    set->begin_step();
    for (const auto& c : contacts)
      c->set_factor(compliance);
    set->update(none, true);
    std::vector<double> b(system->size());
    for (int iteration = 0; iteration < 30; ++iteration)
    {
      system->residual(b);
      while (math::column(b).norm() < 1e-13)
      {
        const auto end = set->may_end(none);
        if (end == ActiveSet::End::solution)
        {
          for (const auto& c : contacts)
            c->accept();
          return iteration;
        }
        if (end == ActiveSet::End::frozen_pair_penetrates)
          return -1;
        system->residual(b);
      }
      set->note(math::column(b).norm());
      go(*system, tests::solution(jacobian(), b));
      set->update(none);
    }
    return -1;
  }
};

template <class>
using ActiveSets = testing::Test;

using Methods = testing::Types<NodeToSurface, SurfaceToSurface>;
TYPED_TEST_SUITE(ActiveSets, Methods);
} // namespace

TYPED_TEST_2D_3D(ActiveSets, TheSolutionIsComplementary, dim)
{
  for (const Sliding sliding : {Sliding::finite, Sliding::small})
  {
    Springs scene(dim);
    scene.template add<TypeParam>(scene.law(0), sliding);
    scene.press(0.09, 0.01);
    const int iterations = scene.solve();
    EXPECT_GT(iterations, 0);
    EXPECT_LE(iterations, 10);
    EXPECT_FALSE(scene.set->is_frozen());
    const law::NodeState& nodes = *scene.contacts[0]->nodes();
    std::int64_t closed = 0;
    for (std::int32_t i = 0; i < nodes.num_nodes(); ++i)
    {
      EXPECT_GE(nodes.gap[i], -1e-12);
      EXPECT_GE(nodes.multiplier[i], -1e-12);
      EXPECT_NEAR(nodes.gap[i] * nodes.multiplier[i], 0, 1e-12);
      closed += nodes.multiplier[i] > 1e-6;
    }
    // Some touch, some do not
    EXPECT_GT(closed, 0);
    EXPECT_LT(closed, nodes.num_nodes());
    EXPECT_EQ(scene.set->num_closed(), closed);
    // Once more from there nothing is left to do
    EXPECT_EQ(scene.solve(), 0);
    EXPECT_EQ(scene.set->changes().status, 0);
  }
}

TYPED_TEST_2D_3D(ActiveSets, FrictionStaysInTheCone, dim)
{
  Springs scene(dim);
  scene.add<TypeParam>(scene.law(0.3));
  scene.press(0.09, 0.0, 0.6);
  ASSERT_GE(scene.solve(), 0);
  // Aside: nodes at the edge slip, those in the middle stick
  scene.press(0.09, 0.008, 0.6);
  ASSERT_GE(scene.solve(), 0);
  const Contact& contact = *scene.contacts[0];
  const law::NodeState& nodes = *contact.nodes();
  int sticking = 0, slipping = 0;
  for (std::int32_t i = 0; i < nodes.num_nodes(); ++i)
  {
    const double p = nodes.pressure(i);
    double t = 0, slip = 0, work = 0;
    for (int k = 0; k < dim; ++k)
    {
      const std::size_t at = std::size_t(dim) * i + k;
      const double along = nodes.multiplier[at] - p * nodes.normal[at];
      t += along * along;
      slip += nodes.slip[at] * nodes.slip[at];
      work += along * nodes.slip[at];
    }
    EXPECT_LE(std::sqrt(t), 0.3 * p + 1e-12);
    if (nodes.status[i] == law::open or p < 1e-6)
      continue;
    if (std::sqrt(t) < 0.3 * p * (1 - 1e-9))
    {
      EXPECT_NEAR(std::sqrt(slip), 0, 1e-12);
      ++sticking;
    }
    else
    {
      // Against the slip
      EXPECT_NEAR(work, -std::sqrt(t * slip), 1e-12);
      ++slipping;
    }
  }
  EXPECT_GT(sticking, 0);
  EXPECT_GT(slipping, 0);
  for (const double d : contact.history()->dissipation())
    EXPECT_GE(d, -1e-15);
}

TEST(ActiveSet, AFarActiveSetFreezesTheKinematics)
{
  Springs scene(3);
  scene.add<NodeToSurface>();
  scene.begin();
  EXPECT_FALSE(scene.set->is_frozen());
  // All nodes close at once
  scene.scene.put_slave(0, -0.1);
  scene.set->update(scene.none);
  EXPECT_EQ(scene.set->changes().status, scene.scene.sheets.num_slaves);
  EXPECT_TRUE(scene.set->is_frozen());
  EXPECT_TRUE(scene.set->is_linear());
  EXPECT_EQ(scene.contacts[0]->kinematics(), Sliding::small);
  // Nothing changes any more: they are of the iterate again
  const auto changes = scene.set->update(scene.none);
  EXPECT_EQ(changes.status, 0);
  EXPECT_FALSE(scene.set->is_frozen());
  EXPECT_EQ(scene.contacts[0]->kinematics(), Sliding::finite);
  // A residual of frozen kinematics is not the true one
  std::ranges::fill(*scene.scene.u, 0.0);
  std::ranges::fill(scene.contacts[0]->nodes()->multiplier, -1.0);
  scene.set->update(scene.none);
  EXPECT_TRUE(scene.set->is_frozen());
}

TEST(ActiveSet, AResidualOfFrozenKinematicsIsAskedForAgain)
{
  Springs scene(2);
  scene.add<NodeToSurface>();
  law::NodeState& nodes = scene.begin();
  EXPECT_EQ(scene.set->may_end(scene.none), ActiveSet::End::solution);
  scene.scene.put_slave(0, -0.1);
  scene.set->update(scene.none);
  ASSERT_TRUE(scene.set->is_frozen());
  // Many open again while frozen, far aside: pairs stay
  scene.scene.put_slave(0.7, 0);
  std::ranges::fill(nodes.multiplier, 0.0);
  const auto facets
      = [&] { return scene.contacts[0]->master()->weights().nodes; };
  const std::vector<std::int32_t> before = facets();
  scene.set->update(scene.none);
  ASSERT_TRUE(scene.set->is_frozen());
  EXPECT_EQ(facets(), before);
  EXPECT_EQ(scene.set->may_end(scene.none), ActiveSet::End::again);
  EXPECT_FALSE(scene.set->is_frozen());
  EXPECT_NE(facets(), before);
  EXPECT_EQ(scene.set->may_end(scene.none), ActiveSet::End::solution);
}

TEST(ActiveSet, KinematicsFreezeWhereMoreThanAFifthChanges)
{
  Springs scene(3);
  scene.add<NodeToSurface>();
  law::NodeState& nodes = *scene.contacts[0]->nodes();
  const std::int32_t n = nodes.num_nodes();
  const auto all_closed = [&]
  {
    std::ranges::fill(*scene.scene.u, 0.0);
    scene.begin();
    std::ranges::fill(nodes.status, law::slip);
    std::ranges::fill(nodes.multiplier, 1.0);
  };
  for (std::int32_t changes = 0; changes <= n; ++changes)
  {
    all_closed();
    std::fill_n(nodes.multiplier.begin(), changes, -1.0);
    EXPECT_EQ(scene.set->update(scene.none).status, changes);
    EXPECT_EQ(scene.set->is_frozen(),
              changes > std::max(1.0, 0.2 * (n - changes)));
  }
  // Or goes to another facet
  all_closed();
  scene.scene.put_slave(0.7, 0);
  const auto found = scene.set->update(scene.none);
  EXPECT_EQ(found.status, 0);
  EXPECT_EQ(found.pairs, n);
  EXPECT_TRUE(scene.set->is_frozen());
}

TEST(ActiveSet, WhatGoesBackAndForthOnAFarActiveSetCountsForNothing)
{
  Springs scene(2);
  scene.add<Hiding>();
  auto& master = dynamic_cast<Hiding&>(*scene.contacts[0]->master());
  scene.begin();
  master.releases = 0;
  scene.scene.put_slave(0, -0.1);
  scene.set->update(scene.none);
  EXPECT_EQ(master.releases, 1);
  // Nor does the residual of those pairs
  EXPECT_EQ(scene.set->may_end(scene.none), ActiveSet::End::again);
  EXPECT_EQ(master.releases, 1);
  EXPECT_EQ(scene.set->may_end(scene.none),
            ActiveSet::End::frozen_pair_penetrates);
}

TEST(ActiveSet, NodesThatCloseForBalanceFreezeTheKinematics)
{
  for (const double load : {0.0, 1.0})
  {
    // A free body above one node in its way
    Truss truss{2, {}, {}};
    truss.add_block(1, {0, 0, 0}, 1);
    FreeScene body(truss);
    body.add_contact()->add(0, -1, {0, 1, 0}, 0.1);
    Springs scene(2);
    scene.add<NodeToSurface>();
    const auto free = std::make_shared<FreeBodies>(body.free_bodies());
    ActiveSet set(scene.scene.halo, scene.contacts, free);
    const Forces forces = body.loads(body.push(0, {0, -load}));
    set.begin_step();
    free->begin_step();
    set.update(forces, true);
    EXPECT_EQ(free->closed_for_balance(), load > 0);
    EXPECT_EQ(set.is_frozen(), load > 0);
  }
}

TEST(ActiveSet, FrozenPairsThatHideAPenetrationAreNoSolution)
{
  Springs scene(2);
  scene.add<Hiding>();
  auto& master = dynamic_cast<Hiding&>(*scene.contacts[0]->master());
  scene.begin();
  // As if the pairs had gone back and forth since
  for (const bool hides : {true, false})
  {
    master.is_frozen = hides;
    EXPECT_EQ(scene.set->may_end(scene.none),
              hides ? ActiveSet::End::frozen_pair_penetrates
                    : ActiveSet::End::solution);
    EXPECT_EQ(scene.set->hidden_gaps(),
              std::vector<double>{hides ? -1e-3 : 0.0});
  }
}

TEST(ActiveSet, ANodeOfTwoContactsLeavesTheOneThatItDoesNotNeed)
{
  // The same surfaces twice: each node would be held twice along one normal
  Springs scene(2);
  scene.add<NodeToSurface>();
  scene.add<NodeToSurface>();
  scene.press(0.09, 0.0);
  EXPECT_GT(scene.solve(), 0);
  Springs alone(2);
  alone.add<NodeToSurface>();
  alone.press(0.09, 0.0);
  EXPECT_GT(alone.solve(), 0);
  expect_near(*scene.scene.u, *alone.scene.u, 1e-13);
  EXPECT_EQ(scene.set->num_closed(), alone.set->num_closed());
  EXPECT_EQ(scene.set->num_corners(), 0);
}

TEST(ActiveSet, OpenNodesLoseTheirPressures)
{
  Springs scene(3);
  scene.add<NodeToSurface>();
  law::NodeState& nodes = scene.begin();
  // Less than the gap of 0.05 asks for, but for one
  std::ranges::fill(nodes.multiplier, 0.03);
  nodes.multiplier[1] = 0.1;
  scene.set->update(scene.none);
  for (std::int32_t i = 0; i < nodes.num_nodes(); ++i)
    EXPECT_EQ(nodes.multiplier[i], i == 1 ? 0.1 : 0);
}

TEST(ActiveSet, SlipTurnsBackFartherWhereIteratesGoRound)
{
  Springs scene(2);
  const std::int32_t n = scene.scene.sheets.num_slaves;
  const auto law = scene.law(0.5);
  scene.add<NodeToSurface>(law);
  scene.set->begin_step();
  law::NodeState& nodes = *scene.contacts[0]->nodes();
  std::ranges::fill(nodes.c, 1.0);
  scene.contacts[0]->update_gap();
  // Trial friction of 39.5 times its bound, against the traction
  const auto status = [&]
  {
    std::ranges::fill(nodes.status, law::slip);
    std::ranges::fill(nodes.slip_reversals, 0);
    for (std::int32_t i = 0; i < n; ++i)
    {
      nodes.multiplier[2 * i] = 0.5;
      nodes.multiplier[2 * i + 1] = 2;
      nodes.gap[i] = 0;
      nodes.slip[2 * i] = 40;
      nodes.slip[2 * i + 1] = 0;
    }
    law->set_status(nodes, scene.scene.halo->ranks());
    return nodes.status;
  };
  EXPECT_EQ(status(), std::vector<std::int8_t>(n, law::slip));
  for (int turn = 0; turn < 2; ++turn)
    for (const std::int8_t s : {law::open, law::slip})
    {
      std::ranges::fill(nodes.status, s);
      scene.set->note(1.0);
    }
  EXPECT_EQ(status(), std::vector<std::int8_t>(n, law::stick));
  EXPECT_GT(scene.set->cycles(), 0);
  EXPECT_TRUE(scene.set->shortens());
  scene.set->begin_step();
  EXPECT_EQ(scene.set->cycles(), 0);
  EXPECT_FALSE(scene.set->shortens());
}
