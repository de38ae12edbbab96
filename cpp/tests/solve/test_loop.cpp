// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#include "hiding_pairs.h"
#include "spring_bodies.h"

using namespace contactx;
using namespace contactx::contact;
using namespace contactx::solve;
using namespace contactx::tests;

namespace
{
/// Bodies of springs in a Newton loop with dense algebra.
struct Newton : SpringBodies
{
  using SpringBodies::SpringBodies;

  /// Once contacts and Dirichlet conditions are there.
  void begin(bool damped = false)
  {
    if (not loop)
      loop.emplace(SpringBodies::system(), bodies());
    b.resize(system().size());
    EXPECT_TRUE(loop->begin_step(damped));
    loop->settle_first();
  }

  System& system() const { return *loop->system(); }

  Verdict judge(bool is_start = false)
  {
    const Verdict verdict = loop->judge(is_start, rtol, atol, b);
    residuals.push_back(loop->iterate().residual);
    return verdict;
  }

  std::vector<double> unknowns() const
  {
    std::vector<double> x(system().size());
    system().unknowns(x);
    return x;
  }

  /// Take a part of a step.
  void take(std::span<const double> dx, double part)
  {
    iterates.push_back(go(system(), dx, part));
  }

  /// Jacobian by the unknowns, which are lengths.
  Eigen::MatrixXd matrix() const
  {
    return jacobian(system(), loop->free_bodies().springs());
  }

  /// Solve a step as the loop's description says.
  Verdict solve(bool damped = false, int most = 30)
  {
    begin(damped);
    Verdict verdict = judge(true);
    for (int k = 0; k < most and verdict == Verdict::goes_on; ++k)
    {
      const Eigen::MatrixXd J = matrix();
      const std::vector<double> dx = tests::solution(J, b), x = unknowns();
      StepLength& length = loop->length();
      length.begin(loop->size_of(dx), loop->within_cells(dx));
      while (length.has_trial())
      {
        go(system(), dx, length.part());
        system().residual(b);
        system().take(x);
        length.judge(loop->size_of(tests::solution(J, b)));
      }
      take(dx, length.part());
      verdict = judge();
    }
    if (verdict == Verdict::solution)
    {
      for (const auto& c : contacts)
        c->accept();
      loop->accept();
    }
    return verdict;
  }

  using StepLength = solve::StepLength;

