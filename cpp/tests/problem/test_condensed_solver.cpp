// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#include "dense_algebra.h"
#include <contactx/problem/condensed_solver.h>

using namespace contactx;
using namespace contactx::contact;
using namespace contactx::problem;
using namespace contactx::tests;

namespace
{
/// Two bodies of springs that are pressed on each other in steps.
struct Pressed
{
  explicit Pressed(double friction, std::shared_ptr<LooseFields> others = {})
      : bodies(2), friction(friction)
  {
    bodies.bulk->others = std::move(others);
    bodies.add<NodeToSurface>(bodies.law(friction), Sliding::small);
    bodies.bulk->bar = 2;
    bodies.press(0.09, 0.01);
    algebra = std::make_shared<DenseAlgebra>(bodies);
    solver = std::make_unique<CondensedSolver>(bodies.problem(), algebra);
  }

  /// Take steps; those of one more problem by dense factors are the same.
  void step(int count)
  {
    Pressed exact(friction);
    DenseSolver dense(exact.bodies);
    for (int k = 1; k <= count; ++k)
    {
      for (Stepped* one : {&bodies, &exact.bodies})
        one->press(0.09 + 0.01 * k, 0.01 * k);
      bodies.problem().solve(*solver, {.rtol = 1e-11, .max_it = 40});
      exact.bodies.problem().solve(dense, {.rtol = 1e-11, .max_it = 40});
      const std::vector<double>& u = *bodies.scene.u;
      const std::vector<double>& v = *exact.bodies.scene.u;
      expect_near(u, v, 1e-9);
    }
  }

  Stepped bodies;
  double friction;
  std::shared_ptr<DenseAlgebra> algebra;
  std::unique_ptr<CondensedSolver> solver;
};
} // namespace

TEST(CondensedSolver, FindsWhatDenseFactorsFind)
{
  for (const double friction : {0., 0.3})
  {
    SCOPED_TRACE(friction);
    Pressed pressed(friction);
    pressed.step(4);
    EXPECT_TRUE(pressed.solver->statistics().direct.empty());
    // One for all steps
    EXPECT_EQ(pressed.algebra->hierarchies, 1);
  }
}

TEST(CondensedSolver, TakesBlocksOfBodiesWhereMultigridFailsTwice)
{
  Pressed pressed(0.3);
  pressed.algebra->multigrid_converges = false;
  pressed.step(2);
  EXPECT_EQ(pressed.algebra->hierarchies, 2);
  const auto found = pressed.solver->statistics();
  EXPECT_EQ(std::ssize(found.by_bodies), found.solves);
  EXPECT_EQ(found.by_bodies.front(), "multigrid is slow here");
  EXPECT_GT(pressed.algebra->factorised["bodies_soft"], 0);
}

TEST(CondensedSolver, TakesFactorsOfTheWholeWhereBlocksFailTwice)
{
  Pressed pressed(0.3);
  pressed.algebra->asked = "bodies";
  pressed.algebra->bodies_converge = false;
  pressed.step(2);
  const auto found = pressed.solver->statistics();
  EXPECT_EQ(std::ssize(found.direct), found.solves);
  EXPECT_GT(pressed.algebra->factorised["system"], 0);
}

TEST(CondensedSolver, AFailedStepTeachesItNothing)
{
  Pressed pressed(0.3);
  pressed.step(1);
  Problem& problem = pressed.bodies.problem();
  pressed.algebra->multigrid_converges = false;
  pressed.bodies.press(0.12, 0.05);
  EXPECT_THROW(problem.solve(*pressed.solver, {.rtol = 1e-11, .max_it = 1}),
               ConvergenceError);
  const int before = pressed.algebra->hierarchies;
  pressed.algebra->multigrid_converges = true;
  problem.solve(*pressed.solver, {.rtol = 1e-11, .max_it = 40});
  EXPECT_GT(pressed.algebra->hierarchies, before);
  EXPECT_TRUE(pressed.solver->statistics().by_bodies.empty());
}

TEST(CondensedSolver, SolvesAreAsRoughAsTheNextResidualAllows)
{
  // The same iterates: what is rough is the target alone
  std::vector<double> targets;
  for (const double roughness : {1., 1e-3})
  {
    Pressed pressed(0.3);
    pressed.solver->tuning.roughness = roughness;
    pressed.step(1);
    ASSERT_GE(pressed.algebra->targets.size(), 2u);
    targets.push_back(pressed.algebra->targets.front());
  }
  EXPECT_NEAR(targets[1] / targets[0], 1e-3, 1e-9);
}

