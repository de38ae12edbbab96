// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#include "passage_scene.h"
#include <gtest/gtest.h>

using namespace contactx;
using namespace contactx::audit;
using namespace contactx::tests;

namespace
{
constexpr double tiny = 1e-9;

using Crossings = testing::TestWithParam<Made>;

TEST_P(Crossings, HaveTimeAndHeights)
{
  // The surface rises by 1 while the point sinks by 1: they meet at a quarter
  MovingScene s
      = outlined(GetParam(), {{3, 0}, {0, 0}}, {{3, 1}, {0, 1}}, false);
  s.point({1, 0.5, 0.3}, {1, -0.5, 0.3}, {0, -1, 0}, {0.6, -0.8, 0}, tiny);
  s.point({1, -0.5, 0.3}, {1, 2.5, 0.3}, {0, -1, 0}, {0.6, -0.8, 0}, tiny);
  s.point({4, 0.5, 0.3}, {4, -0.5, 0.3}, {0, -1, 0}, {0, -1, 0}, tiny);
  const auto found = s.crossings();
  ASSERT_EQ(found.size(), 2u);
  EXPECT_EQ(found[0].point, 0);
  EXPECT_TRUE(found[0].entering);
  EXPECT_NEAR(found[0].time, 0.25, 1e-8);
  EXPECT_NEAR(found[0].cosine, -1, 1e-15);
  EXPECT_NEAR(found[0].before, 0.5, 1e-15);
  EXPECT_NEAR(found[0].after, -1.5, 1e-15);
  EXPECT_EQ(found[1].point, 1);
  EXPECT_FALSE(found[1].entering);
  EXPECT_NEAR(found[1].time, 0.25, 1e-8);
  EXPECT_NEAR(found[1].cosine, -0.8, 1e-15);
}

TEST_P(Crossings, CountPointsFromTheirTolerance)
{
  const Outline floor{{3, 0}, {0, 0}};
  for (const double end : {-0.098, -0.102})
  {
    MovingScene s = outlined(GetParam(), floor, floor, false);
    s.point({1, 0.5, 0.3}, {1, end, 0.3}, {0, -1, 0}, {0, -1, 0}, 0.1);
    // Along the surface, behind it by less
    s.point({1, -0.05, 0.3}, {2, -0.05, 0.3}, {0, -1, 0}, {0, -1, 0}, 0.1);
    EXPECT_EQ(s.crossings().size(), end < -0.1 ? 1u : 0u) << end;
  }
}

TEST_P(Crossings, NeedAMovement)
{
  const Outline floor{{3, 0}, {1.5, 0}, {0, 0}};
  MovingScene s = outlined(GetParam(), floor, floor, false);
  for (double height : {0.1, 0., -1e-12, -0.1, -0.5})
    s.point({1.5, height, 0}, {1.5, height, 0}, {0, -1, 0}, {0, -1, 0}, 0.1);
  EXPECT_TRUE(s.crossings().empty());
}

TEST_P(Crossings, OfOwnFacetsDoNotCount)
{
  const Outline floor{{3, 0}, {1.5, 0}, {0, 0}};
  MovingScene s = outlined(GetParam(), floor, floor, false);
  for (const int number : {-1, 0, 1})
    s.point({1, 1, -1.8}, {1, -1, -1.8}, {0, -1, 0}, {0, -1, 0}, tiny, number);
  const auto found = s.crossings();
  // Node 0 is not at the facets near the point, node 1 at all of them
  ASSERT_EQ(found.size(), 2u);
  EXPECT_EQ(found[0].point, 0);
  EXPECT_EQ(found[1].point, 1);
}

TEST_P(Crossings, AreFoundThereAndBack)
{
  // The surface turns, and is highest at the point, at 0, half-way
  for (const double height : {0.01, -0.1, -0.7})
  {
    MovingScene s
        = outlined(GetParam(), {{3, -1}, {-3, 1}}, {{3, 1}, {-3, -1}}, false);
    s.point({2, height, 0.1}, {-2, height, 0.1}, {0, -1, 0}, {0, -1, 0}, tiny);
    auto found = s.crossings();
    ASSERT_EQ(found.size(), height == -0.1 ? 2u : 0u);
    if (found.empty())
      continue;
    std::ranges::sort(found, {}, &Crossing::time);
    EXPECT_TRUE(found[0].entering);
    EXPECT_FALSE(found[1].entering);
    // Where 2/3 (2 t - 1)^2 is 0.1
    EXPECT_NEAR(found[0].time, 0.5 - 0.5 * std::sqrt(0.15), 1e-8);
    EXPECT_NEAR(found[1].time, 0.5 + 0.5 * std::sqrt(0.15), 1e-8);
  }
}

INSTANTIATE_TEST_SUITE_P(All, Crossings,
                         testing::Values(Made::segments, Made::triangles,
                                         Made::quadrilaterals));

TEST(Crossing, OfAWarpedFacetHasTheHeightsOfItsNodes)
{
  MovingScene s(3);
  for (const Vector<3>& p :
       {Vector<3>{0, 0, 0.1}, {1, 0, -0.1}, {0, 1, -0.1}, {1, 1, 0.1}})
    s.node(p, p);
  s.facets.facet({0, 1, 2, 3});
  // Through its middle, through a corner's height and half-way between them
  for (const auto& [at, height] :
       {std::pair{0.5, 0.}, {0.999, 0.1}, {0.75, 0.05}})
  {
    s.points0.clear(), s.points1.clear(), s.normals0.clear();
    s.normals1.clear(), s.tolerance.clear(), s.nodes.clear();
    s.point({at, at, 1}, {at, at, -1}, {0, 0, -1}, {0, 0, -1}, tiny);
    const auto found = s.crossings();
    ASSERT_EQ(found.size(), 1u);
    EXPECT_NEAR(found[0].time, 0.5 * (1 - height), 1e-3);
    EXPECT_NEAR(found[0].before, 0.9, 1e-15);
    EXPECT_NEAR(found[0].after, -0.9, 1e-15);
  }
}

/// A solid that is star-shaped at all times: nodes move away from its middle or
/// towards it.
template <int D>
struct Star
{
  MovingScene scene{D};
  Vector<D> from, to; ///< its middle

