// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#include "hiding_pairs.h"
#include "stepped_bodies.h"
#include <contactx/contact/contact_state.h>
#include <contactx/solve/derivative_check.h>
#include <contactx/solve/not_finite.h>

using namespace contactx;
using namespace contactx::contact;
using namespace contactx::problem;
using namespace contactx::tests;

namespace
{
constexpr double not_a_number = std::nan("");

void expect_same(const std::vector<std::vector<Saved>>& a,
                 const std::vector<std::vector<Saved>>& b)
{
  ASSERT_EQ(a.size(), b.size());
  for (std::size_t k = 0; k < a.size(); ++k)
  {
    ASSERT_EQ(a[k].size(), b[k].size());
    for (std::size_t i = 0; i < a[k].size(); ++i)
    {
      EXPECT_EQ(a[k][i].name, b[k][i].name);
      std::visit(
          [&](const auto& values)
          {
            const auto& others
                = std::get<std::decay_t<decltype(values)>>(b[k][i].values);
            ASSERT_EQ(values.size(), others.size());
            // NaN is unlike itself
            for (std::size_t j = 0; j < values.size(); ++j)
              EXPECT_TRUE(
                  values[j] == others[j]
                  or (values[j] != values[j] and others[j] != others[j]))
                  << a[k][i].name << " " << j;
          },
          a[k][i].values);
    }
  }
}

} // namespace

TEST(Problem, AStepEndsWithItsReport)
{
  for (const double friction : {0., 0.3})
  {
    Stepped found(2);
    found.add<NodeToSurface>(found.law(friction), Sliding::small);
    found.press(0.09, friction > 0 ? 0.01 : 0);
    const Settled end = found.solve();
    ASSERT_TRUE(end.converged) << end.failure;
    EXPECT_GT(end.closed, 0);
    Problem& problem = found.problem();
    EXPECT_TRUE(problem.converged());
    problem.summarise();
    problem.accept();
    const Report& report = problem.report();
    EXPECT_TRUE(report.converged);
    EXPECT_EQ(report.slaves, found.scene.sheets.num_slaves);
    EXPECT_EQ(report.pairs, found.scene.sheets.num_slaves);
    ASSERT_EQ(std::ssize(report.history), end.number + 1);
    for (int k = 0; k <= end.number; ++k)
      EXPECT_EQ(report.history[k].number, k);
    EXPECT_LE(report.history.back().residual, report.history.back().tolerance);
    EXPECT_TRUE(report.warnings.empty());
    EXPECT_EQ(report.slip > 0, friction > 0);
    EXPECT_EQ(report.dissipation > 0, friction > 0);
    EXPECT_FALSE(problem.has_begun());
  }
}

TEST(Problem, AWholeStepIsThatOfItsParts)
{
  for (const double friction : {0., 0.3})
  {
    Stepped one(2), other(2);
    for (Stepped* found : {&one, &other})
    {
      found->add<NodeToSurface>(found->law(friction), Sliding::small);
      found->press(0.09, 0.01);
    }
    ASSERT_TRUE(one.solve().converged);
    one.problem().accept();
    DenseSolver solver(other);
    other.problem().solve(solver, {.rtol = 1e-12, .max_it = 30});
    expect_same(one.state(), other.state());
    EXPECT_EQ(solver.solves, one.problem().number());
    EXPECT_TRUE(other.problem().report().converged);
  }
}

TEST(Problem, AFailedStepIsTriedOnceMoreDamped)
{
  // Linear bodies of small sliding are solved exactly by full steps
  for (const Sliding sliding : {Sliding::finite, Sliding::small})
  {
    Stepped found(2);
    found.add<NodeToSurface>(found.law(0.3), sliding);
    found.press(0.09, 0.05);
    const auto before = found.state();
    DenseSolver solver(found);
    expect_refusal<ConvergenceError>(
        [&] { found.problem().solve(solver, {.rtol = 1e-12, .max_it = 0}); },
        "no convergence in 0 iterations");
    EXPECT_EQ(found.problem().report().damped, sliding == Sliding::finite);
    expect_same(found.state(), before);
  }
}

