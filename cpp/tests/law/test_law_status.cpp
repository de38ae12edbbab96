// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#include "node_states.h"
#include "thread_ranks.h"

using namespace contactx;
using namespace contactx::law;
using namespace contactx::tests;

namespace
{
/// Nodes with friction 0.5, upright.
struct FrictionState
{
  explicit FrictionState(int n, int gdim = 3, double mu = 0.5)
      : nodes(n, gdim, true)
  {
    law.set_friction(std::vector<double>(n, mu));
    for (int i = 0; i < n; ++i)
      set_upright(nodes, i, 2, 0, 0, 0);
  }

  int update() { return law.set_status(nodes, ranks); }
  void set(std::size_t i, std::int8_t status, double p, double t, double slip)
  {
    set_upright(nodes, i, p, t, 0, slip);
    nodes.status[i] = status;
  }

  NodeState nodes;
  law::Coulomb law;
  mesh::OneRank ranks;
};

TEST(FrictionlessLaw, ClosesUnderPressureOrPenetration)
{
  NodeState nodes(4, 3, false);
  nodes.multiplier = {1, 0, -1, 1};
  nodes.gap = {0, -0.1, 0, NAN};
  mesh::OneRank ranks;
  const Frictionless law;
  EXPECT_EQ(law.set_status(nodes, ranks), 2);
  EXPECT_EQ(nodes.status, (std::vector<std::int8_t>{slip, slip, open, open}));
  EXPECT_EQ(law.set_status(nodes, ranks), 0);
  // Once closed a node opens without pressure only
  nodes.gap[0] = nodes.gap[1] = 10;
  EXPECT_EQ(law.set_status(nodes, ranks), 1);
  EXPECT_EQ(nodes.status, (std::vector<std::int8_t>{slip, open, open, open}));
}

TEST(FrictionlessLaw, ImmobileAndCededNodesStayOpen)
{
  NodeState nodes(3, 3, false);
  nodes.multiplier = {1, 1, 1};
  nodes.gap = {-1, -1, -1};
  nodes.immobile[0] = nodes.redundant[1] = 1;
  mesh::OneRank ranks;
  EXPECT_EQ(Frictionless().set_status(nodes, ranks), 1);
  EXPECT_EQ(nodes.status, (std::vector<std::int8_t>{open, open, slip}));
}

TEST(CoulombLaw, ChecksItsCoefficients)
{
  law::Coulomb law;
  const NodeState nodes(2, 3, true);
  for (double bad : {-0.5, double(NAN), infinity})
    EXPECT_REFUSED(law.set_friction(std::vector{0.3, bad}));
  EXPECT_REFUSED(law.friction(nodes));
  law.set_friction(std::vector{0.3, 0.4});
  EXPECT_REFUSED(law.set_friction(std::vector{-0.25, 0.4}));
  EXPECT_EQ(law.friction(nodes), (std::vector{0.3, 0.4}));
  EXPECT_EQ(refusal([&] { law.set_friction(std::vector{-0.125, -0.25, 0.3}); }),
            "friction is -0.25: give numbers of at least 0 (manual: "
            "errors/friction-values)");
}

TEST(CoulombLaw, ChecksTheBoundsOfAFunction)
{
  NodeState nodes(2, 3, true);
  mesh::OneRank ranks;
  const auto gives = [&](const law::Bounds& bounds)
  {
    const law::Coulomb law([&](auto, auto) { return bounds; });
    EXPECT_TRUE(law.may_throw());
    law.has_friction(nodes);
    law.set_status(nodes, ranks);
  };
  const std::vector<double> ok{0.0, 0.5};
  EXPECT_NO_THROW(gives({ok, ok, ok}));
  EXPECT_REFUSED(gives({{0.5}, ok, ok}));
  EXPECT_REFUSED(gives({ok, ok, {0, 0, 0}}));
  EXPECT_REFUSED(gives({{0.5, -0.5}, ok, ok}));
  EXPECT_REFUSED(gives({{0.5, NAN}, ok, ok}));
  EXPECT_REFUSED(gives({ok, {0, NAN}, ok}));
  EXPECT_REFUSED(gives({ok, ok, {NAN, 0}}));
}

TEST(CoulombLaw, ABoundOfTrescaDoesNotDependOnThePressure)
{
  const auto tresca = [](std::span<const double> p, auto)
  {
    const std::vector<double> zero(p.size());
    return law::Bounds{std::vector(p.size(), 0.3), zero, zero};
  };
  NodeState nodes(3, 2, true);
  // Pressed by 1 and 100, and pulled sideways by 0.2, 0.4 and 0.2 in the end
  nodes.normal = {0, 1, 0, 1, 0, 1};
  nodes.multiplier = {0.2, 1, 0.4, 100, 0.2, -1};
  std::ranges::fill(nodes.c, 1.0);
  std::ranges::fill(nodes.gap, 0.0);
  const law::Coulomb law(tresca);
  mesh::OneRank ranks;
  EXPECT_EQ(law.has_friction(nodes), (std::vector<std::int8_t>{1, 1, 0}));
  law.set_status(nodes, ranks);
  EXPECT_EQ(nodes.status, (std::vector<std::int8_t>{stick, slip, open}));
}

TEST(CoulombLaw, ASmoothNodeHasNoFriction)
{
  FrictionState a(2);
  a.nodes.frictionless[1] = 1;
  EXPECT_EQ(a.law.friction(a.nodes), (std::vector{0.5, 0.0}));
  EXPECT_EQ(a.update(), 2);
  EXPECT_EQ(a.nodes.status, (std::vector<std::int8_t>{stick, slip}));
}

TEST(CoulombLaw, ImmobileAndCededNodesStayOpen)
{
  FrictionState a(3);
  a.nodes.immobile[0] = a.nodes.redundant[1] = 1;
  EXPECT_EQ(a.update(), 1);
  EXPECT_EQ(a.nodes.status, (std::vector<std::int8_t>{open, open, stick}));
}

TEST(CoulombLaw, OnTheEdgeOfTheConeANodeThatSlipsGoesOn)
{
  // mu p = 1, c = 8. A part of 1e-6 of the pressure is left of the bound by
  // Newton's method
  FrictionState a(6);
  a.set(0, slip, 2, 1.8 - 1e-7, 0.1);
  a.set(1, slip, 2, 1.8 - 1e-5, 0.1);
  a.set(2, stick, 2, 1.8 - 1e-7, 0.1);
  a.set(3, open, 2, 1.8 - 1e-7, 0.1);
  a.set(4, slip, 2, 1 - 1e-7, 0);
  a.set(5, slip, 2, 1 - 1e-5, 0);
  a.update();
  EXPECT_EQ(a.nodes.status,
            (std::vector<std::int8_t>{slip, stick, stick, stick, slip, stick}));
}

TEST(CoulombLaw, TheEdgeIsAsWideAsTheLargestPressureSays)
{
  // What a solve leaves goes with the largest pressure, also of other ranks
  const auto status = [](mesh::Ranks& ranks, double elsewhere)
  {
    FrictionState a(2);
    a.set(0, slip, 2, 1.8 - 1e-3, 0.1);
    a.set(1, stick, elsewhere, 0, 0);
    a.law.set_status(a.nodes, ranks);
    return a.nodes.status[0];
  };
  mesh::OneRank alone;
  EXPECT_EQ(status(alone, 2), stick);
  EXPECT_EQ(status(alone, 2e4), slip);
  for (const double heavy : {2.0, 2e4})
    on_ranks(2,
             [&](mesh::Ranks& ranks)
             {
               EXPECT_EQ(status(ranks, ranks.rank() == 0 ? 2 : heavy),
                         heavy > 2 ? slip : stick);
             });
  // But no node falls short of its bound by more than half of it
  FrictionState a(2);
  a.set(0, slip, 2e-12, 0.49e-12, 0);
  a.set(1, stick, 2, 0, 0);
  a.update();
  EXPECT_EQ(a.nodes.status[0], stick);
}

TEST(CoulombLaw, EveryFourthClosingWithSlipSticks)
{
  FrictionState a(2);
  a.law.set_friction(std::vector{0.5, 0.0});
  for (int k = 0; k < 8; ++k)
  {
    for (std::size_t i : {0, 1})
      a.set(i, open, 2, 4, 0);
    EXPECT_EQ(a.update(), 2);
    EXPECT_EQ(a.nodes.status[0], k % 4 == 3 ? stick : slip) << k;
    EXPECT_EQ(a.nodes.slip_closings[0], k + 1);
    // Nothing sticks without friction
    EXPECT_EQ(a.nodes.status[1], slip);
    EXPECT_EQ(a.nodes.slip_closings[1], 0);
  }
  // One that is closed already does not count
  a.set(0, slip, 2, 4, 0);
  a.nodes.slip_closings[0] = 3;
  a.update();
  EXPECT_EQ(a.nodes.status[0], slip);
  EXPECT_EQ(a.nodes.slip_closings[0], 3);
}

TEST(CoulombLaw, SlipThatTurnsBackSticksFirst)
{
  FrictionState a(1);
  for (int k = 0; k < 4; ++k)
  {
    // mu p = 1, t_hat = 0.5 - 8 * 0.5 against t
    a.set(0, slip, 2, 0.5, 0.5);
    // It counts in the end: the second turn asks for slip
    EXPECT_EQ(a.update(), k % 2 == 0);
    EXPECT_EQ(a.nodes.status[0], k % 2 == 0 ? stick : slip) << k;
    EXPECT_EQ(a.nodes.slip_reversals[0], k + 1);
  }
  // What sticks within the bound has not turned back
  a.nodes.slip_reversals[0] = 1;
  a.set(0, slip, 2, 0.5, 0);
  EXPECT_EQ(a.update(), 1);
  EXPECT_EQ(a.nodes.status[0], stick);
  EXPECT_EQ(a.nodes.slip_reversals[0], 1);
  // mu p_hat = 1.4 where it penetrates
  a.set(0, slip, 2, 1.2, 0);
  a.nodes.gap[0] = -0.1;
  EXPECT_EQ(a.update(), 1);
  EXPECT_EQ(a.nodes.status[0], stick);
  EXPECT_EQ(a.nodes.slip_reversals[0], 1);
  // Nor has what stuck before
  a.set(0, stick, 2, 0.5, 0.5);
  EXPECT_EQ(a.update(), 0);
  EXPECT_EQ(a.nodes.slip_reversals[0], 1);
}

TEST(CoulombLaw, MayTakeASmallerFactorAlongTheSurface)
{
  // mu p = 1, and c = 8: trial friction is 1.1 or 0.9
  for (const double length : {1.1, 0.9})
  {
    FrictionState a(1);
    a.nodes.tangential_ratio = 0.25;
    a.set(0, stick, 2, 0, length / 2);
    a.update();
    EXPECT_EQ(a.nodes.status[0], length > 1 ? slip : stick);
  }
}

TEST(CoulombLaw, ReachesFartherWhereIteratesGoRound)
{
  FrictionState a(1);
  // |t_hat| = 39.5 mu p
  const auto status = [&a]
  {
    a.nodes.slip_reversals[0] = 0;
    a.set(0, slip, 2, 0.5, 5);
    a.update();
    return a.nodes.status[0];
  };
  EXPECT_EQ(status(), slip);
  a.law.allow_any_friction();
  EXPECT_EQ(status(), stick);
  a.law.begin_step();
  EXPECT_EQ(status(), slip);
}

TEST(TiedLaw, TiesWhatHasAPair)
{
  NodeState nodes(4, 2, true);
  nodes.gap = {1, NAN, -1, -1};
  nodes.status[1] = stick;
  nodes.redundant[2] = 1;
  // Its multiplier is another one's matter
  nodes.immobile[3] = 1;
  mesh::OneRank ranks;
  const Tied law;
  EXPECT_EQ(law.set_status(nodes, ranks), 3);
  EXPECT_EQ(nodes.status, (std::vector<std::int8_t>{stick, open, open, stick}));
  EXPECT_EQ(law.set_status(nodes, ranks), 0);
}

TEST(Laws, RefuseOtherMultipliers)
{
  NodeState scalar(1, 3, false), vector(1, 3, true);
  mesh::OneRank ranks;
  law::Coulomb coulomb;
  coulomb.set_friction(std::vector{0.5});
  const Tied tied;
  for (const Law* law : std::initializer_list<const Law*>{&coulomb, &tied})
  {
    EXPECT_TRUE(law->is_vector());
    EXPECT_REFUSED(law->evaluate(scalar));
    EXPECT_REFUSED(law->set_status(scalar, ranks));
  }
  EXPECT_FALSE(Frictionless().is_vector());
  EXPECT_REFUSED(Frictionless().evaluate(vector));
  EXPECT_REFUSED(Frictionless().set_status(vector, ranks));
}
} // namespace
