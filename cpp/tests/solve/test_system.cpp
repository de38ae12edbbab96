// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#include "spring_bodies.h"

using namespace contactx;
using namespace contactx::contact;
using namespace contactx::tests;

namespace
{
/// Two sheets at any displacements, with any multipliers and status, and two
/// contacts between them: with friction and without.
struct Hanging : SpringBodies
{
  explicit Hanging(int dim, mesh::Ranks* ranks = nullptr)
      : SpringBodies(dim, 0.05, ranks)
  {
    const int last = dim - 1;
    bulk->bar = 2;
    // A slave node, and one of the master's beneath
    prescribe(1, last, -0.03);
    prescribe(scene.sheets.num_slaves + 2, 0, 0.02);
    add<NodeToSurface>(law(0.3));
    add<NodeToSurface>(law(0));
    std::vector<double> everywhere(scene.u->size());
    Generator random(4);
    const auto any = [&](std::size_t n)
    {
      std::vector<double> values = random.numbers(n, -0.02, 0.02);
      return values;
    };
    *scene.u = scene.mesh.here(any(everywhere.size()), dim);
    bulk->ends = scene.mesh.here(any(everywhere.size()), dim);
    bulk->load = scene.mesh.here(any(everywhere.size()), dim);
    const std::vector<double> pressures = any(everywhere.size());
    for (const auto& c : contacts)
    {
      law::NodeState& nodes = *c->nodes();
      const auto owned = c->slaves().owned();
      for (std::size_t i = 0; i < owned.size(); ++i)
      {
        const std::size_t node = scene.mesh.number[owned[i]];
        for (int k = 0; k < nodes.size(); ++k)
          nodes.multiplier[nodes.size() * i + k] = pressures[dim * node + k];
        nodes.multiplier[nodes.size() * i + nodes.size() - 1] += 1;
        const std::array kinds{
            law::open, nodes.is_vector() ? law::stick : law::slip, law::slip};
        nodes.status[i] = kinds[node % 3];
        nodes.c[i] = 2;
      }
      c->update_gap();
    }
    system = SpringBodies::system();
  }

  /// Dirichlet values that the displacements have.
  void meet_values()
  {
    for (std::size_t i = 0; i < bulk->values.size(); ++i)
      if (bulk->fixed[i])
        bulk->values[i] = (*scene.u)[i];
  }

  std::vector<double> residual()
  {
    std::vector<double> b(system->size());
    system->residual(b);
    return b;
  }

  /// Forces of bulk and contacts without Dirichlet conditions, and the
  /// complementarity functions; of one rank.
  std::vector<double> expected()
  {
    std::vector<double> b = tests::residual(contacts);
    const auto force = bulk->residual();
    for (std::size_t i = 0; i < force.size(); ++i)
      b[i] += force[i];
    return b;
  }

  std::shared_ptr<solve::System> system;
};

} // namespace

TEST_2D_3D(System, UnknownsAreDisplacementsThenMultipliersOfEachContact, dim)
{
  Hanging s(dim);
  const std::size_t n = s.scene.u->size(), m = s.scene.slaves->owned().size();
  EXPECT_EQ(s.system->offsets(),
            (std::vector<std::size_t>{0, n, n + dim * m, n + dim * m + m}));
  EXPECT_EQ(s.system->num_displacements(), n);
  std::vector<double> x(s.system->size()), back(x);
  for (std::size_t i = 0; i < x.size(); ++i)
    x[i] = 1e-3 * static_cast<double>(i);
  s.system->take(x);
  EXPECT_EQ(*s.scene.u, std::vector<double>(x.begin(), x.begin() + n));
  EXPECT_EQ(s.contacts[1]->nodes()->multiplier[1], x[n + dim * m + 1]);
  s.system->unknowns(back);
  EXPECT_EQ(back, x);
}

