// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#include "moved_contact.h"
#include <contactx/audit/surfaces_audit.h>
#include <gtest/gtest.h>
#include <numbers>

using namespace contactx;
using namespace contactx::audit;
using namespace contactx::tests;
using contact::Sliding;

namespace
{
/// A slave sheet over a master whose facets meet at a right angle at 0.2; the
/// slave slopes down there, and at its node at zero it turns by an angle.
class EdgesOfMasters : public ::testing::TestWithParam<int>
{
protected:
  static constexpr double edge = 0.2;

  int gdim() const { return GetParam(); }

  TwoSheets sheets(double slope, double turn = 0, double height = 0.1) const
  {
    TwoSheets s(gdim(), 0, Cells::quadrilaterals);
    const int z = gdim() - 1;
    s.x = s.moved(
        [=](Vector<3> p, bool is_slave)
        {
          if (is_slave)
          {
            p[0] -= 1. / 3;
            p[z] = height - (p[0] - edge) * std::tan(slope);
            if (p[0] < 0)
              p[z] += p[0] * (std::tan(slope) - std::tan(slope + turn));
          }
          else if (p[0] > edge)
          {
            p[z] = edge - p[0];
            p[0] = edge;
          }
          return p;
        });
    return s;
  }

  /// Number of a slave node at zero along the first axis
  std::size_t at_zero(const TwoSheets& s) const
  {
    for (std::int32_t i = 0; i < s.num_slaves; ++i)
      if (std::abs(s.x[gdim() * i]) < 1e-12)
        return i;
    return 0;
  }

  /// Press a node, of the factor c = 2 in the complementarity
  void press(MovedContact& c, std::size_t i, double force) const
  {
    law::NodeState& state = *c.contact->nodes();
    std::ranges::fill(state.c, 2);
    state.status[i] = law::slip;
    state.multiplier[i] = force / state.area[i];
  }
};

constexpr double degree = std::numbers::pi / 180;
} // namespace

TEST_P(EdgesOfMasters, WhatTheyTakeIsComparedWithTheNormalOfASmoothSlave)
{
  for (const double angle : {1., 4., 30.})
    for (const double turn : {0., -55.})
    {
      const TwoSheets s = sheets(angle * degree, turn * degree);
      MovedContact c(s, 1, Sliding::finite);
      SurfacesAudit audit(c.halo, c.contact);
      c.contact->search();
      press(c, at_zero(s), 3);
      const Findings found = audit.find(c.halo->now()->x);
      ASSERT_TRUE(found.edges);
      // The node is at two thirds of the facet that ends at the edge
      EXPECT_NEAR(found.edges->share, 2. / 3, 1e-12);
      const double off
          = turn < 0 ? 0 : 2. / 3 * 2 * std::sin(angle * degree / 2);
      EXPECT_NEAR(found.edges->off, off, 1e-12);
      EXPECT_EQ(found.edges->unseen, 0);
      EXPECT_EQ(found.edges->ratio(), found.edges->off);
      EXPECT_EQ(found.edges->is_coarse(), off > 0.05);
      ASSERT_EQ(found.warnings.size(), off > 0.05);
      if (found.warnings.empty())
        continue;
      EXPECT_NEAR(found.edges->at[0], edge, 1e-14);
      EXPECT_NEAR(found.edges->at[gdim() - 1], 0, 1e-14);
      EXPECT_NE(found.warnings[0].find("take 66.7 % of the force along normals "
                                       "of their faces, 30 degrees off"),
                std::string::npos)
          << found.warnings[0];
      audit.accept();
      EXPECT_TRUE(audit.find(c.halo->now()->x).warnings.empty());
    }
}

TEST_P(EdgesOfMasters, ThoseThatNodesDoNotSeeAreComparedWithWhatNodesTake)
{
  for (const Sliding sliding : {Sliding::finite, Sliding::small})
    for (const double angle : {10., 30., 80.})
    {
      const double depth = 0.01;
      const TwoSheets s = sheets(angle * degree, 0, 0);
      MovedContact c(s, 1, sliding);
      SurfacesAudit audit(c.halo, c.contact);
      c.contact->search();
      // Along the last axis, of which the normal has a part
      c.move(0, s.num_slaves, -depth / std::cos(angle * degree));
      const auto x = c.halo->now()->x;
      const bool counts = angle == 30; // others are as faces are
      const Findings none = audit.find(x);
      ASSERT_EQ(none.edges.has_value(), counts);
      if (counts)
      {
        EXPECT_EQ(none.edges->unseen, contactx::infinity);
        EXPECT_EQ(none.edges->ratio(), contactx::infinity);
        EXPECT_NEAR(none.edges->depth, depth, 1e-12);
        EXPECT_NEAR(none.edges->hidden[0], edge, 1e-14);
        ASSERT_EQ(none.warnings.size(), 1);
        EXPECT_NE(none.warnings[0].find("is 0.01 deep in a slave facet"),
                  std::string::npos)
            << none.warnings[0];
      }
      const std::size_t i = at_zero(s);
      for (const double part : {0.9, 1.1})
      {
        // Stiffness is that of the facet's node of most area
        double most = 0;
        for (const double area : c.contact->nodes()->area)
          most = std::max(most, area);
        press(c, i, 2 * most * depth / part);
        const Findings found = audit.find(x);
        ASSERT_TRUE(found.edges);
        EXPECT_NEAR(found.edges->unseen, counts ? part : 0, 1e-9);
        EXPECT_EQ(found.edges->ratio() == contactx::infinity,
                  counts and part > 1);
      }
    }
}

INSTANTIATE_TEST_SUITE_P(All, EdgesOfMasters, ::testing::Values(2, 3));
