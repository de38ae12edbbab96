// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#include "contact_scene.h"

using namespace contactx;
using namespace contactx::contact;
using namespace contactx::tests;

namespace
{
template <class>
using Contacts = testing::Test;

using Methods = testing::Types<NodeToSurface, SurfaceToSurface>;
TYPED_TEST_SUITE(Contacts, Methods);

/// A random state in the middle of a step.
void spoil(ContactScene& scene, Contact& contact, std::mt19937& random)
{
  scene.shake(random, 0.01);
  contact.search();
  contact.update_gap();
  contact.accept();
  contact.begin_step();
  scene.shake(random, 0.01);
  contact.search();
  contact.update_gap();
  law::NodeState& nodes = *contact.nodes();
  std::uniform_real_distribution<double> one(0, 1);
  const int size = nodes.size();
  for (std::int32_t i = 0; i < nodes.num_nodes(); ++i)
  {
    nodes.status[i] = static_cast<std::int8_t>(i % 3);
    nodes.c[i] = 1 + one(random);
    for (int k = 0; k < size; ++k)
      nodes.multiplier[size * i + k] = one(random) - 0.5;
    nodes.multiplier[size * i + size - 1] = 1 + one(random);
  }
  if (not nodes.is_vector())
    for (auto& s : nodes.status)
      s = s == law::open ? law::open : law::slip;
  if (contact.law()->is_tied())
    for (auto& s : nodes.status)
      s = law::stick;
}

/// Compares the Jacobian with central differences of the residual.
void expect_derivative(ContactScene& scene,
                       const std::shared_ptr<Contact>& contact)
{
  const std::vector<std::shared_ptr<Contact>> contacts{contact};
  std::vector<double>& u = *scene.u;
  std::vector<double>& m = contact->nodes()->multiplier;
  residual(contacts);
  const condense::ContactBlock J(contacts, {});
  ASSERT_EQ(J.size(), u.size() + m.size());
  double largest = 0;
  for (const double v : J.entries().values)
    largest = std::max(largest, std::abs(v));
  const double h = 1e-6;
  std::vector<double> direction(J.size(), 0);
  for (std::size_t j = 0; j < J.size(); ++j)
  {
    double& unknown = j < u.size() ? u[j] : m[j - u.size()];
    const double before = unknown;
    unknown = before + h;
    const std::vector<double> after = residual(contacts);
    unknown = before - h;
    std::vector<double> difference = residual(contacts);
    unknown = before;
    for (std::size_t i = 0; i < difference.size(); ++i)
      difference[i] = (after[i] - difference[i]) / (2 * h);
    direction[j] = 1;
    const std::vector<double> column = J.multiply(direction);
    direction[j] = 0;
    for (std::size_t i = 0; i < column.size(); ++i)
      ASSERT_NEAR(column[i], difference[i], 1e-7 * largest)
          << "row " << i << ", column " << j;
  }
}
} // namespace

TYPED_TEST(Contacts, TheJacobianIsTheDerivativeOfTheResidual)
{
  std::mt19937 random(3);
  for (int dim : {2, 3})
    for (const Sliding sliding : {Sliding::finite, Sliding::small})
      for (const bool has_friction : {false, true})
      {
        ContactScene scene(dim);
        std::shared_ptr<law::Law> law = std::make_shared<law::Frictionless>();
        if (has_friction)
          law = coulomb(scene.sheets.num_slaves, 0.4);
        const auto contact
            = scene.template contact<TypeParam>(std::move(law), sliding);
        spoil(scene, *contact, random);
        expect_derivative(scene, contact);
      }
}

TYPED_TEST(Contacts, NothingHasSlippedInSmallSlidingAtAStepsStart)
{
  constexpr double away = 1 << 20;
  constexpr double eps = std::numeric_limits<double>::epsilon();
  std::mt19937 random(6);
  for (int dim : {2, 3})
  {
    TwoSheets sheets(dim, 0.05);
    for (double& x : sheets.x)
      x += away;
    ContactScene scene(sheets);
    const auto contact = scene.template contact<TypeParam>(
        coulomb(scene.sheets.num_slaves, 0.4), Sliding::small);
    scene.shake(random, 0.01);
    contact->accept();
    contact->begin_step();
    contact->update_gap();
    for (const double slip : contact->nodes()->slip)
      EXPECT_LE(std::abs(slip), 16 * eps);
  }
}

