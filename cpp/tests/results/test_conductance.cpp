// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#include "asperities.h"
#include "contact_scene.h"
#include "moved_contact.h"
#include <contactx/geometry/plane.h>
#include <contactx/results/conductance.h>
#include <contactx/results/transfer.h>

using namespace contactx;
using namespace contactx::contact;
using namespace contactx::tests;
using law::Coefficient;
using results::Conductance;
using results::Derivatives;
using results::Results;

namespace
{
constexpr double pressure = 2;

Conductance conducting(const std::shared_ptr<Contact>& contact,
                       Coefficient h = Coefficient(asperities),
                       std::optional<double> obstacle_value = std::nullopt)
{
  return {contact, std::make_shared<Results>(contact), std::move(h),
          obstacle_value};
}

/// Close all slave nodes with a pressure along their normals.
void press(Contact& contact)
{
  contact.search();
  contact.update_gap();
  law::NodeState& nodes = *contact.nodes();
  std::ranges::fill(nodes.status, law::slip);
  if (not nodes.is_vector())
  {
    std::ranges::fill(nodes.multiplier, pressure);
    return;
  }
  const int g = contact.halo().gdim();
  const std::vector<double> normals = contact.master()->normals();
  for (std::size_t k = 0; k < nodes.multiplier.size(); ++k)
    nodes.multiplier[k] = pressure * normals[3 * (k / g) + k % g];
}

/// Two sheets in small sliding that are uneven, by the numbers of their nodes
/// in the mesh.
template <class M>
std::shared_ptr<Contact> uneven(ContactScene& scene, bool has_friction)
{
  scene.make_uneven();
  std::shared_ptr<law::Law> law = std::make_shared<law::Frictionless>();
  if (has_friction)
    law = coulomb(scene.slaves->owned().size(), 0.4);
  auto contact = scene.contact<M>(law, Sliding::small);
  press(*contact);
  return contact;
}

/// A field that differs from node to node.
std::vector<double> warm(const ContactScene& scene)
{
  std::vector<double> field(scene.halo->num_owned());
  for (std::size_t i = 0; i < field.size(); ++i)
    field[i] = 10 + 3 * std::cos(5. * double(scene.mesh.number[i]));
  return field;
}

/// Derivative of the residual along a way by central differences.
template <class Move>
std::vector<double> quotient(Conductance& conductance,
                             const std::vector<double>& field, Move&& move)
{
  constexpr double step = 1e-5;
  move(step);
  std::vector<double> high = conductance.residual(field);
  move(-2 * step);
  const std::vector<double> low = conductance.residual(field);
  move(step);
  for (std::size_t i = 0; i < high.size(); ++i)
    high[i] = (high[i] - low[i]) / (2 * step);
  return high;
}

void expect_product(const Triplets& A, const std::vector<double>& way,
                    const std::vector<double>& expected)
{
  std::vector<double> product(expected.size(), 0);
  A.multiply(way, product);
  double most = 0;
  for (const double v : expected)
    most = std::max(most, std::abs(v));
  ASSERT_GT(most, 0.01);
  expect_near(product, expected, 1e-7 * most);
}

std::vector<double> any(std::size_t count, unsigned seed, double low = -1,
                        double high = 1)
{
  return Generator(seed).numbers(count, low, high);
}

void add(std::vector<double>& x, const std::vector<double>& way, double by)
{
  for (std::size_t i = 0; i < x.size(); ++i)
    x[i] += by * way[i];
}

template <class>
using Conductances = testing::Test;

using Methods = testing::Types<NodeToSurface, SurfaceToSurface>;
TYPED_TEST_SUITE(Conductances, Methods);

/// What is recovered from uniform pressures is uniform: along these the
/// derivative by the nodes' own pressures is exact.
TYPED_TEST_2D_3D(Conductances, DerivativesAreThoseOfTheResidual, dim)
{
  for (const bool has_friction : {false, true})
  {
    ContactScene scene(dim);
    const auto contact = uneven<TypeParam>(scene, has_friction);
    Conductance conductance = conducting(contact);
    std::vector<double> field = warm(scene);
    for (const double gap : contact->nodes()->gap)
      ASSERT_GT(gap, 0.01);
    const Derivatives derivatives = conductance.derivatives(field);
    auto way = any(field.size(), 1);
    // Linear in the field
    expect_product(derivatives.by_field, field, conductance.residual(field));
    expect_product(derivatives.by_field, way, conductance.residual(way));
    const Triplets alone = conductance.by_field();
    EXPECT_EQ(alone.rows, derivatives.by_field.rows);
    EXPECT_EQ(alone.columns, derivatives.by_field.columns);
    EXPECT_EQ(alone.values, derivatives.by_field.values);
    way = any(scene.u->size(), 2);
    expect_product(derivatives.by_displacement, way,
                   quotient(conductance, field,
                            [&](double by) { add(*scene.u, way, by); }));
    // Components along the surface press nothing
    auto& multiplier = contact->nodes()->multiplier;
    way.assign(multiplier.size(), 1);
    if (has_friction)
      for (std::size_t k = 0; k < way.size(); ++k)
        way[k] = k % dim == std::size_t(dim - 1) ? 1 : 0.7;
    expect_product(derivatives.by_multiplier, way,
                   quotient(conductance, field,
                            [&](double by) { add(multiplier, way, by); }));
  }
}

TYPED_TEST_2D_3D(Conductances, WhatLeavesOneSideEntersTheOther, dim)
{
  ContactScene scene(dim);
  const auto contact = uneven<TypeParam>(scene, false);
  Conductance conductance = conducting(contact);
  std::vector<double> field = warm(scene);
  for (std::int32_t i = 0; i < scene.sheets.num_slaves; ++i)
    field[i] += 20;
  const auto residual = conductance.residual(field);
  const auto first_master = residual.begin() + scene.sheets.num_slaves;
  const double out = std::accumulate(residual.begin(), first_master, 0.);
  const double in = std::accumulate(first_master, residual.end(), 0.);
  const double flow = conductance.flow(field);
  ASSERT_GT(flow, 1);
  EXPECT_NEAR(out, flow, 1e-12 * flow);
  EXPECT_NEAR(in, -flow, 1e-12 * flow);
  // Where both sides are alike nothing flows
  std::ranges::fill(field, 7);
  EXPECT_NEAR(conductance.flow(field), 0, 1e-12 * flow);
}

TYPED_TEST(Conductances, NegativePressuresAndGapsCountAsZero)
{
  ContactScene scene(2, -0.05);
  const auto contact = uneven<TypeParam>(scene, false);
  for (double& p : contact->nodes()->multiplier)
    p = -p;
  for (const double gap : contact->nodes()->gap)
    ASSERT_LT(gap, 0);
  bool is_called = false;
  Conductance conductance
      = conducting(contact, Coefficient(
                                [&](auto p, auto gap)
                                {
                                  is_called = true;
                                  for (std::size_t i = 0; i < p.size(); ++i)
                                  {
                                    EXPECT_EQ(p[i], 0);
                                    EXPECT_EQ(gap[i], 0);
                                  }
                                  return asperities(p, gap);
                                }));
  const auto field = warm(scene);
  EXPECT_EQ(conductance.residual(field),
            conducting(contact, Coefficient(0.5)).residual(field));
  EXPECT_TRUE(is_called);
}

TYPED_TEST(Conductances, ContactsThatAreSwitchedOffConductNothing)
{
  ContactScene scene(2);
  const auto contact = uneven<TypeParam>(scene, false);
  Conductance conductance = conducting(contact);
  const auto field = warm(scene);
  ASSERT_NE(conductance.flow(field), 0);
  contact->set_active(false);
  EXPECT_EQ(conductance.flow(field), 0);
  EXPECT_EQ(conductance.residual(field), std::vector<double>(field.size(), 0));
  contact->set_active(true);
  EXPECT_NE(conductance.flow(field), 0);
}

TYPED_TEST_2D_3D(Conductances, AreTheSameOnRanks, dim)
{
  ContactScene scene(dim);
  const auto contact = uneven<TypeParam>(scene, true);
  Conductance alone = conducting(contact);
  const auto field = warm(scene);
  const double flow = alone.flow(field);
  const auto residual = alone.residual(field);
  const Derivatives derivatives = alone.derivatives(field);
  std::vector<double> product(residual.size(), 0);
  derivatives.by_displacement.multiply(*scene.u, product);
  derivatives.by_multiplier.multiply(contact->nodes()->multiplier, product);
  const auto work = [&](mesh::Ranks& ranks)
  {
    ContactScene part(dim, 0.05, Cells::mixed, &ranks);
    const auto here = uneven<TypeParam>(part, true);
    Conductance conductance = conducting(here);
    const auto mine = warm(part);
    EXPECT_NEAR(conductance.flow(mine), flow, 1e-11);
    const auto out = conductance.residual(mine);
    const Derivatives by = conductance.derivatives(mine);
    std::vector<double> sums(part.halo->num_nodes(), 0);
    by.by_displacement.multiply(*part.u, sums);
    by.by_multiplier.multiply(here->nodes()->multiplier, sums);
    part.halo->reverse(sums, 1);
    ASSERT_EQ(out.size(), std::size_t(part.halo->num_owned()));
    for (std::size_t i = 0; i < out.size(); ++i)
    {
      EXPECT_NEAR(out[i], residual[part.mesh.number[i]], 1e-11);
      EXPECT_NEAR(sums[i], product[part.mesh.number[i]], 1e-8);
    }
  };
  on_ranks(3, work);
}

/// A body over a plate: h A (T - T0) flows.
TEST(Conductance, ARigidObstacleHasAValue)
{
  MovedContact moved = square_above_plane();
  press(*moved.contact);
  Conductance conductance = conducting(moved.contact, Coefficient(0.5), 3);
  const std::vector<double> field(4, 10);
  EXPECT_NEAR(conductance.flow(field), 0.5 * 4 * (10 - 3), 1e-13);
  for (const double out : conductance.residual(field))
    EXPECT_NEAR(out, 0.5 * 7, 1e-13);
  EXPECT_REFUSED((void)conducting(moved.contact));
}

TEST(Conductance, RefusesWhatDoesNotFit)
{
  ContactScene scene(2);
  const auto contact = uneven<NodeToSurface>(scene, false);
  const auto results = std::make_shared<Results>(contact);
  EXPECT_REFUSED((void)conducting(contact, Coefficient(1), 3.));
  EXPECT_REFUSED(Conductance(nullptr, results, Coefficient(1)));
  EXPECT_REFUSED(Conductance(contact, nullptr, Coefficient(1)));
  Conductance conductance(contact, results, Coefficient(1));
  const std::vector<double> few(3, 0);
  EXPECT_REFUSED((void)conductance.flow(few));
  EXPECT_REFUSED((void)conductance.residual(few));
  EXPECT_REFUSED((void)conductance.derivatives(few));
  Conductance bad = conducting(
      contact,
      Coefficient([](auto p, auto) { return std::vector(p.size(), -1.); }));
  EXPECT_REFUSED((void)bad.by_field());
}

template <class>
using Transfers = testing::Test;
TYPED_TEST_SUITE(Transfers, Methods);

/// What goes from slave to master of two sheets that are shaken.
template <class M>
struct Shaken : ContactScene
{
  explicit Shaken(int dim) : ContactScene(dim), between(contact<M>())
  {
    std::mt19937 random(7);
    shake(random, 0.005);
    between->search();
    between->update_gap();
    transfer.emplace(*between);
  }

