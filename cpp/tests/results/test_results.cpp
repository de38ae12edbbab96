// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#include "contact_scene.h"
#include "moved_contact.h"
#include "self_scene.h"
#include <contactx/geometry/plane.h>
#include <contactx/problem/sides.h>
#include <contactx/results/results.h>

using namespace contactx;
using namespace contactx::contact;
using namespace contactx::tests;
using results::Results;

namespace
{
template <class>
using ResultsOf = testing::Test;

using Methods = testing::Types<NodeToSurface, SurfaceToSurface>;
TYPED_TEST_SUITE(ResultsOf, Methods);

void press(Contact& contact, double pressure)
{
  contact.search();
  contact.update_gap();
  law::NodeState& nodes = *contact.nodes();
  std::ranges::fill(nodes.multiplier, pressure);
  std::ranges::fill(nodes.status, law::slip);
}

/// A state that differs from node to node, by the numbers in the mesh as it was
/// made.
template <class M>
std::shared_ptr<Contact> uneven(ContactScene& scene)
{
  const int g = scene.sheets.gdim;
  scene.make_uneven();
  const auto owned = scene.slaves->owned();
  auto contact = scene.contact<M>(coulomb(owned.size(), 0.4));
  contact->search();
  contact->update_gap();
  law::NodeState& nodes = *contact->nodes();
  for (std::size_t i = 0; i < owned.size(); ++i)
  {
    const auto number = double(scene.mesh.number[owned[i]]);
    nodes.status[i] = static_cast<std::int8_t>(std::int64_t(number) % 3);
    for (int k = 0; k < g; ++k)
      nodes.multiplier[g * i + k]
          = nodes.closed(i) ? (k == g - 1) + 0.3 * std::cos(number + k) : 0;
  }
  return contact;
}

Vector<3> point_in(int gdim)
{
  Vector<3> point{0.3, -0.2, 0.7};
  if (gdim == 2)
    point[2] = 0;
  return point;
}

Vector<3> moment(const Results& results, int gdim)
{
  const Vector<3> point = point_in(gdim);
  return results.moment(std::span<const double>(point).first(gdim));
}

/// A fold of a strip whose legs overlap, in contact with itself.
struct Fold
{
  static constexpr int cells = 40;
  Strip strip{cells, 4, 0.1};
  std::shared_ptr<std::vector<double>> u
      = std::make_shared<std::vector<double>>(strip.x.size(), 0.);
  std::shared_ptr<mesh::Halo> halo = mesh::serial_halo(strip.x, 2, u);
  std::vector<std::int32_t> mesh;
  std::shared_ptr<Contact> contact;

  Fold()
  {
    for (int i = 0; i < cells; ++i)
      mesh.insert(mesh.end(), {i, i + 1, strip.top(i), strip.top(i + 1)});
    const auto bodies = std::make_shared<mesh::Bodies>(mesh, 4, cells,
                                                       halo->original(), halo);
    const auto slaves = problem::make_slave_nodes(halo, strip.facets.list());
    auto law = std::make_shared<law::Frictionless>();
    problem::MasterOptions self;
    self.is_self = true;
    const auto master
        = problem::make_master({halo, bodies, mesh, 4}, slaves, "strip",
                               {"strip", strip.facets.list()}, *law, self);
    Contact::Options options{Sliding::finite, Method::node_to_surface, {}, {}};
    options.prescribed.assign(u->size(), 0);
    contact = std::make_shared<Contact>(halo, slaves, master, law,
                                        std::move(options));
    *u = strip.folded(-0.01);
    contact->search();
    contact->update_gap();
  }
};
} // namespace

TYPED_TEST(ResultsOf, NothingIsInContactBeforeTheFirstUpdate)
{
  ContactScene scene(2);
  const Results results(scene.template contact<TypeParam>());
  const std::size_t n = scene.sheets.num_slaves;
  ASSERT_EQ(results.gap().size(), n);
  for (std::size_t i = 0; i < n; ++i)
  {
    EXPECT_TRUE(std::isnan(results.gap()[i]));
    EXPECT_EQ(results.status()[i], law::open);
  }
  EXPECT_EQ(results.pressure(), std::vector<double>(n, 0));
  EXPECT_EQ(results.slip(), std::vector<double>(2 * n, 0));
  EXPECT_EQ(results.master_pressure(),
            std::vector<double>(scene.halo->num_owned(), 0));
  EXPECT_EQ(results.force(), Vector<3>{});
}