  std::optional<Loop> loop;
  std::vector<double> b, residuals;
  std::vector<std::vector<double>> iterates;
  double rtol = 1e-12, atol = 0;
};

/// Displacements and tractions for the active set and the directions of slip
/// that a solution of small sliding has, from its equations as a whole.
std::vector<double> direct(const Newton& found, double friction)
{
  const Contact& contact = *found.contacts[0];
  const law::NodeState& nodes = *contact.nodes();
  const int g = found.scene.sheets.gdim;
  const std::size_t n = found.scene.u->size(), m = nodes.num_nodes();
  const kernel::Weights weights = contact.master()->weights();
  const std::vector<double> normals = contact.master()->normals();
  const auto x = found.scene.halo->reference();
  Eigen::MatrixXd A = Eigen::MatrixXd::Zero(n + m * g, n + m * g);
  std::vector<double> f(n + m * g);

  const Eigen::MatrixXd K = found.stiffness();
  for (std::size_t i = 0; i < n; ++i)
  {
    const bool is_fixed = found.bulk->fixed[i];
    for (std::size_t j = 0; j < n; ++j)
      A(i, j) = is_fixed ? i == j : K(i, j);
    f[i] = is_fixed ? found.bulk->values[i]
                    : found.bulk->load[i]
                          + found.bulk->ground[i] * found.bulk->ends[i];
  }
  for (std::size_t e = 0; e < weights.nodes.size(); ++e)
    for (int k = 0; k < g; ++k)
    {
      const std::size_t s = weights.slaves[e], dof = g * weights.nodes[e] + k;
      const std::size_t row = n + g * s;
      if (not found.bulk->fixed[dof])
        A(dof, row + k) -= nodes.area[s] * weights.values[e];
      if (nodes.status[s] == law::open)
        continue;
      // The gap along the normal, what sticks across it
      const double* normal = &normals[3 * s];
      for (int r = 0; r < g; ++r)
      {
        const double along = normal[r] * normal[k];
        const double across
            = nodes.status[s] == law::stick ? (r == k) - along : 0;
        A(row + r, dof) += (along + across) * weights.values[e];
        f[row + r] -= along * weights.values[e] * x[dof];
        f[row + r] += across * weights.values[e] * (*found.scene.u)[dof];
      }
    }
  for (std::size_t s = 0; s < m; ++s)
  {
    const std::size_t row = n + g * s;
    const double* normal = &normals[3 * s];
    double size = 0;
    std::vector<double> direction(g);
    for (int r = 0; r < g and nodes.is_vector(); ++r)
    {
      direction[r]
          = nodes.multiplier[g * s + r] - nodes.pressure(s) * normal[r];
      size += direction[r] * direction[r];
      if (nodes.status[s] == law::stick)
        f[row + r] -= nodes.slip[g * s + r];
    }
    for (int r = 0; r < g; ++r)
      for (int k = 0; k < g; ++k)
      {
        const double across = (r == k) - normal[r] * normal[k];
        if (nodes.status[s] == law::open)
          A(row + r, row + k) = r == k;
        else if (nodes.status[s] == law::slip)
          A(row + r, row + k)
              = across
                - (friction > 0
                       ? friction * direction[r] / std::sqrt(size) * normal[k]
                       : 0);
      }
  }
  return tests::solution(A, f);
}

std::int64_t count(const Contact& contact, std::int8_t status)
{
  return std::ranges::count(contact.nodes()->status, status);
}

/// Two lines on springs, with triangles from one to the other.
struct Triangles : Newton
{
  explicit Triangles(mesh::Ranks* ranks = nullptr) : Newton(2, 0.5, ranks)
  {
    const std::int32_t n = scene.sheets.num_slaves;
    std::vector<std::int32_t> cells;
    for (std::int32_t i = 0; i + 1 < scene.sheets.num_nodes(); ++i)
      if (i + 1 != n)
        cells.insert(cells.end(), {i, i + 1, i < n ? n : 0});
    bulk = std::make_shared<SpringBulk>(scene.mesh, scene.halo, scene.u, cells,
                                        3);
    std::ranges::fill(bulk->ground, 3.0);
    add<NodeToSurface>(law(0));
    begin();
  }
};

/// A slave sheet without supports, and a master on springs.
struct Loose : Newton
{
  explicit Loose(int dim = 2, double height = 0.05) : Newton(dim, height)
  {
    bulk->bar = 2;
    std::fill_n(bulk->ground.begin(), dim * scene.sheets.num_slaves, 0.0);
  }

  /// Move the slave.
  void shift(int direction, double way)
  {
    for (std::int32_t i = 0; i < scene.sheets.num_slaves; ++i)
      (*scene.u)[scene.sheets.gdim * i + direction] += way;
  }
};
} // namespace

TEST_2D_3D(Loop, FindsTheAnswerOfADirectSolveOfTheFinalActiveSet, dim)
{
  for (const double friction : {0.0, 0.3})
  {
    std::int64_t slips = 0, sticks = 0;
    for (const bool damped : {false, true})
    {
      Newton found(dim);
      found.bulk->bar = 0.5;
      // A slave node on a master that is pushed aside and up
      found.prescribe(1, 0, 0.003);
      found.prescribe(found.scene.sheets.num_slaves + 1, dim - 1, 0.01);
      found.add<NodeToSurface>(found.law(friction), Sliding::small);
      found.press(0.09, 0, 1.2 / (dim - 1));
      ASSERT_EQ(found.solve(damped), Verdict::solution);
      // Nodes stick, or slip
      found.press(0.11, damped ? 0.02 : 0.008, 3.0 / (dim - 1));
      found.residuals.clear();
      ASSERT_EQ(found.solve(damped), Verdict::solution);
      EXPECT_LE(found.residuals.size(), 15u);
      const std::vector<double> expected = direct(found, friction);
      const std::size_t n = found.scene.u->size();
      expect_near(*found.scene.u, std::span(expected).first(n), 1e-11);
      const law::NodeState& nodes = *found.contacts[0]->nodes();
      const std::vector<double> normals
          = found.contacts[0]->master()->normals();
      for (std::int32_t s = 0; s < nodes.num_nodes(); ++s)
        for (int k = 0; k < dim; ++k)
          EXPECT_NEAR(nodes.is_vector()
                          ? nodes.multiplier[dim * s + k]
                          : nodes.multiplier[s] * normals[3 * s + k],
                      expected[n + dim * s + k], 1e-9);
      const Contact& contact = *found.contacts[0];
      EXPECT_GT(count(contact, law::open), 0);
      slips += count(contact, law::slip);
      sticks += count(contact, law::stick);
      EXPECT_EQ(found.loop->iterate().closed,
                nodes.num_nodes() - count(contact, law::open));
      // Once more there is nothing left to do
      found.residuals.clear();
      EXPECT_EQ(found.solve(), Verdict::solution);
      EXPECT_EQ(found.residuals.size(), 1u);
    }
    EXPECT_GT(slips, 0);
    EXPECT_EQ(sticks > 0, friction > 0);
  }
}