TEST(Problem, StepsOfAPlanAreCutUntilTheyConverge)
{
  Stepped found(2);
  found.add<NodeToSurface>(found.law(0), Sliding::small);
  DenseSolver solver(found);
  // Loads beyond that are not finite until steps are short
  double reached = 0;
  std::vector<double> tried;
  const auto update = [&](double t)
  {
    tried.push_back(t);
    found.press(0.09 * t, 0);
    found.bulk->load[0] = t - reached > 0.3 ? not_a_number : 0;
  };
  StepPlan plan(StepPlan::equal(2), 2);
  std::vector<AttemptRecord> log;
  while (not plan.finished())
  {
    found.problem().advance(plan, update, solver, {},
                            [&](const auto& record) { log.push_back(record); });
    reached = plan.t();
    EXPECT_TRUE(found.problem().report().converged);
  }
  EXPECT_EQ(tried, (std::vector{0.5, 0.25, 0.5, 1.0, 0.75, 1.0}));
  // A record for each attempt
  std::vector<double> starts, ends;
  std::vector<int> steps, attempts;
  for (const AttemptRecord& record : log)
  {
    steps.push_back(record.step);
    attempts.push_back(record.attempt);
    starts.push_back(record.start);
    ends.push_back(record.end);
    EXPECT_EQ(record.failure.empty(), record.residual <= record.tolerance);
  }
  EXPECT_EQ(ends, tried);
  EXPECT_EQ(starts, (std::vector{0., 0., 0.25, 0.5, 0.5, 0.75}));
  EXPECT_EQ(steps, (std::vector{1, 1, 2, 3, 3, 4}));
  EXPECT_EQ(attempts, (std::vector{1, 2, 1, 1, 2, 1}));
  EXPECT_EQ(log.back().closed, 2);
  EXPECT_EQ(log.back().solves, found.problem().report().history.back().number);
  // Too short a plan leaves all as it was
  const auto before = found.state();
  StepPlan stuck(StepPlan::equal(1), 1);
  reached = -10;
  expect_refusal<ConvergenceError>(
      [&] { found.problem().advance(stuck, update, solver); },
      "No step from t = 0 converged; the last attempt, to t = 0.5, was the "
      "shortest");
  EXPECT_EQ(tried.back(), 0);
  EXPECT_EQ(stuck.t(), 0);
  expect_same(found.state(), before);
}

TEST(Problem, AnAttemptIsALineOfALog)
{
  EXPECT_EQ(step_log_heading(),
            "step attempt           t         dt solves  closed slipping  "
            "residual tolerance  seconds  outcome");
  EXPECT_EQ(
      step_log_line({12, 1, 0.25, 0.5, 7, 40, 3, 1.25e-9, 2e-8, 0.125, ""}),
      "  12       1         0.5       0.25      7      40        3  "
      "1.25e-09     2e-08    0.125  accepted");
  EXPECT_EQ(
      step_log_line({1, 2, 0, 1, 50, 4, 0, 3, 1e-8, 1200, "no\nway"}),
      "   1       2           1          1     50       4        0         "
      "3     1e-08  1.2e+03  failed: no way");
}