TEST(Ties, TheJacobianIsTheDerivativeOfTheResidual)
{
  std::mt19937 random(4);
  for (int dim : {2, 3})
    for (const Sliding sliding : {Sliding::finite, Sliding::small})
    {
      ContactScene scene(dim);
      for (const auto& contact :
           {scene.contact<NodeTie>(std::make_shared<law::Tied>(), sliding),
            scene.contact<SurfaceTie>(std::make_shared<law::Tied>(), sliding)})
      {
        spoil(scene, *contact, random);
        expect_derivative(scene, contact);
      }
    }
}

TYPED_TEST(Contacts, ForcesAndMomentsOfItsPairsSumToZero)
{
  std::mt19937 random(5);
  for (int dim : {2, 3})
  {
    ContactScene scene(dim);
    const auto contact = scene.template contact<TypeParam>();
    spoil(scene, *contact, random);
    contact->update_gap();
    std::vector<double> b(scene.u->size(), 0);
    contact->add_residual(b);
    const std::vector<double> x = scene.halo->now()->x;
    double largest = 0;
    Vector<3> sum{}, moment{};
    for (std::int32_t i = 0; i < scene.sheets.num_nodes(); ++i)
    {
      const Vector<3> f = vector_at(b, i, dim);
      largest = std::max(largest, norm(f));
      sum = sum + f;
      moment = moment + cross(vector_at(x, i, dim), f);
    }
    ASSERT_GT(largest, 0.01);
    for (int k = 0; k < 3; ++k)
    {
      EXPECT_NEAR(sum[k], 0, 1e-13);
      // Mean normals are not along the way to the master
      const bool is_exact = std::is_same_v<TypeParam, NodeToSurface>;
      EXPECT_NEAR(is_exact ? moment[k] : 0.0, 0, 1e-13);
    }
  }
}

TYPED_TEST_2D_3D(Contacts, GapsAreHeightsLessWhatIsTakenOff, dim)
{
  ContactScene scene(dim, 0.05);
  std::vector<std::int8_t> shared(scene.sheets.num_nodes(), 0);
  shared[1] = 1;
  const auto contact = scene.template contact<TypeParam>(
      std::make_shared<law::Frictionless>(), Sliding::finite, shared);
  const std::int32_t n = scene.sheets.num_slaves;
  const std::vector<double>& gap = contact->nodes()->gap;
  const auto expect = [&](double expected)
  {
    contact->update_gap();
    for (std::int32_t i = 0; i < n; ++i)
    {
      if (i == 1)
        EXPECT_TRUE(std::isnan(gap[i]));
      else
        EXPECT_NEAR(gap[i], expected, 1e-14);
    }
  };
  expect(0.05);
  // The slave comes down
  scene.put_slave(0, -0.02);
  expect(0.03);
  contact->set_offset(std::vector<double>(n, 0.01));
  expect(0.02);
  contact->set_active(false);
  contact->update_gap();
  for (const double g : gap)
    EXPECT_TRUE(std::isnan(g));
  contact->set_active(true);
  expect(0.02);
  EXPECT_REFUSED(contact->set_offset(std::vector<double>(n + 1, 0)));
}