TEST_2D_3D(System, TheResidualIsForcesThenComplementarity, dim)
{
  Hanging s(dim);
  s.meet_values();
  std::vector<double> b = s.expected();
  for (std::size_t i = 0; i < s.scene.u->size(); ++i)
    if (s.bulk->fixed[i])
      b[i] = 0;
  expect_near(s.residual(), b, 1e-14);
  EXPECT_EQ(s.bulk->lifts, 0);
}

TEST_2D_3D(System, DirichletValuesThatAreNotThereYetCountInOtherRows, dim)
{
  Hanging s(dim);
  const auto defect = s.bulk->defect();
  const std::vector<double> d(defect.begin(), defect.end());
  const std::vector<double> now = *s.scene.u;
  const auto at = [&](double part)
  {
    for (std::size_t i = 0; i < d.size(); ++i)
      (*s.scene.u)[i] = now[i] + part * d[i];
    return s.expected();
  };
  // What all rows are where the values are met, were they linear
  std::vector<double> b = at(0);
  constexpr double h = 1e-5;
  const std::vector<double> plus = at(h), minus = at(-h);
  for (std::size_t i = 0; i < b.size(); ++i)
    b[i] -= (plus[i] - minus[i]) / (2 * h);
  at(0);
  for (std::size_t i = 0; i < d.size(); ++i)
    if (s.bulk->fixed[i])
      b[i] = d[i];
  expect_near(s.residual(), b, 1e-8);
  EXPECT_EQ(s.bulk->lifts, 1);
  // The part of the contacts is no rounding error
  s.bulk->bar = 0;
  std::ranges::fill(s.bulk->ground, 0.0);
  s.system->begin_step();
  const std::vector<double> lifted = s.residual(), plain = s.expected();
  double forces = 0, rows = 0;
  for (std::size_t i = 0; i < b.size(); ++i)
    if (i >= d.size())
      rows = std::max(rows, std::abs(lifted[i] - plain[i]));
    else if (not s.bulk->fixed[i])
      forces = std::max(forces, std::abs(lifted[i] - plain[i]));
  EXPECT_GT(forces, 1e-4);
  EXPECT_GT(rows, 1e-4);
}

TEST(System, RoundingOfDirichletValuesIsNotLifted)
{
  Hanging s(2);
  s.meet_values();
  double most = 0;
  for (const double v : *s.scene.u)
    most = std::max(most, std::abs(v));
  const auto fixed = std::ranges::find(s.bulk->fixed, 1);
  const std::size_t dof = fixed - s.bulk->fixed.begin();
  for (const double part : {0.5, 2.0})
  {
    s.bulk->lifts = 0;
    (*s.scene.u)[dof] = part * math::sum_round_off * most;
    s.bulk->values[dof] = 0;
    EXPECT_EQ(s.residual()[dof], part * math::sum_round_off * most);
    EXPECT_EQ(s.bulk->lifts, part > 1);
  }
}

TEST_2D_3D(System, ForcesAreThoseOfBulkAndContactsWithoutDirichletConditions,
           dim)
{
  Hanging s(dim);
  const std::vector<double> b = s.expected();
  expect_near(s.system->forces(), std::span(b).first(s.scene.u->size()), 1e-14);
}

TEST_2D_3D(System, MultipliersAreSolvedForAsLengths, dim)
{
  Hanging s(dim);
  s.residual();
  const std::size_t n = s.system->num_displacements();
  std::vector<double> x(s.system->size()), before(x.size());
  for (std::size_t i = n; i < x.size(); ++i)
    x[i] = std::sin(1.0 + static_cast<double>(i));
  const condense::ContactBlock block(s.contacts, s.scene.prescribed);
  s.system->multiply(block, x, before);
  for (const auto& c : s.contacts)
    std::ranges::fill(c->nodes()->c, 5.0);
  s.system->take_factors();
  // The next power of two
  for (const double factor : s.system->factors())
    EXPECT_EQ(factor, 8);
  std::vector<double> after(x.size()), back(x.size());
  s.system->multiply(block, x, after);
  for (std::size_t i = 0; i < x.size(); ++i)
    EXPECT_NEAR(after[i], 8 * before[i], 1e-13 * std::abs(after[i]));
  s.system->take(x);
  std::size_t at = n;
  for (const auto& c : s.contacts)
    for (const double multiplier : c->nodes()->multiplier)
      EXPECT_EQ(multiplier, 8 * x[at++]);
  s.system->unknowns(back);
  EXPECT_EQ(back, x);
}