TEST_2D_3D(Loop, IteratesAreTheSameOnRanks, dim)
{
  const auto make = [&](Newton& found)
  {
    found.bulk->bar = 0.5;
    found.prescribe(1, 0, 0.003);
    found.add<NodeToSurface>(found.law(0.3));
    found.press(0.09, 0.008, 0.6);
  };
  Newton one(dim);
  make(one);
  ASSERT_EQ(one.solve(), Verdict::solution);
  for (const int size : {2, 3})
    on_ranks(size,
             [&](mesh::Ranks& ranks)
             {
               Newton here(dim, 0.05, &ranks);
               make(here);
               here.begin();
               Verdict verdict = here.judge(true);
               for (const std::vector<double>& x : one.iterates)
               {
                 EXPECT_EQ(verdict, Verdict::goes_on);
                 here.system().take(here.mine(x));
                 verdict = here.judge();
               }
               EXPECT_EQ(verdict, Verdict::solution);
               // What the last iterates leave is rounding
               expect_near(here.residuals, one.residuals, 1e-12);
               EXPECT_EQ(here.loop->iterate().closed,
                         one.loop->iterate().closed);
               EXPECT_DOUBLE_EQ(here.loop->max_increment(),
                                one.loop->max_increment());
             });
}

TEST(Loop, AnIterateWithoutItsDirichletValuesIsNoSolution)
{
  // No force tells of it
  for (const double part : {0.9, 1.1})
  {
    Newton found(2);
    const std::int32_t last = found.scene.sheets.num_nodes() - 1;
    found.prescribe(last, 1, 1);
    found.bulk->ground[2 * last + 1] = 0;
    found.add<NodeToSurface>(found.law(0));
    found.press(0.02, 0.01);
    found.begin();
    EXPECT_EQ(found.judge(true), Verdict::goes_on);
    std::vector<double> x = found.unknowns();
    std::ranges::copy(found.bulk->ends, x.begin());
    for (const double defect : {1.0, part * 1e-10})
    {
      x[2 * last + 1] = 1 + defect;
      found.system().take(x);
      const bool is_met = defect < 1e-10;
      EXPECT_EQ(found.judge(), is_met ? Verdict::solution : Verdict::goes_on);
      const Iterate& iterate = found.loop->iterate();
      EXPECT_LE(iterate.residual, iterate.tolerance);
      EXPECT_NEAR(iterate.defect, defect, 1e-15);
    }
  }
}