TYPED_TEST_2D_3D(Contacts, AdjustedGapsCountAsNone, dim)
{
  for (const Sliding sliding : {Sliding::finite, Sliding::small})
  {
    // Slave nodes are 0.05 above the master
    ContactScene scene(dim);
    const auto contact = [&](std::shared_ptr<law::Law> law, double adjust)
    {
      return scene.template contact<TypeParam>(std::move(law), sliding, {},
                                               adjust);
    };
    const auto frictionless = std::make_shared<law::Frictionless>();
    const std::int32_t n = scene.sheets.num_slaves;
    for (const double adjust : {0.06, 0.04})
    {
      const double taken = adjust > 0.05 ? 0.05 : 0;
      const auto one = contact(frictionless, adjust);
      const auto expect = [&](double gap)
      {
        one->update_gap();
        for (std::int32_t i = 0; i < n; ++i)
        {
          EXPECT_NEAR(one->adjusted()[i], taken, 1e-14);
          EXPECT_NEAR(one->nodes()->gap[i], gap, 1e-14);
        }
      };
      expect(0.05 - taken);
      // An offset comes on top
      one->set_offset(std::vector<double>(n, 0.01));
      expect(0.04 - taken);
      // What the bodies move by is a gap
      scene.put_slave(0, 0.02);
      expect(0.06 - taken);
      std::ranges::fill(*scene.u, 0);
    }
    EXPECT_REFUSED(contact(frictionless, -1));
    EXPECT_REFUSED(contact(frictionless, INFINITY));
  }
}

TYPED_TEST(Contacts, FrozenKinematicsAreLinear)
{
  std::mt19937 random(6);
  for (int dim : {2, 3})
  {
    ContactScene scene(dim);
    const auto contact = scene.template contact<TypeParam>();
    scene.shake(random, 0.01);
    contact->search();
    const std::int64_t version = contact->version();
    contact->freeze(true);
    EXPECT_EQ(contact->kinematics(), Sliding::small);
    EXPECT_GT(contact->version(), version);
    const int skipped = contact->skipped_searches();
    EXPECT_EQ(contact->search(), 0);
    EXPECT_EQ(contact->skipped_searches(), skipped + 1);
    EXPECT_TRUE(contact->block("stiffness").values.empty());
    // Gaps along a straight way: the middle one is the mean
    std::vector<std::vector<double>> gaps;
    const std::vector<double> from = *scene.u;
    scene.shake(random, 0.02);
    const std::vector<double> to = *scene.u;
    for (const double t : {0.0, 0.5, 1.0})
    {
      for (std::size_t k = 0; k < to.size(); ++k)
        (*scene.u)[k] = (1 - t) * from[k] + t * to[k];
      contact->update_gap();
      gaps.push_back(contact->nodes()->gap);
    }
    for (std::size_t i = 0; i < gaps[0].size(); ++i)
      EXPECT_NEAR(gaps[1][i], (gaps[0][i] + gaps[2][i]) / 2, 1e-14);
    contact->freeze(false);
    EXPECT_EQ(contact->kinematics(), Sliding::finite);
    EXPECT_FALSE(contact->block("stiffness").values.empty());
  }
}

TYPED_TEST(Contacts, TermsAreThoseOfChosenSlaveNodes)
{
  ContactScene scene(3);
  const auto contact = scene.template contact<TypeParam>();
  law::NodeState& nodes = *contact->nodes();
  contact->update_gap();
  std::ranges::fill(nodes.status, law::open);
  nodes.status[2] = law::slip;
  std::ranges::fill(nodes.multiplier, 1.0);
  std::ranges::fill(nodes.c, 1.0);
  contact->law()->evaluate(nodes);
  const std::vector<std::shared_ptr<Contact>> contacts{contact};
  const std::size_t n = nodes.num_nodes();
  std::vector<double> d(n, 0);
  d[4] = 1;
  const condense::ContactBlock all(contacts, {}), some(contacts, {}, false, d);
  // Multipliers that may differ from zero act as in the whole
  std::vector<double> x(all.size(), 0);
  x[scene.u->size() + 2] = x[scene.u->size() + 4] = 1;
  EXPECT_EQ(some.multiply(x), all.multiply(x));
  EXPECT_LT(some.entries().values.size(), all.entries().values.size());
  // Nothing acts on, or comes from, a displacement that is prescribed
  std::vector<std::int8_t> prescribed(scene.u->size(), 0);
  const std::size_t down = 3 * 2 + 2;
  prescribed[down] = 1;
  const condense::ContactBlock rest(contacts, prescribed);
  std::vector<double> y(all.size(), 1);
  EXPECT_NE(all.multiply(y)[down], 0);
  EXPECT_EQ(rest.multiply(y)[down], 0);
  EXPECT_REFUSED(
      condense::ContactBlock(contacts, {}, false, std::vector<double>(1)));
}

