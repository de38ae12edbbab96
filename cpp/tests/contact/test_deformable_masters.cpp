// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#include "expect.h"
#include "two_sheets.h"
#include <contactx/contact/mobility.h>
#include <contactx/contact/slip_weights.h>
#include <contactx/kernel/layout.h>

using namespace contactx;
using namespace contactx::contact;
using namespace contactx::tests;

namespace
{
template <class>
using DeformableMasters = testing::Test;

using Methods = testing::Types<NodeToSurface, SurfaceToSurface>;
TYPED_TEST_SUITE(DeformableMasters, Methods);

std::vector<std::int8_t> ones(std::size_t n)
{
  return std::vector<std::int8_t>(n, 1);
}

/// Relative movement of each slave node in a field of displacements.
std::vector<double> movement(const kernel::Weights& weights, std::size_t n,
                             std::span<const double> u, int gdim)
{
  std::vector<double> moved(n * gdim, 0);
  for (std::size_t e = 0; e < weights.values.size(); ++e)
    for (int k = 0; k < gdim; ++k)
      moved[std::size_t(weights.slaves[e]) * gdim + k]
          += weights.values[e] * u[std::size_t(weights.nodes[e]) * gdim + k];
  return moved;
}

TYPED_TEST_2D_3D(DeformableMasters, AllThatIsInFrontIsPaired, gdim)
{
  TwoSheets sheets(gdim, 0.01);
  const auto pairs = sheets.template pairs<TypeParam>();
  EXPECT_EQ(pairs->paired(), ones(sheets.num_slaves));
  const auto normals = pairs->normals();
  for (std::int32_t i = 0; i < sheets.num_slaves; ++i)
    for (int k = 0; k < 3; ++k)
      EXPECT_NEAR(normals[3 * i + k], k == gdim - 1, 1e-12);
  EXPECT_TRUE(pairs->frozen_pairs().empty());
}

TYPED_TEST_2D_3D(DeformableMasters, WeightsReproduceLinearFields, gdim)
{
  TwoSheets sheets(gdim);
  const auto pairs = sheets.template pairs<TypeParam>();
  // Slave and master are at the same place: no linear field moves them
  const auto u = sheets.moved(
      [](const Vector<3>& p, bool)
      { return Vector<3>{1 + p[0] - 2 * p[1], 3 * p[0] + p[2], 2 - p[1]}; });
  for (double m : movement(pairs->weights(), sheets.num_slaves, u, sheets.gdim))
    EXPECT_NEAR(m, 0, 1e-12);
}

TYPED_TEST_2D_3D(DeformableMasters, AMasterTurnsWithItsFacets, gdim)
{
  TwoSheets sheets(gdim, 0.01);
  const auto pairs = sheets.template pairs<TypeParam>();
  EXPECT_FALSE(pairs->turn(sheets.x));
  const double angle = 0.4;
  const auto turn = pairs->turn(sheets.turned(angle));
  ASSERT_TRUE(turn);
  const int z = gdim - 1;
  for (std::int32_t i = 0; i < sheets.num_slaves; ++i)
    for (int r = 0; r < gdim; ++r)
      for (int c = 0; c < gdim; ++c)
      {
        double expected = r == c;
        if ((r == 0 or r == z) and (c == 0 or c == z))
          expected = r == c   ? std::cos(angle)
                     : r == 0 ? -std::sin(angle)
                              : std::sin(angle);
        EXPECT_NEAR((*turn)[gdim * (gdim * i + r) + c], expected, 1e-12);
      }
}

TYPED_TEST(DeformableMasters, ComplianceIsThatOfTheFacetsInFront)
{
  TwoSheets sheets(3, 0.01);
  const auto pairs = sheets.template pairs<TypeParam>();
  std::vector<double> nodal(sheets.num_nodes(), 5.0);
  for (std::int32_t i = sheets.num_slaves; i < sheets.num_nodes(); ++i)
    nodal[i] = 2.0;
  for (double c : pairs->compliance(nodal))
    EXPECT_NEAR(c, 2.0, 1e-12);
}

TYPED_TEST(DeformableMasters, NothingMovesWhereAllIsPrescribed)
{
  TwoSheets sheets(3, 0.01);
  const auto pairs = sheets.template pairs<TypeParam>();
  std::vector<std::int8_t> free(sheets.x.size(), 1);
  const Mobility all = pairs->mobility(free);
  EXPECT_EQ(all.normal, std::vector<double>(sheets.num_slaves, 1));
  // Across the normal nothing may move
  for (std::int32_t i = 0; i < sheets.num_nodes(); ++i)
    free[3 * i + 2] = 0;
  const Mobility none = pairs->mobility(free);
  for (std::int32_t i = 0; i < sheets.num_slaves; ++i)
  {
    EXPECT_NEAR(none.normal[i], 0, 1e-8);
    EXPECT_EQ(none.each[3 * i + 2], 0);
    EXPECT_GT(none.each[3 * i], 0.5);
  }
}

TYPED_TEST(DeformableMasters, WhatIsSavedComesBack)
{
  TwoSheets sheets(3, 0.01);
  const auto pairs = sheets.template pairs<TypeParam>();
  const auto moved = sheets.aside(0.07);
  pairs->search(moved, sheets.open());
  sheets.halo->set_start(sheets.moved_by(moved));
  pairs->begin_step();
  const auto saved = pairs->save();
  const auto other = sheets.template pairs<TypeParam>();
  sheets.halo->set_start(sheets.moved_by(moved));
  other->load(saved);
  const auto expected = pairs->pairs(), found = other->pairs();
  ASSERT_EQ(found.size(), expected.size());
  for (std::size_t g = 0; g < found.size(); ++g)
  {
    EXPECT_TRUE(found[g].same(expected[g]));
    EXPECT_EQ(found[g].data, expected[g].data);
    EXPECT_EQ(found[g].slip, expected[g].slip);
  }
  EXPECT_REFUSED(other->load({}));
}

TYPED_TEST(DeformableMasters, ReachMustBePositiveAndSlavesOfTheDimension)
{
  const TwoSheets sheets(3), line(2);
  auto halo = mesh::serial_halo(sheets.x, 3);
  const auto& [offsets, nodes] = sheets.master;
  auto surface = search::make_master_surface(halo, offsets, nodes);
  auto outside = std::make_shared<search::InsideTest>(halo, offsets, nodes);
  const auto slaves_of = [&](const geometry::Facets& facets)
  { return std::make_shared<SlaveNodes>(halo, facets.list(), facets.list()); };
  const auto make = [&](std::shared_ptr<SlaveNodes> slaves, double reach)
  {
    TypeParam(halo, slaves, surface, outside,
              PairingOptions{reach, false, false});
  };
  EXPECT_NO_THROW(make(slaves_of(sheets.slave), 1));
  for (double reach : {0.0, -1.0, std::nan("")})
    EXPECT_REFUSED(make(slaves_of(sheets.slave), reach));
  for (const auto& slaves :
       {slaves_of(line.slave), std::shared_ptr<SlaveNodes>()})
    EXPECT_REFUSED(make(slaves, 1));
}

TEST(NodeToSurface, ANodeThatFallsAsideSlipsFromWhereItTouches)
{
  for (bool is_small : {false, true})
  {
    // From a height of 0.1 to a depth of 0.1, and 0.2 aside: half of the way
    TwoSheets sheets(2, 0.1);
    const auto pairs = sheets.pairs<NodeToSurface>(is_small);
    const auto fallen = sheets.moved(
        [](Vector<3> p, bool is_slave)
        {
          if (is_slave)
            p = p + Vector<3>{0.2, -0.2, 0};
          return p;
        });
    if (not is_small)
      pairs->search(fallen, sheets.open());
    const std::vector<double> offset(sheets.num_slaves, 0);
    auto which = sheets.open();
    which[1] = 1;
    pairs->touch(which, fallen, sheets.moved_by(fallen), offset);
    int found = 0;
    for (const Saved& s : pairs->save())
      if (s.name == (is_small ? "moved" : "start"))
      {
        const auto& start = std::get<std::vector<double>>(s.values);
        // In small sliding the movement relative to the master
        EXPECT_NEAR(start[2], is_small ? 0.1 : sheets.x[2] + 0.1, 1e-12);
        EXPECT_NEAR(start[3], is_small ? -0.1 : 0, 1e-12);
        ++found;
        // Others stay
        if (is_small)
        {
          EXPECT_EQ(start[0], 0);
          EXPECT_EQ(start[1], 0);
          continue;
        }
        EXPECT_EQ(start[0], sheets.x[0]);
        EXPECT_EQ(start[1], sheets.x[1]);
      }
    EXPECT_EQ(found, 1);
  }
}

TEST(NodeTie, TheOffsetMakesItLonger)
{
  TwoSheets sheets(3, 0.05);
  const auto tie = sheets.pairs<NodeTie>();
  EXPECT_FALSE(
      tie->update(sheets.x, false, std::vector<double>(sheets.num_slaves, 0)));
  const auto longer = tie->update(sheets.x, false,
                                  std::vector<double>(sheets.num_slaves, 0.01));
  ASSERT_TRUE(longer);
  for (const kernel::Pairs& p : *longer)
    for (std::size_t i = 0; i < p.size(); ++i)
    {
      const auto slip = p.slip_row<kernel::FacetSlip>(i);
      EXPECT_NEAR(slip.gap, 0.06, 1e-12);
      EXPECT_NEAR(slip.origin[2], 0.06, 1e-12);
      EXPECT_NEAR(slip.origin[0], 0, 1e-12);
    }
  // Only the first search counts
  const auto before = tie->pairs();
  EXPECT_EQ(tie->search(sheets.aside(0.5), sheets.open()), 0);
  EXPECT_TRUE(tie->pairs()[0].same(before[0]));
}

TEST_2D_3D(SurfaceToSurface, TheAreaIsWhatTheMasterCovers, gdim)
{
  // Half of the slave is beyond the master's end at 2
  TwoSheets sheets(gdim, 0.01, Cells::quadrilaterals);
  const auto pairs = sheets.pairs<SurfaceToSurface>();
  const auto whole = geometry::nodal_areas(sheets.slave.list(), sheets.x, gdim);
  const std::vector<double> all(whole.begin(),
                                whole.begin() + sheets.num_slaves);
  expect_near(pairs->area(all), all, 1e-12);
  pairs->search(sheets.aside(1.5), sheets.open());
  double sum = 0;
  const auto paired = pairs->paired();
  const auto area = pairs->area(all);
  for (std::int32_t i = 0; i < sheets.num_slaves; ++i)
    sum += paired[i] ? area[i] : 0.0;
  EXPECT_NEAR(sum, 0.5, 1e-12);
  EXPECT_NE(paired, ones(sheets.num_slaves));
}

TEST(SurfaceToSurface, SlipIsMeasuredWithTheWeightsOfTheStart)
{
  TwoSheets sheets(3, 0.01);
  const auto pairs = sheets.pairs<SurfaceToSurface>();
  const auto count = [](const std::vector<kernel::Pairs>& groups)
  {
    return std::ranges::count_if(groups, [](const kernel::Pairs& p)
                                 { return p.is_movement; });
  };
  EXPECT_GT(count(pairs->pairs()), 0);
  const auto start = pairs->pairs().back();
  pairs->search(sheets.aside(0.3), sheets.open());
  EXPECT_TRUE(pairs->pairs().back().same(start));
  const auto other = sheets.pairs<SurfaceToSurface>(false, false);
  EXPECT_EQ(count(other->pairs()), 0);
}

TEST(SurfaceTie, TheOffsetIsAddedToTheGap)
{
  TwoSheets sheets(2, 0.05);
  const auto tie = sheets.pairs<SurfaceTie>();
  const auto sum = [](const std::vector<kernel::Pairs>& groups)
  {
    double total = 0;
    for (const kernel::Pairs& p : groups)
    {
      const kernel::MortarLayout at(p.num_slaves, p.num_nodes);
      for (std::size_t i = 0; i < p.size(); ++i)
        for (int s = 0; s < p.num_slaves; ++s)
          total += p.data[at.size * i + at.gap + s];
    }
    return total;
  };
  // The slave is one long
  EXPECT_NEAR(sum(tie->pairs()), 0.05, 1e-12);
  const auto longer = tie->update(sheets.x, false,
                                  std::vector<double>(sheets.num_slaves, 0.02));
  ASSERT_TRUE(longer);
  EXPECT_NEAR(sum(*longer), 0.07, 1e-12);
}

TEST(FreeSquares, PartsWithTheSameNodeAddUpFirst)
{
  // Slave node 0 has node 2 in two facets; node 1 of it is prescribed along x
  const kernel::Weights weights{
      {0, 0, 0, 0}, {0, 1, 2, 2}, {1, -0.5, -0.2, -0.3}};
  std::vector<std::int8_t> free{1, 1, 0, 1, 1, 1};
  const std::vector<std::int8_t> paired{1, 1};
  const auto squares = free_squares(weights, free, paired, 2);
  EXPECT_NEAR(squares[0], 1 + 0.25, 1e-15);
  EXPECT_NEAR(squares[1], 1 + 0.25 + 0.25, 1e-15);
  // Of what nothing is prescribed
  EXPECT_EQ(squares[2], 1);
}

/// A slave node with made-up weights over some facets of a master in a frame.
struct Weighted
{
  TwoSheets sheets;
  SlaveNodes slaves;
  MortarSides sides;
  Mortar mortar;
  std::vector<double> x;

