// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#include "spring_bodies.h"
#include <contactx/solve/interior_point.h>

using namespace contactx;
using namespace contactx::contact;
using namespace contactx::solve;
using namespace contactx::tests;

namespace
{
/// Bodies of springs on the path of an interior point, with dense algebra.
struct OnPath : SpringBodies
{
  using SpringBodies::SpringBodies;

  void begin()
  {
    system = SpringBodies::system();
    path = std::make_unique<InteriorPoint>(system);
    for (const auto& c : contacts)
    {
      c->begin_step();
      c->set_factor(std::vector<double>(scene.sheets.num_nodes(), 1.0 / 3));
      c->search();
      c->update_gap();
      c->update_status(true);
    }
    system->take_factors();
    path->begin_step(false);
    b.resize(system->size());
  }

  std::vector<double> solution()
  {
    system->residual(b);
    return tests::solution(jacobian(*system), b);
  }

  void take(std::span<const double> dx, double part) { go(*system, dx, part); }

  void update()
  {
    for (const auto& c : contacts)
    {
      c->search();
      c->update_gap();
    }
  }

  /// The first steps of an active set, which show the scales.
  void look()
  {
    for (int k = 0; k < 2; ++k)
    {
      const std::vector<double> dx = solution();
      path->note(dx);
      take(dx, 1);
      update();
      for (const auto& c : contacts)
        c->update_status(false);
    }
  }

  /// The slave pressed down and aside, and what `look` shows of it.
  void begin_pressed(double down, double aside, double friction,
                     Sliding sliding = Sliding::finite)
  {
    press(down, aside);
    add<NodeToSurface>(law(friction), sliding);
    begin();
    look();
  }

  /// Residual of the displacements, over the forces.
  double residual()
  {
    system->residual(b);
    double sum = 0, force = 0;
    const auto bulk_residual = system->bulk_residual();
    for (std::size_t i = 0; i < system->num_displacements(); ++i)
    {
      if (not bulk->fixed[i])
        sum += b[i] * b[i];
      force += bulk_residual[i] * bulk_residual[i];
    }
    return std::sqrt(sum / force);
  }

  /// One iterate: predictor and corrector.
  void step()
  {
    EXPECT_TRUE(path->is_predictor());
    path->correct(solution());
    EXPECT_FALSE(path->is_predictor());
    const std::vector<double> dx = solution();
    const double part = path->limit(dx);
    EXPECT_GT(part, 0);
    EXPECT_LE(part, 1);
    take(dx, part);
    path->take();
    update();
    path->predict();
  }

  /// Iterate until an active set shows; the number of iterates.
  int solve()
  {
    path->start();
    update();
    path->predict();
    for (int k = 1; k <= 40; ++k)
    {
      step();
      if (path->may_end(residual()))
      {
        path->leave();
        return k;
      }
    }
    return 0;
  }

  std::vector<std::int8_t> status() const
  {
    return contacts[0]->nodes()->status;
  }

