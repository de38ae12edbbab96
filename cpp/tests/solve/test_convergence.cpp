// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#include "spring_bodies.h"

using namespace contactx;
using namespace contactx::tests;

namespace
{
constexpr double eps = 16 * std::numeric_limits<double>::epsilon();
constexpr double rtol = 1e-10;

/// A row of nodes from 0 to 2 that hang on springs, in 2D. Residuals are what
/// the test says, forces those of loads.
struct Row
{
  WholeMesh mesh;
  std::shared_ptr<std::vector<double>> u;
  std::shared_ptr<mesh::Halo> halo;
  std::shared_ptr<SpringBulk> bulk;
  std::shared_ptr<solve::System> system;
  std::shared_ptr<solve::Convergence> convergence;

  /// The nodes of its cells are two each.
  explicit Row(std::vector<std::int32_t> cells = {0, 1, 1, 2}, int n = 3,
               mesh::Ranks* ranks = nullptr)
      : mesh(n, ranks), u(std::make_shared<std::vector<double>>(2 * n))
  {
    std::vector<double> x(2 * n);
    for (int i = 0; i < n; ++i)
      x[2 * i] = 2.0 * i / (n - 1);
    halo = mesh.halo(x, 2, u);
    bulk = std::make_shared<SpringBulk>(mesh, halo, u, cells, 2);
    make();
  }

  /// Look at the bulk anew.
  void make()
  {
    system = std::make_shared<solve::System>(halo, bulk,
                                             solve::System::Contacts{});
    convergence = std::make_shared<solve::Convergence>(system);
  }

  /// A force on a node.
  double& load(std::int32_t node) { return bulk->load[2 * mesh.place[node]]; }

  /// Displacement of a node.
  double& way(std::int32_t node) { return (*u)[2 * mesh.place[node]]; }

  /// Start a step with a stiffness of each node of the mesh.
  void begin_step(const std::vector<double>& stiffness)
  {
    std::vector<double> here = mesh.here(stiffness, 1);
    here.resize(mesh.num_owned);
    system->begin_step();
    convergence->begin_step(std::move(here));
  }

  /// Compare a residual of nodes of the mesh along the row.
  solve::Convergence::Result compare(const std::vector<double>& residual,
                                     double atol = 0)
  {
    std::vector<double> b(2 * std::size_t(mesh.num_owned));
    for (std::int32_t i = 0; i < mesh.num_owned; ++i)
      b[2 * i] = residual[mesh.number[i]];
    return convergence->compare(b, rtol, atol);
  }

  bool converges(const std::vector<double>& residual)
  {
    const auto found = compare(residual);
    return found.residual <= found.tolerance;
  }
};

/// A row whose middle has been moved by 1 and is stiff.
struct StiffRow : Row
{
  static constexpr double stiff = 1e12, rounding = eps * stiff;

  explicit StiffRow(double force) : Row(std::vector<std::int32_t>())
  {
    way(1) = 1;
    load(0) = force;
    begin_step({1, stiff, 1});
  }
};
} // namespace

TEST(Convergence, IsRelativeToTheForcesOfTheBulk)
{
  Row row;
  row.load(0) = 3;
  row.load(2) = 4;
  row.begin_step({1, 1, 1});
  EXPECT_DOUBLE_EQ(row.convergence->scale(), 5);
  const auto found = row.compare({0.3, 0, 0.4});
  EXPECT_DOUBLE_EQ(found.residual, 0.5);
  EXPECT_DOUBLE_EQ(found.tolerance, 5 * rtol);
  EXPECT_EQ(found.defect, 0);
  EXPECT_DOUBLE_EQ(row.compare({0.3, 0, 0.4}, 1e-3).tolerance, 1e-3);
  EXPECT_TRUE(row.converges({4.9 * rtol, 0, 0}));
  EXPECT_FALSE(row.converges({5.1 * rtol, 0, 0}));
}

TEST(Convergence, UnloadingIsRelativeToTheForcesAtItsStart)
{
  Row row;
  row.load(0) = 5;
  // A spring that takes a part of the load over
  row.bulk->ground[0] = 1;
  row.begin_step({1, 1, 1});
  row.compare({5, 0, 0});
  row.way(0) = 4.875;
  EXPECT_EQ(row.convergence->scale(), 0.125);
  EXPECT_DOUBLE_EQ(row.compare({1, 0, 0}).tolerance, 5 * rtol);
  // Forces that grow count at once
  row.way(0) = 25;
  EXPECT_DOUBLE_EQ(row.compare({1, 0, 0}).tolerance, 20 * rtol);
  // But not those of a step before
  row.way(0) = 4.875;
  row.begin_step({1, 1, 1});
  EXPECT_DOUBLE_EQ(row.compare({1, 0, 0}).tolerance, 0.125 * rtol);
  // What first changes of Dirichlet values ask for says little
  row.begin_step({1, 1, 1});
  EXPECT_DOUBLE_EQ(row.compare({1e6, 0, 0}).tolerance, rtol);
}

