// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#include "moved_contact.h"
#include "obstacles.h"
#include <contactx/audit/audit.h>
#include <contactx/audit/obstacle_audit.h>
#include <contactx/audit/surfaces_audit.h>

using namespace contactx;
using namespace contactx::audit;
using namespace contactx::tests;
using contact::Sliding;

namespace
{
/// Three segments from 0 to 1 that look down, at a height
Scene segments(double height)
{
  return sheet(2, 3, {}, false, 0, 1, level(2, height));
}

std::shared_ptr<geometry::Sphere> disc(double x, double y, double radius)
{
  return std::make_shared<geometry::Sphere>(std::vector<double>{x, y}, radius);
}

/// A contact with an obstacle, and its audit from where it is.
struct Audited : MovedContact
{
  ObstacleAudit audit;

  Audited(const Scene& slave, std::shared_ptr<geometry::Obstacle> obstacle)
      : MovedContact(slave, std::move(obstacle)), audit(halo, contact)
  {
    audit.accept();
  }
};

/// The same disc as a function that is its distance, and fails where it is told
/// to
std::shared_ptr<geometry::LevelSet>
function(double cx, double cy, double radius, const bool* fails = nullptr)
{
  return std::make_shared<geometry::LevelSet>(
      [=](std::span<const double> x, int, int)
      {
        if (fails and *fails)
          throw std::runtime_error("the function fails");
        geometry::LevelValues at;
        for (std::size_t i = 0; i < x.size(); i += 2)
        {
          const double dx = x[i] - cx, dy = x[i + 1] - cy;
          const double r = std::hypot(dx, dy);
          at.value.push_back(r - radius);
          at.gradient.insert(at.gradient.end(), {dx / r, dy / r});
        }
        return at;
      });
}
} // namespace

TEST(AuditOfObstacles, ReachesBetweenSlaveNodes)
{
  const double radius = 0.1, h = 1. / 3;
  for (const double depth : {-0.02, 0.07})
  {
    Audited c(segments(0), disc(0.5, depth - radius, radius));
    const Findings found = c.audit.find({});
    EXPECT_EQ(found.passed.count + found.inside.count, 0);
    EXPECT_EQ(found.penetrates_too_deep, depth > 0);
    EXPECT_EQ(found.is_fault(), depth > 0);
    EXPECT_NEAR(found.facet_size, h, 1e-15);
    if (depth < 0)
      continue;
    ASSERT_TRUE(found.deepest.has_value());
    EXPECT_NEAR(found.deepest->depth, depth, 1e-14);
    EXPECT_NEAR(found.deepest->size, h, 1e-15);
    EXPECT_FALSE(found.deepest->is_held);
    // The facet does not resolve a curvature of at least 1 / radius, and what
    // is away from contact sees no more of the disc than its diameter
    EXPECT_GE(found.deepest->excess, depth * 256 / (2 * radius));
    ASSERT_EQ(found.deepest->at.size(), 2);
    EXPECT_NEAR(found.deepest->at[0], 0.5, 1e-15);
    EXPECT_NEAR(found.deepest->at[1], 0, 1e-15);
  }
}

TEST(AuditOfObstacles, IsSeenHoweverNarrow)
{
  // A 17th of the facet wide, and beside its middle
  const double radius = 0.01, depth = 0.005;
  Audited c(segments(0), disc(1.3 / 3, depth - radius, radius));
  const Findings found = c.audit.find({});
  EXPECT_TRUE(found.penetrates_too_deep);
  EXPECT_LE(found.deepest->depth, depth + 1e-15);
  EXPECT_GE(found.deepest->depth, 0.6 * depth);
}

TEST(AuditOfObstacles, WhereAStepEndsBeforeANodeTouchesOrAfterItIsTheSame)
{
  // An arc that the facet resolves, as deep as until it meets the nodes
  const double radius = 0.4, h = 1. / 3,
               low = std::sqrt(radius * radius - h * h / 4);
  Audited c(segments(0), disc(0.5, -low, radius));
  const double depth = radius - low;
  const Findings open = c.audit.find({});
  ASSERT_TRUE(open.deepest.has_value());
  EXPECT_FALSE(open.is_fault());
  EXPECT_FALSE(open.deepest->is_held);
  c.contact->nodes()->close(std::vector<std::int32_t>{1, 2});
  const Findings held = c.audit.find({});
  ASSERT_TRUE(held.deepest.has_value());
  EXPECT_TRUE(held.deepest->is_held);
  EXPECT_FALSE(held.is_fault());
  EXPECT_NEAR(held.deepest->depth, depth, 1e-14);
  EXPECT_NEAR(held.deepest->excess, depth / (0.15 * h), 1e-12);
  EXPECT_EQ(open.deepest->excess, held.deepest->excess);
  // A gap that is closed in the mean while the node is beside the obstacle
  c.move(0, 4, 0.01);
  EXPECT_FALSE(c.audit.find({}).deepest->is_held);
}

