// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#include "node_states.h"
#include "thread_ranks.h"
#include <contactx/law/slip_history.h>

using namespace contactx;
using namespace contactx::law;
using namespace contactx::tests;

namespace
{
using Flags = std::vector<std::int8_t>;
constexpr double nan = std::nan("");

TEST(NodeState, BeginsOpen)
{
  const law::NodeState vector(2, 3, true), scalar(2, 3, false);
  EXPECT_EQ(vector.size(), 3);
  EXPECT_EQ(scalar.size(), 1);
  EXPECT_EQ(vector.by_multiplier.size(), 18u);
  EXPECT_EQ(vector.by_slip.size(), 18u);
  EXPECT_EQ(vector.mobile, std::vector<double>(6, 1.0));
  EXPECT_EQ(scalar.by_multiplier.size(), 2u);
  // Nothing tangential exists
  for (const auto* a : {&scalar.normal, &scalar.slip, &scalar.mobile,
                        &scalar.by_slip, &scalar.by_normal})
    EXPECT_TRUE(a->empty());
  EXPECT_EQ(vector.status, Flags(2, law::open));
  EXPECT_TRUE(std::isnan(vector.gap[1]));
  EXPECT_REFUSED(law::NodeState(-1, 3, true));
  EXPECT_REFUSED(law::NodeState(1, 1, true));
  EXPECT_REFUSED(law::NodeState(1, 4, false));
}

TEST(NodeState, HoldsWhatIsClosedOrWouldBe)
{
  law::NodeState nodes(4, 2, true);
  nodes.status = {law::slip, law::open, law::open, law::open};
  nodes.immobile[1] = nodes.redundant[2] = 1;
  nodes.gap = {1, 2, 3, 4};
  const Flags held{1, 1, 1, 0}, closed{1, 0, 0, 0};
  for (std::size_t i = 0; i < 4; ++i)
  {
    EXPECT_EQ(nodes.is_constrained(i), held[i] == 1);
    EXPECT_EQ(nodes.closed(i), closed[i] == 1);
  }
  EXPECT_EQ(nodes.closable_gap(0), 1);
  EXPECT_TRUE(std::isnan(nodes.closable_gap(1)));
  EXPECT_TRUE(std::isnan(nodes.closable_gap(2)));
  EXPECT_EQ(nodes.closable_gap(3), 4);
}

TEST(NodeState, PressureIsAlongTheNormal)
{
  law::NodeState vector(2, 3, true), scalar(2, 3, false);
  vector.normal = {0, 0, 1, 0.6, 0, 0.8};
  vector.multiplier = {5, 6, 7, 1, 9, 2};
  EXPECT_EQ(vector.pressure(0), 7);
  EXPECT_DOUBLE_EQ(vector.pressure(1), 2.2);
  scalar.multiplier = {3, 4};
  EXPECT_EQ(scalar.pressure(1), 4);
}

TEST(NodeState, ClosesAsTheLawDoes)
{
  Generator random(3);
  law::NodeState nodes(300, 3, false);
  mesh::OneRank ranks;
  randomise(nodes, random);
  for (std::size_t i = 0; i < 300; i += 7)
    nodes.gap[i] = nan;
  for (std::size_t i = 0; i < 300; i += 11)
    nodes.immobile[i] = 1;
  std::vector<bool> closing;
  for (std::size_t i = 0; i < 300; ++i)
    closing.push_back(nodes.closing(i));
  law::Frictionless().set_status(nodes, ranks);
  for (std::size_t i = 0; i < 300; ++i)
    EXPECT_EQ(nodes.closed(i), closing[i]) << i;
}

TEST(NodeState, TouchesUpToATie)
{
  law::NodeState nodes(6, 3, false);
  nodes.gap = {1e-13, -1e-13, 1e-11, nan, 1e-13, -1e-11};
  nodes.multiplier = {0, -1, 0, 0, 0, -1};
  nodes.redundant[4] = 1;
  std::vector<bool> none, touching;
  for (std::size_t i = 0; i < 6; ++i)
  {
    none.push_back(nodes.closing(i));
    touching.push_back(nodes.closing(i, 1e-12));
  }
  EXPECT_EQ(none, std::vector<bool>(6, false));
  EXPECT_EQ(touching, (std::vector{true, true, false, false, false, false}));
}

TEST(NodeState, ClosedNodesStickWhereThereIsFriction)
{
  law::NodeState vector(3, 2, true), scalar(3, 2, false);
  vector.frictionless[2] = 1;
  const std::vector<std::int32_t> which{0, 2};
  vector.close(which);
  scalar.close(which);
  EXPECT_EQ(vector.status, (Flags{law::stick, law::open, law::slip}));
  EXPECT_EQ(scalar.status, (Flags{law::slip, law::open, law::slip}));
  for (std::int32_t bad : {-1, 3})
    EXPECT_REFUSED(vector.close(std::vector<std::int32_t>{1, bad}));
  EXPECT_EQ(vector.status[1], law::open);
}

TEST(NodeState, DropsTheMultipliersOfOpenNodes)
{
  law::NodeState nodes(2, 2, true);
  nodes.multiplier = {1, 2, 3, 4};
  nodes.status[1] = law::slip;
  nodes.drop_open();
  EXPECT_EQ(nodes.multiplier, (std::vector<double>{0, 0, 3, 4}));
}

TEST(NodeState, FactorIsTheStiffnessOverTheArea)
{
  law::NodeState nodes(3, 2, true);
  nodes.area = {2, 1, 4};
  mesh::OneRank ranks;
  nodes.set_factor(ranks, std::vector{0.5, 0.0, 1.0});
  // Where nothing can move the geometric mean of the others: of 1 and 1/4
  EXPECT_DOUBLE_EQ(nodes.c[0], 1);
  EXPECT_DOUBLE_EQ(nodes.c[1], 0.5);
  EXPECT_DOUBLE_EQ(nodes.c[2], 0.25);
  // Of all ranks: the product 64 of another one makes it (1 * 4 * 64)^(1/3)
  on_ranks(2,
           [](mesh::Ranks& two)
           {
             const bool is_first = two.rank() == 0;
             law::NodeState here(is_first ? 3 : 2, 2, true);
             here.area = is_first ? std::vector<double>{2, 1, 4}
                                  : std::vector<double>{32, 1};
             here.set_factor(two, is_first ? std::vector{0.5, 0.0, 1.0}
                                           : std::vector{2.0, 0.0});
             EXPECT_DOUBLE_EQ(here.c[1], 1 / std::cbrt(256.0));
             EXPECT_DOUBLE_EQ(here.c[0], is_first ? 1 : 1.0 / 64);
           });
  nodes.set_factor(ranks, std::vector(3, 0.0));
  EXPECT_EQ(nodes.c, std::vector(3, 1.0));
  EXPECT_REFUSED(nodes.set_factor(ranks, std::vector(2, 1.0)));
}

TEST(TouchingGap, IsThatOfAllRanks)
{
  const std::vector<double> x{0, 1, 2, -1}, other{1, -3, -0.5, 5};
  const double eps = std::numeric_limits<double>::epsilon();
  // The first one with nodes of its own, and without
  for (const std::vector<double>& first : {x, {}})
    on_ranks(2,
             [&](mesh::Ranks& two)
             {
               EXPECT_DOUBLE_EQ(
                   law::touching_gap(two, two.rank() == 0 ? first : other, 2),
                   1e-12 * 8 + 16 * eps * 5);
             });
  mesh::OneRank alone;
  EXPECT_EQ(law::touching_gap(alone, {}, 3), 0);
  EXPECT_REFUSED(law::touching_gap(alone, x, 3));
  EXPECT_REFUSED(law::touching_gap(alone, x, 0));
}

TEST(MeanNormal, HasUnitLengthWithoutDirectionsThatCannotMove)
{
  law::NodeState nodes(4, 3, true, true);
  nodes.normal = {0, 0, 0.5, 0.3, 0, 0.4, 0.1, 0, 0.4, 0, 0, 0};
  // A plane of symmetry across x; one that has all of the normal
  nodes.mobile = {1, 1, 1, 0, 1, 1, 1, 1, 0, 1, 1, 1};
  nodes.normalise();
  const double s = std::sqrt(0.17);
  const std::vector<double> expected{0,       0, 1,       0, 0, 1,
                                     0.1 / s, 0, 0.4 / s, 0, 0, 0};
  expect_near(nodes.normal, expected, 1e-15);
}

TEST(MeanNormal, SlipIsAlongTheSurface)
{
  law::NodeState nodes(2, 3, true, true);
  nodes.normal = {0, 0, 0.5, 0.3, 0, 0.4};
  nodes.slip = {1, 2, 3, 1, 2, 3};
  nodes.mobile[1] = 0;
  nodes.normalise();
  nodes.project(std::vector<double>{0, 0, 0, 0.5, 0, 0});
  // (0.5, 2, 3) - 2.7 (0.6, 0, 0.8)
  expect_near(nodes.slip, {1, 0, 0, -1.12, 2, 0.84}, 1e-15);
  EXPECT_REFUSED(nodes.project(std::vector<double>{1}));
  // Nodes with normals of their own keep what they have
  law::NodeState plain(1, 2, true);
  plain.normal = {0, 0.5};
  plain.slip = {1, 2};
  plain.normalise();
  plain.project(std::vector<double>{3, 4});
  EXPECT_EQ(plain.normal, (std::vector{0, 0.5}));
  EXPECT_EQ(plain.slip, (std::vector<double>{1, 2}));
}

TEST(SlipHistory, AddsLengthsAndWorkOfClosedNodes)
{
  law::NodeState nodes(2, 2, true);
  nodes.area = {2, 2};
  nodes.status[0] = law::slip;
  nodes.slip = {3, 4, 5, 6};
  nodes.multiplier = {-1, -0.5, 7, 8};
  law::SlipHistory history(2, 2);
  history.add(nodes);
  EXPECT_EQ(history.slip(), (std::vector<double>{3, 4, 0, 0}));
  EXPECT_EQ(history.total(), (std::vector<double>{5, 0}));
  EXPECT_EQ(history.dissipation(), (std::vector<double>{10, 0}));
  nodes.slip = {0, -2, 0, 1};
  nodes.multiplier = {0, 0.25, 0, -1};
  nodes.status[1] = law::stick;
  history.add(nodes);
  EXPECT_EQ(history.slip(), nodes.slip);
  EXPECT_EQ(history.total(), (std::vector<double>{7, 1}));
  EXPECT_EQ(history.dissipation(), (std::vector<double>{11, 2}));
}

TEST(SlipHistory, GoesOnFromWhatItGave)
{
  law::NodeState nodes(1, 2, true);
  nodes.area = {1};
  nodes.status[0] = law::slip;
  nodes.slip = {3, 4};
  law::SlipHistory history(1, 2), other(1, 2);
  history.add(nodes);
  other.restore(history.slip(), history.total(), history.dissipation());
  other.add(nodes);
  EXPECT_EQ(other.total()[0], 10);
  EXPECT_REFUSED(other.restore({1}, {1}, {1}));
  EXPECT_EQ(other.slip(), nodes.slip);
  EXPECT_REFUSED(other.add(law::NodeState(2, 2, true)));
  EXPECT_REFUSED(other.add(law::NodeState(1, 2, false)));
}
} // namespace