  Star(Generator& random, int n)
      : from(random.vector<D>(-1, 1)), to(random.vector<D>(-1, 1))
  {
    const auto node = [this, &random](const Vector<D>& direction)
    {
      Vector<3> a{}, b{};
      std::ranges::copy(from + random(0.3, 1.5) * direction, a.begin());
      std::ranges::copy(to + random(0.3, 1.5) * direction, b.begin());
      scene.node(a, b);
    };
    if constexpr (D == 2)
    {
      for (const auto& direction : circle(1, n))
        node(direction);
      for (int i = 0; i < n; ++i)
        scene.facets.facet({i, (i + 1) % n});
    }
    else
    {
      for (int k = 0; k < 8; ++k)
        node({k & 1 ? 1. : -1., k & 2 ? 1. : -1., k & 4 ? 1. : -1.});
      for (const auto& q : {std::array{0, 4, 2, 6},
                            {1, 3, 5, 7},
                            {0, 1, 4, 5},
                            {2, 6, 3, 7},
                            {0, 2, 1, 3},
                            {4, 5, 6, 7}})
        scene.facets.patch({q[0], q[1], q[2], q[3]}, random(0, 1) < 0.5);
    }
  }

  Vector<D> at(double t, int node) const
  {
    Vector<D> a, b;
    std::copy_n(scene.facets.x.begin() + D * node, D, a.begin());
    std::copy_n(scene.x1.begin() + D * node, D, b.begin());
    return (1 - t) * (a - from) + t * (b - to);
  }

  /// Whether the cone over the corners holds p, and p is below its base.
  static bool below(const std::array<Vector<D>, D>& c, const Vector<D>& p)
  {
    std::array<double, D> w;
    double det;
    if constexpr (D == 2)
    {
      det = c[0][0] * c[1][1] - c[0][1] * c[1][0];
      w = {p[0] * c[1][1] - p[1] * c[1][0], c[0][0] * p[1] - c[0][1] * p[0]};
    }
    else
    {
      det = dot(c[0], cross(c[1], c[2]));
      w = {dot(p, cross(c[1], c[2])), dot(p, cross(c[2], c[0])),
           dot(p, cross(c[0], c[1]))};
    }
    double sum = 0;
    for (double& v : w)
    {
      if (v / det < 0)
        return false;
      sum += v / det;
    }
    return sum < 1;
  }

