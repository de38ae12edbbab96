// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#include "dense_algebra.h"
#include <contactx/problem/condensed_solver.h>
#include <gtest/gtest.h>

using namespace contactx;
using namespace contactx::contact;
using namespace contactx::problem;
using namespace contactx::tests;

namespace
{
/// Two bodies of springs that are pressed on each other in steps.
struct Pressed
{
  explicit Pressed(double friction) : bodies(2), friction(friction)
  {
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
      for (std::size_t i = 0; i < u.size(); ++i)
        EXPECT_NEAR(u[i], v[i], 1e-9);
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