  std::shared_ptr<Contact> between;
  std::optional<results::Transfer> transfer;
};

TYPED_TEST_2D_3D(Transfers, NothingIsLostAndUniformFieldsHaveNoDifference, dim)
{
  const Shaken<TypeParam> scene(dim);
  const results::Transfer& transfer = *scene.transfer;
  EXPECT_GT(std::ranges::count(transfer.is_paired(), 1), 3);
  const std::size_t nodes = scene.halo->num_nodes();
  for (const double d : transfer.differences(std::vector<double>(nodes, 3)))
    EXPECT_NEAR(d, 0, 1e-13);
  std::vector<double> b(nodes, 0);
  transfer.add(any(transfer.area().size(), 1, 0.5, 1.5), b);
  double sum = 0, size = 0;
  for (const double v : b)
  {
    sum += v;
    size += std::abs(v);
  }
  EXPECT_GT(size, 1);
  EXPECT_NEAR(sum, 0, 1e-13 * size);
}

/// Derivatives against what flows.
TYPED_TEST_2D_3D(Transfers, MatricesAreTheDerivatives, dim)
{
  const Shaken<TypeParam> scene(dim);
  const results::Transfer& transfer = *scene.transfer;
  const std::size_t n = transfer.area().size();
  const std::size_t nodes = scene.halo->num_nodes();
  const auto h = any(n, 2, 0.5, 1.5), field = any(nodes, 3, 0.5, 1.5);
  std::vector<double> flow = transfer.differences(field);
  for (std::size_t i = 0; i < n; ++i)
    flow[i] *= h[i] * transfer.area()[i];
  std::vector<double> b(nodes, 0), product(nodes, 0);
  transfer.add(flow, b);
  transfer.by_field(h).multiply(field, product);
  expect_near(product, b, 1e-13);
  std::ranges::fill(product, 0);
  transfer.by_slaves(h).multiply(flow, product);
  std::ranges::fill(b, 0);
  for (std::size_t i = 0; i < n; ++i)
    flow[i] *= h[i];
  transfer.add(flow, b);
  expect_near(product, b, 1e-13);
  // By a displacement: what the gaps change by, with the normals as they are
  const auto u = any(nodes * dim, 4, 0.5, 1.5);
  const std::vector<double> normals = scene.between->master()->normals();
  std::vector<double> opening(n, 0), part(nodes);
  for (int k = 0; k < dim; ++k)
  {
    for (std::size_t j = 0; j < nodes; ++j)
      part[j] = u[dim * j + k];
    const auto d = transfer.differences(part);
    for (std::size_t i = 0; i < n; ++i)
      opening[i] += normals[3 * i + k] * d[i];
  }
  for (std::size_t i = 0; i < n; ++i)
    opening[i] *= h[i];
  std::ranges::fill(b, 0);
  transfer.add(opening, b);
  std::ranges::fill(product, 0);
  transfer.by_displacement(h).multiply(u, product);
  expect_near(product, b, 1e-12);
}

TYPED_TEST_2D_3D(Transfers, MasterHasMeansOfWhatIsInFrontOfIt, dim)
{
  const Shaken<TypeParam> scene(dim);
  const results::Transfer& transfer = *scene.transfer;
  const std::vector<double> uniform(transfer.area().size(), 2);
  const auto values = any(transfer.area().size(), 5, 0.5, 1.5);
  const auto same = transfer.at_master(uniform);
  const auto means = transfer.at_master(values);
  std::size_t count = 0;
  for (std::size_t k = 0; k < means.size(); ++k)
  {
    EXPECT_EQ(std::isnan(means[k]), std::isnan(same[k]));
    if (std::isnan(means[k]))
      continue;
    ++count;
    EXPECT_NEAR(same[k], 2, 1e-13);
    EXPECT_GE(means[k], 0.5);
    EXPECT_LE(means[k], 1.5);
  }
  EXPECT_GT(count, 2);
  for (const std::int32_t node : scene.slaves->owned())
    EXPECT_TRUE(std::isnan(means[node]));
}

TYPED_TEST(Transfers, SizesAreChecked)
{
  const Shaken<TypeParam> scene(2);
  const results::Transfer& transfer = *scene.transfer;
  const std::vector<double> none;
  std::vector<double> b(scene.halo->num_nodes());
  EXPECT_REFUSED((void)transfer.differences(none));
  EXPECT_REFUSED(transfer.add(none, b));
  EXPECT_REFUSED((void)transfer.by_field(none));
  EXPECT_REFUSED((void)transfer.by_slaves(none));
  EXPECT_REFUSED((void)transfer.by_displacement(none));
  EXPECT_REFUSED((void)transfer.at_master(none));
}
} // namespace