TYPED_TEST(ResultsOf, AUniformPressureHasTheForceAndMomentOfItsMiddle)
{
  constexpr double p = 2.5, height = 0.05;
  for (const int dim : {2, 3})
  {
    ContactScene scene(dim, height);
    const auto contact = scene.template contact<TypeParam>();
    press(*contact, p);
    Results results(contact);
    results.update();
    // The slave is the unit interval or square
    Vector<3> force{}, middle{0.5, 0.5, height};
    force[dim - 1] = p;
    if (dim == 2)
      middle = {0.5, height, 0};
    expect_near(results.force(), force, 1e-13);
    expect_near(results.imbalance(), {0, 0, 0}, 1e-13);
    expect_near(moment(results, dim), cross(middle - point_in(dim), force),
                1e-13);
    EXPECT_NEAR(results.recovery_change(), 0, 1e-13);
    for (std::int32_t i = 0; i < scene.sheets.num_slaves; ++i)
    {
      EXPECT_NEAR(results.pressure()[i], p, 1e-13);
      EXPECT_NEAR(results.gap()[i], height, 1e-13);
      EXPECT_EQ(results.status()[i], law::slip);
      for (int k = 0; k < dim; ++k)
        EXPECT_NEAR(results.traction()[dim * i + k], k == dim - 1 ? p : 0,
                    1e-13);
    }
    // Nodes of the master have the pressure, or are beside the slave
    std::int32_t count = 0;
    for (std::int32_t k = 0; k < scene.halo->num_owned(); ++k)
      if (const double there = results.master_pressure()[k]; there != 0)
      {
        EXPECT_NEAR(there, p, 1e-13);
        EXPECT_GE(k, scene.sheets.num_slaves);
        ++count;
      }
    EXPECT_GT(count, 2);
    const results::Totals totals = results.totals();
    EXPECT_EQ(totals.closed, scene.sheets.num_slaves);
    EXPECT_EQ(totals.slipping, scene.sheets.num_slaves);
    EXPECT_NEAR(totals.area, 1, 1e-13);
    EXPECT_NEAR(totals.largest_pressure, p, 1e-13);
    EXPECT_NEAR(totals.smallest_gap, height, 1e-13);
    EXPECT_EQ(totals.dissipation, 0);
  }
}

TYPED_TEST(ResultsOf, RecoveryKeepsTheForceAndLeavesMultipliersAlone)
{
  ContactScene scene(3);
  const auto contact = scene.template contact<TypeParam>();
  press(*contact, 1);
  law::NodeState& nodes = *contact->nodes();
  for (std::int32_t i = 0; i < nodes.num_nodes(); ++i)
    nodes.multiplier[i] += 0.2 * (i % 2);
  const std::vector<double> before = nodes.multiplier;
  Results results(contact);
  results.update();
  EXPECT_EQ(nodes.multiplier, before);
  EXPECT_NE(results.pressure(), before);
  EXPECT_EQ(results.recovered_pressure(), results.pressure());
  // The surfaces are flat
  double force = 0;
  for (std::int32_t i = 0; i < nodes.num_nodes(); ++i)
    force += nodes.area[i] * results.traction()[3 * i + 2];
  EXPECT_NEAR(force, results.force()[2], 1e-13);
  EXPECT_NEAR(results.recovery_change(), 0, 1e-13);
}

TYPED_TEST_2D_3D(ResultsOf, ForcesAreInBalanceAndTheSameOnRanks, dim)
{
  ContactScene scene(dim);
  Results alone(uneven<TypeParam>(scene));
  alone.update();
  ASSERT_GT(norm(alone.force()), 0.1);
  ASSERT_GT(norm(moment(alone, dim)), 0.01);
  expect_near(alone.imbalance(), {0, 0, 0}, 1e-13);
  const results::Totals totals = alone.totals();
  ASSERT_GT(totals.closed, totals.slipping);
  const auto work = [&](mesh::Ranks& ranks)
  {
    ContactScene part(dim, 0.05, Cells::mixed, &ranks);
    Results here(uneven<TypeParam>(part));
    here.update();
    expect_near(here.force(), alone.force(), 1e-13);
    expect_near(here.imbalance(), {0, 0, 0}, 1e-13);
    expect_near(moment(here, dim), moment(alone, dim), 1e-13);
    EXPECT_NEAR(here.recovery_change(), alone.recovery_change(), 1e-13);
    const results::Totals there = here.totals();
    EXPECT_EQ(there.closed, totals.closed);
    EXPECT_EQ(there.slipping, totals.slipping);
    EXPECT_NEAR(there.area, totals.area, 1e-13);
    EXPECT_NEAR(there.largest_pressure, totals.largest_pressure, 1e-13);
    EXPECT_NEAR(there.smallest_gap, totals.smallest_gap, 1e-13);
    const auto owned = part.slaves->owned();
    for (std::size_t i = 0; i < owned.size(); ++i)
    {
      const std::int64_t node = part.mesh.number[owned[i]];
      EXPECT_NEAR(here.pressure()[i], alone.pressure()[node], 1e-13);
      EXPECT_EQ(here.status()[i], alone.status()[node]);
    }
    for (std::int32_t i = 0; i < part.halo->num_owned(); ++i)
      EXPECT_NEAR(here.master_pressure()[i],
                  alone.master_pressure()[part.mesh.number[i]], 1e-13);
  };
  on_ranks(3, work);
}