/// A contact with friction at the start of a step, with factors c of one.
template <class T>
auto started(ContactScene& scene)
{
  const auto contact
      = scene.template contact<T>(coulomb(scene.sheets.num_slaves, 0.5));
  contact->begin_step();
  contact->search();
  contact->update_gap();
  contact->update_status(true);
  std::ranges::fill(contact->nodes()->c, 1.0);
  return contact;
}

TYPED_TEST_2D_3D(Contacts, SlipIsMeasuredFromWhereANodeTouches, dim)
{
  ContactScene scene(dim, 0.1);
  const auto contact = started<TypeParam>(scene);
  // Down by twice the gap, aside by 0.04: it touches on half the way
  scene.put_slave(0.04, -0.2);
  contact->search();
  contact->update_gap();
  for (std::int32_t i = 0; i < scene.sheets.num_slaves; ++i)
    EXPECT_NEAR(contact->nodes()->slip[dim * i], 0.04, 1e-13);
  EXPECT_EQ(contact->update_status(false), scene.sheets.num_slaves);
  for (std::int32_t i = 0; i < scene.sheets.num_slaves; ++i)
    EXPECT_NEAR(contact->nodes()->slip[dim * i], 0.02, 1e-13);
  // The residual asks again, and finds the same
  contact->update_gap();
  EXPECT_NEAR(contact->nodes()->slip[0], 0.02, 1e-13);
  // It opens and closes once more: what counts is where it first touched
  scene.put_slave(0.08, -0.2);
  std::ranges::fill(contact->nodes()->status, law::open);
  contact->update_gap();
  EXPECT_EQ(contact->update_status(false), scene.sheets.num_slaves);
  for (std::int32_t i = 0; i < scene.sheets.num_slaves; ++i)
    EXPECT_NEAR(contact->nodes()->slip[dim * i], 0.06, 1e-13);
}

TYPED_TEST_2D_3D(Contacts, WhatClosesAfterTheFirstIterateSlipsFromTheStart, dim)
{
  ContactScene scene(dim, 0.1);
  const auto contact = started<TypeParam>(scene);
  // The first iterate comes half as near, the second one through
  for (const auto& [aside, down] : {std::pair{0.04, 0.05}, {0.08, 0.2}})
  {
    scene.put_slave(aside, -down);
    contact->search();
    contact->update_gap();
    EXPECT_EQ(contact->update_status(false),
              down > 0.1 ? scene.sheets.num_slaves : 0);
    for (std::int32_t i = 0; i < scene.sheets.num_slaves; ++i)
      EXPECT_NEAR(contact->nodes()->slip[dim * i], aside, 1e-13);
  }
}

TYPED_TEST_2D_3D(Contacts, WhatTouchesButForRoundingClosesAtTheStart, dim)
{
  for (const double gap : {5e-13, 1e-9})
  {
    ContactScene scene(dim, 0.0);
    const auto contact = scene.template contact<TypeParam>();
    scene.put_slave(0, gap);
    contact->begin_step();
    contact->search();
    contact->update_gap();
    const std::int32_t closes = gap < 1e-12 ? scene.sheets.num_slaves : 0;
    EXPECT_EQ(contact->update_status(true), closes);
    // Nothing presses, so they open in the iterates that follow
    EXPECT_EQ(contact->update_status(false), closes);
    EXPECT_EQ(contact->nodes()->status,
              std::vector<std::int8_t>(scene.sheets.num_slaves, law::open));
  }
}

