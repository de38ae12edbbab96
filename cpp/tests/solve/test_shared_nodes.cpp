// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#include "expect.h"
#include "generator.h"
#include <contactx/solve/shared_nodes.h>

using namespace contactx;
using namespace contactx::solve;
using namespace contactx::tests;

namespace
{
using Flags = std::vector<std::int8_t>;

/// A contact of one node that it shares with others.
struct Side
{
  Vector<3> normal;
  double gap = -1;
  bool is_tied = false;
  std::int8_t closes = 1;
};

/// What becomes of a node that is slave in several contacts.
struct Node
{
  explicit Node(std::size_t n)
      : junctions(std::vector<std::span<const std::int32_t>>(n, number))
  {
  }

  void update(const std::vector<Side>& sides)
  {
    std::vector<Closing> contacts;
    for (const Side& s : sides)
      contacts.push_back({s.is_tied,
                          {&s.closes, 1},
                          {&s.gap, 1},
                          {s.normal.data(), s.normal.size()}});
    redundant.clear();
    frictionless.clear();
    for (const Shared& s : junctions.update(contacts))
    {
      redundant.push_back(s.redundant.at(0));
      frictionless.push_back(s.frictionless.at(0));
    }
  }

  std::vector<std::int32_t> number{7};
  SharedNodes junctions;
  Flags redundant, frictionless;
};

/// Unit normal in the plane at an angle from the vertical.
Vector<3> tilted(double angle) { return {std::sin(angle), std::cos(angle), 0}; }

/// Square of the volume that vectors span.
double gram(const std::vector<Vector<3>>& v)
{
  const std::size_t n = v.size();
  std::vector<std::vector<double>> g(n, std::vector<double>(n));
  for (std::size_t i = 0; i < n; ++i)
    for (std::size_t j = 0; j < n; ++j)
      g[i][j] = dot(v[i], v[j]);
  if (n == 0)
    return 1;
  if (n == 1)
    return g[0][0];
  if (n == 2)
    return g[0][0] * g[1][1] - g[0][1] * g[1][0];
  if (n > 3)
    return 0;
  return g[0][0] * (g[1][1] * g[2][2] - g[1][2] * g[2][1])
         - g[0][1] * (g[1][0] * g[2][2] - g[1][2] * g[2][0])
         + g[0][2] * (g[1][0] * g[2][1] - g[1][1] * g[2][0]);
}
} // namespace

TEST(SharedNodes, FindTheNodesThatContactsShare)
{
  const std::vector<std::int32_t> a{1, 3, 5, 9}, b{0, 3, 9}, c{9, 2}, none;
  const SharedNodes junctions({a, b, c, none});
  EXPECT_EQ(junctions.shared(), (std::vector<std::int32_t>{3, 9}));
  EXPECT_TRUE(SharedNodes({a, none}).shared().empty());
  EXPECT_TRUE(SharedNodes({}).shared().empty());
}

TEST(SharedNodes, InAWedgeANodeClosesBothAndSlides)
{
  Node node(2);
  node.update({{tilted(0.8)}, {tilted(-0.8), -0.5}});
  EXPECT_EQ(node.redundant, Flags({0, 0}));
  EXPECT_EQ(node.frictionless, Flags({1, 1}));
  EXPECT_EQ(node.junctions.corners(), 1);
  // One alone keeps its friction
  node.update({{tilted(0.8)}, {tilted(-0.8), 0.5, false, 0}});
  EXPECT_EQ(node.redundant, Flags({0, 0}));
  EXPECT_EQ(node.frictionless, Flags({0, 0}));
  EXPECT_EQ(node.junctions.corners(), 0);
}

TEST(SharedNodes, InAShallowValleyTheDeepestComesFirst)
{
  // The sine of the angle between the normals is a tenth
  const double angle = std::asin(0.1);
  for (double more : {-1e-3, 1e-3})
  {
    Node node(2);
    node.update({{tilted(0)}, {tilted(angle + more), -2}});
    EXPECT_EQ(node.redundant, Flags({more < 0, 0}));
    EXPECT_EQ(node.frictionless, Flags({more > 0, more > 0}));
    EXPECT_EQ(node.junctions.corners(), more > 0);
  }
}

TEST(SharedNodes, OfEqualGapsTheFirstContactCounts)
{
  Node node(2);
  node.update({{tilted(0)}, {tilted(0.01)}});
  EXPECT_EQ(node.redundant, Flags({0, 1}));
}

TEST(SharedNodes, TheSameNormalTwiceIsNeverKept)
{
  Node node(2);
  for (int i = 0; i < 8; ++i)
  {
    const bool swap = i % 2;
    node.update({{tilted(0.3), swap ? -1. : -2}, {tilted(0.3), -1.5}});
    EXPECT_EQ(node.redundant, Flags({swap, not swap}));
    EXPECT_EQ(node.junctions.corners(), 0);
  }
}

