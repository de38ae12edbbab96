// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#include "stepped_bodies.h"
#include <contactx/problem/step_plan.h>
#include <contactx/problem/time_step.h>

using namespace contactx;
using namespace contactx::problem;
using namespace contactx::tests;

namespace
{
constexpr double duration = 0.25, height = 0.05, aside = 0.3, down = -2;

struct Masses final : Inertia
{
  std::span<const double> diagonal() const override { return mass; }
  bool is_lumped() const override { return lumped; }
  std::span<const double> product(std::span<const double> velocity) override
  {
    momentum.resize(velocity.size());
    for (std::size_t i = 0; i < velocity.size(); ++i)
      momentum[i] = mass[i] * velocity[i];
    return momentum;
  }
  void constrain(std::span<const std::int8_t> markers) override
  {
    ++constrained;
    fixed.assign(markers.begin(), markers.end());
  }
  void solve(std::span<double> values) override
  {
    for (std::size_t i = 0; i < values.size(); ++i)
      values[i] = fixed[i] ? 0 : values[i] / mass[i];
  }
  std::optional<double> strain_energy() override { return energy; }
  std::span<const double> loads() override { return load; }

  std::vector<double> mass, momentum, load;
  std::vector<std::int8_t> fixed;
  std::optional<double> energy;
  bool lumped = true;
  int constrained = 0;
};

/// Faces of two squares, one above the other: the nodes 0 and 1 of the slave
/// are above the nodes 2 and 3 of the master.
TwoSheets faces()
{
  TwoSheets sheets(2);
  sheets.x = {0, height,     1, height,     0, 0,  1, 0, //
              0, height + 1, 1, height + 1, 0, -1, 1, -1};
  sheets.slave = {{0, 2}, {0, 1}};
  sheets.master = {{0, 2}, {3, 2}};
  sheets.num_slaves = 2;
  return sheets;
}

/// Two squares whose nodes are masses apart from each other. The upper one
/// comes down on the other within a step.
struct Falling : Stepped
{
  /// @param[in] held Whether the lower one's nodes are prescribed.
  /// @param[in] lift Velocity of the lower one.
  explicit Falling(bool held = false, double lift = 0)
      : Stepped(faces(), {0, 1, 4, 5, 6, 7, 2, 3}, 4),
        inertia(std::make_shared<Masses>())
  {
    has_results = true;
    for (std::int32_t i = 0; i < scene.sheets.num_nodes(); ++i)
    {
      const bool is_upper = i < 2 or i == 4 or i == 5;
      // Faces stay level
      const double m = is_upper ? 1.5 : 0.8;
      inertia->mass.insert(inertia->mass.end(), {m, m});
      velocity.insert(velocity.end(),
                      {held ? 0 : aside, is_upper ? down : lift});
      for (int k = 0; k < 2; ++k)
        if (held and not is_upper)
          prescribe(i, k, k == 1 ? duration * lift : 0);
    }
    add<contact::NodeToSurface>(law(0));
    inertia->load.assign(velocity.size(), 0);
    std::ranges::fill(bulk->size, 0.5);
    inertia->energy = 0.125;
    load();
  }

  /// Masses as springs to where they would go.
  void load()
  {
    for (std::size_t i = 0; i < velocity.size(); ++i)
    {
      bulk->ground[i] = 2 * inertia->mass[i] / (duration * duration);
      bulk->ends[i] = (*scene.u)[i] + duration * velocity[i];
    }
  }

  TimeStep& make(std::optional<double> impact_travel = std::nullopt)
  {
    contactx::problem::Problem& driver = problem();
    step = std::make_shared<TimeStep>(driver.system(), results_of, inertia,
                                      impact_travel);
    attach(driver, step);
    return *step;
  }

  void solve()
  {
    DenseSolver solver(*this);
    problem().solve(solver);
  }

  double mass(std::int32_t node) const { return inertia->mass[2 * node]; }