TEST(Problem, LoadsAreSetBackWhereAStepOfAPlanThrows)
{
  Stepped found(2);
  found.add<NodeToSurface>(found.law(0), Sliding::small);
  DenseSolver solver(found);
  StepPlan plan(StepPlan::equal(2), 1);
  std::vector<double> tried;
  const auto update = [&](double t)
  {
    tried.push_back(t);
    found.press(0.09 * t, 0);
  };
  found.problem().advance(plan, update, solver);
  const auto before = found.state();
  struct Throwing final : LinearSolver
  {
    void update() override {}
    void solve(std::span<const double>, std::span<double>) override
    {
      throw std::runtime_error("no memory");
    }
  } throwing;
  EXPECT_EQ(refusal<std::runtime_error>(
                [&] { found.problem().advance(plan, update, throwing); }),
            "no memory");
  EXPECT_EQ(tried, (std::vector{0.5, 1.0, 0.5}));
  EXPECT_EQ(plan.t(), 0.5);
  expect_same(found.state(), before);
  // What cannot be set back is said
  const auto once = [&](double t)
  {
    if (t == 0.5)
      throw std::runtime_error("no such load");
    update(t);
    found.bulk->load[0] = not_a_number;
  };
  StepPlan stuck(std::vector{0.5, 1.0}, 0);
  stuck.accept(1);
  expect_refusal<ConvergenceError>(
      [&] { found.problem().advance(stuck, once, solver); },
      "Setting the loads of t = 0.5 again failed: no such load");
}

TEST(Problem, CallsHaveAnOrder)
{
  Stepped found(2);
  found.add<NodeToSurface>(found.law(0), Sliding::small);
  found.press(0.09, 0);
  Problem& problem = found.problem();
  std::vector<double> dx(problem.system()->size());
  const auto refused = [](auto call, const char* words)
  { expect_refusal<std::logic_error>(call, words); };
  refused([&] { problem.settle(1e-11, 0, 50); },
          "settle() before begin_step()");
  refused([&] { problem.enter("residual"); }, "residual() before begin_step()");
  problem.begin_step();
  refused([&] { problem.limit(dx); }, "limit() before settle()");
  problem.settle(1e-11, 0, 50);
  refused([&] { problem.enter("accept"); },
          "accept() of an iterate that is no solution");
  problem.update(dx);
  refused([&] { problem.limit(dx); }, "limit() before settle()");
  EXPECT_REFUSED(problem.update(dx, not_a_number));
  problem.restore();
  refused([&] { problem.update(dx); }, "update() before begin_step()");
}

TEST(Problem, ItReturnsToWhereAStepBeganBitForBit)
{
  for (const double friction : {0., 0.3})
  {
    Stepped found(3);
    found.add<NodeToSurface>(found.law(friction), Sliding::small);
    found.press(0.09, 0.01);
    ASSERT_TRUE(found.solve().converged);
    Problem& problem = found.problem();
    problem.accept();
    const auto before = found.state();
    found.press(0.14, -0.02);
    problem.begin_step();
    problem.settle(1e-12, 0, 50);
    found.advance();
    problem.settle(1e-12, 0, 50);
    problem.restore();
    expect_same(found.state(), before);
    // What is missing, or of another size, changes nothing
    auto saved = save(*found.contacts[0]);
    saved[1].values = std::vector<double>(3);
    EXPECT_REFUSED(load(*found.contacts[0], saved));
    saved.erase(saved.begin() + 1);
    EXPECT_REFUSED(load(*found.contacts[0], saved));
    expect_same(found.state(), before);
    EXPECT_TRUE(found.solve().converged);
  }
}

TEST(Problem, TooManyIterationsEndIt)
{
  Stepped found(2);
  found.add<NodeToSurface>(found.law(0), Sliding::small);
  found.press(0.09, 0);
  const Settled& end = found.solve(1);
  EXPECT_FALSE(end.converged);
  EXPECT_EQ(end.number, 1);
  expect_says(end.failure,
              "no convergence in 1 iterations: take smaller load steps");
  EXPECT_FALSE(end.is_final);
}

