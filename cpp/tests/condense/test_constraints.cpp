// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#include "saddle.h"
#include "thread_ranks.h"
#include <contactx/condense/master_springs.h>
#include <contactx/condense/multigrid.h>
#include <contactx/condense/stiff_bodies.h>
#include <contactx/law/normal.h>

using namespace contactx;
using namespace contactx::condense;
using namespace contactx::mesh;
using namespace contactx::tests;
using enum law::Status;

namespace
{
/// One contact without friction whose constraints and forces are the same
Saddle symmetric(int gdim)
{
  Saddle saddle(gdim, 6, {{{0, 2}, {1, 5}, 1, {slip, slip}}}, {}, 6);
  for (std::size_t i = 0; i < saddle.m; ++i)
    for (std::size_t j = 0; j < saddle.n; ++j)
      saddle.contact(saddle.n + i, j) = -3 * saddle.contact(j, saddle.n + i);
  return saddle;
}

TEST_2D_3D(DependentConstraints, ANodeThatIsSlaveHereAndMasterThere, gdim)
{
  for (const int size : {1, gdim})
  {
    const SerialNodes nodes(8);
    const std::int8_t held = size == 1 ? slip : stick;
    const auto found = [&](const Saddle& saddle)
    {
      const DependentConstraints all
          = dependent_constraints(saddle.condensed().elimination(), nodes);
      return std::pair(all.right.size(), all.left.size());
    };
    using Counts = std::pair<std::size_t, std::size_t>;
    Saddle chain(gdim, 8,
                 {{{0, 2}, {1, 5}, size, {held, held}},
                  {{3, 4}, {2, 7}, size, {held, held}}},
                 {}, 3);
    // Of nodes 3 and 4 from node 2, each displacement of it that is
    // eliminated
    const std::size_t count = 2 * size * size;
    EXPECT_EQ(found(chain), Counts(count, count));
    // It is master by its forces alone
    for (std::size_t i = 2 * size; i < chain.m; ++i)
      for (int j = 0; j < gdim; ++j)
        chain.contact(chain.n + i, 2 * gdim + j) = 0;
    EXPECT_EQ(found(chain), Counts(0, count));
    // Open there, or no master there
    Saddle half(gdim, 8,
                {{{0, 2}, {1, 5}, size, {held, open}},
                 {{3, 4}, {2, 7}, size, {held, held}}},
                {}, 3);
    EXPECT_EQ(found(half), Counts(0, 0));
    Saddle apart(gdim, 8,
                 {{{0, 2}, {1, 5}, size, {held, held}},
                  {{3, 4}, {6, 7}, size, {held, held}}},
                 {}, 3);
    EXPECT_EQ(found(apart), Counts(0, 0));
  }
}

TEST(DependentConstraints, TheOtherNodeIsOfAnotherRank)
{
  // The first rank's master node 5 is the other one's first node
  const auto count = [](const std::vector<Contact>& others)
  {
    std::array<std::size_t, 2> found{};
    const auto work = [&](Ranks& ranks)
    {
      const bool is_first = ranks.rank() == 0;
      Saddle saddle
          = is_first
                ? Saddle(3, 6, {{{0, 2}, {1, 5}, 3, {stick, stick}}}, {}, 3)
                : Saddle(3, 8, others, {}, 4);
      const NumberedNodes nodes
          = is_first ? NumberedNodes(ranks, {0, 1, 2, 3, 4, 5}, 5)
                     : NumberedNodes(ranks, {5, 6, 7, 8, 9, 10, 11, 12}, 8);
      const DependentConstraints all
          = dependent_constraints(saddle.condensed().elimination(), nodes);
      EXPECT_EQ(all.right.size(), all.left.size());
      found[ranks.rank()] = all.right.size();
    };
    on_ranks(2, work);
    return found;
  };
  using Counts = std::array<std::size_t, 2>;
  // Slave there or not
  EXPECT_EQ(count({{{0}, {3}, 3, {stick}}}), (Counts{18, 0}));
  EXPECT_EQ(count({{{0}, {3}, 3, {stick}, {0.1}}}), (Counts{18, 0}));
  EXPECT_EQ(count({{{1}, {3}, 3, {stick}}}), (Counts{0, 0}));
  EXPECT_EQ(count({{{1}, {2}, 3, {stick}}, {{2}, {3}, 3, {stick}}}),
            (Counts{0, 9}));
}

TEST(DependentConstraints, MarksReachOtherRanks)
{
  on_ranks(2,
           [](Ranks& ranks)
           {
             const bool is_first = ranks.rank() == 0;
             const NumberedNodes nodes
                 = is_first ? NumberedNodes(ranks, {0, 1, 2}, 2)
                            : NumberedNodes(ranks, {2, 0}, 1);
             using Marks = std::vector<std::int8_t>;
             const auto dofs = is_first ? std::vector<std::int32_t>{1, 2}
                                        : std::vector<std::int32_t>{1};
             EXPECT_EQ(marks(nodes, dofs, 2), is_first
                                                  ? (Marks{0, 1, 1, 0, 0, 1})
                                                  : (Marks{0, 1, 0, 1}));
           });
}

TEST_2D_3D(DependentConstraints, SymmetricWithoutFriction, gdim)
{
  // On both ranks, and on one alone
  for (const bool is_both : {true, false})
    on_ranks(2,
             [=](Ranks& ranks)
             {
               Saddle mine = symmetric(gdim);
               if (ranks.rank() == 1 and not is_both)
                 mine.contact(gdim, mine.n) += 1e-6;
               const std::int64_t first = 6 * ranks.rank();
               const NumberedNodes nodes(ranks,
                                         {first, first + 1, first + 2,
                                          first + 3, first + 4, first + 5},
                                         6);
               EXPECT_EQ(is_symmetric(mine.condensed().elimination(), nodes),
                         is_both);
             });

  Saddle saddle = symmetric(gdim);
  const SerialNodes all(6);
  EXPECT_TRUE(is_symmetric(saddle.condensed().elimination(), all));
  // A master's force, or its part in the constraint, differs
  saddle.contact(gdim, saddle.n) += 1e-6;
  EXPECT_FALSE(is_symmetric(saddle.condensed().elimination(), all));
  saddle = symmetric(gdim);
  saddle.contact(saddle.n + 1, 5 * gdim) = 0;
  EXPECT_FALSE(is_symmetric(saddle.condensed().elimination(), all));
}

TEST(DependentConstraints, NotSymmetricWithFriction)
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
  const Eigen::MatrixXd right
      = Eigen::MatrixXd::Identity(saddle.n, saddle.n)
        + dense(elimination.right(), saddle.n, saddle.n);
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
    const Column u = product(right, v);
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
  EXPECT_REFUSED(bound(elimination, nodes, Column(1, 0)));
}