  explicit Weighted(int gdim, double angle)
      : sheets(gdim, 0.1), slaves(mesh::serial_halo(sheets.x, gdim),
                                  sheets.slave.list(), sheets.slave.list()),
        sides(slaves, sheets.x, gdim), x(sheets.turned(angle))
  {
    sides.set_master_facets(sheets.master.list(), {});
    const std::size_t w = mortar.width = sides.width();
    mortar.slave = {0, 0, 0};
    mortar.master = {0, 1, 3};
    mortar.gap.assign(3 * w, 0);
    mortar.weight.assign(3 * w * w, 0);
    double total = 0;
    for (std::size_t p = 0; p < 3; ++p)
      for (int l = 0; l < gdim; ++l)
        total += at(p, l) = l == 0 and p == 2 ? -0.1 : 0.1 + 0.1 * p + 0.2 * l;
    for (double& value : mortar.weight)
      value /= total;
  }

  double& at(std::size_t p, int l)
  {
    return mortar.weight[p * mortar.width * mortar.width + l];
  }

  /// Normals of all slave nodes.
  std::vector<double> normals(double angle) const
  {
    std::vector<double> n(3 * sides.size(), 0);
    for (std::size_t i = 0; i < sides.size(); ++i)
    {
      n[3 * i] = -std::sin(angle);
      n[3 * i + sheets.gdim - 1] = std::cos(angle);
    }
    return n;
  }

