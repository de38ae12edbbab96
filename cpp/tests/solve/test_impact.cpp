// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#include "contact_scene.h"
#include "obstacle_scene.h"
#include <contactx/solve/impact.h>

using namespace contactx;
using namespace contactx::contact;
using namespace contactx::solve;
using namespace contactx::tests;

namespace
{
constexpr double dt = 0.25;

template <class>
using Impacts = testing::Test;

using Methods = testing::Types<NodeToSurface, SurfaceToSurface>;
TYPED_TEST_SUITE(Impacts, Methods);

/// Two sheets in contact that have masses and velocities.
struct MovingScene
{
  ContactScene scene;
  std::mt19937 random{11};
  std::shared_ptr<Contact> contact;
  std::vector<double> mass, velocity;
  std::vector<double> before; ///< impulses of the step
  solve::Impact::SolveMass solve = [this](std::span<double> values)
  {
    for (std::size_t j = 0; j < values.size(); ++j)
      values[j] /= mass[j / scene.halo->gdim()];
  };

  explicit MovingScene(int dim) : scene(dim) {}

  /// Pairs the sheets, and closes all nodes that have a pair.
  /// @param[in] push Largest pressure.
  template <class M>
  void start(std::shared_ptr<law::Law> law, double push = 1)
  {
    contact = scene.contact<M>(std::move(law));
    contact->begin_step();
    contact->search();
    contact->update_gap();
    std::uniform_real_distribution<double> one(0, 1);
    law::NodeState& nodes = *contact->nodes();
    const auto paired = contact->master()->paired();
    const int size = nodes.size();
    for (std::int32_t i = 0; i < nodes.num_nodes(); ++i)
    {
      const bool sticks
          = contact->law()->is_tied() or (nodes.is_vector() and i % 2 == 0);
      nodes.status[i] = not paired[i] ? law::open
                        : sticks      ? law::stick
                                      : law::slip;
      for (int k = 0; k < size; ++k)
        nodes.multiplier[size * i + k]
            = push * one(random)
              * (nodes.is_vector() ? nodes.normal[size * i + k] : 1);
    }
    const int g = scene.halo->gdim();
    for (int i = 0; i < scene.halo->num_nodes(); ++i)
    {
      mass.push_back(0.5 + one(random));
      for (int k = 0; k < g; ++k)
        velocity.push_back(one(random) - 0.5);
    }
  }

  double kinetic() const
  {
    double sum = 0;
    for (std::size_t j = 0; j < velocity.size(); ++j)
      sum += 0.5 * mass[j / scene.halo->gdim()] * velocity[j] * velocity[j];
    return sum;
  }

  /// Relative velocities of the slave nodes.
  std::vector<double> relative() const
  {
    const int g = scene.halo->gdim();
    const kernel::Weights w = contact->master()->weights();
    std::vector<double> r(std::size_t(contact->nodes()->num_nodes()) * g, 0);
    for (std::size_t e = 0; e < w.slaves.size(); ++e)
      if (w.slaves[e] < contact->nodes()->num_nodes())
        for (int k = 0; k < g; ++k)
          r[g * w.slaves[e] + k] += w.values[e] * velocity[g * w.nodes[e] + k];
    return r;
  }
};

double along(std::span<const double> v, std::span<const double> normals, int g,
             std::size_t i)
{
  double sum = 0;
  for (int k = 0; k < g; ++k)
    sum += v[g * i + k] * normals[3 * i + k];
  return sum;
}
} // namespace

