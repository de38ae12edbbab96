// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#include "passage_scene.h"
#include <gtest/gtest.h>

using namespace contactx;
using namespace contactx::audit;
using namespace contactx::tests;

namespace
{
constexpr double tol = 0.05;
constexpr Vector<2> down{0, -1}, up{0, 1}, left{-1, 0}, right{1, 0};
const Outline table = rectangle({0, -1}, {4, 0}, 7);
const Outline plate = rectangle({0, -0.1}, {4, 0}, 7);

Outline shifted(Outline outline, const Vector<2>& by)
{
  for (auto& p : outline)
    p = p + by;
  return outline;
}

Vector<2> at_angle(double radius, double degrees)
{
  const double angle = degrees * std::numbers::pi / 180;
  return {radius * std::cos(angle), radius * std::sin(angle)};
}

Vector<3> padded(const Vector<2>& v, double z) { return {v[0], v[1], z}; }

template <int D>
void same_for_all_observers(MovingScene scene, bool passes, unsigned seed)
{
  Generator random(seed);
  for (int degrees = 0; degrees <= 180; degrees += 20)
    for (const double unit : {1e-8, 1., 1e8})
    {
      MovingScene s = scene;
      s.move(turn<D>(random, 17 * degrees, 3), false);
      s.move(turn<D>(random, degrees, 30), true);
      s.scale(unit);
      const Passages found = s.passages();
      EXPECT_EQ(found.facet[0] >= 0, passes)
          << degrees << " degrees, units of " << unit;
    }
}

/// Surfaces of every kind of facet, each seen by observers who turn with it in
/// the step, in units of all sizes.
class Passage : public testing::TestWithParam<Made>
{
protected:
  struct Step
  {
    Vector<2> from, to, normal0, normal1;
  };

  Passages run(const Outline& from, const Outline& to, const Step& p,
               bool closed = true, int number = -1)
  {
    MovingScene scene = outlined(GetParam(), from, to, closed);
    scene.point(padded(p.from, 0.3), padded(p.to, 0.4), padded(p.normal0, 0),
                padded(p.normal1, 0), tol, number);
    const Passages found = scene.passages();
    const bool passes = found.facet[0] >= 0;
    if (GetParam() == Made::segments)
      same_for_all_observers<2>(scene, passes, 1);
    else
      same_for_all_observers<3>(scene, passes, 2);
    return found;
  }