TYPED_TEST_2D_3D(ResultsOf, PartsOfASurfaceMakeUpTheWhole, dim)
{
  const auto check = [&](ContactScene& scene)
  {
    const auto contact = uneven<TypeParam>(scene);
    Results results(contact);
    results.update();
    // Left and right facets, which share nodes
    const geometry::FacetList whole = scene.slaves->own();
    std::array<std::vector<std::int32_t>, 2> offsets{{{0}, {0}}}, nodes;
    for (std::int32_t f = 0; f < whole.size(); ++f)
    {
      double middle = 0;
      for (const std::int32_t node : whole[f])
        middle += scene.halo->reference()[dim * node] / whole[f].size();
      const int side = middle > 0.4;
      nodes[side].insert(nodes[side].end(), whole[f].begin(), whole[f].end());
      offsets[side].push_back(std::ssize(nodes[side]));
    }
    Vector<3> force{}, turn{};
    results::Totals sum;
    std::int64_t closed = 0;
    double pressure = 0;
    const Vector<3> point = point_in(dim);
    const auto about = std::span<const double>(point).first(dim);
    for (int side = 0; side < 2; ++side)
    {
      const std::vector<double> shares
          = results.shares({offsets[side], nodes[side]}, whole);
      force = force + results.force(shares);
      turn = turn + results.moment(about, shares);
      const results::Totals part = results.totals(shares);
      EXPECT_GT(part.area, 0.1);
      sum.area += part.area;
      closed += part.closed;
      pressure = std::max(pressure, part.largest_pressure);
    }
    const results::Totals totals = results.totals();
    expect_near(force, results.force(), 1e-13);
    expect_near(turn, moment(results, dim), 1e-13);
    EXPECT_NEAR(sum.area, totals.area, 1e-13);
    EXPECT_EQ(pressure, totals.largest_pressure);
    // Those on the border are in both
    EXPECT_GE(closed, totals.closed);
    const std::vector<double> few(1, 1.);
    EXPECT_REFUSED(results.force(few));
    EXPECT_REFUSED(results.totals(few));
  };
  ContactScene alone(dim);
  check(alone);
  on_ranks(3,
           [&](mesh::Ranks& ranks)
           {
             ContactScene part(dim, 0.05, Cells::mixed, &ranks);
             check(part);
           });
}

TYPED_TEST_2D_3D(ResultsOf, ACopyIsReturnedToBitForBit, dim)
{
  ContactScene scene(dim);
  const auto contact = uneven<TypeParam>(scene);
  Results results(contact);
  results.update();
  const Results kept = results;
  const Vector<3> before = moment(results, dim);
  for (double& u : *scene.u)
    u += 0.01;
  contact->search();
  contact->update_gap();
  std::ranges::fill(contact->nodes()->multiplier, 0.5);
  std::ranges::fill(contact->nodes()->status, law::stick);
  contact->accept();
  results.update();
  EXPECT_NE(results.force(), kept.force());
  EXPECT_NE(moment(results, dim), before);
  results = kept;
  EXPECT_EQ(moment(results, dim), before);
  Results anew(uneven<TypeParam>(scene));
  anew.update();
  for (const Results* r : std::array<const Results*, 2>{&kept, &anew})
  {
    EXPECT_EQ(results.pressure(), r->pressure());
    EXPECT_EQ(results.traction(), r->traction());
    EXPECT_EQ(results.master_pressure(), r->master_pressure());
    EXPECT_EQ(results.gap(), r->gap());
    EXPECT_EQ(results.status(), r->status());
    EXPECT_EQ(results.slip(), r->slip());
    EXPECT_EQ(results.slip_total(), r->slip_total());
    EXPECT_EQ(results.force(), r->force());
    EXPECT_EQ(results.imbalance(), r->imbalance());
    EXPECT_EQ(results.recovery_change(), r->recovery_change());
  }
}