TEST_2D_3D(System, MultipliesByTheContactsPartOfTheJacobian, dim)
{
  Hanging s(dim);
  s.residual();
  std::vector<double> x(s.system->size());
  for (std::size_t i = 0; i < x.size(); ++i)
    x[i] = std::sin(1.0 + static_cast<double>(i));
  // All of the Jacobian less the bulk's part, but for Dirichlet rows
  std::vector<double> inner = x;
  for (std::size_t i = 0; i < s.scene.u->size(); ++i)
    if (s.bulk->fixed[i])
      inner[i] = 0;
  std::vector<double> expected = tests::product(s.jacobian(), inner);
  const std::vector<double> of_bulk
      = s.bulk->product(std::span(inner).first(s.scene.u->size()));
  for (std::size_t i = 0; i < of_bulk.size(); ++i)
    expected[i] = s.bulk->fixed[i] ? 0 : expected[i] - of_bulk[i];
  const condense::ContactBlock block(s.contacts, s.scene.prescribed);
  std::vector<double> y(x.size(), 99);
  s.system->multiply(block, x, y);
  expect_near(y, expected, 1e-13);
}

TEST(System, TheBulkIsAssembledOnlyWhereSomethingHasChanged)
{
  Hanging s(2);
  s.residual();
  s.residual();
  s.system->forces();
  s.system->bulk_residual();
  EXPECT_EQ(s.bulk->residuals, 1);
  // Multipliers do not count
  s.contacts[0]->nodes()->multiplier[0] += 1;
  s.residual();
  EXPECT_EQ(s.bulk->residuals, 1);
  s.scene.u->back() += 1e-3;
  const std::vector<double> before = s.residual();
  EXPECT_EQ(s.bulk->residuals, 2);
  // Loads do from the next step on
  s.bulk->load.back() += 1;
  EXPECT_EQ(s.residual(), before);
  s.system->begin_step();
  EXPECT_NEAR(s.residual()[s.scene.u->size() - 1],
              before[s.scene.u->size() - 1] - 1, 1e-15);
  EXPECT_EQ(s.bulk->residuals, 3);
}

TEST(System, SizesThatDoNotFitAreRefused)
{
  Hanging s(2);
  s.residual();
  const condense::ContactBlock block(s.contacts, {});
  std::vector<double> right(s.system->size());
  for (const std::size_t size : {right.size() - 1, right.size() + 1})
  {
    std::vector<double> wrong(size);
    EXPECT_REFUSED(s.system->unknowns(wrong));
    EXPECT_REFUSED(s.system->take(wrong));
    EXPECT_REFUSED(s.system->residual(wrong));
    EXPECT_REFUSED(s.system->multiply(block, wrong, right));
    EXPECT_REFUSED(s.system->multiply(block, right, wrong));
  }
}

TEST_2D_3D(System, IsTheSameOnRanks, dim)
{
  Hanging one(dim);
  const std::vector<double> b = one.residual(), forces = one.system->forces();
  std::vector<double> x(b.size()), y(b.size());
  one.system->unknowns(x);
  one.system->multiply(condense::ContactBlock(one.contacts, {}), x, y);
  for (const int size : {2, 3})
    on_ranks(size,
             [&](mesh::Ranks& ranks)
             {
               Hanging here(dim, &ranks);
               expect_near(here.residual(), here.mine(b), 1e-13);
               // Nothing of the multipliers
               std::vector<double> all = forces;
               all.resize(b.size());
               all = here.mine(all);
               expect_near(
                   here.system->forces(),
                   std::span(all).first(here.system->num_displacements()),
                   1e-13);
               std::vector<double> u(here.system->size()), v(u);
               here.system->unknowns(u);
               EXPECT_EQ(u, here.mine(x));
               here.system->multiply(condense::ContactBlock(here.contacts, {}),
                                     u, v);
               expect_near(v, here.mine(y), 1e-13);
               // What one rank throws all do
               u.resize(u.size() + (ranks.rank() == 0));
               EXPECT_REFUSED(here.system->take(u));
               EXPECT_REFUSED(here.system->residual(u));
             });
}