TEST(Loop, HalfAStepIsTakenWhereIteratesGoRound)
{
  Newton found(3);
  found.add<NodeToSurface>(found.law(0));
  found.press(0.09, 0.01);
  ASSERT_EQ(found.solve(), Verdict::solution);
  // Pressed harder by a little: no node opens or closes
  for (double& end : found.bulk->ends)
    end *= 1.001;
  found.begin();
  EXPECT_EQ(found.judge(true), Verdict::goes_on);
  const std::vector<double> x = found.unknowns(),
                            dx = tests::solution(found.matrix(), found.b);
  found.take(dx, 0);
  EXPECT_EQ(found.loop->active_set().cycles(), 0);
  found.judge();
  EXPECT_EQ(found.unknowns(), x);
  // The same residual again
  EXPECT_EQ(found.loop->active_set().cycles(), 1);
  double left = 1;
  for (int step = 0; step < 3; ++step)
  {
    found.system().take(x);
    found.take(dx, 1);
    found.judge();
    // Two steps go half the way from the iterate before
    left = step < 2 ? left / 2 : 0;
    std::vector<double> expected = x;
    for (std::size_t i = 0; i < x.size(); ++i)
      expected[i] -= (1 - left) * dx[i];
    expect_near(found.unknowns(), expected, 1e-15);
  }
  EXPECT_EQ(found.loop->iterate().changes.status, 0);
  found.begin();
  EXPECT_EQ(found.loop->active_set().cycles(), 0);
}

TEST(Loop, AResidualThatIsNotFiniteEndsIt)
{
  for (const double bad : {std::nan(""), infinity})
  {
    Newton found(2);
    found.add<NodeToSurface>(found.law(0));
    found.press(0.09, 0);
    ASSERT_EQ(found.solve(), Verdict::solution);
    found.bulk->load[0] = bad;
    EXPECT_FALSE(found.loop->begin_step(false));
    found.bulk->load[0] = 0;
    found.begin();
    EXPECT_EQ(found.judge(true), Verdict::solution);
    found.bulk->load[0] = bad;
    (*found.scene.u)[0] += 1e-3;
    EXPECT_EQ(found.judge(), Verdict::not_finite);
  }
}

TEST(Loop, FrozenPairsThatHideAPenetrationEndIt)
{
  for (const bool hides : {true, false})
  {
    Newton found(2);
    found.add<Hiding>(found.law(0));
    auto& master = dynamic_cast<Hiding&>(*found.contacts[0]->master());
    found.begin();
    // As if the pairs had gone back and forth since
    master.is_frozen = hides;
    const std::int64_t version = found.loop->version();
    EXPECT_EQ(found.judge(true),
              hides ? Verdict::frozen_pair_penetrates : Verdict::solution);
    EXPECT_EQ(found.loop->version(), version);
  }
}

TEST(Loop, ALooseBodyThatHasLeftTheSceneIsNoSolution)
{
  for (const bool is_loose : {true, false})
    for (const double way : {2.9, -3.1})
    {
      Loose found;
      if (not is_loose)
        std::fill_n(found.bulk->ground.begin(), 2, 1.0);
      found.add<NodeToSurface>(found.law(0));
      found.atol = 1e-6;
      found.begin();
      EXPECT_EQ(found.loop->free_bodies().free_modes(), is_loose ? 2 : 0);
      found.shift(0, way);
      if (not is_loose)
        found.bulk->ends[0] = way;
      EXPECT_DOUBLE_EQ(found.loop->max_increment(), std::abs(way));
      EXPECT_EQ(found.judge(), is_loose and way < -3 ? Verdict::unbounded_motion
                                                     : Verdict::solution);
    }
}

TEST(Loop, ALooseBodyThatHasTurnedIsNoSolution)
{
  for (const double angle : {0.013, -0.015})
    for (const bool is_linear : {true, false})
    {
      Loose found;
      found.bulk->bar = 0;
      found.bulk->linear = is_linear;
      found.add<NodeToSurface>(found.law(0));
      found.atol = 1e-6;
      found.begin();
      found.shift(1, 0.5);
      for (std::int32_t i = 0; i < found.scene.sheets.num_slaves; ++i)
        (*found.scene.u)[2 * i + 1] += angle * found.scene.sheets.x[2 * i];
      EXPECT_NEAR(found.loop->turned(), is_linear ? std::abs(angle) : 0, 1e-12);
      EXPECT_EQ(found.judge(), is_linear and angle < 0 ? Verdict::large_rotation
                                                       : Verdict::solution);
    }
}