/// Eigenvalues of a matrix with a diagonal, without some unknowns
Eigen::VectorXd eigenvalues(const Eigen::MatrixXd& A, const Column& diagonal,
                            std::span<const std::int32_t> without)
{
  std::vector<int> left;
  for (int i = 0; i < A.rows(); ++i)
    if (std::ranges::find(without, i) == without.end())
      left.push_back(i);
  Eigen::VectorXd scale(left.size());
  for (std::size_t i = 0; i < left.size(); ++i)
    scale[i] = 1 / std::sqrt(diagonal[left[i]]);
  return Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(
             scale.asDiagonal() * A(left, left) * scale.asDiagonal())
      .eigenvalues();
}

TEST(Multigrid, SpringsAreNeverStiffForTheBulk)
{
  const SerialNodes nodes(8);
  for (const int gdim : {2, 3})
    for (const int size : {1, gdim})
    {
      // With the diagonal that the smoother divides by: the largest eigenvalue
      // of the bulk, and the least one where the nodes are not soft
      double most = 0, least = 0;
      for (const double compliance :
           {0., 1e-8, 1e-6, 1e-4, 1e-2, 1e-1, 1., 10., 100.})
      {
        const auto held = std::int8_t(size == 1 ? slip : stick);
        std::vector<double> each(2, compliance);
        Saddle saddle(gdim, 8, {{{0, 2}, {1, 5}, size, {held, held}, each}}, {},
                      6);
        saddle.make_symmetric();
        const Condensation condensation = saddle.condensed();
        const auto& elimination = condensation.elimination();
        const Saddle::Condensed condensed(saddle, condensation);
        Column D = bound(elimination, nodes, saddle.diagonal());
        const Eigen::MatrixXd springs
            = dense(elimination.springs(), saddle.n, saddle.n);
        for (std::size_t i = 0; i < saddle.n; ++i)
          D[i] += springs.row(i).cwiseAbs().sum();
        const Eigen::VectorXd found
            = eigenvalues(condensed.A, D, elimination.eliminated());
        if (compliance == 0)
        {
          most = eigenvalues(saddle.bulk, saddle.diagonal(), {}).maxCoeff();
          least = found.minCoeff();
        }
        EXPECT_EQ(elimination.is_soft(), compliance > 0);
        EXPECT_LE((condensed.A - condensed.A.transpose()).norm(),
                  1e-10 * condensed.A.norm());
        EXPECT_LE(found.maxCoeff(), std::max(1.0, most) * (1 + 1e-10));
        EXPECT_GE(found.minCoeff(), 0.5 * least) << compliance;
      }
    }
}