TEST(SharedNodes, BesideATieOtherContactsStayOpen)
{
  const double none = std::nan("");
  for (double gap : {0., 1., none})
  {
    Node node(3);
    node.update({{tilted(1.5), -9}, {tilted(0), gap, true}, {{0, 0, 1}, -7}});
    EXPECT_EQ(node.redundant, Flags({1, 0, 1}));
    EXPECT_EQ(node.frictionless, Flags({0, 0, 0}));
    EXPECT_EQ(node.junctions.corners(), 0);
  }
  // Of two ties the second is too many
  Node node(2);
  node.update({{tilted(1), 0, true}, {tilted(0), -1, true}});
  EXPECT_EQ(node.redundant, Flags({1, 0}));
}

TEST(SharedNodes, KeepIndependentNormalsOfAnyNumber)
{
  // By the volumes that normals span, in the order of their gaps
  Generator random(1);
  int kept_three = 0, ceded_some = 0;
  for (int again = 0; again < 500; ++again)
  {
    const auto n = static_cast<std::size_t>(random(2, 6));
    std::vector<Side> sides;
    for (std::size_t k = 0; k < n; ++k)
    {
      Vector<3> normal = random.unit<3>();
      // Some are nearly in a plane
      if (random(0, 1) < 0.5)
        normal[2] *= 0.1;
      normal = (1 / norm(normal)) * normal;
      sides.push_back({normal, random(-1, 0), false, random(0, 1) < 0.8});
    }
    Node node(n);
    node.update(sides);

    std::vector<std::size_t> order(n);
    std::iota(order.begin(), order.end(), 0);
    std::ranges::sort(order, {}, [&](std::size_t k) { return sides[k].gap; });
    std::vector<Vector<3>> kept;
    Flags redundant(n, 0), frictionless(n, 0);
    for (std::size_t k : order)
    {
      if (not sides[k].closes)
        continue;
      auto with = kept;
      with.push_back(sides[k].normal);
      if (std::sqrt(std::max(gram(with) / gram(kept), 0.0)) < 0.1)
        redundant[k] = 1;
      else
      {
        kept = with;
        frictionless[k] = 1;
      }
    }
    if (kept.size() < 2)
      std::ranges::fill(frictionless, 0);
    EXPECT_EQ(node.redundant, redundant);
    EXPECT_EQ(node.frictionless, frictionless);
    EXPECT_EQ(node.junctions.corners(), kept.size() > 1);
    kept_three += kept.size() == 3;
    ceded_some += std::ranges::count(redundant, 1) > 0;
  }
  EXPECT_GT(kept_three, 50);
  EXPECT_GT(ceded_some, 50);
}

TEST(SharedNodes, DecideForEachNodeAlone)
{
  const std::vector<std::int32_t> a{4, 6, 8}, b{8, 6};
  SharedNodes junctions({a, b});
  const Flags all(3, 1), some{1, 0};
  const std::vector<double> gap_a{-1, -1, -1}, gap_b{-2, -2};
  std::vector<double> normal_a, normal_b;
  for (int i = 0; i < 3; ++i)
    normal_a.insert(normal_a.end(), {0, 1, 0});
  for (int i = 0; i < 2; ++i)
    normal_b.insert(normal_b.end(), {1, 0, 0});
  const std::vector<Closing> contacts{{false, all, gap_a, normal_a},
                                      {false, some, gap_b, normal_b}};
  const auto result = junctions.update(contacts);
  // Node 8 alone closes both
  EXPECT_EQ(result[0].frictionless, Flags({0, 0, 1}));
  EXPECT_EQ(result[1].frictionless, Flags({1, 0}));
  EXPECT_EQ(result[0].redundant, Flags({0, 0, 0}));
  EXPECT_EQ(result[1].redundant, Flags({0, 0}));
  EXPECT_EQ(junctions.corners(), 1);
}

TEST(SharedNodes, RefuseWhatDoesNotFit)
{
  const std::vector<std::int32_t> a{4};
  SharedNodes junctions({a, a});
  const Flags one{1}, two{1, 1};
  const std::vector<double> gap{0}, normal{0, 1, 0}, flat{0, 1};
  const Closing good{false, one, gap, normal};
  EXPECT_REFUSED(junctions.update({good}));
  EXPECT_REFUSED(junctions.update({good, {false, two, gap, normal}}));
  EXPECT_REFUSED(junctions.update({good, {false, one, flat, normal}}));
  EXPECT_REFUSED(junctions.update({good, {false, one, gap, flat}}));
}