TEST(Loop, LoadsThatNothingBalancesEndIt)
{
  Loose found;
  found.add<NodeToSurface>(found.law(0));
  found.bulk->load[1] = 1;
  EXPECT_EQ(found.solve(), Verdict::unbalanced);
  EXPECT_EQ(found.residuals.size(), 10u);
  // The next step counts anew
  found.begin();
  EXPECT_EQ(found.judge(true), Verdict::goes_on);
}

TEST(Loop, StepsThatLeadNowhereEndIt)
{
  Newton found(2);
  found.add<NodeToSurface>(found.law(0));
  found.press(0.09, 0);
  found.begin();
  Verdict verdict = found.judge(true);
  for (int step = 0; step < 3; ++step)
  {
    EXPECT_EQ(verdict, Verdict::goes_on);
    found.loop->length().begin(1, 1e-4);
    verdict = found.judge();
  }
  EXPECT_EQ(verdict, Verdict::stuck);
  found.begin();
  EXPECT_EQ(found.judge(true), Verdict::goes_on);
  for (int step = 0; step < 3; ++step)
    found.loop->length().begin(1, 1e-4);
  // But where they have led there
  found.rtol = 1;
  EXPECT_EQ(found.judge(), Verdict::solution);
}

TEST(Loop, DriftOfFreeBodiesIsTakenOffWhereContactIsLinear)
{
  for (const Sliding sliding : {Sliding::small, Sliding::finite})
  {
    Loose found(2, 0);
    const std::int32_t n = found.scene.sheets.num_slaves;
    for (std::int32_t i = 0; i < found.scene.sheets.num_nodes(); ++i)
      if (i < n)
        found.bulk->load[2 * i + 1] = -0.01;
      else
        for (const int k : {0, 1})
          found.prescribe(i, k, 0);
    found.add<NodeToSurface>(found.law(0), sliding);
    ASSERT_EQ(found.solve(), Verdict::solution);
    EXPECT_EQ(found.loop->free_bodies().free_modes(), 1);
    const std::vector<double> before = *found.scene.u;
    found.shift(0, 0.01);
    (*found.scene.u)[0] += 0.001;
    const std::vector<double> shifted = *found.scene.u;
    found.judge();
    if (sliding == Sliding::finite)
    {
      EXPECT_EQ(*found.scene.u, shifted);
      continue;
    }
    // The mean, not what deforms
    for (std::size_t i = 0; i < before.size(); ++i)
    {
      const bool is_slave = i < 2 * std::size_t(n) and i % 2 == 0;
      EXPECT_NEAR((*found.scene.u)[i],
                  before[i] + (is_slave ? 0.001 * ((i == 0) - 1.0 / n) : 0),
                  1e-14);
    }
  }
}

TEST(Loop, TheVersionTellsWhenTheJacobianHasChanged)
{
  Newton found(2);
  found.add<NodeToSurface>(found.law(0));
  found.press(0.09, 0);
  found.begin();
  std::int64_t version = found.loop->version();
  // The first iterate has been settled
  EXPECT_EQ(found.judge(true), Verdict::goes_on);
  EXPECT_EQ(found.loop->version(), version);
  for (int step = 0; step < 3; ++step)
  {
    found.judge();
    EXPECT_GT(found.loop->version(), version);
    version = found.loop->version();
  }
  found.loop->begin_step(false);
  EXPECT_EQ(found.loop->iterate().residual, 0);
  EXPECT_GT(found.loop->version(), version);
  version = found.loop->version();
  found.loop->settle_first();
  EXPECT_GT(found.loop->version(), version);
}