TYPED_TEST(ResultsOf, SlipIsThatOfTheAcceptedSteps)
{
  ContactScene scene(3);
  const std::int32_t n = scene.sheets.num_slaves;
  const auto contact = scene.template contact<TypeParam>(coulomb(n, 0.3));
  press(*contact, 1);
  law::NodeState& nodes = *contact->nodes();
  for (std::int32_t i = 0; i < n; ++i)
    nodes.slip[3 * i] = 0.3, nodes.slip[3 * i + 1] = -0.4;
  contact->accept();
  Results results(contact);
  results.update();
  EXPECT_EQ(results.slip(), nodes.slip);
  for (const double total : results.slip_total())
    EXPECT_NEAR(total, 0.5, 1e-15);
  EXPECT_GT(results.totals().dissipation, 0);
}

TYPED_TEST(ResultsOf, ValuesOnBothSurfacesAndAcross)
{
  ContactScene scene(3);
  const auto contact = scene.template contact<TypeParam>();
  press(*contact, 1);
  const Results results(contact);
  const std::int32_t n = scene.sheets.num_slaves;
  const std::size_t every = scene.halo->num_owned();
  constexpr double nan = std::nan("");
  std::vector<double> values(n, 3);
  values[0] = nan;
  const std::vector<double> both = results.on_both(values, -7);
  ASSERT_EQ(both.size(), every);
  EXPECT_EQ(both[0], -7);
  std::size_t there = 0;
  for (std::size_t k = 1; k < every; ++k)
  {
    EXPECT_NEAR(both[k], both[k] == -7 ? -7 : 3, 1e-13);
    there += k >= std::size_t(n) and both[k] != -7;
  }
  EXPECT_GT(there, 2);
  for (const double v : results.on_both(std::vector<double>(n, nan), 0.5))
    EXPECT_EQ(v, 0.5);

  // One on the slave, two on the master
  std::vector<double> field(every, 2);
  std::fill_n(field.begin(), n, 1);
  const std::vector<double> across = results.across(field);
  for (std::size_t k = 0; k < every; ++k)
    EXPECT_NEAR(across[k],
                k < std::size_t(n) ? 2
                : both[k] != -7    ? 1
                                   : 2,
                1e-13);
  EXPECT_REFUSED((void)results.on_both(field, 0));
  EXPECT_REFUSED((void)results.across(values));
}

TEST(Results, ARigidObstacleCarriesItsForce)
{
  MovedContact moved = square_above_plane();
  moved.move(0, 4, -0.1);
  press(*moved.contact, 3);
  Results results(moved.contact);
  results.update();
  expect_near(results.force(), {0, 0, 12}, 1e-13);
  expect_near(results.imbalance(), {0, 0, 0}, 1e-13);
  // Forces act where the nodes have moved to
  expect_near(moment(results, 3),
              cross(Vector<3>{1, 1, 0} - point_in(3), {0, 0, 12}), 1e-13);
  EXPECT_EQ(results.master_pressure(), std::vector<double>(4, 0));
  const std::vector<double> values(4, 1);
  EXPECT_REFUSED((void)results.on_both(values, 0));
  EXPECT_REFUSED((void)results.across(values));
}

TEST(Results, TheForceOfSelfContactIsThatOnNodesInContact)
{
  Fold fold;
  ASSERT_TRUE(fold.contact->is_self());
  law::NodeState& nodes = *fold.contact->nodes();
  const std::vector<double> normals = fold.contact->master()->normals();
  Vector<3> force{};
  int closed = 0;
  for (std::int32_t i = 0; i < nodes.num_nodes(); ++i)
    if (nodes.gap[i] < 0)
    {
      nodes.status[i] = law::slip;
      nodes.multiplier[i] = 1 + 0.1 * (i % 3);
      force = force
              + nodes.area[i] * nodes.multiplier[i] * vector_at(normals, i, 3);
      ++closed;
    }
  ASSERT_GT(closed, 5);
  ASSERT_GT(norm(force), 0.5);
  Results results(fold.contact);
  results.update();
  expect_near(results.force(), force, 1e-12);
  expect_near(results.imbalance(), {0, 0, 0}, 1e-12);
}