  bool inside(double t, const Vector<D>& p) const
  {
    const auto facets = scene.facets.facets();
    const Vector<D> q = p - ((1 - t) * from + t * to);
    for (std::int32_t f = 0; f < facets.size(); ++f)
    {
      const auto n = facets[f];
      if constexpr (D == 2)
      {
        if (below({at(t, n[0]), at(t, n[1])}, q))
          return true;
      }
      else if (n.size() == 3)
      {
        if (below({at(t, n[0]), at(t, n[1]), at(t, n[2])}, q))
          return true;
      }
      else
      {
        const Vector<3> middle
            = 0.25 * (at(t, n[0]) + at(t, n[1]) + at(t, n[2]) + at(t, n[3]));
        for (const auto& [i, j] : geometry::Quadrilateral::edges)
          if (below({at(t, n[i]), at(t, n[j]), middle}, q))
            return true;
      }
    }
    return false;
  }
};

/// The crossings are those that a point makes in many small steps, and others
/// only in pairs between two of them.
template <int D>
void follows_small_steps(unsigned seed, int scenes)
{
  constexpr int steps = 2000;
  Generator random(seed);
  int total = 0, unseen = 0;
  for (int i = 0; i < scenes; ++i)
  {
    Star<D> star(random, 3 + i % 6);
    const double reach = i % 2 == 0 ? 2.5 : 1.2;
    Vector<3> a{}, b{};
    const Vector<D> p = random.vector<D>(-reach, reach),
                    q = random.vector<D>(-reach, reach);
    std::ranges::copy(p, a.begin());
    std::ranges::copy(q, b.begin());
    star.scene.point(a, b, {}, {}, tiny);
    auto found = star.scene.crossings();
    std::ranges::sort(found, {}, &Crossing::time);
    bool inside = star.inside(0, p);
    for (const Crossing& c : found)
    {
      ASSERT_EQ(c.entering, !inside) << "scene " << i;
      inside = !inside;
    }
    inside = star.inside(0, p);
    std::size_t k = 0;
    for (int step = 1; step <= steps; ++step)
    {
      const double t = double(step) / steps;
      std::size_t next = k;
      while (next < found.size() and found[next].time < t)
        ++next;
      const bool now = star.inside(t, (1 - t) * p + t * q);
      // Within what the point is taken aside the two may differ
      if (next < found.size() and found[next].time < t + 1e-6)
        continue;
      ASSERT_EQ(now != inside, (next - k) % 2 == 1) << "scene " << i;
      unseen += next - k > 1;
      inside = now;
      k = next;
    }
    total += found.size();
  }
  // Scenes that test something
  EXPECT_GT(total, scenes / 3);
  EXPECT_LT(unseen, scenes / 20);
}

TEST(Crossing, FollowsSmallStepsInThePlaneAndInSpace)
{
  follows_small_steps<2>(1, 400);
  follows_small_steps<3>(2, 150);
}

TEST(Crossing, TakesAnyNumbers)
{
  for (const double bad : {std::nan(""), infinity, -infinity, 1e300})
    for (Made made : {Made::segments, Made::triangles, Made::quadrilaterals})
    {
      const Outline floor{{3, 0}, {1.5, 0}, {0, 0}};
      MovingScene s = outlined(made, floor, floor, false);
      s.x1[1] = bad;
      s.point({1, 1, 0}, {1, bad, 0}, {0, -1, 0}, {0, bad, 0}, 0.1);
      s.point({1, 1, 0}, {1, -1, 0}, {0, -1, 0}, {0, -1, 0}, 0.1);
      for (const Crossing& c : s.crossings())
        EXPECT_TRUE(c.time >= 0 and c.time <= 1);
      s.passages();
    }
}
} // namespace