  /// Slave node less the master's points.
  std::vector<double> distances(const Mortar& m) const
  {
    const int g = sheets.gdim;
    std::vector<double> d(g * sides.size(), 0);
    const std::size_t i = sides.numbers(0)[0];
    const std::int32_t node = sides.slaves()[i];
    for (int k = 0; k < g; ++k)
    {
      d[g * i + k] = x[g * node + k];
      for (std::size_t p = 0; p < m.size(); ++p)
        for (int l = 0; l < m.width; ++l)
          d[g * i + k]
              -= m.row(p, 0)[l] * x[g * sides.master_nodes(m.master[p])[l] + k];
    }
    return d;
  }
};

TEST_2D_3D(SlipWeights, PutMastersRightBeforeTheirNodeInAnyFrame, gdim)
{
  for (double angle : {0.0, 0.7, 1.5})
  {
    const Weighted w(gdim, angle);
    const auto n = w.normals(angle);
    const auto before = w.distances(w.mortar);
    const Mortar found = slip_weights(w.mortar, w.sides, before, n, w.x, gdim);
    const auto after = w.distances(found);
    const std::size_t i = w.sides.numbers(0)[0];
    double along = 0, was = 0;
    for (int k = 0; k < gdim; ++k)
    {
      along += n[3 * i + k] * after[gdim * i + k];
      was += n[3 * i + k] * before[gdim * i + k];
    }
    double across = 0, offset = 0;
    for (int k = 0; k < gdim; ++k)
    {
      across = std::max(across,
                        std::abs(after[gdim * i + k] - along * n[3 * i + k]));
      offset = std::max(offset,
                        std::abs(before[gdim * i + k] - was * n[3 * i + k]));
    }
    EXPECT_GT(offset, 0.1);
    EXPECT_LT(across, 1e-12);
    EXPECT_NEAR(along, was, 1e-12); // masters are in a plane
    const auto sum = [](const std::vector<double>& values)
    { return std::accumulate(values.begin(), values.end(), 0.0); };
    EXPECT_NEAR(sum(found.weight), 1, 1e-12);
    // The same weights in any frame
    const Weighted flat(gdim, 0);
    const Mortar upright
        = slip_weights(flat.mortar, flat.sides, flat.distances(flat.mortar),
                       flat.normals(0), flat.x, gdim);
    for (std::size_t e = 0; e < found.weight.size(); ++e)
    {
      EXPECT_NEAR(found.weight[e], upright.weight[e], 1e-12);
      if (w.mortar.weight[e] == 0)
      {
        EXPECT_EQ(found.weight[e], 0);
      }
    }
  }
}

TEST_2D_3D(SlipWeights, LeaveWhatIsRightBeforeTheirNode, gdim)
{
  const Weighted w(gdim, 0.7);
  const std::vector<double> n = w.normals(0.7);
  std::vector<double> d(gdim * w.sides.size(), 0);
  for (std::size_t i = 0; i < w.sides.size(); ++i)
    for (int k = 0; k < gdim; ++k)
      d[gdim * i + k] = 0.3 * n[3 * i + k];
  const Mortar found = slip_weights(w.mortar, w.sides, d, n, w.x, gdim);
  expect_near(found.weight, w.mortar.weight, 1e-14);
}

TEST(SlipWeights, LeaveMastersInOneLineAlone)
{
  // Nothing is known across it
  Weighted w(3, 0);
  for (std::size_t p = 0; p < 3; ++p)
    for (int l = 0; l < 3; ++l)
      w.at(p, l) = p == 0 and l < 2 ? 0.5 : 0.0;
  const Mortar found = slip_weights(w.mortar, w.sides, w.distances(w.mortar),
                                    w.normals(0), w.x, 3);
  EXPECT_EQ(found.weight, w.mortar.weight);
}
} // namespace