TEST(CondensedSolver, SoftNodesOfAnyStiffness)
{
  for (const auto& [friction, asked] :
       {std::pair(0., ""), std::pair(0.3, ""), std::pair(0.3, "bodies")})
  {
    Pressed pressed(friction);
    pressed.step(1);
    pressed.algebra->asked = asked;
    Problem& problem = pressed.bodies.problem();
    problem.begin_step();
    problem.settle(1e-12, 0, 10);
    law::NodeState& nodes = *pressed.bodies.contacts.front()->nodes();
    const std::size_t size = nodes.size();
    int count = 0;
    // Mixed ones, soft ones alone, then none of them
    for (const auto& [least, most] :
         {std::pair{-8, 2}, std::pair{1, 2}, std::pair{0, 0}})
    {
      SCOPED_TRACE(least);
      Generator random(3);
      for (std::int32_t k = 0; k < nodes.num_nodes(); ++k)
        if (nodes.closed(k) and (size == 1 or nodes.status[k] == law::stick))
        {
          ++count;
          for (std::size_t i = 0; i < size; ++i)
            for (std::size_t j = 0; j < size; ++j)
              nodes.by_multiplier[(k * size + i) * size + j]
                  = most == 0
                        ? 0
                        : nodes.area[k] * std::pow(10, random(least, most))
                              * ((i == j ? 2 : 0) + 0.5 * random(-1, 1));
        }
      const Eigen::MatrixXd J = pressed.bodies.matrix();
      std::vector<double> b(J.rows()), x(J.rows());
      for (std::size_t i = 0; i < b.size(); ++i)
        b[i] = std::sin(1.0 + double(i));
      const auto prescribed = pressed.bodies.bulk->markers();
      for (std::size_t i = 0; i < prescribed.size(); ++i)
        if (prescribed[i])
          b[i] = 0;
      pressed.solver->solve(b, x);
      const std::vector<double> exact = solution(J, b);
      const double scale = math::column(exact).cwiseAbs().maxCoeff();
      expect_near(x, exact, 1e-10 * scale);
    }
    EXPECT_GT(count, 0);
    const auto found = pressed.solver->statistics();
    EXPECT_TRUE(found.direct.empty());
    EXPECT_EQ(found.by_bodies.empty(), pressed.algebra->asked.empty());
    EXPECT_EQ(pressed.algebra->hierarchies, 1);
    // One for each solve: blocks of bodies have the springs, too
    EXPECT_EQ(found.iterations, 3);
  }
}

TEST(CondensedSolver, MultipliesByTheJacobian)
{
  Pressed pressed(0.3);
  pressed.step(1);
  Problem& problem = pressed.bodies.problem();
  problem.begin_step();
  problem.settle(1e-12, 0, 10);
  const Eigen::MatrixXd J = pressed.bodies.matrix();
  std::vector<double> x(J.rows()), y(J.rows());
  for (std::size_t i = 0; i < x.size(); ++i)
    x[i] = std::sin(1.0 + double(i));
  pressed.solver->multiply(x, y);
  const std::vector<double> exact = product(J, x);
  for (std::size_t i = 0; i < x.size(); ++i)
    EXPECT_NEAR(y[i], exact[i], 1e-10 * J.norm());
}

TEST(CondensedSolver, SolvesForOtherFieldsTogether)
{
  for (const double friction : {0., 0.3})
  {
    SCOPED_TRACE(friction);
    Pressed pressed(friction, std::make_shared<LooseFields>(
                                  std::vector<std::size_t>{0, 2, 5}));
    SpringBulk& bulk = *pressed.bodies.bulk;
    const auto n = static_cast<Eigen::Index>(pressed.bodies.scene.u->size());
    // Two pressures, which resist no volume, and a field of its own stiffness
    std::srand(3);
    Eigen::MatrixXd C = Eigen::MatrixXd::Random(5, n);
    for (Eigen::Index i = 0; i < n; ++i)
      if (bulk.markers()[i])
        C.col(i).setZero();
    Eigen::MatrixXd S = Eigen::MatrixXd::Zero(5, 5);
    S.diagonal().tail(3).setConstant(4);
    pressed.algebra->of_fields = C;
    pressed.algebra->by_fields = S;
    pressed.solver->tuning.roughness = 1e-12;

    Problem& problem = pressed.bodies.problem();
    problem.begin_step();
    problem.settle(1e-12, 0, 10);
    const Eigen::MatrixXd contact = pressed.bodies.matrix();
    const Eigen::Index rest = contact.rows() - n;
    Eigen::MatrixXd J = Eigen::MatrixXd::Zero(n + 5 + rest, n + 5 + rest);
    J.topLeftCorner(n, n) = contact.topLeftCorner(n, n);
    J.topRightCorner(n, rest) = contact.topRightCorner(n, rest);
    J.bottomLeftCorner(rest, n) = contact.bottomLeftCorner(rest, n);
    J.bottomRightCorner(rest, rest) = contact.bottomRightCorner(rest, rest);
    J.block(n, 0, 5, n) = C;
    J.block(0, n, n, 5) = C.transpose();
    J.block(n, n, 5, 5) = S;

    std::vector<double> b(J.rows()), x(J.rows()), y(J.rows());
    for (std::size_t i = 0; i < b.size(); ++i)
      b[i] = std::sin(1.0 + double(i));
    pressed.solver->solve(b, x);
    const std::vector<double> exact = solution(J, b);
    expect_near(x, exact, 1e-8 * math::column(exact).norm());
    const auto found = pressed.solver->statistics();
    EXPECT_TRUE(found.direct.empty());
    EXPECT_TRUE(found.by_bodies.empty());
    // Exact but for the Schur complement, which has rank five
    EXPECT_LE(found.iterations, 12);
    EXPECT_EQ(pressed.algebra->factorised["fields"], 1);

    pressed.solver->multiply(exact, y);
    expect_near(y, b, 1e-9 * J.norm());
  }
}