TYPED_TEST_2D_3D(Contacts, WhereNothingPressesYetNodesStick, dim)
{
  for (const double pressure : {0.0, 1e-3})
    for (const bool is_first : {true, false})
    {
      ContactScene scene(dim, 0.0);
      const std::int32_t n = scene.sheets.num_slaves;
      const auto contact = scene.template contact<TypeParam>(coulomb(n, 0.5));
      contact->begin_step();
      contact->search();
      contact->update_gap();
      law::NodeState& nodes = *contact->nodes();
      std::ranges::fill(nodes.c, 1.0);
      // Aside by more than friction takes
      scene.put_slave(0.02, -0.01);
      for (std::int32_t i = 0; i < n; ++i)
        nodes.multiplier[dim * i + dim - 1] = pressure;
      contact->search();
      contact->update_gap();
      contact->update_status(is_first);
      const std::int8_t expected
          = is_first and pressure == 0 ? law::stick : law::slip;
      EXPECT_EQ(nodes.status, std::vector<std::int8_t>(n, expected));
    }
}

TEST(Contact, WhatHardlyMovesAlongAnAxisHasNoFrictionThere)
{
  // All nodes on rails along y but for one of the master
  ContactScene scene(2, 0.05);
  const std::int32_t n = scene.sheets.num_slaves;
  std::int32_t free = n;
  for (std::int32_t i = n; i < scene.sheets.num_nodes(); ++i)
    if (std::abs(scene.sheets.x[2 * i] - 0.8)
        < std::abs(scene.sheets.x[2 * free] - 0.8))
      free = i;
  for (std::int32_t i = 0; i < scene.sheets.num_nodes(); ++i)
    scene.prescribed[2 * i] = i != free;
  const auto contact = scene.contact<NodeToSurface>(coulomb(n, 0.5));
  const double aside = -0.34 / 3;
  scene.put_slave(aside, 0);
  contact->search();
  contact->accept();
  contact->begin_step();
  contact->search();
  const law::NodeState& nodes = *contact->nodes();
  int hardly = 0, moving = 0;
  for (std::int32_t i = 0; i < n; ++i)
  {
    // What the node that is free weighs in the place under the slave node
    const double x = scene.sheets.x[2 * i] + aside;
    const double weight = std::max(1 - std::abs(x - 0.8) / 0.6, 0.0);
    EXPECT_EQ(nodes.mobile[2 * i], weight < 0.05 ? 0 : 1);
    EXPECT_EQ(nodes.mobile[2 * i + 1], 1);
    EXPECT_EQ(nodes.immobile[i], 0);
    hardly += weight > 0 and nodes.mobile[2 * i] == 0;
    moving += nodes.mobile[2 * i] == 1;
  }
  EXPECT_GT(hardly, 0);
  EXPECT_GT(moving, 0);
}

TEST(Contact, ASlaveNodeThatIsHeldWhereItsFacetsMoveHasNoConstraint)
{
  // Integrals over its facets move with the nodes beside it. One that is held
  // along a master that moves is pushed along it: there is friction
  ContactScene scene(2, 0.05);
  const std::int32_t n = scene.sheets.num_slaves, held = 1;
  for (const int axis : {0, 1})
    for (const bool cuts_master : {false, true})
      for (const bool alone : {true, false})
      {
        scene.prescribed.assign(scene.u->size(), 0);
        for (std::int32_t i = 0; i < scene.sheets.num_nodes(); ++i)
          scene.prescribed[2 * i + axis]
              = i < n ? i == held or not alone : cuts_master and alone;
        const auto contact = scene.contact<SurfaceToSurface>(coulomb(n, 0.5));
        const law::NodeState& nodes = *contact->nodes();
        for (std::int32_t i = 0; i < n; ++i)
        {
          // If all of them are held, the master moves
          const bool drops = alone and i == held;
          EXPECT_EQ(nodes.mobile[2 * i + axis],
                    not(drops and (cuts_master or axis == 1)));
          EXPECT_EQ(nodes.mobile[2 * i + 1 - axis], 1);
          EXPECT_EQ(nodes.immobile[i], axis == 1 and drops);
        }
      }
}