TEST(Results, VerticesOfQuadraticTrianglesWithoutAPairAreLikeTheirNeighbours)
{
  // One triangle of six nodes in four parts, on a slope; its vertices have no
  // gap, as at a crack's tip
  Scene slave(
      3, {{0, 0, 0}, {0, 2, 0}, {2, 0, 0}, {0, 1, 0}, {1, 0, 0}, {1, 1, 0}},
      {{0, 3, 4}, {3, 1, 5}, {4, 5, 2}, {3, 5, 4}});
  slave.move([](const Vector<3>& p)
             { return Vector<3>{p[0], p[1], 0.1 * p[0] + 0.3 * p[1]}; });
  const auto u = std::make_shared<std::vector<double>>(slave.x.size(), 0.);
  const auto halo = mesh::serial_halo(slave.x, 3, u);
  const auto slaves
      = std::make_shared<SlaveNodes>(halo, slave.facets(), slave.facets());
  slaves->set_level(std::vector<std::int8_t>{0, 0, 0, 1, 1, 1}, false);
  const auto master = std::make_shared<ObstacleMaster>(
      std::make_shared<geometry::Plane>(std::vector<double>{0, 0, 0},
                                        std::vector<double>{0, 0, 1}),
      slaves, slave.x, 3, infinity, false);
  Contact::Options options{
      Sliding::finite, Method::node_to_surface, {}, {1, 1, 1, 0, 0, 0}};
  options.prescribed.assign(u->size(), 0);
  const auto contact = std::make_shared<Contact>(
      halo, slaves, master, std::make_shared<law::Frictionless>(),
      std::move(options));
  contact->search();
  contact->update_gap();
  law::NodeState& nodes = *contact->nodes();
  for (std::size_t i = 0; i < 3; ++i)
    ASSERT_TRUE(std::isnan(nodes.gap[i]));
  std::ranges::fill(nodes.status.begin() + 3, nodes.status.end(), law::slip);
  std::ranges::fill(nodes.multiplier.begin() + 3, nodes.multiplier.end(), 2);
  Results results(contact);
  results.update();
  // Heights in the middles of edges are 0.3, 0.1 and 0.4
  EXPECT_NEAR(results.gap()[0], 0.2, 1e-14);
  EXPECT_NEAR(results.gap()[1], 0.35, 1e-14);
  EXPECT_NEAR(results.gap()[2], 0.25, 1e-14);
  const std::vector<double>& p = results.pressure();
  EXPECT_GT(p[3], 1);
  EXPECT_NEAR(p[0], (p[3] + p[4]) / 2, 1e-14);
  EXPECT_NEAR(p[1], (p[3] + p[5]) / 2, 1e-14);
  EXPECT_NEAR(p[2], (p[4] + p[5]) / 2, 1e-14);
  for (std::size_t i = 0; i < 6; ++i)
  {
    EXPECT_EQ(results.status()[i], law::slip);
    EXPECT_NEAR(results.traction()[3 * i + 2], p[i], 1e-14);
  }
}

TEST(Results, AnAxisymmetricModelHasNoMoment)
{
  for (const double part : {1., 2 * std::numbers::pi})
    for (const bool is_radius : {true, false})
    {
      ContactScene scene(2);
      std::vector<double> weight;
      for (const std::int32_t node : scene.slaves->owned())
        weight.push_back(part * (is_radius ? scene.sheets.x[2 * node] : 1));
      scene.slaves->set_weight(weight);
      const auto contact = scene.contact<NodeToSurface>();
      press(*contact, 1);
      Results results(contact);
      results.update();
      EXPECT_EQ(results.is_axisymmetric(), is_radius);
      EXPECT_NEAR(results.force()[1], is_radius ? part / 2 : part, 1e-13);
      if (is_radius)
      {
        EXPECT_THROW((void)moment(results, 2), std::logic_error);
      }
      else
      {
        EXPECT_NEAR(moment(results, 2)[2], 0.2 * part, 1e-13);
      }
    }
}

TEST(Results, RefuseWhatDoesNotFit)
{
  EXPECT_REFUSED(Results(nullptr));
  ContactScene scene(3);
  const Results results(scene.contact<NodeToSurface>());
  const std::vector<double> few(2, 0), none{0, infinity, 0};
  EXPECT_REFUSED((void)results.moment(few));
  EXPECT_REFUSED((void)results.moment(none));
}