TEST_2D_3D(Loop, FactorsOfComplementarityAreOfSpringsInSeries, dim)
{
  Newton found(dim);
  const std::int32_t n = found.scene.sheets.num_slaves;
  std::vector<double> compliance(found.scene.sheets.num_nodes());
  const auto& facets = found.scene.sheets.master;
  for (std::size_t i = 0; i < compliance.size(); ++i)
  {
    // Directions of which the mean counts, of those that are free
    const double k = 1.0 + static_cast<double>(i * i % 7);
    for (int d = 0; d < dim; ++d)
      found.bulk->ground[dim * i + d] = k * (d == 0 ? 2 : 0.5);
    double free = dim;
    double sum = k * (2 + 0.5 * (dim - 1));
    if (i == 1)
    {
      found.prescribe(1, 0, 0);
      sum -= 2 * k;
      --free;
    }
    compliance[i] = free / sum;
  }
  // What cannot move gives way to nothing
  for (int d = 0; d < dim; ++d)
    found.prescribe(n + 2, d, 0);
  compliance[n + 2] = 0;
  found.add<NodeToSurface>(found.law(0));
  found.begin();
  const Contact& contact = *found.contacts[0];
  const auto weights = contact.master()->weights();
  for (std::int32_t s = 0; s < n; ++s)
  {
    // Mean of the nodes of the facet that the node is in front of
    std::vector<double> of_facet;
    for (std::int32_t f = 0; f < facets.list().size(); ++f)
    {
      std::vector<std::int32_t> nodes(facets.list()[f].begin(),
                                      facets.list()[f].end()),
          paired;
      for (std::size_t e = 0; e < weights.nodes.size(); ++e)
        if (weights.slaves[e] == s and weights.nodes[e] >= n)
          paired.push_back(weights.nodes[e]);
      std::ranges::sort(nodes);
      std::ranges::sort(paired);
      if (nodes == paired)
        for (const std::int32_t node : nodes)
          of_facet.push_back(compliance[node]);
    }
    ASSERT_FALSE(of_facet.empty());
    double mean = 0;
    for (const double value : of_facet)
      mean += value / static_cast<double>(of_facet.size());
    EXPECT_NEAR(contact.nodes()->c[s] * contact.nodes()->area[s]
                    * (compliance[s] + mean),
                1, 1e-12);
  }
}

TEST(Loop, TheJacobianMayBeAskedForBeforeTheResidual)
{
  Newton found(2, 0);
  found.add<NodeToSurface>(found.law(0));
  found.begin();
  const law::NodeState& nodes = *found.contacts[0]->nodes();
  for (std::int32_t i = 0; i < nodes.num_nodes(); ++i)
    EXPECT_DOUBLE_EQ(std::abs(nodes.by_gap[i]), nodes.area[i] * nodes.c[i]);
}

TEST(Loop, MeasuresSteps)
{
  Triangles found;
  const std::int32_t n = found.scene.sheets.num_slaves;
  std::vector<double> dx(found.system().size(), 1e3);
  std::fill_n(dx.begin(), found.system().num_displacements(), 0.0);
  EXPECT_EQ(found.loop->size_of(dx), 0);
  EXPECT_EQ(found.loop->within_cells(dx), 1);
  // Down by twice their height: they are turned inside out
  const auto go = [&](double way)
  {
    for (std::int32_t i = 0; i < n; ++i)
      dx[2 * i + 1] = way;
  };
  go(1);
  EXPECT_DOUBLE_EQ(found.loop->size_of(dx), 2);
  EXPECT_EQ(found.loop->within_cells(dx), 1);
  found.bulk->linear = false;
  EXPECT_NEAR(found.loop->within_cells(dx), 0.3, 1e-3);
  // The last node's one cell is another rank's
  std::vector<double> last = dx;
  for (std::int32_t i = 0; i + 1 < n; ++i)
    last[2 * i + 1] = 0;
  EXPECT_LT(found.loop->within_cells(last), 1);
  on_ranks(2,
           [&](mesh::Ranks& ranks)
           {
             Triangles here(&ranks);
             here.bulk->linear = false;
             EXPECT_EQ(here.loop->within_cells(here.mine(last)),
                       found.loop->within_cells(last));
             EXPECT_DOUBLE_EQ(here.loop->size_of(here.mine(dx)), 2);
           });
  go(-1);
  EXPECT_EQ(found.loop->within_cells(dx), 1);
  // Part of the closed nodes that change
  (*found.scene.u)[1] = (*found.scene.u)[3] = -0.6;
  (*found.scene.u)[2] = -0.01;
  EXPECT_EQ(found.loop->max_increment(), 0.6);
  found.judge();
  EXPECT_EQ(found.loop->iterate().closed, 2);
  EXPECT_EQ(found.loop->changing(), 1);
  found.judge();
  EXPECT_EQ(found.loop->changing(), 0);
}
