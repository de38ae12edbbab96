// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#include "expect.h"
#include "saddle.h"
#include <contactx/law/normal.h>

using namespace contactx;
using namespace contactx::condense;
using namespace contactx::tests;
using enum law::Status;

namespace
{
/// Solve with random right-hand sides, whole and without multipliers
void compare(Saddle& saddle, bool holds = false)
{
  const Condensation condensation = saddle.condensed(holds);
  const Column b = saddle.column(saddle.n), d = saddle.column(saddle.m);
  const Column exact = saddle.solve(b, d);
  const Column found = saddle.solve_condensed(condensation, b, d);
  EXPECT_LE(distance(found, exact), 1e-10 * largest(exact));
  // No multiplier is forgotten: each has an equation
  const Column other
      = saddle.solve_condensed(condensation, b, Column(saddle.m, 0));
  EXPECT_GT(distance(other, exact), 1e-3 * largest(exact));
}

std::vector<std::int32_t> along(int gdim, std::vector<std::int32_t> nodes,
                                std::vector<int> axes)
{
  std::vector<std::int32_t> dofs;
  for (const std::int32_t node : nodes)
    for (const int axis : axes)
      dofs.push_back(node * gdim + axis);
  return dofs;
}

/// What a system that cannot be condensed says
std::string reason(const Saddle& saddle)
{
  return refusal<NotCondensable>([&] { saddle.condensed(); });
}

class Eliminated : public testing::TestWithParam<int>
{
protected:
  int gdim = GetParam();
  std::vector<int> axes
      = gdim == 2 ? std::vector{0, 1} : std::vector{0, 1, 2}; ///< all of them
};

INSTANTIATE_TEST_SUITE_P(Dimensions, Eliminated, testing::Values(2, 3));

TEST_P(Eliminated, Frictionless)
{
  for (unsigned seed = 0; seed < 10; ++seed)
  {
    Saddle saddle(gdim, 7, {{{0, 4, 2}, {1, 5, 6}, 1, {slip, open, slip}}}, {},
                  seed);
    compare(saddle);
    EXPECT_FALSE(saddle.condensed().elimination().slips());
    EXPECT_EQ(saddle.condensed().elimination().eliminated().size(), 2u);
  }
}

TEST_P(Eliminated, OpenNodesKeepWhatTheyAreGiven)
{
  Saddle saddle(gdim, 6,
                {{{0, 4}, {1, 5}, gdim, {open, open}}, {{2}, {1}, 1, {open}}},
                {}, 3);
  const Condensation condensation = saddle.condensed();
  EXPECT_TRUE(condensation.elimination().eliminated().empty());
  EXPECT_TRUE(condensation.elimination().recovered().empty());
  compare(saddle);
}

TEST_P(Eliminated, StickingOrTied)
{
  for (unsigned seed = 0; seed < 10; ++seed)
  {
    Saddle saddle(gdim, 7, {{{3, 4, 2}, {1, 5, 6}, gdim, {stick, open, stick}}},
                  {}, seed);
    compare(saddle);
    const Condensation condensation = saddle.condensed();
    const auto& dofs = condensation.elimination().eliminated();
    EXPECT_EQ(dofs.size(), 2u * gdim);
    EXPECT_TRUE(std::ranges::is_sorted(dofs));
  }
}

TEST_P(Eliminated, SlippingWithFriction)
{
  for (unsigned seed = 0; seed < 10; ++seed)
  {
    Saddle saddle(gdim, 7,
                  {{{3, 0, 4, 2}, {1, 5, 6}, gdim, {slip, stick, open, slip}}},
                  {}, seed);
    compare(saddle);
    EXPECT_TRUE(saddle.condensed().elimination().slips());
  }
}

TEST_P(Eliminated, RigidObstacle)
{
  for (const int size : {1, gdim})
  {
    const std::int8_t held = size == 1 ? slip : stick;
    Saddle saddle(gdim, 5, {{{0, 3, 4}, {}, size, {held, slip, open}}}, {}, 7);
    compare(saddle);
  }
}

TEST_P(Eliminated, PrescribedDisplacementsOfSlaveNodesAndMasters)
{
  for (unsigned seed = 0; seed < 10; ++seed)
  {
    const auto fixed = along(gdim, {0, 2, 3}, {int(seed) % gdim});
    Saddle vectors(gdim, 8,
                   {{{0, 2, 3, 7}, {1, 5, 6}, gdim, {slip, stick, open, slip}}},
                   fixed, seed);
    compare(vectors);
    // What round-off leaves of their law is no spring
    EXPECT_FALSE(vectors.condensed().elimination().is_soft());
    Saddle scalars(gdim, 8, {{{0, 2, 3, 7}, {1, 5, 6}, 1, {2, 2, 0, 2}}}, fixed,
                   seed);
    compare(scalars);
    Saddle masters(gdim, 8,
                   {{{0, 2, 3, 7}, {1, 5, 6}, gdim, {slip, stick, open, slip}}},
                   along(gdim, {1, 6}, {0, 1}), seed);
    compare(masters);
  }
}

TEST_P(Eliminated, AllDisplacementsOfASlaveNodePrescribed)
{
  // With friction the law alone gives its traction
  Saddle vectors(gdim, 6, {{{0, 2}, {1, 5}, gdim, {stick, stick}}},
                 along(gdim, {0}, axes), 1);
  compare(vectors);
  Saddle scalars(gdim, 6, {{{0, 2}, {1, 5}, 1, {slip, slip}}},
                 along(gdim, {0}, axes), 1);
  EXPECT_EQ(reason(scalars),
            "all displacements of a slave node are prescribed");
}

TEST_P(Eliminated, SoftNodes)
{
  for (const int size : {1, gdim})
    for (unsigned seed = 0; seed < 10; ++seed)
    {
      const auto held = std::int8_t(size == 1 ? slip : stick);
      Generator random(seed);
      const auto soft = [&] { return std::pow(10, random(-8, 2)); };
      // Nodes 4, 2 and 3 are soft, 6 is not
      Saddle saddle(
          gdim, 10,
          {{{0, 4, 2, 3, 6},
            {1, 5, 7},
            size,
            {open, held, held, held, held},
            {0, soft(), soft(), soft(), 0}}},
          seed % 2 ? along(gdim, {3}, {1}) : std::vector<std::int32_t>(), seed);
      compare(saddle);
      const Condensation condensation = saddle.condensed();
      EXPECT_TRUE(condensation.elimination().is_soft());
      EXPECT_GT(condensation.elimination().springs().size(), 0u);
      EXPECT_EQ(condensation.elimination().eliminated().size(),
                std::size_t(size));
    }
}

TEST_P(Eliminated, SoftNodesFeelTheirNeighbours)
{
  for (const int size : {1, gdim})
    for (unsigned seed = 0; seed < 10; ++seed)
    {
      const auto held = std::int8_t(size == 1 ? slip : stick);
      Generator random(seed);
      const auto soft = [&] { return std::pow(10, random(-8, 2)); };
      // Slave nodes 2 and 4 are masters of the other contact, of which one is
      // soft, too
      Saddle saddle(
          gdim, 9,
          {{{0, 2, 4}, {1, 5}, size, {held, held, held}, {soft(), soft(), 0}},
           {{3, 6}, {2, 4}, size, {held, held}, {soft(), 0}}},
          {}, seed);
      compare(saddle);
      // And one slips
      if (size > 1)
      {
        Saddle slips(gdim, 9,
                     {{{0, 2, 4},
                       {1, 5},
                       size,
                       {stick, stick, slip},
                       {soft(), soft(), 0}},
                      {{3, 6}, {2, 4}, size, {stick, slip}, {soft(), 0}}},
                     {}, seed);
        compare(slips);
      }
    }
}

TEST_P(Eliminated, SoftNodesWithoutADisplacementForThemselves)
{
  // Node 0 is prescribed; node 4 is slave of two contacts along one axis
  Saddle saddle(gdim, 7,
                {{{0, 4}, {1, 5}, 1, {slip, slip}, {0.3, 1e-3}},
                 {{2, 4}, {6}, 1, {slip, slip}, {0.01, 0.2}}},
                along(gdim, {0}, axes), 3);
  compare(saddle);
  EXPECT_EQ(saddle.condensed().elimination().constrained().size(), 2u);
  EXPECT_GT(saddle.condensed().springs().size(), 0u);
}

TEST_P(Eliminated, TwoContacts)
{
  for (unsigned seed = 0; seed < 10; ++seed)
  {
    Saddle saddle(gdim, 10,
                  {{{0, 4, 2}, {1, 5, 6}, gdim, {slip, open, stick}},
                   {{8, 3}, {6, 7, 9}, 1, {slip, slip}}},
                  along(gdim, {0, 8}, {0}), seed);
    compare(saddle);
    // Slave nodes of both, each once and in order
    EXPECT_EQ(saddle.condensed().elimination().slave_dofs().size(), 5u * gdim);
  }
}

TEST_P(Eliminated, ANodeThatIsSlaveInTwoContacts)
{
  for (const int other : {1, gdim})
  {
    const std::int8_t held = other == 1 ? slip : stick;
    Saddle closed(gdim, 6,
                  {{{0, 2}, {1}, gdim, {stick, stick}},
                   {{0, 4}, {5}, other, {held, held}}},
                  {}, 2);
    EXPECT_EQ(reason(closed),
              "a node is slave in several contacts that are closed");
    // One of them may be open
    Saddle half(gdim, 6,
                {{{0, 2}, {1}, gdim, {stick, stick}},
                 {{0, 4}, {5}, other, {open, held}}},
                {}, 2);
    compare(half);
    EXPECT_EQ(half.condensed().elimination().slave_dofs().size(), 3u * gdim);
  }
}

TEST_P(Eliminated, APrescribedDisplacementWithoutALaw)
{
  // The law gives no traction where the slave node is held and sticks
  Saddle saddle(gdim, 5, {{{0, 2}, {1}, gdim, {stick, stick}}},
                along(gdim, {0}, {1}), 5);
  saddle.contacts[0].by_multiplier[gdim + 1] = 0;
  EXPECT_EQ(reason(saddle),
            "a slave node with a prescribed displacement moves its master");
}

TEST_P(Eliminated, MultipliersOfPrescribedDisplacementsMayStayUnknowns)
{
  for (unsigned seed = 0; seed < 10; ++seed)
  {
    // Nodes 0 and 3 stick to what moves; of 2 and 7 the law gives a multiplier
    Saddle saddle(
        gdim, 9, {{{0, 2, 3, 7}, {1, 5, 6}, gdim, {stick, slip, stick, stick}}},
        along(gdim, {0, 2, 3, 7}, {1}), seed);
    for (const int s : {0, 2})
      for (int i = 0; i < gdim; ++i)
        for (int j = 0; j < gdim; ++j)
        {
          const std::size_t first = saddle.n + std::size_t(s) * gdim;
          saddle.contacts[0].by_multiplier[(s * gdim + i) * gdim + j] = 0;
          saddle.contact(first + i, first + j) = 0;
        }
    EXPECT_EQ(reason(saddle),
              "a slave node with a prescribed displacement moves its master");
    const Condensation condensation = saddle.condensed(true);
    EXPECT_EQ(condensation.retained().dofs,
              (std::vector<std::int32_t>{1, 3 * gdim + 1}));
    EXPECT_EQ(condensation.retained().multipliers,
              (std::vector<std::int32_t>{1, 2 * gdim + 1}));
    compare(saddle, true);
  }
}

TEST_P(Eliminated, RetainedMultipliersDoNotDependOnUnits)
{
  // A body a million times as stiff scales their rows and columns as its own
  Saddle saddle(gdim, 9, {{{0, 3}, {1, 5, 6}, gdim, {stick, stick}}},
                along(gdim, {0, 3}, {1}), 4);
  std::ranges::fill(saddle.contacts[0].by_multiplier, 0);
  saddle.contact.bottomRightCorner(2 * gdim, 2 * gdim).setZero();
  const Condensation soft = saddle.condensed(true);
  saddle.bulk *= 1e6;
  const Condensation stiff = saddle.condensed(true);
  ASSERT_EQ(soft.retained().dofs.size(), 2u);
  for (std::size_t i = 0; i < 2; ++i)
  {
    EXPECT_NEAR(stiff.retained().scale[i] / soft.retained().scale[i], 1e6,
                1e-3);
    EXPECT_NEAR(stiff.retained().row_scale[i] / soft.retained().row_scale[i],
                1e6, 1e-3);
  }
}

TEST_P(Eliminated, WhatASingularLawDoesNotGiveMayStayUnknown)
{
  for (unsigned seed = 0; seed < 10; ++seed)
  {
    Saddle saddle(gdim, 7, {{{0, 4}, {1, 2, 3}, gdim, {slip, slip}}},
                  along(gdim, {0}, axes), seed);
    // Singular, but not zero
    for (int j = 0; j < gdim; ++j)
    {
      saddle.contacts[0].by_multiplier[j] = 0;
      saddle.contact(saddle.n, saddle.n + j) = 0;
    }
    EXPECT_NE(reason(saddle), "");
    compare(saddle, true);
    EXPECT_EQ(saddle.condensed(true).retained().dofs.size(), 1u);
  }
}

TEST_P(Eliminated, WhatNoFreeMasterHoldsIsNotHeld)
{
  Saddle saddle(gdim, 5, {{{0}, {1, 2}, gdim, {stick}}},
                along(gdim, {0, 1, 2}, axes), 3);
  saddle.contacts[0].by_multiplier.assign(gdim * gdim, 0);
  EXPECT_THROW(saddle.condensed(true), NotCondensable);
}

TEST_P(Eliminated, ConstraintsThatDoNotHoldTheirNode)
{
  Saddle saddle(gdim, 5, {{{0, 2}, {1}, gdim, {stick, stick}}}, {}, 5);
  for (int j = 0; j < gdim; ++j)
    saddle.contact(saddle.n, j) = 0;
  EXPECT_NE(reason(saddle), "");
}

TEST_P(Eliminated, SurfacesFeelTheirNeighbours)
{
  for (const int size : {1, gdim})
    for (const std::int8_t held : {stick, slip})
      for (unsigned seed = 0; seed < 10; ++seed)
      {
        const std::int8_t status = size == 1 ? std::int8_t(slip) : held;
        Saddle saddle(gdim, 7,
                      {{{0, 4, 2}, {1, 5}, size, {status, status, stick}}}, {},
                      seed);
        // Constraints of node 0 have entries of node 4 and the other way, and
        // a node's own traction is not diagonal
        for (const auto& [own, other] : {std::pair{0, 4}, {4, 0}, {0, 0}})
          for (int k = 0; k < size; ++k)
          {
            const std::size_t row = saddle.n + (own == 0 ? 0 : size) + k;
            for (int i = 0; i < gdim; ++i)
            {
              saddle.contact(row, other * gdim + i) += saddle.random(-1, 1);
              saddle.contact(other * gdim + i, row)
                  += 0.3 * saddle.random(-1, 1);
            }
          }
        compare(saddle);
      }
}

TEST_P(Eliminated, ANodeThatIsSlaveHereAndMasterThere)
{
  for (const int size : {1, gdim})
    for (unsigned seed = 0; seed < 10; ++seed)
    {
      const std::int8_t held = size == 1 ? slip : stick;
      Saddle chain(gdim, 8,
                   {{{0, 2}, {1, 5}, size, {held, slip}},
                    {{3, 4}, {2, 7}, size, {slip, held}}},
                   {}, seed);
      compare(chain);
      // Both ways
      Saddle ring(gdim, 8,
                  {{{0, 2}, {3, 5}, size, {held, slip}},
                   {{3, 4}, {2, 7}, size, {slip, held}}},
                  {}, seed);
      compare(ring);
    }
}

TEST_P(Eliminated, TwoPressuresOnOneNode)
{
  // Each has a displacement of the node for itself, and the other's, too
  Saddle saddle(
      gdim, 6, {{{0, 2}, {1}, 1, {slip, slip}}, {{4, 0}, {5}, 1, {slip, slip}}},
      {}, 3);
  compare(saddle);
}

TEST_P(Eliminated, ArraysThatDoNotFitAreRefused)
{
  const Saddle whole(gdim, 6, {{{0, 2}, {1, 5}, gdim, {stick, slip}}}, {}, 1);
  EXPECT_NO_THROW(whole.condensed());
  using Spoil = void (*)(Saddle&);
  for (const auto& [name, spoil] :
       std::initializer_list<std::pair<std::string, Spoil>>{
           {"status", [](Saddle& s) { s.contacts[0].status.pop_back(); }},
           {"area", [](Saddle& s) { s.contacts[0].area.push_back(1); }},
           {"normal", [](Saddle& s) { s.contacts[0].normal.pop_back(); }},
           {"by_multiplier",
            [](Saddle& s) { s.contacts[0].by_multiplier.pop_back(); }},
           {"slaves", [](Saddle& s) { s.contacts[0].slaves[1] = 6; }},
           {"size", [](Saddle& s) { s.contacts[0].size = 5 - s.gdim; }},
           {"free", [](Saddle& s) { s.free.pop_back(); }},
           {"gdim", [](Saddle& s) { s.gdim = 4; }}})
  {
    Saddle wrong = whole;
    spoil(wrong);
    const std::string said = refusal([&] { wrong.condensed(); });
    EXPECT_TRUE(said.starts_with(name)) << name << ": " << said;
  }

  const Condensation condensation = whole.condensed();
  Column d(whole.m, 0), u(whole.n, 0), few(1, 0);
  EXPECT_REFUSED(condensation.right_hand_side(few));
  EXPECT_REFUSED(condensation.recover(few, u, u, d));
  // The last row that gives a multiplier is of node 2
  const Column too_few(3 * gdim - 1, 0);
  EXPECT_REFUSED(condensation.recover(d, too_few, u, d));
  EXPECT_REFUSED(condensation.recover(d, u, few, d));
  EXPECT_REFUSED(condensation.recover(d, u, u, few));
}

TEST(Blocks, SortedFromRows)
{
  // Two displacements and two multipliers
  const std::vector<std::int32_t> offsets{0, 3, 4, 6, 7};
  const std::vector<std::int32_t> columns{0, 1, 3, 2, 0, 2, 1};
  const std::vector<double> values{1, 0, 2, 3, 4, 5, 6};
  const Blocks blocks = sorted({offsets, columns, values}, 2);
  const Eigen::MatrixXd S = dense(blocks.stiffness, 2, 2),
                        T = dense(blocks.traction, 2, 2),
                        C = dense(blocks.constraint, 2, 2);
  // Zeros and what joins multipliers are left out
  EXPECT_EQ(blocks.stiffness.size(), 1u);
  EXPECT_EQ(S(0, 0), 1);
  EXPECT_EQ(blocks.traction.size(), 2u);
  EXPECT_EQ(T(0, 1), 2);
  EXPECT_EQ(T(1, 0), 3);
  EXPECT_EQ(blocks.constraint.size(), 2u);
  EXPECT_EQ(C(0, 0), 4);
  EXPECT_EQ(C(1, 1), 6);
}

TEST(Blocks, ArraysThatAreNoMatrixAreRefused)
{
  using Ints = std::vector<std::int32_t>;
  const std::vector<double> values{1, 2}, few{1};
  const auto sort = [](const Ints& offsets, const Ints& columns,
                       const std::vector<double>& of, std::size_t n)
  { sorted({offsets, columns, of}, n); };
  EXPECT_NO_THROW(sort({0, 1, 2}, {0, 1}, values, 1));
  for (const Ints& offsets : {Ints{0, 2, 1}, {1, 1, 2}})
    EXPECT_REFUSED(sort(offsets, {0, 1}, values, 1));
  EXPECT_REFUSED(sort({}, {0, 1}, values, 0));
  for (const Ints& columns : {Ints{0, 2}, {0, -1}})
    EXPECT_REFUSED(sort({0, 1, 2}, columns, values, 1));
  EXPECT_REFUSED(sort({0, 1, 2}, {0, 1}, few, 1));
  EXPECT_REFUSED(sort({0, 1, 2}, {0, 1}, values, 3));
}
} // namespace