TEST(Convergence, TheSameSolveAgainHasNothingToDo)
{
  for (const bool is_same : {true, false})
  {
    Row row;
    row.load(0) = 5;
    row.bulk->ground[0] = 1;
    row.begin_step({1, 1, 1});
    row.compare({5, 0, 0});
    row.way(0) = 4.875;
    row.convergence->accept();
    if (not is_same)
      row.load(2) = 1e-12;
    row.begin_step({1, 1, 1});
    EXPECT_DOUBLE_EQ(row.compare({1e-9, 0, 0}).tolerance,
                     rtol * (is_same ? 5 : 0.125));
  }
}

TEST(Convergence, DirichletDefectsAreNoForces)
{
  Row row;
  row.load(0) = 5;
  row.bulk->fixed[2] = 1;
  row.begin_step({1, 0, 1});
  // Far larger than all forces, of either sign
  const auto found = row.compare({3, -1e6, 4});
  EXPECT_DOUBLE_EQ(found.residual, 5);
  EXPECT_DOUBLE_EQ(found.tolerance, 5 * rtol);
  EXPECT_EQ(found.defect, 1e6);
}

TEST(Convergence, RoundingOfStiffBodiesExcusesNoResidualElsewhere)
{
  StiffRow row(1e5);
  const double part = 0.9 * StiffRow::rounding;
  ASSERT_GT(part, 100 * rtol * 1e5);
  const auto there = row.compare({0, part, 0});
  EXPECT_EQ(there.residual, part);
  EXPECT_NEAR(there.tolerance, StiffRow::rounding, 1e-9 * StiffRow::rounding);
  const auto elsewhere = row.compare({0, 0, part});
  EXPECT_EQ(elsewhere.residual, part);
  EXPECT_DOUBLE_EQ(elsewhere.tolerance, 1e5 * rtol);
  // Nor more than it is
  const auto more = row.compare({0, part, 2e5 * rtol});
  EXPECT_NEAR(more.residual, 2e5 * rtol, 1e-9 * part);
  EXPECT_DOUBLE_EQ(more.tolerance, 1e5 * rtol);
}

TEST(Convergence, RoundingExcusesAMillionthOfTheForcesAtMost)
{
  StiffRow row(1);
  EXPECT_DOUBLE_EQ(row.compare({0, 1.1e-6, 0}).tolerance, 1e-6);
  EXPECT_FALSE(row.converges({0, 1.1e-6, 0}));
  EXPECT_TRUE(row.converges({0, 0.9e-6, 0}));
}

TEST(Convergence, StrainsOfANonlinearBulkHaveTheRoundingOfCells)
{
  for (const bool is_linear : {true, false})
  {
    StiffRow row(1e5);
    row.bulk->linear = is_linear;
    row.bulk->size = {0, 2, 0};
    row.make();
    row.begin_step({1, StiffRow::stiff, 1});
    EXPECT_EQ(row.converges({0, 2.9 * StiffRow::rounding, 0}), not is_linear);
    EXPECT_FALSE(row.converges({0, 3.1 * StiffRow::rounding, 0}));
  }
}

TEST(Convergence, ForcesThatCancelLeaveTheirRounding)
{
  for (const bool cancels : {true, false})
  {
    Row row;
    row.bulk->cell_force = {0, cancels ? 1e3 : 0.0, 0};
    row.load(1) = 1e-20;
    row.begin_step({1, 1, 1});
    EXPECT_EQ(row.bulk->looks, 1);
    EXPECT_EQ(row.converges({0, 0.9 * eps * 1e3, 0}), cancels);
    EXPECT_FALSE(row.converges({0, 1.1 * eps * 1e3, 0}));
    EXPECT_FALSE(row.converges({0.9 * eps * 1e3, 0, 0})) << "elsewhere";
    // Forces on free bodies, too
    EXPECT_NEAR(row.convergence->scale_of_balance(),
                cancels ? 1e6 * eps * 1e3 : 1e-20, 1e-22);
  }
}

