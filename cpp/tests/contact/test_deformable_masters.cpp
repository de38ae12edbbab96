// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#include "two_sheets.h"
#include <contactx/contact/mobility.h>
#include <contactx/kernel/layout.h>
#include <gtest/gtest.h>
#include <limits>
#include <numbers>

using namespace contactx;
using namespace contactx::contact;
using namespace contactx::tests;

namespace
{
/// What is asked of pairs of either method.
template <class M>
class DeformableMasters : public testing::Test
{
};

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
} // namespace

TYPED_TEST(DeformableMasters, AllThatIsInFrontIsPaired)
{
  for (int gdim : {2, 3})
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
}

TYPED_TEST(DeformableMasters, WeightsReproduceLinearFields)
{
  for (int gdim : {2, 3})
  {
    TwoSheets sheets(gdim);
    const auto pairs = sheets.template pairs<TypeParam>();
    // Slave and master are at the same place: no linear field moves them
    const auto u = sheets.moved(
        [](const Vector<3>& p, bool)
        { return Vector<3>{1 + p[0] - 2 * p[1], 3 * p[0] + p[2], 2 - p[1]}; });
    for (double m :
         movement(pairs->weights(), sheets.num_slaves, u, sheets.gdim))
      EXPECT_NEAR(m, 0, 1e-12);
  }
}

TYPED_TEST(DeformableMasters, AMasterTurnsWithItsFacets)
{
  for (int gdim : {2, 3})
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
  const auto moved = sheets.moved(
      [](Vector<3> p, bool is_slave)
      {
        p[0] += is_slave ? 0.07 : 0.0;
        return p;
      });
  pairs->search(moved, std::vector<std::int8_t>(sheets.num_slaves, 0));
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
  EXPECT_THROW(other->load({}), std::invalid_argument);
}

TYPED_TEST(DeformableMasters, ReachMustBePositive)
{
  TwoSheets sheets(2);
  auto halo = mesh::serial_halo(sheets.x, 2);
  const auto& [offsets, nodes] = sheets.master;
  auto surface = search::make_master_surface(halo, offsets, nodes);
  auto outside = std::make_shared<search::InsideTest>(halo, offsets, nodes);
  auto slaves = std::make_shared<SlaveNodes>(halo, sheets.slave.list(),
                                             sheets.slave.list());
  for (double reach : {0.0, -1.0, std::numeric_limits<double>::quiet_NaN()})
    EXPECT_THROW(TypeParam(halo, slaves, surface, outside,
                           PairingOptions{reach, false, false}),
                 std::invalid_argument);
}

TYPED_TEST(DeformableMasters, SlaveFacetsMustBeOfTheDimension)
{
  const TwoSheets sheets(3), line(2);
  auto halo = mesh::serial_halo(sheets.x, 3);
  const auto& [offsets, nodes] = sheets.master;
  auto surface = search::make_master_surface(halo, offsets, nodes);
  auto outside = std::make_shared<search::InsideTest>(halo, offsets, nodes);
  const auto segments = std::make_shared<SlaveNodes>(halo, line.slave.list(),
                                                     line.slave.list());
  for (const auto& slaves : {segments, std::shared_ptr<SlaveNodes>()})
    EXPECT_THROW(TypeParam(halo, slaves, surface, outside,
                           PairingOptions{1.0, false, false}),
                 std::invalid_argument);
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
      pairs->search(fallen, std::vector<std::int8_t>(sheets.num_slaves, 0));
    const std::vector<double> offset(sheets.num_slaves, 0);
    std::vector<std::int8_t> which(sheets.num_slaves, 0);
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
  const auto aside = sheets.moved(
      [](Vector<3> p, bool is_slave)
      {
        p[0] += is_slave ? 0.5 : 0.0;
        return p;
      });
  const auto before = tie->pairs();
  EXPECT_EQ(tie->search(aside, std::vector<std::int8_t>(sheets.num_slaves, 0)),
            0);
  EXPECT_TRUE(tie->pairs()[0].same(before[0]));
}

TEST(SurfaceToSurface, TheAreaIsWhatTheMasterCovers)
{
  for (int gdim : {2, 3})
  {
    // Half of the slave is beyond the master's end at 2
    TwoSheets sheets(gdim, 0.01, Cells::quadrilaterals);
    const auto pairs = sheets.pairs<SurfaceToSurface>();
    const auto whole
        = geometry::nodal_areas(sheets.slave.list(), sheets.x, gdim);
    const std::vector<double> all(whole.begin(),
                                  whole.begin() + sheets.num_slaves);
    const auto covered = pairs->area(all);
    for (std::int32_t i = 0; i < sheets.num_slaves; ++i)
      EXPECT_NEAR(covered[i], all[i], 1e-12);
    const auto beyond = sheets.moved(
        [](Vector<3> p, bool is_slave)
        {
          p[0] += is_slave ? 1.5 : 0.0;
          return p;
        });
    pairs->search(beyond, std::vector<std::int8_t>(sheets.num_slaves, 0));
    double sum = 0;
    const auto paired = pairs->paired();
    const auto area = pairs->area(all);
    for (std::int32_t i = 0; i < sheets.num_slaves; ++i)
      sum += paired[i] ? area[i] : 0.0;
    EXPECT_NEAR(sum, 0.5, 1e-12);
    EXPECT_NE(paired, ones(sheets.num_slaves));
  }
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
  const auto moved = sheets.moved(
      [](Vector<3> p, bool is_slave)
      {
        p[0] += is_slave ? 0.3 : 0.0;
        return p;
      });
  pairs->search(moved, std::vector<std::int8_t>(sheets.num_slaves, 0));
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