TEST(Contact, AGuideAcrossASlopeIsNoPlaneOfSymmetry)
{
  for (const bool cuts_master : {false, true})
  {
    ContactScene scene(2, 0.05);
    const std::int32_t n = scene.sheets.num_slaves, held = 1;
    for (std::int32_t i = 0; i < scene.sheets.num_nodes(); ++i)
    {
      (*scene.u)[2 * i + 1] = 0.5 * scene.sheets.x[2 * i];
      scene.prescribed[2 * i] = i == held or (cuts_master and i >= n);
    }
    const auto contact = scene.contact<SurfaceToSurface>(coulomb(n, 0.5));
    contact->begin_step();
    contact->search();
    EXPECT_EQ(contact->nodes()->mobile[2 * held], not cuts_master);
    EXPECT_EQ(contact->nodes()->mobile[2 * held + 1], 1);
    EXPECT_EQ(contact->nodes()->immobile[held], 0);
  }
}

TEST(Contact, WhatCannotMoveAlongTheNormalStaysOpen)
{
  // On a master with a slope normals are not along an axis but for rounding
  for (const double slope : {0.0, 1e-10, 1e-3})
  {
    ContactScene scene(2, 0.0);
    const std::int32_t n = scene.sheets.num_slaves;
    for (std::int32_t i = 0; i < scene.sheets.num_nodes(); ++i)
    {
      scene.prescribed[2 * i + 1] = 1;
      (*scene.u)[2 * i + 1] = slope * scene.sheets.x[2 * i] - (i < n) * 0.01;
    }
    const auto contact = scene.contact<NodeToSurface>();
    contact->begin_step();
    contact->search();
    contact->update_gap();
    const bool is_immobile = slope < 1e-8;
    EXPECT_EQ(contact->nodes()->immobile,
              std::vector<std::int8_t>(n, is_immobile));
    EXPECT_EQ(contact->update_status(false), is_immobile ? 0 : n);
  }
}

TYPED_TEST_2D_3D(Contacts, FactorIsTheStiffnessOfSlaveAndMasterInARow, dim)
{
  ContactScene scene(dim);
  const std::int32_t n = scene.sheets.num_slaves;
  const auto contact = scene.template contact<TypeParam>();
  std::vector<double> compliance(scene.sheets.num_nodes(), 5.0);
  std::fill_n(compliance.begin(), n, 2.0);
  contact->set_factor(compliance);
  for (std::int32_t i = 0; i < n; ++i)
    EXPECT_NEAR(contact->nodes()->c[i] * contact->nodes()->area[i] * 7, 1,
                1e-13);
}

TEST(Contact, TurnsAndClosingsAreThoseOfAStep)
{
  ContactScene scene(2);
  const std::int32_t n = scene.sheets.num_slaves;
  const auto contact = scene.contact<NodeToSurface>(coulomb(n, 0.5));
  law::NodeState& nodes = *contact->nodes();
  std::ranges::fill(nodes.slip_reversals, 1);
  std::ranges::fill(nodes.slip_closings, 3);
  contact->begin_step();
  EXPECT_EQ(nodes.slip_reversals, std::vector<std::int32_t>(n, 0));
  EXPECT_EQ(nodes.slip_closings, std::vector<std::int32_t>(n, 0));
}

TEST_2D_3D(Contact, TractionsTurnWithTheMaster, dim)
{
  ContactScene scene(dim, 0.0);
  const std::int32_t n = scene.sheets.num_slaves;
  const auto contact = scene.contact<NodeToSurface>(coulomb(n, 0.5));
  contact->begin_step();
  contact->search();
  contact->update_gap();
  std::vector<double>& t = contact->nodes()->multiplier;
  for (std::int32_t i = 0; i < n; ++i)
  {
    t[dim * i] = 0.2;
    t[dim * i + dim - 1] = 1;
  }
  contact->accept();
  const double angle = 0.3;
  *scene.u = scene.sheets.moved_by(scene.sheets.turned(angle));
  contact->begin_step();
  for (std::int32_t i = 0; i < n; ++i)
  {
    EXPECT_NEAR(t[dim * i], 0.2 * std::cos(angle) - std::sin(angle), 1e-13);
    EXPECT_NEAR(t[dim * i + dim - 1], 0.2 * std::sin(angle) + std::cos(angle),
                1e-13);
  }
}

