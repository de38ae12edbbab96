// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#include "expect.h"
#include "pairing_scene.h"
#include <contactx/geometry/shape.h>

using namespace contactx;
using namespace contactx::search;
using namespace contactx::tests;

namespace
{
const std::vector<Vector<2>> flat{{0, 0}, {1, 0}, {2, 0}};

void take_over(Pairing& to, const Pairing& from)
{
  to.restore(from.facet(), from.feature(), from.xi(), from.cone(),
             from.normal());
}

TEST(Pairing, StartsWithoutPairs)
{
  const Pairing pairing({0, 3, 6}, {8, 3, 5, 5, 3, 2}, {0, 3}, {0, 1, 4}, 3);
  EXPECT_EQ(pairing.slaves(), (std::vector<std::int32_t>{2, 3, 5, 8}));
  EXPECT_EQ(pairing.facet(), std::vector<std::int32_t>(4, -1));
  EXPECT_EQ(pairing.xi().size(), 8u);
  EXPECT_EQ(pairing.cone().size(), 12u);
  EXPECT_TRUE(pairing.frozen().empty());
}

TEST(Pairing, FindsFacetAndLocalCoordinates)
{
  SlidingSegment s(flat);
  s.search_at({1.25, 0.1}, false);
  EXPECT_EQ(s.facet(), 1);
  EXPECT_EQ(s.feature(), geometry::interior);
  EXPECT_NEAR(s.pairing.xi()[0], 0.75, 1e-15); // the facet starts at x = 2
}

TEST(Pairing, LetsGoBeyondTheOuterEdge)
{
  SlidingSegment s(flat);
  s.search_at({0.5, 0.1}, false);
  s.search_at({-0.9 * geometry::facet_margin, 0.1}, false);
  EXPECT_EQ(s.facet(), 0);
  s.search_at({-1.1 * geometry::facet_margin, 0.1}, false);
  EXPECT_EQ(s.facet(), -1);
  s.search_at({0.2, 0.1}, false);
  EXPECT_EQ(s.facet(), 0);
}

TEST(Pairing, LetsGoOfAFacetThatIsFarAway)
{
  // Above the right part rises another facet, nearer to where the node goes
  SlidingSegment s({{0, 0}, {2, 0}, {2.5, 3}, {4, 3}});
  s.search_at({1, 0.1}, false);
  EXPECT_EQ(s.facet(), 0);
  s.search_at({1.9, 1.9}, false);
  EXPECT_EQ(s.facet(), 0);
  s.search_at({1.9, 2.1}, false); // farther than the facet is long
  EXPECT_EQ(s.facet(), 1);
}

/// Expect that a node keeps its facet within its margin.
void expect_kept_in_margin(double begin, double height)
{
  SlidingSegment s(flat);
  s.search_at({begin, height}, false);
  EXPECT_EQ(s.facet(), 0);
  s.search_at({1 + 0.9 * geometry::facet_margin, height}, false);
  EXPECT_EQ(s.facet(), 0);
  EXPECT_NEAR(s.pairing.xi()[0], -0.9 * geometry::facet_margin, 1e-15);
  s.search_at({1 + 1.1 * geometry::facet_margin, height}, false);
  EXPECT_EQ(s.facet(), 1);
  s.search_at({1 - 0.9 * geometry::facet_margin, height}, false);
  EXPECT_EQ(s.facet(), 1);
  s.search_at({1 - 1.1 * geometry::facet_margin, height}, false);
  EXPECT_EQ(s.facet(), 0);
}

TEST(Pairing, KeepsAFacetInsideItsMargin) { expect_kept_in_margin(0.5, 0.1); }

TEST(Pairing, FarFromAnEdgeOfTwoFacetsItKeepsTheOneThatItHas)
{
  expect_kept_in_margin(0.99, 1.5); // longer than a facet
}

TEST(Pairing, LooksNoFartherThanItsReach)
{
  SlidingSegment s(flat);
  s.search_at({0.5, 0.3}, false, 0.25);
  EXPECT_EQ(s.facet(), -1);
  s.search_at({0.5, 0.2}, false, 0.25);
  EXPECT_EQ(s.facet(), 0);
  s.search_at({0.5, 0.3}, false, 0.25); // a pair that it has, too
  EXPECT_EQ(s.facet(), -1);
}

TEST(Pairing, CountsTheNodesInContactThatChange)
{
  SlidingSegment s(flat);
  EXPECT_EQ(s.search_at({0.5, 0.1}, false), 0);
  EXPECT_EQ(s.search_at({1.5, 0.1}, true), 1);
  EXPECT_EQ(s.search_at({1.5, 0.1}, true), 0);
  EXPECT_EQ(s.search_at({1.6, 0.1}, true), 0);
  EXPECT_EQ(s.search_at({-1, 0.1}, true), 1); // lost its facet
  EXPECT_EQ(s.search_at({-1, 0.2}, true), 0);
}

TEST(Pairing, FreezesANodeThatReturnsTwice)
{
  SlidingSegment s(flat);
  s.search_at({0.5, 0}, true);
  EXPECT_EQ(s.search_at({1.5, 0}, true), 1);
  EXPECT_EQ(s.search_at({0.5, 0}, true), 1);
  EXPECT_TRUE(s.pairing.frozen().empty());
  EXPECT_EQ(s.search_at({1.5, 0}, true), 0); // frozen
  EXPECT_EQ(s.pairing.frozen(), std::vector<std::int32_t>{0});
  EXPECT_EQ(s.facet(), 0);
  EXPECT_NEAR(s.pairing.xi()[0], -0.5, 1e-15); // on the extended facet
  EXPECT_EQ(s.search_at({1.25, 0}, true), 0);
  EXPECT_EQ(s.facet(), 0);
  EXPECT_NEAR(s.pairing.xi()[0], -0.25, 1e-15);
}

TEST(Pairing, ANewStepUnfreezesAndSoDoesWhatIsRestored)
{
  for (const bool is_restored : {true, false})
  {
    SlidingSegment s(flat);
    for (double x : {0.5, 1.5, 0.5, 1.5})
      s.search_at({x, 0}, true);
    ASSERT_EQ(s.pairing.frozen().size(), 1u);
    if (is_restored)
      take_over(s.pairing, Pairing(s.pairing));
    else
      s.pairing.begin_step();
    EXPECT_TRUE(s.pairing.frozen().empty());
    EXPECT_EQ(s.facet(), 0); // until the next search
    EXPECT_EQ(s.search_at({1.5, 0}, true), 1);
    EXPECT_EQ(s.facet(), 1);
  }
}

TEST(Pairing, StepsDoNotAddUp)
{
  SlidingSegment s(flat);
  for (double x : {0.5, 1.5, 0.5, 1.5, 0.5, 1.5})
  {
    s.pairing.begin_step();
    s.search_at({x, 0}, true);
    EXPECT_EQ(s.facet(), x > 1);
  }
  EXPECT_TRUE(s.pairing.frozen().empty());
}

TEST(Pairing, OpenNodesAreNeverFrozen)
{
  SlidingSegment s(flat);
  for (int i = 0; i < 10; ++i)
    for (double x : {0.5, 1.5})
    {
      EXPECT_EQ(s.search_at({x, 0.1}, false), 0);
      EXPECT_EQ(s.facet(), x > 1);
    }
  EXPECT_TRUE(s.pairing.frozen().empty());
}

TEST(Pairing, FreezesANodeThatComesOffTheSurfaceTwice)
{
  // In contact it leaves by the outer edge, and is back in contact or open
  for (const bool closed : {true, false})
  {
    SlidingSegment s(flat);
    s.search_at({0.5, 0}, false);
    for (int k = 0; k < 2; ++k)
    {
      EXPECT_TRUE(s.pairing.frozen().empty());
      EXPECT_EQ(s.search_at({-0.5, 0}, true), 1);
      EXPECT_EQ(s.facet(), -1);
      EXPECT_EQ(s.search_at({0.5, 0}, closed), 0);
      EXPECT_EQ(s.facet(), 0);
    }
    EXPECT_EQ(s.pairing.frozen(), std::vector<std::int32_t>{0});
    EXPECT_EQ(s.search_at({-0.5, 0}, true), 0);
    EXPECT_EQ(s.facet(), 0);
  }
}

TEST(Pairing, SlidingOnIsNoReturn)
{
  std::vector<Vector<2>> line;
  for (int i = 0; i <= 10; ++i)
    line.push_back({double(i), 0});
  SlidingSegment s(line);
  for (int i = 0; i < 10; ++i)
  {
    s.search_at({i + 0.5, 0}, true);
    EXPECT_EQ(s.facet(), i);
  }
  EXPECT_TRUE(s.pairing.frozen().empty());
}

TEST(Pairing, CopiesAreIndependent)
{
  SlidingSegment s(flat);
  s.search_at({0.5, 0}, true);
  s.search_at({1.5, 0}, true);
  SlidingSegment copy = s;
  s.search_at({0.5, 0}, true);
  s.search_at({1.5, 0}, true);
  EXPECT_EQ(s.pairing.frozen().size(), 1u);
  EXPECT_TRUE(copy.pairing.frozen().empty());
  EXPECT_EQ(copy.facet(), 1);
  EXPECT_EQ(copy.search_at({0.5, 0}, true), 1);
  EXPECT_EQ(copy.facet(), 0);
  // Each has a tree of its own
  for (std::size_t i = 4; i < s.x.size(); i += 2)
    s.x[i] += 100;
  s.search_at({0.5, 0}, true);
  EXPECT_EQ(copy.search_at({1.5, 0}, false), 0);
  EXPECT_EQ(copy.facet(), 1);
}

const std::vector<Vector<2>> ridge{{0, 0}, {1, 1}, {2, 0}};

using Ints = std::vector<std::int32_t>;

void expect_same(const Pairing& a, const Pairing& b)
{
  EXPECT_EQ(a.facet(), b.facet());
  EXPECT_EQ(a.feature(), b.feature());
  EXPECT_EQ(a.xi(), b.xi());
  EXPECT_EQ(a.cone(), b.cone());
  EXPECT_EQ(a.normal(), b.normal());
}

TEST(PairingRestore, GoesOnAsTheOther)
{
  // Inside the margin memory decides, on a ridge the normal that was found
  for (const auto& [line, first, then] :
       {std::tuple{flat, Vector<2>{1.5, 0},
                   Vector<2>{1 - 0.5 * geometry::facet_margin, 0}},
        std::tuple{ridge, Vector<2>{1.01, 1.2}, Vector<2>{0.99, 1.2}}})
  {
    SlidingSegment a(line), b(line);
    a.search_at(first, true);
    take_over(b.pairing, a.pairing);
    EXPECT_EQ(a.search_at(then, true), b.search_at(then, true));
    expect_same(a.pairing, b.pairing);
  }
}

TEST(PairingRestore, RefusesWhatDoesNotFit)
{
  SlidingSegment s(flat);
  s.search_at({0.5, 0.1}, true);
  const Ints before = s.pairing.facet();
  const std::vector<double> xi(4), xyz(6);
  const auto with = [&](const Ints& facet, const Ints& feature)
  { s.pairing.restore(facet, feature, xi, xyz, xyz); };
  EXPECT_REFUSED(with({0}, {0}));
  EXPECT_REFUSED(with({1, 2}, {0, 0}));
  EXPECT_REFUSED(with({1, -2}, {0, 0}));
  EXPECT_REFUSED(with({1, 1}, {0, 3}));
  EXPECT_REFUSED(with({1, -1}, {0, 1}));
  EXPECT_REFUSED(with({1, 1}, {0, -1}));
  EXPECT_EQ(s.pairing.facet(), before);
  with({1, -1}, {2, 0});
  EXPECT_EQ(s.pairing.facet(), (Ints{1, -1}));
}

/// A roof with its ridge at the origin.
const std::vector<Vector<2>> roof{{-1, -1}, {0, 0}, {1, -1}};
/// A sharper one.
const std::vector<Vector<2>> spike{{-0.2, -1}, {0, 0}, {0.2, -1}};

Vector<3> cone(const SlidingSegment& s)
{
  return vector_at(s.pairing.cone(), 0, 3);
}

TEST(PairingOnRidge, HasAUnitNormal)
{
  SlidingSegment s(roof);
  s.search_at({0.1, 0.5}, false);
  EXPECT_NE(s.feature(), geometry::interior);
  EXPECT_NEAR(norm(cone(s)), 1, 1e-15);
  // The left facet's normal is (-1, 1) / sqrt(2)
  const Vector<2> n = (1 / std::hypot(0.1, 0.5)) * Vector<2>{0.1, 0.5};
  EXPECT_NEAR(cone(s)[2], (n[1] - n[0]) / std::sqrt(2), 1e-15);
}

TEST(PairingOnRidge, KeepsItsNormalWhileInContact)
{
  SlidingSegment s(spike);
  s.search_at({0.02, 0.1}, false);
  const Vector<3> first = cone(s);
  EXPECT_EQ(s.search_at({-0.005, 0.09}, true), 0);
  EXPECT_EQ(cone(s), first);
  EXPECT_EQ(s.search_at({0.03, 0.09}, true), 0);
  EXPECT_EQ(cone(s), first);
  s.search_at({0.03, 0.09}, false); // open: the normal follows the node
  EXPECT_NE(cone(s), first);
}

TEST(PairingOnRidge, TakesAnotherNormalBesideTheRidge)
{
  // By the margin of a facet across the normal, at any height. Where bodies
  // deform in between, the first normal may be none of the ridge any more, and
  // the node touch along it from afar
  const double size = std::hypot(0.2, 1);
  const Vector<2> n{0.6, 0.8}, across{-0.8, 0.6};
  for (const double height : {0.1, 0.5})
    for (const double part : {0.9, 1.1})
    {
      SlidingSegment s(spike);
      s.search_at(0.2 * n, false);
      const Vector<3> first = cone(s);
      EXPECT_EQ(s.search_at(height * n
                                + part * geometry::facet_margin * size * across,
                            true),
                0);
      EXPECT_NE(s.feature(), geometry::interior);
      EXPECT_EQ(cone(s) == first, part < 1) << height;
    }
}

TEST(PairingOnRidge, LeavesItForAFacet)
{
  SlidingSegment s(roof);
  s.search_at({0.1, 0.5}, false);
  EXPECT_EQ(s.search_at({0.5, -0.4}, true), 1);
  EXPECT_EQ(s.facet(), 1);
  EXPECT_EQ(s.feature(), geometry::interior);
  EXPECT_EQ(cone(s), Vector<3>{});
}

TEST(PairingOnRidge, DoesNotFlipBetweenItsFacets)
{
  // Along the ridge of a roof that is turned somehow: its two facets are
  // equally far, and rounding must not choose
  Generator random(1);
  for (int set = 0; set < 20; ++set)
  {
    const Motion<3> motion(random, 3);
    Scene scene(3);
    for (Vector<3> p : {Vector<3>{0, 0, 0},
                        {0, 1, 0},
                        {-1, 0.5, -1},
                        {1, 0.5, -1},
                        {0, 0, 0},
                        {0, 0.01, 0},
                        {0.01, 0, 0}})
      scene.node(motion(p));
    Pairing pairing({0, 3}, {4, 5, 6}, {0, 3, 6}, {0, 1, 2, 1, 0, 3}, 3);
    const std::vector<std::int8_t> closed{1, 0, 0};
    for (int i = 0; i < 50; ++i)
    {
      const Vector<3> p{random(-0.05, 0.05), random(0.1, 0.9), 0.5};
      for (int k : {0, 1, 2})
      {
        Vector<3> q = p;
        if (k > 0)
          q[2 - k] += 0.01;
        // Facing down: (0, 1, 0) x (1, 0, 0)
        q = motion(q);
        std::copy(q.begin(), q.end(), scene.x.begin() + 3 * (4 + k));
      }
      EXPECT_EQ(pairing.update(scene.x, 10, closed), i == 0);
      EXPECT_EQ(pairing.facet()[0], 0);
      EXPECT_EQ(pairing.feature()[0], 1);
    }
  }
}
} // namespace