  std::vector<double> velocity;
  std::shared_ptr<Masses> inertia;
  std::shared_ptr<TimeStep> step;
};

TEST(TimeStep, TwoMassesGoOnTogether)
{
  for (const bool lumped : {true, false})
  {
    Falling s;
    s.inertia->lumped = lumped;
    TimeStep& step = s.make();
    const double kinetic = step.kinetic_energy(s.velocity);
    const std::vector<double> momentum = step.momentum(s.velocity);
    step.begin(duration, s.velocity);
    s.solve();
    double loss = 0, impulse = 0;
    std::vector<double> expected = s.velocity;
    for (std::int32_t i = 0; i < s.scene.sheets.num_slaves; ++i)
    {
      const double a = s.mass(i), b = s.mass(i + 2);
      const double together = a * down / (a + b);
      expected[2 * i + 1] = expected[2 * (i + 2) + 1] = together;
      loss += 0.5 * a * b / (a + b) * down * down;
      impulse += a * (together - down);
    }
    expect_near(step.velocity(), expected, 1e-12);
    const Balance balance = step.balance();
    EXPECT_EQ(balance.dt, duration);
    EXPECT_NEAR(balance.kinetic, kinetic - loss, 1e-12);
    EXPECT_NEAR(balance.contact_loss, loss, 1e-12);
    EXPECT_EQ(balance.work_of_supports, 0);
    EXPECT_EQ(balance.work_of_loads, 0);
    EXPECT_EQ(balance.strain, 0.125);
    EXPECT_EQ(balance.energy(), balance.kinetic + 0.125);
    for (int k = 0; k < 2; ++k)
      EXPECT_NEAR(balance.momentum[k], momentum[k], 1e-12);
    ASSERT_EQ(balance.impulse.size(), 1);
    EXPECT_NEAR(balance.impulse[0][0], 0, 1e-12);
    EXPECT_NEAR(balance.impulse[0][1], impulse, 1e-12);
    EXPECT_EQ(s.inertia->constrained, lumped ? 0 : 1);
    // Moment of momentum about the origin, where nodes are now
    double moment = 0;
    for (std::int32_t i = 0; i < s.scene.sheets.num_nodes(); ++i)
    {
      const double x = s.scene.sheets.x[2 * i] + (*s.scene.u)[2 * i],
                   y = s.scene.sheets.x[2 * i + 1] + (*s.scene.u)[2 * i + 1];
      moment += s.mass(i) * (x * expected[2 * i + 1] - y * expected[2 * i]);
    }
    ASSERT_EQ(balance.angular_momentum.size(), 1);
    EXPECT_NEAR(balance.angular_momentum[0], moment, 1e-11);
    const std::vector<std::string> lines = balance.lines();
    ASSERT_EQ(lines.size(), 2);
    expect_says(lines[0], "time step 0.25: kinetic energy");
  }
}

TEST(TimeStep, MasterThatIsHeldDoesWork)
{
  for (const double lift : {0.0, 0.1})
  {
    Falling s(true, lift);
    TimeStep& step = s.make();
    s.inertia->load[1] = 3;
    const double kinetic = step.kinetic_energy(s.velocity);
    step.begin(duration, s.velocity);
    s.solve();
    for (const std::int32_t i : {0, 1, 2, 3, 6, 7})
      EXPECT_NEAR(step.velocity()[2 * i + 1], lift, 1e-12);
    for (const std::int32_t i : {4, 5})
      EXPECT_NEAR(step.velocity()[2 * i + 1], down, 1e-12);
    const Balance balance = step.balance();
    double impulse = 0;
    for (std::int32_t i = 0; i < s.scene.sheets.num_slaves; ++i)
      impulse += s.mass(i) * (lift - down);
    EXPECT_NEAR(balance.impulse[0][1], impulse, 1e-12);
    EXPECT_NEAR(balance.kinetic - kinetic,
                balance.work_of_supports - balance.contact_loss, 1e-12);
    EXPECT_NEAR(balance.work_of_loads, 3 * (duration * lift - height), 1e-12);
    if (lift == 0)
    {
      EXPECT_NEAR(balance.contact_loss,
                  0.5 * (s.mass(0) + s.mass(1)) * down * down, 1e-12);
      EXPECT_NEAR(balance.work_of_supports, 0, 1e-12);
    }
  }
}

TEST(TimeStep, NodesThatComeTooFarAreRefused)
{
  Falling s;
  TimeStep& step = s.make(0.05);
  const auto before = s.state();
  step.begin(duration, s.velocity);
  EXPECT_EQ(refusal<ConvergenceError>([&] { s.solve(); }),
            "a node moved by 0.1 of a cell to what it hits, further than "
            "impact_travel = 0.05: take shorter steps (manual: "
            "errors/impact-travel)");
  EXPECT_FALSE(s.problem().report().converged);
  EXPECT_TRUE(step.velocity().empty());
  const auto after = s.state();
  ASSERT_EQ(after.size(), before.size());
  EXPECT_EQ(std::get<std::vector<double>>(after[0][0].values),
            std::get<std::vector<double>>(before[0][0].values));
  // One that may come that far
  Falling t;
  t.make(0.11).begin(duration, t.velocity);
  t.solve();
  EXPECT_TRUE(t.problem().report().converged);
}

TEST(TimeStep, NothingIsSaidOfBodiesThatFly)
{
  Falling s;
  for (std::size_t i = 1; i < s.velocity.size(); i += 2)
    s.velocity[i] = 0;
  s.load();
  TimeStep& step = s.make();
  step.begin(duration, s.velocity);
  s.solve();
  EXPECT_EQ(step.velocity(), s.velocity);
  EXPECT_EQ(step.balance().contact_loss, 0);
  EXPECT_TRUE(s.problem().report().warnings.empty());
}

TEST(TimeStep, WrongArgumentsAreRefused)
{
  Falling s;
  TimeStep& step = s.make();
  const auto& system = s.problem().system();
  EXPECT_REFUSED(TimeStep(nullptr, s.results_of, s.inertia));
  EXPECT_REFUSED(TimeStep(system, {}, s.inertia));
  EXPECT_REFUSED(TimeStep(system, {nullptr}, s.inertia));
  EXPECT_REFUSED(TimeStep(system, s.results_of, nullptr));
  EXPECT_REFUSED(TimeStep(system, s.results_of, s.inertia, 0.0));
  EXPECT_REFUSED(step.begin(0, s.velocity));
  EXPECT_REFUSED(step.begin(duration, {}));
  std::vector<double> bad = s.velocity;
  bad[2] = NAN;
  EXPECT_REFUSED(step.begin(duration, bad));
  EXPECT_THROW(step.end(), std::logic_error);
  for (const double mass : {0.0, -1.0, double(INFINITY)})
  {
    s.inertia->mass[3] = mass;
    EXPECT_REFUSED(TimeStep(system, s.results_of, s.inertia));
  }
  s.inertia->mass.clear();
  EXPECT_REFUSED(TimeStep(system, s.results_of, s.inertia));
}

/// All t that are attempted, failed ones negative, until the end or the last
/// failure.
std::vector<double> walk(StepPlan plan,
                         const std::function<bool(double, double)>& fails,
                         int iterations = 5, int lost = 5)
{
  std::vector<double> tried;
  while (not plan.finished())
  {
    const double t = plan.next();
    const bool failed = fails(plan.t(), t);
    tried.push_back(failed ? -t : t);
    if (not failed)
      plan.accept(iterations);
    else if (not plan.cut(lost))
      break;
  }
  return tried;
}

TEST(StepPlan, AFailedStepIsHalvedAndGrowsBackOnceItIsMadeUpFor)
{
  const StepPlan plan(StepPlan::equal(2));
  EXPECT_EQ(walk(plan, [](double, double) { return true; }),
            (std::vector{-0.5, -0.25, -0.125, -0.0625, -0.03125, -0.015625,
                         -0.0078125}));
  const auto at_start
      = [](double start, double t) { return start == 0 and t > 0.1; };
  EXPECT_EQ(walk(plan, at_start), (std::vector{-0.5, -0.25, -0.125, 0.0625,
                                               0.1875, 0.4375, 0.5, 1.0}));
  // A failure that cost as much as six steps
  EXPECT_EQ(walk(plan, at_start, 5, 30),
            (std::vector{-0.5, -0.25, -0.125, 0.0625, 0.125, 0.1875, 0.25,
                         0.3125, 0.375, 0.5, 0.75, 1.0}));
  // Or after easy ones, where a user says what these are
  const StepPlan easy(StepPlan::equal(2), 6, 10);
  EXPECT_EQ(walk(easy, at_start, 5, 30),
            (std::vector{-0.5, -0.25, -0.125, 0.0625, 0.125, 0.25, 0.5, 1.0}));
  EXPECT_EQ(walk(easy, at_start, 11).size(), 3 + 16u);
}

TEST(StepPlan, AnAttemptMayCostWhatStepsBesideItDo)
{
  StepPlan plan(StepPlan::equal(2), 1);
  // Nothing to measure it against
  EXPECT_FALSE(plan.attempt().budget);
  plan.accept(10);
  const auto next = plan.attempt();
  EXPECT_EQ(next.start, 0.5);
  EXPECT_EQ(next.end, 1);
  EXPECT_EQ(next.budget, 40);
  // No shorter one follows
  plan.cut(40);
  EXPECT_FALSE(plan.attempt().budget);
}

TEST(StepPlan, GivenTAreMetExactly)
{
  const std::vector<double> given{0.1, 0.3, 0.7};
  const auto tried = walk(StepPlan(given), [](double start, double t)
                          { return t - start > 0.07; });
  for (const double t : given)
    EXPECT_NE(std::ranges::find(tried, t), tried.end());
}

TEST(StepPlan, ASavedPlaceIsGoneOnFrom)
{
  StepPlan plan(StepPlan::equal(4));
  plan.cut(7);
  plan.accept(5);
  StepPlan other(StepPlan::equal(4));
  other.load(plan.given(), plan.place());
  EXPECT_EQ(other, plan);
  StepPlan finer({0.05, 0.2, 1});
  finer.load(plan.given(), plan.place());
  EXPECT_EQ(finer.t(), 0.125);
  EXPECT_EQ(finer.next(), 0.2);
  StepPlan shorter({0.1});
  EXPECT_REFUSED(shorter.load(plan.given(), plan.place()));
  EXPECT_EQ(shorter.t(), 0);
}

TEST(StepPlan, WhatDoesNotFitIsRefused)
{
  EXPECT_REFUSED(StepPlan({}));
  EXPECT_REFUSED(StepPlan({0, 1}));
  EXPECT_REFUSED(StepPlan({0.5, 0.5}));
  EXPECT_REFUSED(StepPlan({1}, -1));
  EXPECT_REFUSED(StepPlan({1}, 41));
  EXPECT_REFUSED(StepPlan({1}, 6, -1));
  EXPECT_REFUSED(StepPlan::equal(0));
}
} // namespace