TEST(Contact, ForcesStayWhereAreasChange)
{
  // A fold of the slave that turns away from the master carries nothing
  ContactScene scene(2, 0.0);
  const auto contact = scene.contact<NodeToSurface>();
  law::NodeState& nodes = *contact->nodes();
  std::ranges::fill(nodes.multiplier, 2.0);
  const std::vector<double> before = nodes.area;
  double force = 0;
  for (const double a : before)
    force += 2 * a;
  // Its last segment stands upright now
  const auto owned = scene.slaves->owned();
  std::int32_t last = 0;
  for (const std::int32_t i : owned)
    if (scene.sheets.x[2 * i] > scene.sheets.x[2 * last])
      last = i;
  (*scene.u)[2 * last] = -0.5;
  (*scene.u)[2 * last + 1] = 1;
  contact->search();
  contact->accept();
  double after = 0;
  for (std::size_t i = 0; i < before.size(); ++i)
    after += nodes.multiplier[i] * nodes.area[i];
  EXPECT_NE(nodes.area, before);
  EXPECT_NEAR(after, force, 1e-12);
}

TYPED_TEST_2D_3D(Contacts, ChangesAreDerivativesOfGapSlipAndNormals, dim)
{
  ContactScene scene(dim);
  const auto contact
      = scene.contact<TypeParam>(coulomb(scene.sheets.num_slaves, 0.3));
  Generator random(2);
  const std::size_t n = scene.u->size();
  const auto u = random.numbers(n, -2e-3, 2e-3), du = random.numbers(n, -1, 1);
  law::NodeState& nodes = *contact->nodes();
  contact->begin_step();
  *scene.u = u;
  contact->search();
  contact->update_gap();
  contact->law()->evaluate(nodes);
  const auto change = contact->change(du);
  const auto base = nodes.normal;
  const auto at = [&](double step)
  {
    for (std::size_t i = 0; i < n; ++i)
      (*scene.u)[i] = u[i] + step * du[i];
    // Pairs stay
    contact->update_gap();
    return std::tuple(nodes.gap, nodes.slip, nodes.normal);
  };
  const double h = 1e-6;
  const auto [gap_plus, slip_plus, normal_plus] = at(h);
  const auto [gap_minus, slip_minus, normal_minus] = at(-h);
  int count = 0;
  for (std::size_t k = 0; k < base.size(); ++k)
  {
    const double gap = (gap_plus[k / dim] - gap_minus[k / dim]) / (2 * h);
    if (std::isnan(gap))
      continue;
    ++count;
    EXPECT_NEAR(change.movement[k],
                base[k] * gap + (slip_plus[k] - slip_minus[k]) / (2 * h), 1e-6);
    EXPECT_NEAR(change.normal[k], (normal_plus[k] - normal_minus[k]) / (2 * h),
                1e-6);
  }
  EXPECT_GT(count, 3 * dim);
}

TEST(Contact, WhatDoesNotFitIsRefused)
{
  ContactScene scene(2);
  auto law = std::make_shared<law::Frictionless>();
  const auto make = [&](std::size_t prescribed, std::size_t shared)
  {
    return Contact(scene.halo, scene.slaves,
                   scene.master<NodeToSurface>(*law, Sliding::finite), law,
                   {Sliding::finite, contact::Method::node_to_surface,
                    std::vector<std::int8_t>(prescribed, 0),
                    std::vector<std::int8_t>(shared, 0)});
  };
  EXPECT_NO_THROW(make(scene.u->size(), 0));
  EXPECT_REFUSED(make(scene.u->size() - 1, 0));
  EXPECT_REFUSED(make(scene.u->size(), 1));
  const auto contact = scene.contact<NodeToSurface>(law);
  std::vector<double> few(1);
  EXPECT_REFUSED(contact->add_residual(few));
  EXPECT_REFUSED(contact->set_factor(few));
  EXPECT_REFUSED(contact->block("stiffness", std::vector<std::int8_t>(1)));
  EXPECT_REFUSED(contact->block("gap"));
}