  std::shared_ptr<System> system;
  std::unique_ptr<InteriorPoint> path;
  std::vector<double> b;
};

/// Status that plain iterates of the active set end with.
std::vector<std::int8_t> exact(int dim, double friction)
{
  OnPath found(dim);
  found.bulk->bar = 0.2;
  found.press(0.2, 0.02);
  found.add<NodeToSurface>(found.law(friction), Sliding::small);
  found.begin();
  for (int k = 0; k < 30; ++k)
  {
    found.take(found.solution(), 1);
    found.update();
    if (found.contacts[0]->update_status(false) == 0 and k > 3)
      break;
  }
  return found.status();
}

TEST_2D_3D(InteriorPoint, ShowsTheActiveSetOfTheSolution, dim)
{
  for (const double friction : {0.0, 0.3})
  {
    SCOPED_TRACE(std::to_string(dim) + "D, " + std::to_string(friction));
    OnPath found(dim);
    found.bulk->bar = 0.2;
    found.begin_pressed(0.2, 0.02, friction, Sliding::small);
    const int iterates = found.solve();
    EXPECT_GT(iterates, 1);
    EXPECT_LE(iterates, 15);
    EXPECT_TRUE(found.path->is_trial());
    EXPECT_FALSE(found.contacts[0]->nodes()->interior);
    EXPECT_EQ(found.status(), exact(dim, friction));
    EXPECT_TRUE(std::ranges::any_of(found.status(),
                                    [](auto s) { return s != law::open; }));
  }
}

TEST(InteriorPoint, SlacksAndTractionsStayInsideTheirCones)
{
  OnPath found(3);
  found.begin_pressed(0.1, 0.05, 0.3);
  found.path->start();
  found.update();
  found.path->predict();
  const law::NodeState& nodes = *found.contacts[0]->nodes();
  for (int k = 0; k < 8; ++k)
  {
    found.step();
    const law::Interior& in = *nodes.interior;
    for (std::size_t i = 0; i < in.is_on.size(); ++i)
    {
      if (not in.is_on[i])
        continue;
      const auto length = [i](const std::vector<double>& v)
      { return math::column(std::span(v).subspan(3 * i, 3)).norm(); };
      EXPECT_GT(in.pressure[i], 0);
      EXPECT_GT(in.slack[i], 0);
      EXPECT_GT(in.bound[i], length(in.traction));
      EXPECT_GT(in.slip_length[i], length(in.slip));
      EXPECT_NEAR(nodes.pressure(i), in.pressure[i], 1e-9 * in.pressure[i]);
    }
  }
}

TEST(InteriorPoint, ATrialThatChangesMuchIsTakenBackAndOneThatFailsEndsThePath)
{
  OnPath found(2);
  found.begin_pressed(0.2, 0.02, 0.3);
  std::vector<double> before(found.system->size());
  found.system->unknowns(before);
  ASSERT_GT(found.solve(), 0);
  std::vector<double> now(before.size());
  EXPECT_FALSE(found.path->is_refused(1, 100));
  EXPECT_TRUE(found.path->is_refused(50, 100));
  found.take(std::vector<double>(before.size(), 1e-3), 1);
  found.path->resume();
  EXPECT_TRUE(found.path->is_on());
  EXPECT_TRUE(found.contacts[0]->nodes()->interior);
  found.update();
  found.path->predict();
  // Not at the same iterate again
  EXPECT_FALSE(found.path->may_end(0));
  found.path->give_up();
  EXPECT_FALSE(found.path->is_on());
  EXPECT_FALSE(found.contacts[0]->nodes()->interior);
  found.system->unknowns(now);
  EXPECT_EQ(now, before);
}

TEST(InteriorPoint, BeginsWhereTheActiveSetHasMoreToGoThanAPathTakes)
{
  OnPath found(2);
  found.add<NodeToSurface>(found.law(0));
  found.begin();
  InteriorPoint& path = *found.path;
  const auto begins = [&](std::initializer_list<int> changes, int closed = 100)
  {
    path.begin_step(false);
    bool does = false;
    for (const int n : changes)
      does = path.begins({n, 0, n}, closed, 1);
    return does;
  };
  // The rate of 20 nodes in 12 iterates
  EXPECT_FALSE(begins({100}));
  EXPECT_FALSE(begins({100, 60}));
  EXPECT_TRUE(begins({100, 80}));
  EXPECT_FALSE(begins({100, 60, 36}));
  EXPECT_TRUE(begins({100, 60, 70}));
  // Over three iterates
  EXPECT_FALSE(begins({100, 60, 40, 20}));
  EXPECT_TRUE(begins({100, 60, 30, 12, 30}));
  // One iterate that changes many, and those that follow it
  EXPECT_FALSE(begins({18, 2, 0, 2, 14}, 62));
  EXPECT_FALSE(begins({18, 2, 0, 2, 14, 9, 5}, 62));
  // Few nodes that change, or that are closed
  EXPECT_FALSE(begins({2, 2}));
  EXPECT_FALSE(begins({30, 30}, 36));
  EXPECT_TRUE(begins({30, 30}, 37));
  // Nodes that change between stick and slip do not count
  path.begin_step(false);
  EXPECT_FALSE(path.begins({100, 0, 0}, 100, 1)
               or path.begins({100, 0, 0}, 100, 1));
  // Any that change for long
  EXPECT_TRUE(begins({9, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1}));
  EXPECT_FALSE(begins({9, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 0}));
  path.begin_step(true);
  EXPECT_FALSE(path.begins({100, 0, 100}, 100, 1)
               or path.begins({100, 0, 100}, 100, 1));
}

} // namespace