TEST(Convergence, ANodeThatStaysHasTheRoundingOfThoseAround)
{
  Row row({0, 1, 1, 2});
  row.way(2) = 1;
  // Two cells with 1 and 0 at the middle node, of which the mean counts
  row.begin_step({1e12, 1e12, 0});
  EXPECT_TRUE(row.converges({0, 0.49 * eps * 1e12, 0}));
  EXPECT_FALSE(row.converges({0, 0.51 * eps * 1e12, 0}));
  EXPECT_FALSE(row.converges({0.49 * eps * 1e12, 0, 0}));
  // The largest of a cell, not their sum
  row.way(1) = 1;
  EXPECT_TRUE(row.converges({0.99 * eps * 1e12, 0, 0}));
  EXPECT_TRUE(row.converges({0, 0.99 * eps * 1e12, 0}));
  EXPECT_FALSE(row.converges({0, 1.01 * eps * 1e12, 0}));
}

TEST(Convergence, CellsAreLookedIntoOnceAStepAtMostAndIfLittleIsLeft)
{
  Row row;
  const double stiff = std::sqrt(3.0), tiny = 1e-8 * stiff * 2;
  row.begin_step({1, 1, 1});
  // No force, no error
  EXPECT_EQ(row.bulk->looks, 0);
  EXPECT_TRUE(row.convergence->may_be_rounding(0.99 * tiny));
  EXPECT_FALSE(row.convergence->may_be_rounding(1.01 * tiny));
  row.compare({0, 0, 0});
  row.compare({1.01 * tiny, 0, 0});
  EXPECT_EQ(row.bulk->looks, 0);
  // A residual that still falls is more than rounding
  row.compare({1e-2 * tiny, 0, 0});
  EXPECT_EQ(row.bulk->looks, 0);
  row.compare({0.2e-2 * tiny, 0, 0});
  EXPECT_EQ(row.bulk->looks, 1);
  row.compare({0.2e-2 * tiny, 0, 0});
  EXPECT_EQ(row.bulk->looks, 1);
  // The next step looks again: at its start if forces are that small
  row.load(0) = 0.99 * tiny;
  row.begin_step({1, 1, 1});
  EXPECT_EQ(row.bulk->looks, 2);
  row.compare({0.5 * tiny, 0, 0});
  EXPECT_EQ(row.bulk->looks, 2);
  // Whatever the residual was before
  row.load(0) = 1.01 * tiny;
  row.begin_step({1, 1, 1});
  EXPECT_EQ(row.bulk->looks, 2);
  row.compare({1e-4 * tiny, 0, 0});
  EXPECT_EQ(row.bulk->looks, 3);
  EXPECT_EQ(row.convergence->scales().length, 2);
}

TEST(Convergence, ABodyThatHasRunAwayIsNoSolution)
{
  for (const double far : {1.999e3, 2.001e3})
    for (const double sign : {1.0, -1.0})
    {
      Row row;
      row.load(0) = 5;
      row.way(2) = sign * far;
      row.begin_step({1, 1, 1});
      EXPECT_EQ(row.compare({0, 0, 0}).tolerance == 0, far > 2e3);
    }
}

TEST(Convergence, TheFarthestIsTheSceneOrWhatIsPrescribed)
{
  Row row;
  EXPECT_EQ(row.convergence->farthest(), 2);
  row.bulk->fixed[2] = 1;
  for (const double value : {1.0, -7.0})
  {
    row.bulk->values[2] = value;
    // Whatever displacements are now
    for (const double now : {0.0, 100.0})
    {
      row.way(1) = now;
      EXPECT_EQ(row.convergence->farthest(), std::max(2.0, std::abs(value)));
    }
  }
  row.load(0) = 5;
  row.way(1) = 2.001e3;
  row.begin_step({1, 1, 1});
  EXPECT_GT(row.compare({0, 0, 0}).tolerance, 0);
}

TEST(Convergence, GapsOfClosedNodesHaveTheRoundingOfPositions)
{
  // In small sliding that of displacements
  for (const contact::Sliding sliding :
       {contact::Sliding::finite, contact::Sliding::small})
  {
    SpringBodies bodies(2);
    bodies.add<contact::NodeToSurface>(bodies.law(0), sliding);
    const auto system = bodies.system();
    solve::Convergence convergence(system);
    contact::Contact& contact = *bodies.contacts[0];
    law::NodeState& nodes = *contact.nodes();
    // An open node asks for nothing
    std::ranges::fill(nodes.c, 1e9);
    nodes.c[1] = 1e6;
    nodes.status[1] = law::slip;
    convergence.begin_step(
        std::vector<double>(bodies.scene.sheets.num_nodes()));
    // From -1 to 2
    bodies.bulk->load[0] = 1e-3;
    (*bodies.scene.u)[0] = -0.25;
    double length = 2.25;
    if (sliding == contact::Sliding::small)
    {
      // The offset is another length of theirs
      contact.set_offset(std::vector<double>(nodes.status.size(), -0.5));
      length = 0.5 + 0.25;
    }
    std::vector<double> b(system->size());
    for (const double part : {0.99, 1.01})
    {
      b[system->num_displacements() + 1]
          = part * eps * nodes.area[1] * 1e6 * length;
      const auto found = convergence.compare(b, 1e-12, 0);
      EXPECT_EQ(found.residual <= found.tolerance, part < 1) << part;
    }
  }
}