TEST_2D_3D(System, OtherFieldsComeBetweenDisplacementsAndMultipliers, dim)
{
  Hanging s(dim);
  const std::size_t n = s.scene.u->size();
  const std::vector<double> without = s.residual();
  const auto others
      = std::make_shared<LooseFields>(std::vector<std::size_t>{0, 3, 7});
  s.bulk->others = others;
  auto now = std::make_shared<solve::System>(s.scene.halo, s.bulk, s.contacts);
  EXPECT_EQ(now->num_displacements(), n);
  EXPECT_EQ(now->num_bulk(), n + 7);
  EXPECT_EQ(now->size(), s.system->size() + 7);
  EXPECT_EQ(now->factors().size(), s.system->factors().size());
  for (std::size_t i = 0; i < 7; ++i)
  {
    others->value[i] = 2.0 + double(i);
    others->load[i] = 1;
    others->stiffness[i] = 3;
  }
  std::vector<double> b(now->size()), expected = without;
  now->residual(b);
  // Dirichlet values of the displacements are lifted there, too
  EXPECT_EQ(others->lifts, 1);
  std::vector<double> rows;
  for (const double v : others->value)
    rows.push_back(3 * v - 1 + 0.5);
  expected.insert(expected.begin() + n, rows.begin(), rows.end());
  expect_near(b, expected, 1e-14);
  EXPECT_EQ(now->forces().size(), n);
  EXPECT_EQ(now->bulk_residual().size(), n);
  // Another value of theirs alone is another state
  const int before = s.bulk->residuals;
  now->residual(b);
  EXPECT_EQ(s.bulk->residuals, before);
  others->value[6] = 0;
  now->residual(b);
  EXPECT_EQ(s.bulk->residuals, before + 1);
  EXPECT_EQ(b[n + 6], -0.5);

  std::vector<double> x(now->size()), back(x);
  for (std::size_t i = 0; i < x.size(); ++i)
    x[i] = 1e-3 * static_cast<double>(i);
  now->take(x);
  EXPECT_EQ(others->value,
            std::vector<double>(x.begin() + n, x.begin() + n + 7));
  now->unknowns(back);
  EXPECT_EQ(back, x);
  // Contact has no part in them
  std::vector<double> y(x.size(), 1);
  now->multiply(condense::ContactBlock(s.contacts, s.scene.prescribed), x, y);
  for (std::size_t i = n; i < n + 7; ++i)
    EXPECT_EQ(y[i], 0);
  EXPECT_NE(*std::max_element(y.begin() + n + 7, y.end()), 0);
}

TEST(System, DirichletRowsOfOtherFieldsAreDifferences)
{
  Hanging s(2);
  s.meet_values();
  const auto others
      = std::make_shared<LooseFields>(std::vector<std::size_t>{0, 2});
  s.bulk->others = others;
  others->value = {5, 5};
  others->fixed = {1, 0};
  others->prescribed = {4, 0};
  solve::System system(s.scene.halo, s.bulk, s.contacts);
  std::vector<double> b(system.size());
  system.residual(b);
  const std::size_t n = system.num_displacements();
  EXPECT_EQ(b[n], 1);
  EXPECT_EQ(b[n + 1], 5.5);
  EXPECT_EQ(others->lifts, 1);
  EXPECT_EQ(s.bulk->lifts, 1);
  // Rounding is not lifted
  others->prescribed[0] = 5 * (1 - 4e-16);
  system.residual(b);
  EXPECT_EQ(others->lifts, 1);
}
