// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#include <contactx/condense/multigrid.h>
#include <gtest/gtest.h>

#include "dense.h"

using namespace contactx;
using namespace contactx::condense;
using namespace contactx::parallel;
using namespace contactx::tests;

namespace
{
constexpr std::int8_t open = 0, stick = 1, slip = 2;

/// Two ranks, of which the other one has the largest or the least value
class Two final : public Ranks
{
public:
  int rank() const override { return 0; }
  int size() const override { return 2; }
  void reduce(std::span<double>, Reduction) override {}
  void reduce(std::span<std::int64_t> values, Reduction how) override
  {
    for (std::int64_t& value : values)
      value = how == Reduction::largest ? std::max<std::int64_t>(value, other)
                                        : std::min<std::int64_t>(value, other);
  }
  Messages exchange(const Messages&) override { return {}; }

  std::int64_t other = 0;
};

/// Nodes of one of two ranks: those from `owned` on are the other one's, which
/// marks all of their displacements, or adds one to those of this rank
class Half final : public NodeMap
{
public:
  Half(std::int32_t owned, std::int32_t all) : _owned(owned), _all(all) {}

  Ranks& ranks() const override { return two; }
  std::int32_t num_owned() const override { return _owned; }
  std::int32_t num_nodes() const override { return _all; }
  void forward(std::span<double>, int) const override {}
  void forward(std::span<std::int64_t> values, int width) const override
  {
    for (std::size_t i = _owned * width; i < values.size(); ++i)
      values[i] = is_marked;
  }
  void reverse(std::span<double> values, int width) const override
  {
    for (std::int32_t i = 0; i < _owned * width; ++i)
      values[i] += 1;
  }

  mutable Two two;
  bool is_marked = true;

private:
  std::int32_t _owned, _all;
};

/// One contact without friction whose constraints and forces are the same
Saddle symmetric(int gdim)
{
  Saddle saddle(gdim, 6, {{{0, 2}, {1, 5}, 1, {slip, slip}}}, {}, 6);
  for (std::size_t i = 0; i < saddle.m; ++i)
    for (std::size_t j = 0; j < saddle.n; ++j)
      saddle.contact(saddle.n + i, j) = -3 * saddle.contact(j, saddle.n + i);
  return saddle;
}
} // namespace

TEST(Chains, ANodeThatIsSlaveHereAndMasterThere)
{
  for (const int gdim : {2, 3})
    for (const int size : {1, gdim})
    {
      const SerialNodes nodes(8);
      const std::int8_t held = size == 1 ? slip : stick;
      Saddle chain(gdim, 8,
                   {{{0, 2}, {1, 5}, size, {held, held}},
                    {{3, 4}, {2, 7}, size, {held, held}}},
                   {}, 3);
      EXPECT_THROW(check_chains(chain.condensed().elimination(), nodes),
                   NotCondensable);
      // It is master by its forces alone
      for (std::size_t i = 2 * size; i < chain.m; ++i)
        for (int j = 0; j < gdim; ++j)
          chain.contact(chain.n + i, 2 * gdim + j) = 0;
      EXPECT_THROW(check_chains(chain.condensed().elimination(), nodes),
                   NotCondensable);
      // Open there, or no master there
      Saddle half(gdim, 8,
                  {{{0, 2}, {1, 5}, size, {held, open}},
                   {{3, 4}, {2, 7}, size, {held, held}}},
                  {}, 3);
      EXPECT_NO_THROW(check_chains(half.condensed().elimination(), nodes));
      Saddle apart(gdim, 8,
                   {{{0, 2}, {1, 5}, size, {held, held}},
                    {{3, 4}, {6, 7}, size, {held, held}}},
                   {}, 3);
      EXPECT_NO_THROW(check_chains(apart.condensed().elimination(), nodes));
    }
}

TEST(Chains, TwoPressuresOnOneNode)
{
  // Each has a displacement of the node for itself, and the other's, too
  const SerialNodes nodes(6);
  Saddle saddle(
      3, 6, {{{0, 2}, {1}, 1, {slip, slip}}, {{4, 0}, {5}, 1, {slip, slip}}},
      {}, 3);
  const Condensation condensation = saddle.condensed();
  EXPECT_EQ(condensation.elimination().eliminated(),
            (std::vector<std::int32_t>{0, 1, 7, 12}));
  EXPECT_THROW(check_chains(condensation.elimination(), nodes), NotCondensable);
}

TEST(Chains, TheOtherNodeIsOfAnotherRank)
{
  Saddle saddle(3, 6, {{{0, 2}, {1, 5}, 3, {stick, stick}}}, {}, 3);
  const Condensation condensation = saddle.condensed();
  // Node 5 is another rank's, slave there or not
  Half nodes(5, 6);
  EXPECT_THROW(check_chains(condensation.elimination(), nodes), NotCondensable);
  nodes.is_marked = false;
  EXPECT_NO_THROW(check_chains(condensation.elimination(), nodes));
  // What another rank finds is thrown here
  nodes.two.other = 1;
  EXPECT_THROW(check_chains(condensation.elimination(), nodes), NotCondensable);
}

TEST(Chains, MarksReachOtherRanks)
{
  const Half nodes(2, 3);
  const std::vector<std::int32_t> dofs{1, 2};
  EXPECT_EQ(marks(nodes, dofs, 2),
            (std::vector<std::int8_t>{0, 1, 1, 0, 1, 1}));
  const Contact first{{1}, {}, 1, {slip}}, second{{0, 1}, {}, 1, {slip, slip}};
  const std::vector<Nodes> contacts{first.nodes(), second.nodes()};
  EXPECT_EQ(slave_marks(nodes, contacts),
            (std::vector<std::int8_t>{0, 1, 1, 1, 1, 1}));
}