TEST(Convergence, DoesNotDependOnUnits)
{
  // Powers of two: the same digits
  const auto run = [](double length, double force)
  {
    std::vector<solve::Convergence::Result> found;
    Row row({0, 1, 1, 2}, 3);
    std::vector<double> x(6);
    x[2] = length;
    x[4] = 2 * length;
    row.halo = row.mesh.halo(x, 2, row.u);
    row.bulk = std::make_shared<SpringBulk>(row.mesh, row.halo, row.u,
                                            std::vector{0, 1, 1, 2}, 2);
    row.bulk->linear = false;
    row.bulk->fixed[0] = 1;
    row.bulk->size = std::vector(3, 0.1 * length);
    row.bulk->cell_force = std::vector(3, 20 * force);
    row.make();
    const double k = force / length;
    for (const double pull : {1.0, 1e-11})
    {
      row.way(1) = 0.25 * length;
      row.load(2) = pull * force;
      row.begin_step({0, 1e5 * k, 7 * k});
      for (const double rest : {1.0, 1e-7, 5e-8, 1e-10, 7e-12, 2e-12, 3e-16})
      {
        auto result = row.convergence->compare(
            std::vector{rest * length, 0.0, rest * force, 0.0,
                        0.1 * rest * force, 0.0},
            rtol, 0);
        result.residual /= force;
        result.tolerance /= force;
        result.defect /= length;
        found.push_back(result);
      }
      EXPECT_EQ(row.convergence->farthest(), 2 * length);
    }
    EXPECT_EQ(row.bulk->looks, 2);
    return found;
  };
  const auto one = run(1, 1);
  int small = 0;
  for (const double length : {0x1p-20, 0x1p20})
    for (const double force : {0x1p-30, 0x1p30})
    {
      const auto other = run(length, force);
      for (std::size_t i = 0; i < one.size(); ++i)
      {
        EXPECT_EQ(other[i].residual, one[i].residual) << i;
        EXPECT_EQ(other[i].tolerance, one[i].tolerance) << i;
        EXPECT_EQ(other[i].defect, one[i].defect) << i;
        small += one[i].residual <= one[i].tolerance;
      }
    }
  EXPECT_GT(small, 0);
  EXPECT_LT(small, 4 * std::ssize(one));
}

TEST(Convergence, IsTheSameOnRanks)
{
  constexpr int n = 12;
  std::vector<std::int32_t> cells;
  for (int i = 0; i + 1 < n; ++i)
    cells.insert(cells.end(), {i, i + 1});
  using Results = std::vector<double>;
  const auto run = [&](mesh::Ranks* ranks, double pull)
  {
    Row row(cells, n, ranks);
    Generator random(3);
    std::vector<double> stiffness(n), part(n);
    row.bulk->linear = false;
    row.bulk->fixed[2 * row.mesh.place[5]] = 1;
    row.bulk->values[2 * row.mesh.place[5]] = 3;
    for (int i = 0; i < n; ++i)
    {
      row.load(i) = pull * random(-1, 1);
      row.way(i) = random(-1, 1);
      row.bulk->size[row.mesh.place[i]] = random(0.1, 0.2);
      row.bulk->cell_force[row.mesh.place[i]] = random(0, 100);
      stiffness[i] = std::pow(10, random(0, 6));
      part[i] = random(-1, 1);
    }
    row.make();
    row.begin_step(stiffness);
    Results found{row.convergence->scale(), row.convergence->farthest(),
                  row.convergence->scale_of_balance()};
    for (const double rest : {1.0, 1e-8, 1e-9, 3e-10, 7e-11, 4e-13})
    {
      std::vector<double> b = part;
      for (double& value : b)
        value *= rest;
      const auto result = row.compare(b);
      found.insert(found.end(),
                   {result.residual, result.tolerance, result.defect});
    }
    row.convergence->accept();
    row.begin_step(stiffness);
    found.push_back(row.compare(part).tolerance);
    found.push_back(row.bulk->looks);
    return found;
  };
  for (const double pull : {1.0, 1e-10})
  {
    const Results one = run(nullptr, pull);
    for (const int size : {2, 3})
      on_ranks(size,
               [&](mesh::Ranks& ranks)
               {
                 const Results here = run(&ranks, pull);
                 for (std::size_t i = 0; i < one.size(); ++i)
                   EXPECT_NEAR(here[i], one[i], 1e-13 * std::abs(one[i])) << i;
               });
  }
}

