// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#include "expect.h"
#include "moved_contact.h"
#include <contactx/audit/audit.h>
#include <contactx/audit/penetration.h>
#include <contactx/audit/surfaces_audit.h>
#include <contactx/geometry/sizes.h>

using namespace contactx;
using namespace contactx::audit;
using namespace contactx::tests;
using contact::Sliding;

namespace
{
class AuditOfSurfaces : public testing::TestWithParam<int>
{
protected:
  int gdim() const { return GetParam(); }

  /// The slave's nodes come first, and see the master from a height
  TwoSheets sheets(double height) const
  {
    return TwoSheets(gdim(), height, Cells::quadrilaterals);
  }

  /// A master node that is between slave nodes, at 0.2 along each axis
  std::int32_t between(const TwoSheets& s) const
  {
    for (std::int32_t i = s.num_slaves; i < s.num_nodes(); ++i)
    {
      bool is_it = true;
      for (int k = 0; k + 1 < gdim(); ++k)
        is_it = is_it and std::abs(s.x[gdim() * i + k] - 0.2) < 1e-12;
      if (is_it)
        return i;
    }
    return -1;
  }

  /// Diagonal of a slave facet
  double facet_size() const { return std::sqrt(gdim() - 1.) / 3; }
};

/// A contact of two sheets, and its audit from where it is.
struct AuditedSheets : MovedContact
{
  SurfacesAudit audit;

