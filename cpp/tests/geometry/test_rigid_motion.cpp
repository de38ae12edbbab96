// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#include "passage_scene.h"
#include <gtest/gtest.h>

using namespace contactx;
using namespace contactx::audit;
using namespace contactx::geometry;
using namespace contactx::tests;

namespace
{
RigidMotion fitted(const MovingScene& s)
{
  const Vector<3> a = s.facets.point(0), b = vector_at(s.x1, 0, s.gdim());
  return rigid_motion(
      moments(s.facets.facets(), s.facets.x, s.x1, s.gdim(), a, b), s.gdim(), a,
      b);
}

template <int D>
double error(const RigidMotion& motion, const MovingScene& s)
{
  double most = 0;
  for (std::size_t i = 0; i < s.x1.size() / D; ++i)
    most = std::max(most, norm(motion.moved_back<D>(row<D>(s.x1, i))
                               - row<D>(s.facets.x, i)));
  return most;
}

template <int D>
MovingScene random_nodes(Generator& random, const Vector<3>& size)
{
  MovingScene s(D);
  for (int i = 0; i < 12; ++i)
  {
    Vector<3> p = random.vector<3>(-1, 1);
    for (int k = 0; k < 3; ++k)
      p[k] *= size[k];
    s.node(p, p);
  }
  for (int i = 0; i + D <= 12; ++i)
    s.facets.facet(D == 2 ? std::vector{i, i + 1}
                          : std::vector{i, i + 1, i + 2});
  return s;
}

template <int D>
void finds_every_turn(const Vector<3>& size)
{
  Generator random(1);
  for (int degrees = 0; degrees <= 180; degrees += 15)
    for (double unit : {1e-8, 1., 1e8})
    {
      MovingScene s = random_nodes<D>(random, size);
      s.move(turn<D>(random, 37, 5), false);
      s.move(turn<D>(random, degrees, 100), true);
      s.scale(unit);
      EXPECT_LT(error<D>(fitted(s), s), 1e-12 * unit) << degrees;
    }
}

TEST(RigidMotion, IsFoundForEveryTurn)
{
  finds_every_turn<2>({1, 1, 0});
  finds_every_turn<3>({1, 1, 1});
  // Of a flat surface it is no reflection
  finds_every_turn<3>({1, 1, 0});
  finds_every_turn<3>({1, 1e-3, 0});
}

void expect_translation(const RigidMotion& motion)
{
  for (int i = 0; i < 3; ++i)
    for (int k = 0; k < 3; ++k)
      EXPECT_EQ(motion.rotation[i][k], i == k);
}

TEST(RigidMotion, OfALineDoesNotTurnAroundTheLine)
{
  Generator random(2);
  for (int i = 0; i < 20; ++i)
  {
    MovingScene s = random_nodes<3>(random, {1, 0, 0});
    s.move(turn<3>(random, random(0, 180), 5), false);
    expect_translation(fitted(s));
  }
}

TEST(RigidMotion, OfPartsIsThatOfTheSum)
{
  Generator random(3);
  MovingScene s = random_nodes<3>(random, {1, 1, 1});
  s.move(turn<3>(random, 120, 10), true);
  const Vector<3> a = random.vector<3>(-1, 1), b = random.vector<3>(5, 9);
  const auto f = s.facets.facets();
  const std::vector<std::int32_t> low(f.offsets.begin(), f.offsets.begin() + 4);
  std::vector<std::int32_t> high(f.offsets.begin() + 3, f.offsets.end());
  for (auto& offset : high)
    offset -= low.back();
  Moments sum
      = moments({low, f.nodes.first(low.back())}, s.facets.x, s.x1, 3, a, b);
  const Moments more
      = moments({high, f.nodes.subspan(low.back())}, s.facets.x, s.x1, 3, a, b);
  for (std::size_t k = 0; k < sum.size(); ++k)
    sum[k] += more[k];
  EXPECT_LT(error<3>(rigid_motion(sum, 3, a, b), s), 1e-12);
}

TEST(RigidMotion, IsNearestToThatOfADeformedSurface)
{
  // Stretched along its axes, then turned by a quarter
  MovingScene s(2);
  for (const Vector<3>& p :
       {Vector<3>{1, 0, 0}, {0, 1, 0}, {-1, 0, 0}, {0, -1, 0}})
    s.node(p, {-0.5 * p[1], 2 * p[0], 0});
  for (int i = 0; i < 4; ++i)
    s.facets.facet({i, (i + 1) % 4});
  const RigidMotion motion = fitted(s);
  EXPECT_NEAR(motion.rotation[1][0], 1, 1e-15);
  EXPECT_NEAR(motion.rotation[0][0], 0, 1e-15);
}

TEST(RigidMotion, IsATranslationWherePartsTurnAgainstEachOther)
{
  // Two wheels on one axle: the larger one turns to the left, the other to the
  // right
  for (const int gdim : {2, 3})
  {
    MovingScene s(gdim);
    for (const double way : {1., -1.})
      for (const auto& c : circle(way > 0 ? 1.2 : 1, 4))
        s.node({c[0], c[1], 0}, {5 - way * c[1], way * c[0], 0});
    for (int i = 0; i < 8; i += 4)
      for (int k = 0; k < 4; ++k)
        s.facets.facet(gdim == 2 ? std::vector{i + k, i + (k + 1) % 4}
                                 : std::vector{i, i + 1, i + 2, i + 3});
    const RigidMotion motion = fitted(s);
    expect_translation(motion);
    EXPECT_NEAR(motion.after[0] - motion.before[0], 5, 1e-14);
  }
}

TEST(RigidMotion, OfNothingIsNone)
{
  const RigidMotion motion = rigid_motion({}, 3, {1, 2, 3}, {1, 2, 3});
  EXPECT_EQ(motion.moved_back<3>({4, 5, 6}), (Vector<3>{4, 5, 6}));
}
} // namespace