  bool passes(const Outline& outline, const Step& p, bool closed = true)
  {
    return run(outline, outline, p, closed).facet[0] >= 0;
  }
};

TEST_P(Passage, IntoABody)
{
  const auto found = run(table, table, {{2.1, 0.5}, {2.1, -0.5}, down, down});
  ASSERT_GE(found.facet[0], 0);
  const MovingScene s = outlined(GetParam(), table, table);
  for (const auto node : s.facets.facets()[found.facet[0]])
    EXPECT_EQ(s.facets.point(node)[1], 0);
  EXPECT_NEAR(found.time[0], 0.5 + tol, 1e-3);
  EXPECT_FALSE(passes(table, {{2.1, 0.5}, {2.1, 0.1}, down, down}));
}

TEST_P(Passage, OfTheSurfaceThatMoves)
{
  EXPECT_GE(
      run(table, shifted(table, {0, 1}), {{2.1, 0.5}, {2.1, 0.5}, down, down})
          .facet[0],
      0);
  EXPECT_LT(
      run(table, shifted(table, {0, 0.4}), {{2.1, 0.5}, {2.1, 0.5}, down, down})
          .facet[0],
      0);
  // All of it moves past where it was
  EXPECT_LT(
      run(table, shifted(table, {0, -5}), {{2.1, 0.5}, {2.1, -4.5}, down, down})
          .facet[0],
      0);
}

TEST_P(Passage, IsDeeperThanTheTolerance)
{
  for (const double start : {0.5, 0., -0.01, -0.03})
  {
    EXPECT_FALSE(passes(table, {{2.1, start}, {2.3, -0.045}, down, down}));
    EXPECT_TRUE(passes(table, {{2.1, start}, {2.3, -0.06}, down, down}));
    // ProbeResult at an angle, too
    const Vector<2> tilted{0.6, -0.8};
    EXPECT_FALSE(passes(table, {{2.1, start}, {2.3, -0.045}, tilted, tilted}));
    EXPECT_TRUE(passes(table, {{2.1, start}, {2.3, -0.06}, tilted, tilted}));
  }
}

TEST_P(Passage, ThroughAThinBody)
{
  EXPECT_TRUE(passes(plate, {{2.1, 0.5}, {2.1, -1.1}, down, down}));
  EXPECT_TRUE(passes(plate, {{2.1, 0}, {2.1, -1.1}, down, down}));
  EXPECT_TRUE(passes(plate, {{2.1, 0.5}, {2.1, -0.12}, down, down}));
  // Whatever else the point comes to there
  const MovingScene one = outlined(GetParam(), plate, plate);
  MovingScene two = one;
  Scene low = one.facets;
  for (std::size_t i = 1; i < low.x.size(); i += low.gdim)
    low.x[i] -= 2;
  two.facets.join(low);
  two.x1.insert(two.x1.end(), low.x.begin(), low.x.end());
  // Onto the second plate, and through both
  for (const double end : {-1.8, -2.05, -5.})
  {
    MovingScene s = two;
    s.point({2.1, 0.5, 0.1}, {2.3, end, 0.1}, {0, -1, 0}, {0, -1, 0}, tol);
    const auto found = s.passages();
    ASSERT_GE(found.facet[0], 0);
    EXPECT_LT(found.facet[0], one.facets.facets().size());
    EXPECT_NEAR(found.time[0], (0.5 + tol) / (0.5 - end), 1e-3);
  }
}

TEST_P(Passage, IsOfPointsThatFaceTheSurface)
{
  for (const Vector<2>& normal :
       {up, left, right, Vector<2>{0, 0}, Vector<2>{0.98, -0.199}})
  {
    EXPECT_FALSE(passes(table, {{2.1, 0.5}, {2.1, -0.5}, normal, normal}));
    EXPECT_FALSE(passes(plate, {{2.1, 0.5}, {2.1, -1.1}, normal, normal}));
  }
  EXPECT_TRUE(passes(plate, {{2.1, 0.5}, {2.1, -1.1}, {0.8, -0.6}, down}));
}

TEST_P(Passage, IsNotWhatSlidesNorWhatIsBehindFromTheStart)
{
  EXPECT_FALSE(passes(table, {{2.1, -0.2}, {2.1, -0.9}, down, down}));
  EXPECT_FALSE(passes(table, {{2.1, -0.2}, {2.1, 0.3}, down, down}));
  EXPECT_FALSE(passes(table, {{0.5, 0}, {3.5, 0}, down, down}));
  EXPECT_FALSE(passes(table, {{0.5, -0.01}, {3.5, -0.01}, down, down}));
  EXPECT_FALSE(passes(plate, {{0.5, 0.02}, {3.5, -0.01}, down, down}));
}

TEST_P(Passage, IsNotWhatSlidesAroundARidge)
{
  const Vector<2> diagonal{-std::sqrt(0.5), -std::sqrt(0.5)};
  EXPECT_FALSE(passes(table, {{3.5, 0}, {4, -0.5}, down, left}));
  EXPECT_FALSE(passes(table, {{3.5, 0}, {4.2, -0.6}, down, diagonal}));
  // Off the edge as it is, not turned
  EXPECT_FALSE(passes(table, {{3.5, 0}, {4.5, -0.5}, down, down}));
  // Through the edge from above: it has not been on the surface
  EXPECT_TRUE(passes(table, {{3.5, 0.4}, {4.5, -0.9}, down, down}));
  // Into the table instead
  EXPECT_TRUE(passes(table, {{3.5, 0}, {3.9, -0.5}, down, left}));
}

TEST_P(Passage, IsNotWhatSlidesAlongARoundSurface)
{
  const Outline shaft = circle(1, 48), hole = circle(1, 48, true);
  for (double to = 100; to < 240; to += 10)
  {
    const Vector<2> p0 = at_angle(1, 90), p1 = at_angle(1, to);
    // Its chord goes through the shaft
    EXPECT_FALSE(passes(shaft, {p0, p1, -1. * p0, -1. * p1})) << to;
    const Vector<2> off = at_angle(1.3, to);
    EXPECT_FALSE(passes(shaft, {p0, off, -1. * p0, -1. * p1})) << to;
    EXPECT_FALSE(passes(hole, {p0, p1, p0, p1})) << to;
  }
  EXPECT_TRUE(passes(shaft, {at_angle(1, 90), {0, 0}, down, down}));
  EXPECT_TRUE(passes(shaft, {at_angle(1, 90), at_angle(1, 270), down, down}));
  EXPECT_TRUE(passes(hole, {at_angle(1, 90), at_angle(1.5, 90), up, up}));
}

TEST_P(Passage, OfAShaftThatTurnsInItsBearing)
{
  // The shaft's nodes go through the hole, those of the hole through the shaft
  const Outline shaft = circle(0.99, 48), hole = circle(1, 48, true);
  for (double turned = 0; turned <= 180; turned += 22.5)
  {
    Outline end;
    for (int i = 0; i < 48; ++i)
      end.push_back(at_angle(0.99, 360. * i / 48 + turned));
    const Vector<2> p0 = at_angle(0.99, 80), p1 = at_angle(0.99, 80 + turned);
    EXPECT_FALSE(passes(hole, {p0, p1, p0, p1})) << turned;
    const Vector<2> p = at_angle(1, 80);
    EXPECT_LT(run(shaft, end, {p, p, -1. * p, -1. * p}).facet[0], 0) << turned;
  }
}

TEST_P(Passage, NeedsATaggedFacet)
{
  const Outline top{{4, 0}, {3, 0}, {2, 0}, {1, 0}, {0, 0}};
  EXPECT_TRUE(passes(top, {{2.1, 0.5}, {2.1, -5}, down, down}, false));
  EXPECT_FALSE(passes(top, {{4.5, 0.5}, {4.5, -5}, down, down}, false));
  // Around its edge to where it was behind
  EXPECT_FALSE(passes(top, {{4.5, 0.5}, {3.5, -5}, down, down}, false));
}

TEST_P(Passage, OfATipIsThatOfNodesThatItDoesNotShare)
{
  // A crack opens: the node is at both sides' tip
  const Outline crack{{3, 0}, {1.5, 0}, {0, 0}};
  Outline opened = crack;
  opened[1][1] = 0.5;
  const Step step{{1.5, 0}, {1.5, -0.5}, down, down};
  EXPECT_GE(run(crack, opened, step, false).facet[0], 0);
  // The node of the layer that the point is next to
  const int tip = GetParam() == Made::segments ? 1 : 4;
  EXPECT_LT(run(crack, opened, step, false, tip).facet[0], 0);
}

TEST_P(Passage, OfTipsOfCantilevers)
{
  // Each bends by five thicknesses and more, as at the tip of the other
  const auto cantilever = [](double bend)
  {
    Outline outline = rectangle({0, -1}, {20, 0}, 10);
    for (auto& p : outline)
    {
      const double s = p[0] / 20, w = bend * s * s;
      p = {p[0] - 0.6 * bend * w / 20 + 2 * bend * s / 20 * (p[1] + 0.5),
           p[1] - w};
    }
    return outline;
  };
  const Step passed{{19, 0.3}, {19, -5.5}, down, down};
  EXPECT_GE(run(cantilever(0), cantilever(-5.5), passed).facet[0], 0);
  const Step pressed{{19, 0.3}, {18.6, -4.6}, down, down};
  EXPECT_LT(run(cantilever(0), cantilever(5.5), pressed).facet[0], 0);
}

INSTANTIATE_TEST_SUITE_P(All, Passage,
                         testing::Values(Made::segments, Made::triangles,
                                         Made::quadrilaterals));

Crossing crossing(double time, bool entering, double cosine, double after = -1,
                  double before = 1)
{
  return {0,      static_cast<std::int32_t>(100 * time),
          time,   entering,
          cosine, before,
          after};
}

std::int32_t judged(const std::vector<Crossing>& crossings)
{
  return passed(crossings, std::vector{tol})[0];
}

TEST(Judgement, TakesCrossingsInTheirOrderAndAllowsATolerance)
{
  const Crossing in = crossing(0.2, true, -1), out = crossing(0.4, false, -1);
  EXPECT_EQ(judged({}), -1);
  EXPECT_EQ(judged({in}), 0);
  EXPECT_EQ(judged({in, out}), -1);
  EXPECT_EQ(judged({out, in}), -1);
  EXPECT_EQ(judged({crossing(0.6, true, -1), out, in}), 0);
  EXPECT_EQ(judged({out}), -1);
  EXPECT_EQ(judged({crossing(0.2, true, -1, -0.9 * tol)}), -1);
  EXPECT_EQ(judged({crossing(0.2, true, -1, -1.1 * tol)}), 0);
  // A ridge that is only touched: both at once, whichever is named first
  EXPECT_EQ(judged({crossing(0.2, false, -1), crossing(0.2, true, -1)}), -1);
}

TEST(Judgement, TakesBackWhatWasGoneThroughThereAndBack)
{
  const std::vector<Crossing> dip{
      crossing(0.1, true, -1), crossing(0.2, false, 1), crossing(0.3, true, 1),
      crossing(0.4, false, -1)};
  EXPECT_EQ(judged(dip), -1);
  auto deeper = dip;
  deeper.pop_back();
  EXPECT_EQ(judged(deeper), 0);
  deeper.pop_back();
  EXPECT_EQ(judged(deeper), 0);
  // A second body that is slid along does not make the first one good
  auto slid = deeper;
  slid.push_back(crossing(0.5, true, -1));
  slid.push_back(crossing(0.6, false, -1));
  EXPECT_EQ(judged(slid), 0);
  // One that it was behind of from the start neither
  EXPECT_EQ(judged({crossing(0.05, false, -1), deeper[0], deeper[1]}), 1);
}

TEST(Judgement, OfAnEdgeDependsOnTheStart)
{
  const Crossing out = crossing(0.4, false, 0);
  EXPECT_EQ(judged({crossing(0.2, true, -1, -1, 1), out}), 0);
  EXPECT_EQ(judged({crossing(0.2, true, -1, -1, 0.5 * tol), out}), -1);
  // Into the edge counts neither way
  EXPECT_EQ(judged({crossing(0.2, true, 0)}), -1);
  EXPECT_EQ(judged({crossing(0.2, true, -1), crossing(0.4, false, 1),
                    crossing(0.6, true, 0)}),
            0);
  EXPECT_EQ(judged({crossing(0.2, true, -1), crossing(0.4, false, 1),
                    crossing(0.6, true, 0), crossing(0.8, false, -1)}),
            0);
}

TEST(Judgement, IsThatOfEachPoint)
{
  std::vector<Crossing> all{crossing(0.2, true, -1), crossing(0.2, true, -1),
                            crossing(0.4, false, -1)};
  all[1].point = all[2].point = 2;
  EXPECT_EQ(passed(all, std::vector{tol, tol, tol}),
            (std::vector<std::int32_t>{0, -1, -1}));
}

/// A body on a body, and gaps of all sizes, turned together.
template <int D>
void common_motion_finds_nothing(unsigned seed)
{
  Generator random(seed);
  const Made made = D == 2 ? Made::segments : Made::quadrilaterals;
  for (double degrees = 0; degrees <= 180; degrees += 4.5)
  {
    MovingScene s = outlined(made, table, table);
    for (int i = 0; i < 40; ++i)
    {
      const double height = i < 10 ? 0 : std::pow(10, random(-6, 3));
      const Vector<3> p{random(-1, 5), height, random(-2, 2)};
      s.point(p, p, {0, -1, 0}, {0, -1, 0}, 1e-4);
    }
    s.move(turn<D>(random, random(0, 360), 3), false);
    s.move(turn<D>(random, degrees, 100), true);
    for (const std::int32_t facet : s.passages().facet)
      EXPECT_EQ(facet, -1) << degrees;
  }
}

TEST(CommonMotion, FindsNothing)
{
  common_motion_finds_nothing<2>(1);
  common_motion_finds_nothing<3>(2);
}

/// Bodies of random shapes on which points slide while all turns: small steps
/// stay in front, so the large one must not pass.
TEST(CommonMotion, WithSlidingFindsNothing)
{
  Generator random(3);
  for (int i = 0; i < 300; ++i)
  {
    MovingScene s = outlined(Made::segments, plate, plate);
    const double x0 = random(0.1, 3.9), x1 = random(0.1, 3.9);
    s.point({x0, 0, 0}, {x1, random(0, 0.01), 0}, {0, -1, 0}, {0, -1, 0}, 0.01);
    s.move(turn<2>(random, random(0, 180), 10), true);
    EXPECT_EQ(s.passages().facet[0], -1);
  }
}

/// Beads around a plate of any shape: whether a bead is through is where it
/// is at the end, as it cannot get around.
template <int D>
void long_plates(unsigned seed)
{
  Generator random(seed);
  int through = 0;
  for (int i = 0; i < 400; ++i)
  {
    const Made made = D == 2       ? Made::segments
                      : i % 2 == 0 ? Made::triangles
                                   : Made::quadrilaterals;
    Outline from = rectangle({-9, -0.3}, {9, 0}, 9), to = from;
    const double wave0 = random(0, 0.5), wave1 = random(0, 0.5),
                 rise = random(-2, 2);
    const auto height
        = [](double wave, double x) { return wave * std::sin(x); };
    for (std::size_t k = 0; k < from.size(); ++k)
    {
      from[k][1] += height(wave0, from[k][0]);
      to[k][1] += rise + height(wave1, to[k][0]);
    }
    MovingScene s = outlined(made, from, to);
    const double x0 = random(-3, 3), x1 = random(-3, 3);
    const double end = random(-4, 4);
    s.point({x0, random(0.6, 2), random(-1, 1)}, {x1, end, random(-1, 1)},
            {0, -1, 0}, {0, -1, 0}, 1e-3);
    // Segments of two deviate from the wave by 0.3 at most
    const double over = end - rise - height(wave1, x1);
    if (over > -0.4 and over < 0.4)
      continue;
    s.move(turn<D>(random, random(0, 180), 5), true);
    EXPECT_EQ(s.passages().facet[0] >= 0, over < 0);
    through += over < 0;
  }
  EXPECT_GT(through, 50);
  EXPECT_LT(through, 300);
}

TEST(LongPlate, IsPassedWherePointsEndOnItsOtherSide)
{
  long_plates<2>(4);
  long_plates<3>(5);
}

TEST(Passages, OfNothingAreNone)
{
  EXPECT_TRUE(outlined(Made::segments, table, table).passages().facet.empty());
  MovingScene s(3);
  s.point({0, 0, 1}, {0, 0, -1}, {0, 0, -1}, {0, 0, -1}, 1e-3);
  EXPECT_EQ(s.passages().facet, (std::vector<std::int32_t>{-1}));
}
} // namespace