TEST(AuditOfObstacles, AFewFacetsARadiusAreWarnedOfOnceWhereNodesTouch)
{
  const double h = 1. / 3;
  for (const double facets : {2., 3.9, 4.1})
  {
    const double radius = facets * h;
    Audited c(segments(0), disc(h, -radius, radius));
    EXPECT_FALSE(c.audit.find({}).roundness) << "no node is in contact";
    c.contact->nodes()->close(std::vector<std::int32_t>{1});
    const Findings found = c.audit.find({});
    ASSERT_TRUE(found.roundness);
    EXPECT_NEAR(found.roundness->radius, radius, 1e-13);
    EXPECT_NEAR(found.roundness->size, h, 1e-14);
    EXPECT_NEAR(found.roundness->facets(), facets, 1e-12);
    EXPECT_NEAR(found.roundness->at[0], h, 1e-14);
    ASSERT_EQ(found.warnings.size(), facets < 4);
    if (facets == 2)
      expect_says(found.warnings[0], "0.667, is 2 slave facets long at the "
                                     "node in contact at (0.333333, 0)");
    // Until the step is accepted, as an iterate may be none
    EXPECT_EQ(c.audit.find({}).warnings, found.warnings);
    c.audit.accept();
    EXPECT_TRUE(c.audit.find({}).warnings.empty());
    EXPECT_TRUE(c.audit.find({}).roundness);
  }
}

TEST(AuditOfObstacles, APlaneIsDeepestAtANode)
{
  Audited c(segments(0),
            std::make_shared<geometry::Plane>(std::vector<double>{0, 0.1},
                                              std::vector<double>{0.2, 1}));
  const Findings found = c.audit.find({});
  EXPECT_FALSE(found.deepest.has_value());
  EXPECT_FALSE(found.is_fault()) << "nodes that face it have pairs";
}

TEST(AuditOfObstacles, SlaveNodesInsideThatFaceAway)
{
  // Of four nodes the two in the middle
  Audited c(segments(-0.2), disc(0.5, 0, 0.4));
  Findings found = c.audit.find({});
  EXPECT_EQ(found.inside.count, 2);
  EXPECT_TRUE(found.is_fault());
  EXPECT_FALSE(found.penetrates_too_deep) << "what else is found comes first";
  const auto slaves = c.contact->slaves().owned();
  const auto x = c.halo->now()->x;
  const auto first = static_cast<std::int32_t>(found.inside.first);
  EXPECT_EQ(std::ranges::count(slaves, first), 1);
  EXPECT_EQ(found.inside.at,
            (std::vector<double>{x[2 * first], x[2 * first + 1]}));
  EXPECT_NEAR(std::abs(found.inside.at[0] - 0.5), 1. / 6, 1e-15);
  // An overlap that was asked for: they are 0.14 deep
  c.contact->set_offset(std::vector<double>(4, -0.15));
  EXPECT_EQ(c.audit.find({}).inside.count, 0);
  c.contact->set_offset(std::vector<double>(4, -0.13));
  EXPECT_EQ(c.audit.find({}).inside.count, 2);
}

TEST(AuditOfObstacles, NodesAndFacetsThatWentThrough)
{
  struct Case
  {
    double radius;
    std::int64_t count;
  };
  // The middle of a facet, and two nodes and three middles
  for (const auto& [radius, count] : {Case{0.1, 1}, Case{0.4, 5}})
  {
    Audited c(segments(0.6), disc(0.5, 0, radius));
    c.move(0, 4, -1.2);
    Findings found = c.audit.find({});
    EXPECT_EQ(found.passed.count, count);
    EXPECT_TRUE(found.is_fault());
    EXPECT_EQ(found.inside.count, 0);
    c.audit.accept();
    EXPECT_EQ(c.audit.find({}).passed.count, 0) << "it was not in this step";
    // Around it, not through it
    c.move(0, 4, 0.);
    c.audit.accept();
    for (std::size_t i = 0; i < 4; ++i)
      (*c.displacement)[2 * i] = 2;
    c.audit.accept();
    c.move(0, 4, -1.2);
    EXPECT_EQ(c.audit.find({}).passed.count, 0);
  }
}

TEST(AuditOfObstacles, OneThatHasMovedCarriesItsOwnFrame)
{
  auto moving = disc(0.5, 0, 0.4);
  Audited c(segments(0.6), moving);
  // The disc goes up through the slave
  moving->place({0.5, 1.2}, 0.4);
  EXPECT_EQ(c.audit.find({}).passed.count, 5);
  // Both go down as one
  moving->place({0.5, -1.2}, 0.4);
  c.move(0, 4, -1.2);
  EXPECT_EQ(c.audit.find({}).passed.count, 0);
}