TEST(Problem, HiddenPenetrationIsRefused)
{
  Stepped found(2);
  found.add<Hiding>(found.law(0));
  auto& master = dynamic_cast<Hiding&>(*found.contacts[0]->master());
  Problem& problem = found.problem();
  problem.prepare();
  int attempts = 0;
  Settled end;
  EXPECT_FALSE(problem.attempt(
      [&](bool damped)
      {
        ++attempts;
        problem.start(damped);
        // As if the pairs had gone back and forth since
        master.is_frozen = true;
        end = problem.settle(1e-11, 0, 50);
        return Outcome::failed;
      }));
  EXPECT_EQ(attempts, 1) << "no other way leads on";
  expect_says(end.failure,
              "hide a penetration: refine the coarser surface there");
  EXPECT_TRUE(end.is_final);
  problem.summarise();
  EXPECT_DOUBLE_EQ(problem.report().frozen_gap, -1e-3);
}

TEST(Problem, WhatIsNotFiniteIsRefusedBeforeAnyWork)
{
  Stepped found(2);
  found.prescribe(0, 1, 0);
  found.add<NodeToSurface>(found.law(0), Sliding::small);
  found.press(0.09, 0);
  Problem& problem = found.problem();
  const auto begin = [&] { problem.begin_step(); };
  (*found.scene.u)[3] = not_a_number;
  expect_refusal(begin, "the displacement u is not finite at 1 dofs");
  (*found.scene.u)[3] = 0;
  const std::size_t dof = 2 * found.scene.mesh.place[0] + 1;
  found.bulk->values[dof] = not_a_number;
  expect_refusal(begin,
                 "bcs prescribe displacements that are not finite, at 1 dofs");
  found.bulk->values[dof] = 0;
  found.bulk->load[0] = not_a_number;
  expect_refusal<solve::NotFinite>(
      begin, "the residual is not finite: the material fails at the start");
  found.bulk->load[0] = 0;
  EXPECT_TRUE(found.solve().converged);
}

TEST(Problem, ValuesThatDoNotVaryAreReadOnce)
{
  for (const bool varies : {true, false})
  {
    Stepped found(2);
    found.add<NodeToSurface>(found.law(0.3), Sliding::small);
    found.press(0.09, 0.01);
    found.problem();
    GivenValues& given = *found.given[0];
    EXPECT_EQ(given.reads, 1);
    given.varies = varies;
    ASSERT_TRUE(found.solve().converged);
    EXPECT_EQ(given.reads > 1, varies);
    given.coefficient = -1;
    found.problem().accept();
    if (varies)
      EXPECT_REFUSED(found.problem().begin_step());
    else
      EXPECT_NO_THROW(found.problem().begin_step());
  }
}

TEST(Problem, AContactOutOfReachIsWarnedOf)
{
  for (const bool may_fly : {true, false})
  {
    Stepped found(2, 3);
    found.add<NodeToSurface>(found.law(0), Sliding::small);
    Problem& problem = found.problem();
    if (may_fly)
      problem.allow_flight();
    ASSERT_TRUE(found.solve().converged);
    problem.accept();
    const auto& warnings = problem.report().warnings;
    ASSERT_EQ(warnings.size(), may_fly ? 0 : 1);
    if (not may_fly)
    {
      expect_says(warnings[0],
                  "contact 0 (of sheets) transmits no force: it has no slave "
                  "node within reach of its master; the nearest is ");
      expect_says(warnings[0], "in the reference configuration");
    }
  }
}

TEST(Problem, ARightStiffnessIsNotBlamed)
{
  Stepped found(2);
  found.bulk->bar = 2;
  found.add<NodeToSurface>(found.law(0), Sliding::small);
  found.press(0.09, 0.01);
  Problem& problem = found.problem();
  problem.begin_step();
  std::vector<double> direction(problem.system()->size());
  for (std::size_t i = 0; i < direction.size(); ++i)
    direction[i] = std::sin(static_cast<double>(i));
  const std::vector<double> before = *found.scene.u;
  EXPECT_LT(solve::derivative_error(*problem.system(), direction, 1e-4), 1e-9);
  EXPECT_EQ(*found.scene.u, before);
  EXPECT_EQ(problem.why_slow(direction), "");
  direction.assign(direction.size(), 0);
  EXPECT_EQ(solve::derivative_error(*problem.system(), direction, 1e-4), 0);
}