TEST(Chains, SymmetricWithoutFriction)
{
  for (const int gdim : {2, 3})
  {
    Saddle saddle = symmetric(gdim);
    Half nodes(6, 6);
    nodes.two.other = 1;
    EXPECT_TRUE(is_symmetric(saddle.condensed().elimination(), nodes));
    // Another rank's is not
    nodes.two.other = 0;
    EXPECT_FALSE(is_symmetric(saddle.condensed().elimination(), nodes));

    const SerialNodes all(6);
    EXPECT_TRUE(is_symmetric(saddle.condensed().elimination(), all));
    // A master's force, or its part in the constraint, differs
    saddle.contact(gdim, saddle.n) += 1e-6;
    EXPECT_FALSE(is_symmetric(saddle.condensed().elimination(), all));
    saddle = symmetric(gdim);
    saddle.contact(saddle.n + 1, 5 * gdim) = 0;
    EXPECT_FALSE(is_symmetric(saddle.condensed().elimination(), all));
  }
}

TEST(Chains, NotSymmetricWithFriction)
{
  const SerialNodes nodes(6);
  for (const std::int8_t status : {stick, slip})
  {
    Saddle saddle(3, 6, {{{0, 2}, {1, 5}, 3, {status, status}}}, {}, 6);
    EXPECT_FALSE(is_symmetric(saddle.condensed().elimination(), nodes));
    // On what is rigid stick leaves nothing
    Saddle rigid(3, 6, {{{0, 2}, {}, 3, {status, status}}}, {}, 6);
    EXPECT_EQ(is_symmetric(rigid.condensed().elimination(), nodes),
              status == stick);
  }
}

TEST(Multigrid, TheBoundHoldsForAllDisplacements)
{
  const SerialNodes nodes(8);
  Saddle saddle(
      3, 8,
      {{{0, 2}, {1, 5}, 3, {slip, stick}}, {{3, 4}, {6, 7}, 1, {slip, slip}}},
      {}, 3);
  const Condensation condensation = saddle.condensed();
  const auto& elimination = condensation.elimination();
  Column diagonal(saddle.n);
  for (double& value : diagonal)
    value = saddle.random(0.5, 2);
  const Column D = bound(elimination, nodes, diagonal);
  const Dense right
      = Dense::one(saddle.n) + Dense(elimination.right(), saddle.n, saddle.n);
  // Halves of it are too small for some
  bool is_sharp = false;
  for (int trial = 0; trial < 200; ++trial)
  {
    Column v = saddle.column(saddle.n);
    // Along the row of one eliminated displacement
    if (trial < std::ssize(elimination.eliminated()))
      for (std::size_t j = 0; j < saddle.n; ++j)
        v[j] = right(elimination.eliminated()[trial], j) > 0 ? 1 : -1;
    for (const std::int32_t dof : elimination.eliminated())
      v[dof] = 0;
    const Column u = right * v;
    double energy = 0, most = 0;
    for (std::size_t i = 0; i < saddle.n; ++i)
    {
      energy += diagonal[i] * u[i] * u[i];
      most += D[i] * v[i] * v[i];
    }
    EXPECT_LE(energy, most * (1 + 1e-12));
    is_sharp = is_sharp or energy > 0.5 * most;
  }
  EXPECT_TRUE(is_sharp);
  EXPECT_THROW(bound(elimination, nodes, Column(1, 0)), std::invalid_argument);
}

TEST(Multigrid, TheBoundAddsWhatOtherRanksHave)
{
  Saddle saddle(2, 6, {{{0, 2}, {1, 5}, 1, {slip, slip}}}, {}, 3);
  const Condensation condensation = saddle.condensed();
  const Column diagonal(10, 1), all(12, 1);
  const Column alone = bound(condensation.elimination(), SerialNodes(6), all);
  const Column both = bound(condensation.elimination(), Half(5, 6), diagonal);
  ASSERT_EQ(both.size(), 10u);
  for (std::size_t i = 0; i < 10; ++i)
    EXPECT_NEAR(both[i], alone[i] + 1, 1e-14);
}

TEST(Multigrid, SpringsOfWhatIsNotEliminated)
{
  const SerialNodes nodes(6);
  Saddle saddle(2, 6, {{{0, 2}, {1, 5}, 1, {slip, slip}}}, {}, 3);
  const Condensation condensation = saddle.condensed();
  const auto& elimination = condensation.elimination();
  const auto taken = marks(nodes, elimination.eliminated(), 2);
  Triplets soft;
  Column diagonal(12, 0);
  for (int i = 0; i < 12; ++i)
  {
    diagonal[i] = i % 3;
    for (int j = 0; j < 12; ++j)
      soft.add(i, j, 1 + i + 12 * j);
  }
  for (const bool has_diagonal : {true, false})
  {
    const Triplets springs
        = elastic(elimination, nodes, soft, has_diagonal ? diagonal : Column());
    const Dense found(springs, 12, 12);
    for (int i = 0; i < 12; ++i)
      for (int j = 0; j < 12; ++j)
      {
        const double own = has_diagonal and i == j ? i % 3 : 0;
        EXPECT_EQ(found(i, j), taken[i] or taken[j] ? 0 : 1 + i + 12 * j + own);
      }
  }
  EXPECT_THROW(elastic(elimination, nodes, soft, Column(1, 0)),
               std::invalid_argument);
}