TEST(AuditOfObstacles, APlaneThatTurnsIsNotPassed)
{
  // By more than a right angle, so that the slave is behind it
  auto plane = std::make_shared<geometry::Plane>(std::vector<double>{0.5, -0.1},
                                                 std::vector<double>{0, 1});
  Audited c(segments(0), plane);
  const double angle = 100 * std::numbers::pi / 180;
  plane->place({0.5, -0.1}, {std::sin(angle), std::cos(angle)});
  c.contact->search();
  const Findings found = c.audit.find({});
  EXPECT_EQ(found.passed.count, 0);
  EXPECT_EQ(found.inside.count, 2) << "of them two nodes";
}

TEST(AuditOfObstacles, AFunctionTellsNoWay)
{
  // Of a disc what was beside it has not passed: here all four nodes and three
  // facets that have come to its far side
  Audited c(segments(0.6), function(0.5, 0, 0.1));
  c.move(0, 4, -1.2);
  EXPECT_EQ(c.audit.find({}).passed.count, 7);
}

TEST(AuditOfObstacles, AFunctionIsSeenAsTheDiscIs)
{
  for (const double y : {0.07 - 0.1, -0.05, 0.2})
  {
    std::vector<Findings> found;
    for (const bool is_function : {false, true})
    {
      std::shared_ptr<geometry::Obstacle> o;
      if (is_function)
        o = function(0.5, y, 0.1);
      else
        o = disc(0.5, y, 0.1);
      Audited c(segments(0), o);
      found.push_back(c.audit.find({}));
    }
    EXPECT_EQ(found[0].is_fault(), found[1].is_fault());
    EXPECT_EQ(found[0].inside.count, found[1].inside.count);
    ASSERT_EQ(found[0].deepest.has_value(), found[1].deepest.has_value());
    if (found[0].deepest and found[0].deepest->depth > 0)
    {
      EXPECT_NEAR(found[0].deepest->depth, found[1].deepest->depth, 1e-12);
      // Nothing tells its size but how its normal turns
      EXPECT_GE(found[1].deepest->excess, found[1].deepest->depth * 256 / 0.3);
    }
  }
}

TEST(AuditOfObstacles, WhatAFunctionThrowsComesThrough)
{
  bool fails = false;
  MovedContact c(segments(0), function(0.5, -0.2, 0.1, &fails));
  Audit audit(c.halo, {c.contact});
  EXPECT_FALSE(audit.find().at(0).is_fault());
  fails = true;
  EXPECT_THROW(audit.find(), std::runtime_error);
  EXPECT_THROW(audit.accept(), std::runtime_error);
  fails = false;
  EXPECT_FALSE(audit.find().at(0).is_fault());
}

TEST(AuditOfObstacles, InSmallSlidingTheyAreNotLookedAt)
{
  for (const Sliding sliding : {Sliding::finite, Sliding::small})
  {
    MovedContact c(segments(0), disc(0.5, -0.03, 0.1), sliding);
    Audit audit(c.halo, {c.contact});
    EXPECT_EQ(audit.find().at(0).is_fault(), sliding == Sliding::finite);
  }
}

TEST(AuditOfObstacles, SpaceToo)
{
  // A needle-like ball between the nodes of a sheet of 3 x 3 cells
  const Scene slave
      = sheet(3, 3, Cells::quadrilaterals, false, 0, 1, level(3, 0));
  for (const double depth : {-0.02, 0.05})
  {
    Audited c(slave, std::make_shared<geometry::Sphere>(
                         std::vector<double>{0.5, 0.5, depth - 0.1}, 0.1));
    const Findings found = c.audit.find({});
    EXPECT_EQ(found.penetrates_too_deep, depth > 0);
    if (depth > 0)
    {
      EXPECT_NEAR(found.deepest->depth, depth, 1e-14);
      EXPECT_NEAR(found.deepest->size, std::sqrt(2.) / 3, 1e-14);
    }
  }
}

TEST(AuditOfObstacles, ArgumentsThatDoNotFit)
{
  MovedContact rigid(segments(0), disc(0.5, -0.2, 0.1));
  MovedContact soft(TwoSheets(2, 0.1), 1, Sliding::finite);
  EXPECT_REFUSED(SurfacesAudit(rigid.halo, rigid.contact));
  EXPECT_REFUSED(ObstacleAudit(soft.halo, soft.contact));
  SurfacesAudit audit(soft.halo, soft.contact);
  EXPECT_REFUSED(audit.find(std::vector<double>(3)));
}