TEST(Convergence, TheLargestCellMayBeOnAnotherRankThanWhatMoves)
{
  const auto run = [](mesh::Ranks* ranks)
  {
    // Nodes 0 and 1 are on two of two ranks
    Row row({0, 1, 1, 2}, 3, ranks);
    row.bulk->linear = false;
    row.way(1) = 1;
    row.bulk->size[row.mesh.place[0]] = 1;
    row.load(1) = 1e-20;
    row.make();
    row.begin_step({1e12, 0, 0});
    return row.converges({1.9 * eps * 1e12, 0, 0});
  };
  EXPECT_TRUE(run(nullptr));
  on_ranks(2, [&](mesh::Ranks& ranks) { EXPECT_TRUE(run(&ranks)); });
}

struct RowWithFields : Row
{
  std::shared_ptr<LooseFields> others
      = std::make_shared<LooseFields>(std::vector<std::size_t>{0, 2, 3});

  RowWithFields()
  {
    bulk->others = others;
    make();
    load(0) = 5;
    begin_step({1, 1, 1});
  }

  /// Residual over tolerance where forces are in balance.
  double excess(std::vector<double> fields)
  {
    std::vector<double> b(6);
    b.insert(b.end(), fields.begin(), fields.end());
    const auto found = convergence->compare(b, rtol, 0);
    EXPECT_EQ(found.defect, 0);
    return found.residual / found.tolerance;
  }
};

TEST(Convergence, OtherFieldsAreRelativeToTheirLargestResidual)
{
  RowWithFields row;
  EXPECT_EQ(row.excess({0, 0, 0}), 0);
  EXPECT_NEAR(row.excess({3, 4, 0}) * rtol, 1, 1e-14);
  EXPECT_NEAR(row.excess({0.3, 0.4, 0}) * rtol, 0.1, 1e-14);
  EXPECT_NEAR(row.excess({6e-10, 8e-10, 0}), 2, 1e-12);
  EXPECT_EQ(row.excess({3e-10, 3.9e-10, 0}), 0);
  // Each by itself: units may be any
  EXPECT_NEAR(row.excess({0, 0, 1e-9}) * rtol, 1, 1e-14);
  EXPECT_NEAR(row.excess({0, 0, 2e-19}), 2, 1e-12);
  EXPECT_EQ(row.excess({0, 0, 0.9e-19}), 0);
  // And in each step
  row.begin_step({1, 1, 1});
  EXPECT_NEAR(row.excess({3e-10, 4e-10, 0}) * rtol, 1, 1e-12);
  EXPECT_TRUE(std::isinf(row.excess({NAN, 0, 0})));
}

TEST(Convergence, RoundingOfOtherFieldsIsNoResidual)
{
  RowWithFields row;
  // Where nothing has changed a residual is all that there ever was
  row.others->size = {3e3, 4e3, 1};
  EXPECT_LE(row.excess({0.6 * eps * 5e3, 0.7 * eps * 5e3, 0}), 1);
  EXPECT_GT(row.excess({0.9 * eps * 5e3, 0.9 * eps * 5e3, 0}), 1);
  EXPECT_GT(row.excess({0, 0, 2 * eps}), 1);
  // It is dear, and looked at where it matters alone
  const int looks = row.others->looks;
  row.excess({1, 1, 0});
  EXPECT_EQ(row.others->looks, looks + 1);
  row.excess({1e-11, 1e-11, 0});
  EXPECT_EQ(row.others->looks, looks + 1);
}

TEST(Convergence, DirichletValuesOfOtherFieldsMustBeMet)
{
  RowWithFields row;
  row.others->fixed = {1, 0, 0};
  row.others->value = {100, 0, 0};
  EXPECT_GT(row.excess({1e-7, 0, 0}), 1);
  EXPECT_LE(row.excess({0.9e-8, 0, 0}), 1);
  // Also where none has a value yet
  row.others->value = {0, 0, 0};
  EXPECT_NEAR(row.excess({7, 0, 0}), 1e10, 1);
}