  AuditedSheets(const TwoSheets& sheets, double reach,
                Sliding sliding = Sliding::finite)
      : MovedContact(sheets, reach, sliding), audit(halo, contact)
  {
    audit.accept();
  }
};

/// Depth that the mesh explains where a node of the facet is in contact, or
/// none is
double explained(const MovedContact& c, const TwoSheets& s, std::int32_t node,
                 double h, bool held)
{
  const auto x = c.halo->now()->x;
  const auto list = s.master.list();
  const auto k = geometry::nodal_curvatures(
      list, x, geometry::nodal_normals(list, x, s.gdim), s.gdim)[node];
  EXPECT_LT(k * h, 0.5);
  const double chord = (1 - std::sqrt(1 - k * k * h * h / 4)) / k;
  return std::max(h * (held ? 0.15 : 1. / 256), 2 * chord);
}

TEST_P(AuditOfSurfaces, NothingIsFoundOnASoundContact)
{
  for (const Sliding sliding : {Sliding::finite, Sliding::small})
    for (const double height : {0., 0.05})
    {
      const TwoSheets s = sheets(height);
      AuditedSheets c(s, 1, sliding);
      const auto start = c.halo->now()->x;
      c.move(0, s.num_slaves, -height);
      c.contact->search();
      const Findings found = c.audit.find(start);
      EXPECT_FALSE(found.is_fault());
      EXPECT_EQ(found.passed.count, 0);
      EXPECT_EQ(found.inside.count, 0);
      ASSERT_TRUE(found.deepest.has_value());
      EXPECT_NEAR(found.deepest->depth, 0, 1e-14);
      EXPECT_NEAR(found.facet_size, facet_size(), 1e-14);
    }
}

TEST_P(AuditOfSurfaces, SlaveNodesBehindTheMasterWithoutAPair)
{
  const TwoSheets s = sheets(0.5);
  for (const Sliding sliding : {Sliding::finite, Sliding::small})
  {
    AuditedSheets c(s, 0.2, sliding);
    // Of a master facet's size a 32nd part is allowed
    const double h = 3. / 5 * std::sqrt(gdim() - 1.);
    for (const double depth : {0.9 * h / 32, 1.1 * h / 32, 0.1})
    {
      c.move(0, s.num_slaves, -0.5);
      (*c.displacement)[2 * gdim() - 1] = -0.5 - depth;
      const auto x = c.halo->now()->x;
      const Findings found = c.audit.find(x);
      EXPECT_EQ(found.passed.count, 0);
      ASSERT_EQ(found.inside.count, depth > h / 32) << depth;
      if (found.inside.count == 0)
        continue;
      EXPECT_TRUE(found.is_fault());
      EXPECT_EQ(found.inside.first, 1);
      EXPECT_EQ(found.inside.at, std::vector<double>(x.begin() + gdim(),
                                                     x.begin() + 2 * gdim()));
      EXPECT_FALSE(found.penetrates_too_deep)
          << "what else is found comes first";
    }
    // An overlap that was asked for
    c.contact->set_offset(std::vector<double>(s.num_slaves, -0.1));
    EXPECT_EQ(c.audit.find(c.halo->now()->x).inside.count, 0);
    c.contact->set_offset(std::vector<double>(s.num_slaves, 0.));
    EXPECT_EQ(c.audit.find(c.halo->now()->x).inside.count, 1);
    // They may be there for good
    c.audit.accept();
    EXPECT_EQ(c.audit.find(c.halo->now()->x).inside.count, 0);
  }
}

TEST_P(AuditOfSurfaces, NodesThatWentThroughWithinAStep)
{
  const int lines = gdim() - 1;
  const auto power = [lines](std::int64_t n) { return lines == 1 ? n : n * n; };
  const TwoSheets s = sheets(0.1);
  struct Case
  {
    double way;
    std::int64_t count;
  };
  // On a way longer than a slave facet master nodes may have passed, too: two
  // a line are below the slave
  for (const auto& [way, count] :
       {Case{0.05, 0}, Case{0.15, 0}, Case{0.3, power(4)},
        Case{0.8, power(4) + power(2)}})
  {
    AuditedSheets c(s, 0.05);
    const auto start = c.halo->now()->x;
    c.move(0, s.num_slaves, -way);
    const Findings found = c.audit.find(start);
    EXPECT_EQ(found.passed.count, count) << way;
    EXPECT_EQ(found.is_fault(), count > 0 or found.inside.count > 0);
    if (count == 0)
      continue;
    EXPECT_EQ(found.passed.first, 0);
    const auto x = c.halo->now()->x;
    EXPECT_EQ(found.passed.at,
              std::vector<double>(x.begin(), x.begin() + gdim()));
    EXPECT_EQ(found.inside.count, 0);
    EXPECT_FALSE(found.penetrates_too_deep);
    EXPECT_EQ(c.audit.find(x).passed.count, 0) << "it was not in this step";
  }
}

TEST_P(AuditOfSurfaces, NodesThatWentThroughAndHaveAPair)
{
  // As thin bodies have behind each other: the pairs are those of the start
  const TwoSheets s = sheets(0.1);
  AuditedSheets c(s, 1);
  c.contact->search();
  for (const std::int8_t paired : c.contact->master()->paired())
    ASSERT_TRUE(paired);
  const auto start = c.halo->now()->x;
  c.move(0, s.num_slaves, -0.8);
  // All of them, and of the master two a line that are below the slave
  EXPECT_EQ(c.audit.find(start).passed.count,
            s.num_slaves + (gdim() == 2 ? 2 : 4));
  c.move(0, s.num_slaves, -0.1 - 1e-3 * facet_size());
  EXPECT_EQ(c.audit.find(start).passed.count, 0);
}

TEST_P(AuditOfSurfaces, FacetsThatBecomeLongAllowNoMore)
{
  // As those of leaves that have flown past each other
  const TwoSheets s = sheets(0.1);
  AuditedSheets c(s, 0.05);
  const auto start = c.halo->now()->x;
  c.move(0, s.num_slaves, -0.3);
  c.move(s.num_nodes() - 1, s.num_nodes(), -50);
  EXPECT_GT(c.audit.find(start).passed.count, 0);
}

TEST_P(AuditOfSurfaces, MasterThatReachesBetweenSlaveNodes)
{
  const double height = 0.28, depth = 0.02, h = facet_size();
  const TwoSheets s = sheets(height);
  for (const bool held : {false, true})
  {
    AuditedSheets c(s, 1);
    const std::int32_t node = between(s);
    ASSERT_GE(node, 0);
    c.move(node, node + 1, height + depth);
    if (held)
      c.contact->nodes()->close(c.contact->slaves().facets()[0]);
    const auto x = c.halo->now()->x;
    const Findings found = c.audit.find(x);
    EXPECT_EQ(found.passed.count + found.inside.count, 0);
    ASSERT_TRUE(found.deepest.has_value());
    const double allowed = explained(c, s, node, h, held);
    EXPECT_NEAR(found.deepest->depth, depth, 1e-14);
    EXPECT_NEAR(found.deepest->size, h, 1e-14);
    EXPECT_NEAR(found.deepest->excess, depth / allowed, 1e-12 / allowed);
    EXPECT_EQ(found.deepest->excess > 1, not held);
    EXPECT_EQ(found.penetrates_too_deep, not held);
    EXPECT_EQ(found.is_fault(), not held);
    EXPECT_EQ(found.deepest->at,
              std::vector<double>(x.begin() + gdim() * node,
                                  x.begin() + gdim() * (node + 1)));
  }
}

TEST_P(AuditOfSurfaces, SmallSlidingSeesGapsThatAreLinear)
{
  // A master that is moved up at one node alone has the normals of before
  const double height = 0.28, depth = 0.02, h = facet_size();
  const TwoSheets s = sheets(height);
  AuditedSheets c(s, 1, Sliding::small);
  const std::int32_t node = between(s);
  c.move(node, node + 1, height + depth);
  const Findings found = c.audit.find(c.halo->now()->x);
  ASSERT_TRUE(found.deepest.has_value());
  EXPECT_NEAR(found.deepest->depth, depth, 1e-14);
  EXPECT_NEAR(found.deepest->excess, depth * 256 / h, 1e-9);
  EXPECT_TRUE(found.penetrates_too_deep);
}

TEST_P(AuditOfSurfaces, WhatBothSurfacesHaveIsNoMaster)
{
  // The master node between slave nodes counts as one of a crack's tip
  const TwoSheets s = sheets(0.28);
  MovedContact c(s, 1, Sliding::finite);
  const std::int32_t node = between(s);
  contact::Contact::Options options{
      Sliding::finite, contact::Method::node_to_surface, {}, {}};
  options.prescribed.assign(c.displacement->size(), 0);
  options.shared.assign(s.num_nodes(), 0);
  options.shared[node] = 1;
  const auto list = s.slave.list();
  c.contact = std::make_shared<contact::Contact>(
      c.halo, std::make_shared<const contact::SlaveNodes>(c.halo, list, list),
      c.contact->master(), c.contact->law(), options);
  SurfacesAudit audit(c.halo, c.contact);
  c.move(node, node + 1, 0.3);
  const Findings found = audit.find(c.halo->now()->x);
  ASSERT_TRUE(found.deepest.has_value());
  EXPECT_LT(found.deepest->depth, 0);
}

TEST_P(AuditOfSurfaces, StepsStartWhereverTheDisplacementIs)
{
  const TwoSheets s = sheets(0.1);
  MovedContact c(s, 0.05, Sliding::finite);
  Audit audit(c.halo, {c.contact});
  audit.begin_step();
  c.move(0, s.num_slaves, -0.3);
  EXPECT_GT(audit.find().at(0).passed.count, 0);
  c.contact->set_active(false);
  EXPECT_EQ(audit.find().at(0).passed.count, 0);
  c.contact->set_active(true);
  EXPECT_GT(audit.find().at(0).passed.count, 0);
  // A displacement that was put there, not solved for
  audit.begin_step();
  EXPECT_EQ(audit.find().at(0).passed.count, 0);
  EXPECT_EQ(audit.find().at(0).inside.count, 0);
}

TEST_P(AuditOfSurfaces, TiesAreNotLookedAt)
{
  const TwoSheets s = sheets(0.1);
  MovedContact c(s, 0.05, Sliding::finite, std::make_shared<law::Tied>());
  Audit audit(c.halo, {c.contact});
  c.move(0, s.num_slaves, -0.3);
  const auto found = audit.find();
  ASSERT_EQ(found.size(), 1);
  EXPECT_FALSE(found[0].is_fault());
  EXPECT_FALSE(found[0].deepest.has_value());
}

INSTANTIATE_TEST_SUITE_P(All, AuditOfSurfaces, testing::Values(2, 3));

/// A slave sheet over a master whose facets meet at a right angle at 0.2; the
/// slave slopes down there, and at its node at zero it turns by an angle.
class EdgesOfMasters : public testing::TestWithParam<int>
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
      expect_says(found.warnings[0],
                  "take 66.7 % of the force along normals of their faces, 30 "
                  "degrees off");
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
        expect_says(none.warnings[0], "is 0.01 deep in a slave facet");
      }
      const std::size_t i = at_zero(s);
      for (const double part : {0.9, 1.1})
      {
        // Stiffness is that of the facet's node of most area
        const double most = std::ranges::max(c.contact->nodes()->area);
        press(c, i, 2 * most * depth / part);
        const Findings found = audit.find(x);
        ASSERT_TRUE(found.edges);
        EXPECT_NEAR(found.edges->unseen, counts ? part : 0, 1e-9);
        EXPECT_EQ(found.edges->ratio() == contactx::infinity,
                  counts and part > 1);
      }
    }
}

INSTANTIATE_TEST_SUITE_P(All, EdgesOfMasters, testing::Values(2, 3));
} // namespace