TYPED_TEST_2D_3D(Impacts, FrictionlessNodesDoNotApproachAndAreNotPulled, dim)
{
  MovingScene s(dim);
  s.start<TypeParam>(std::make_shared<law::Frictionless>());
  const std::vector<double> old = s.velocity;
  const double kinetic = s.kinetic();
  solve::Impact impact(s.scene.halo, {s.contact});
  impact.correct(dt, s.velocity, s.solve);
  EXPECT_LE(s.kinetic(), kinetic);
  const auto r = s.relative();
  const auto normals = s.contact->master()->normals();
  const auto& P = impact.impulses().front();
  int held = 0, left = 0;
  for (std::int32_t i = 0; i < s.contact->nodes()->num_nodes(); ++i)
  {
    const double speed = along(r, normals, dim, i);
    const double pull = along(P, normals, dim, i);
    if (not s.contact->nodes()->closed(i))
    {
      EXPECT_EQ(pull, 0);
      continue;
    }
    EXPECT_GE(pull, -1e-13);
    EXPECT_GE(speed, -1e-12);
    EXPECT_NEAR(pull > 1e-13 ? speed : 0, 0, 1e-12);
    (pull > 1e-13 ? held : left) += 1;
  }
  EXPECT_GT(held, 0);
  EXPECT_GT(left, 0);
  // Impulses of a pair sum to zero
  for (int k = 0; k < dim; ++k)
  {
    double change = 0;
    for (std::size_t i = 0; i < s.mass.size(); ++i)
      change += s.mass[i] * (s.velocity[dim * i + k] - old[dim * i + k]);
    EXPECT_NEAR(change, 0, 1e-12);
  }
}

TYPED_TEST_2D_3D(Impacts, ImpulsesActAsForcesDo, dim)
{
  MovingScene s(dim);
  s.start<TypeParam>(coulomb(s.scene.slaves->owned().size(), 0.3));
  const std::vector<double> old = s.velocity;
  law::NodeState& nodes = *s.contact->nodes();
  const std::vector<double> given = nodes.multiplier;
  solve::Impact impact(s.scene.halo, {s.contact});
  impact.correct(dt, s.velocity, s.solve);
  const auto& P = impact.impulses().front();
  for (std::size_t j = 0; j < P.size(); ++j)
    if (nodes.closed(j / dim))
    {
      nodes.multiplier[j] = P[j] / (dt * nodes.area[j / dim]) - given[j];
      EXPECT_NEAR(impact.corrections().front()[j],
                  dt * nodes.area[j / dim] * nodes.multiplier[j], 1e-13);
    }
  std::vector<double> b(s.velocity.size(), 0);
  s.contact->add_residual(b);
  for (std::size_t j = 0; j < b.size(); ++j)
    EXPECT_NEAR(s.mass[j / dim] * (s.velocity[j] - old[j]), -dt * b[j], 1e-11);
}

TYPED_TEST_2D_3D(Impacts, StickingNodesStopAndFrictionFollowsTheNormalImpulse,
                 dim)
{
  MovingScene s(dim);
  s.start<TypeParam>(coulomb(s.scene.slaves->owned().size(), 0.3), 20);
  law::NodeState& nodes = *s.contact->nodes();
  // Those that slip have a traction along the surface, too
  for (std::int32_t i = 0; i < nodes.num_nodes(); ++i)
    if (nodes.status[i] == law::slip)
    {
      const double p = nodes.pressure(i);
      const double* n = &nodes.normal[dim * i];
      const double size = std::hypot(n[0], n[dim - 1]);
      nodes.multiplier[dim * i] += 0.3 * p * n[dim - 1] / size;
      nodes.multiplier[dim * i + dim - 1] -= 0.3 * p * n[0] / size;
    }
  solve::Impact impact(s.scene.halo, {s.contact});
  impact.correct(dt, s.velocity, s.solve);
  const auto r = s.relative();
  const auto normals = s.contact->master()->normals();
  const auto& P = impact.impulses().front();
  int sticking = 0, slipping = 0;
  for (std::int32_t i = 0; i < nodes.num_nodes(); ++i)
  {
    const double pull = along(P, normals, dim, i);
    double size = 0;
    for (int k = 0; k < dim; ++k)
      size += P[dim * i + k] * P[dim * i + k];
    if (not nodes.closed(i) or size == 0)
      continue;
    if (nodes.status[i] == law::stick)
    {
      for (int k = 0; k < dim; ++k)
        EXPECT_NEAR(r[dim * i + k], 0, 1e-12);
      ++sticking;
    }
    else
    {
      EXPECT_NEAR(along(r, normals, dim, i), 0, 1e-12);
      EXPECT_NEAR(std::sqrt(size - pull * pull), 0.3 * pull, 1e-10);
      ++slipping;
    }
  }
  EXPECT_GT(sticking, 0);
  EXPECT_GT(slipping, 0);
}