TEST(Multigrid, TheBoundAddsWhatOtherRanksHave)
{
  // Node 5 is the other rank's, which has a slave node of its own before it and
  // before node 1
  const std::array<std::vector<std::int64_t>, 2> numbers{
      {{0, 1, 2, 3, 4, 5}, {5, 6, 1}}};
  for (const double compliance : {0., 0.1})
  {
    std::array<Saddle, 2> saddles{
        Saddle(2, 6,
               {{{0, 2}, {1, 5}, 1, {slip, slip}, {compliance, compliance}}},
               {}, 3),
        Saddle(2, 3, {{{1}, {0, 2}, 1, {slip}, {compliance}}}, {}, 4)};
    // What each adds to the unit diagonal
    Column expected(14, 1);
    for (const int r : {0, 1})
    {
      const Condensation condensation = saddles[r].condensed();
      const auto count = static_cast<std::int32_t>(numbers[r].size());
      const Column alone = bound(condensation.elimination(), SerialNodes(count),
                                 Column(2 * count, 1));
      for (std::int32_t i = 0; i < 2 * count; ++i)
      {
        const std::int64_t node = numbers[r][i / 2];
        expected[2 * node + i % 2] += alone[i] - 1;
        // Both have a part in these
        EXPECT_TRUE((node != 1 and node != 5) or alone[i] > 1);
      }
    }
    on_ranks(2,
             [&](Ranks& ranks)
             {
               const int r = ranks.rank();
               const std::int32_t num_owned = r == 0 ? 5 : 2;
               const NumberedNodes nodes(ranks, numbers[r], num_owned);
               const Condensation condensation = saddles[r].condensed();
               const Column both = bound(condensation.elimination(), nodes,
                                         Column(2 * num_owned, 1));
               ASSERT_EQ(std::ssize(both), 2 * num_owned);
               for (std::int32_t i = 0; i < 2 * num_owned; ++i)
                 EXPECT_NEAR(both[i], expected[2 * numbers[r][i / 2] + i % 2],
                             1e-14);
             });
  }
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
    const Eigen::MatrixXd found = dense(springs, 12, 12);
    for (int i = 0; i < 12; ++i)
      for (int j = 0; j < 12; ++j)
      {
        const double own = has_diagonal and i == j ? i % 3 : 0;
        EXPECT_EQ(found(i, j), taken[i] or taken[j] ? 0 : 1 + i + 12 * j + own);
      }
  }
  EXPECT_REFUSED(elastic(elimination, nodes, soft, Column(1, 0)));
}

/// Nodes 0, 1, 2 are slaves, 4, 5, 6 their masters
class MasterSprings : public testing::TestWithParam<int>
{
protected:
  static constexpr std::size_t num_nodes = 8;

  std::size_t n() const { return GetParam() * num_nodes; }

  Saddle saddle(std::vector<std::int8_t> status) const
  {
    return Saddle(GetParam(), num_nodes,
                  {{{0, 1, 2}, {4, 5, 6}, GetParam(), std::move(status)}}, {},
                  4);
  }
};

/// Springs along each axis in all
std::vector<double> sums(const std::vector<double>& springs, int gdim)
{
  std::vector<double> result(gdim, 0);
  for (std::size_t i = 0; i < springs.size(); ++i)
    result[i % gdim] += springs[i];
  return result;
}