TYPED_TEST(Impacts, TiedNodesMayBePulled)
{
  MovingScene s(2);
  s.start<TypeParam>(std::make_shared<law::Tied>());
  solve::Impact impact(s.scene.halo, {s.contact});
  impact.correct(dt, s.velocity, s.solve);
  const auto r = s.relative();
  for (std::size_t j = 0; j < r.size(); ++j)
    if (s.contact->nodes()->closed(j / 2))
    {
      EXPECT_NEAR(r[j], 0, 1e-12);
    }
}

TEST(Impact, WrongArgumentsAreRefused)
{
  MovingScene s(2);
  s.start<NodeToSurface>(std::make_shared<law::Frictionless>());
  EXPECT_REFUSED(solve::Impact(nullptr, {s.contact}));
  EXPECT_REFUSED(solve::Impact(s.scene.halo, {nullptr}));
  solve::Impact impact(s.scene.halo, {s.contact});
  EXPECT_REFUSED(impact.correct(0, s.velocity, s.solve));
  std::vector<double> few(3);
  EXPECT_REFUSED(impact.correct(dt, few, s.solve));
}

TEST(ObstacleMaster, MovementIsThatOfTheObstacle)
{
  const auto plane = std::make_shared<geometry::Plane>(
      std::vector<double>{0, 0}, std::vector<double>{0, 2});
  FacingNodes nodes(*plane, 2);
  for (const bool measures_slip : {false, true})
  {
    plane->place({0, 0}, {0, 2});
    ObstacleMaster master(plane, nodes.slaves, nodes.x, 2, 10, measures_slip);
    master.search(nodes.x, std::vector<std::int8_t>(nodes.n, 1));
    for (const double v : master.movement())
      EXPECT_EQ(v, 0);
    plane->place({0.3, 0.1}, {0, 2});
    const auto moved = master.movement();
    for (int i = 0; i < nodes.n; ++i)
    {
      EXPECT_NEAR(moved[2 * i], measures_slip ? 0.3 : 0, 1e-15);
      EXPECT_NEAR(moved[2 * i + 1], 0.1, 1e-15);
    }
  }
}

TYPED_TEST_2D_3D(Impacts, ArrivalIsTheWayOfNodesThatWereOpen, dim)
{
  MovingScene s(dim);
  s.start<TypeParam>(std::make_shared<law::Frictionless>());
  law::NodeState& nodes = *s.contact->nodes();
  solve::Impact impact(s.scene.halo, {s.contact});
  const std::vector<double> sizes(s.scene.halo->num_owned(), 0.5);
  EXPECT_REFUSED(impact.arrival(s.velocity, sizes));
  // Nothing arrives that was there
  impact.begin_step();
  EXPECT_EQ(impact.arrival(s.velocity, sizes), 0);

  const std::vector<std::int8_t> closed = nodes.status;
  std::int32_t first = 0;
  while (not nodes.closed(first))
    ++first;
  nodes.status[first] = law::open;
  impact.begin_step();
  nodes.status = closed;
  const double way
      = along(s.relative(), s.contact->master()->normals(), dim, first);
  EXPECT_NEAR(impact.arrival(s.velocity, sizes), std::abs(way) / 0.5, 1e-14);

  EXPECT_REFUSED(impact.arrival(s.velocity, {}));
  EXPECT_REFUSED(impact.arrival({}, sizes));
}