TEST_P(MasterSprings, AreInAllThoseOfTheSlaves)
{
  const int gdim = GetParam();
  const Saddle scene = saddle({stick, slip, open});
  const Condensation condensed = scene.condensed();
  std::vector<double> stiffness(n());
  for (std::size_t i = 0; i < n(); ++i)
    stiffness[i] = 1.0 + static_cast<double>(i % 7);
  std::vector<double> area(n(), 0), expected(gdim, 0);
  const Triplets& T = condensed.traction();
  for (std::size_t e = 0; e < T.size(); ++e)
    area[T.rows[e]] += std::abs(T.values[e]);
  // Those of open nodes are no one's
  for (int i = 0; i < 2 * gdim; ++i)
    expected[i % gdim] += stiffness[i] * area[i];
  const std::vector<double> found = master_springs(condensed, stiffness);
  ASSERT_EQ(found.size(), n());
  for (int k = 0; k < gdim; ++k)
    EXPECT_NEAR(sums(found, gdim)[k], expected[k], 1e-12 * expected[k]);
  for (std::size_t i = 0; i < found.size(); ++i)
  {
    EXPECT_GE(found[i], 0);
    const std::size_t node = i / gdim;
    if (node < 4 or node > 6)
    {
      EXPECT_EQ(found[i], 0) << "displacement " << i;
    }
  }
}

TEST_P(MasterSprings, AreNoneWithoutStiffnessAndRefuseWhatDoesNotFit)
{
  const Condensation condensed = saddle({stick, slip, stick}).condensed();
  EXPECT_EQ(master_springs(condensed, std::vector<double>(n(), 0)),
            std::vector<double>(n(), 0));
  EXPECT_REFUSED(master_springs(condensed, std::vector<double>(n() + 1)));
}

INSTANTIATE_TEST_SUITE_P(InSpace, MasterSprings, testing::Values(2, 3));

using Stiff = std::vector<std::int8_t>;

/// Three bodies of four nodes each; the first is slave of the second
class StiffBodies : public testing::Test
{
protected:
  static constexpr int gdim = 3;

  /// Which are stiff, by stiffnesses of the bodies
  Stiff stiff(const std::vector<double>& stiffness, std::int8_t status = stick)
  {
    std::vector<std::int32_t> cells(12);
    for (std::int32_t i = 0; i < 12; ++i)
      cells[i] = i;
    const std::vector<std::int64_t> original(cells.begin(), cells.end());
    const auto nodes = std::make_shared<mesh::SerialNodes>(12);
    const mesh::Bodies bodies(cells, 4, 3, original, nodes);
    const Saddle saddle(
        gdim, 12, {{{0, 1, 2}, {4, 5, 6}, gdim, {status, status, status}}}, {},
        4);
    std::vector<double> diagonal;
    for (std::size_t i = 0; i < saddle.n; ++i)
      diagonal.push_back(stiffness[i / (4 * gdim)]);
    return stiff_bodies(saddle.condensed(), bodies, diagonal);
  }
};

TEST_F(StiffBodies, AreThoseBeyondTheWidestGap)
{
  // A body without contact counts as stiff
  EXPECT_EQ(stiff({1, 1e3, 1}), (Stiff{0, 1, 1}));
  EXPECT_EQ(stiff({1e-9, 1e-6, 1}), (Stiff{0, 1, 1}));
  EXPECT_EQ(stiff({1, 40, 1}), (Stiff{0, 1, 1}));
  // None where bodies are alike, or a stiff body is slave of a soft one
  EXPECT_EQ(stiff({1, 1, 1}), (Stiff{0, 0, 0}));
  EXPECT_EQ(stiff({1, 5, 1e6}), (Stiff{0, 0, 0}));
  EXPECT_EQ(stiff({1e3, 1, 1}), (Stiff{0, 0, 0}));
}

TEST_F(StiffBodies, RefuseADiagonalThatDoesNotFit)
{
  std::vector<std::int32_t> cells{0, 1, 2, 3};
  const std::vector<std::int64_t> original(cells.begin(), cells.end());
  const auto nodes = std::make_shared<mesh::SerialNodes>(4);
  const mesh::Bodies bodies(cells, 4, 1, original, nodes);
  const Saddle saddle(gdim, 4, {{{0}, {1, 2}, gdim, {stick}}}, {}, 4);
  EXPECT_REFUSED(
      stiff_bodies(saddle.condensed(), bodies, std::vector<double>(5)));
}
} // namespace
