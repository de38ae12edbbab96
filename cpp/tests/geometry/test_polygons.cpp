// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#include "polygons.h"
#include <contactx/geometry/clip.h>
#include <contactx/geometry/quadrature.h>
#include <numbers>

using namespace contactx::geometry;
using namespace contactx::tests;
using namespace contactx;

namespace
{

template <int D>
Polygon<D> polygon(const Overlap<D>& o)
{
  return {o.corner.begin(), o.corner.begin() + o.size};
}

Overlap<2> overlap(const Polygon<2>& p)
{
  Overlap<2> o;
  for (const auto& corner : p)
    o.push(corner);
  return o;
}

Overlap<2> box(double left, double bottom, double right, double top)
{
  return overlap({{left, bottom}, {right, bottom}, {right, top}, {left, top}});
}

/// What two polygons share, by clipping either with the other.
double shared_area(const Overlap<2>& a, const Overlap<2>& b)
{
  const double one = area(polygon(clip(a, b)));
  EXPECT_NEAR(area(polygon(clip(b, a))), one, 1e-14);
  return one;
}

Overlap<1> interval(double a, double b)
{
  return outline<Segment>(Flat<Segment>{{{a}, {b}}});
}

/// A random convex polygon with `n` corners.
Overlap<2> random_polygon(Generator& random, int n)
{
  const auto centre = random.vector<2>(-0.5, 0.5);
  const double size = random(0.2, 1);
  std::vector<double> angles;
  double at = random(0, 1);
  for (int i = 0; i < n; ++i)
  {
    angles.push_back(at);
    at += random(0.3, 1);
  }
  Polygon<2> p;
  for (const double angle : angles)
  {
    const double phi = 2 * std::numbers::pi * angle / (at - angles[0]);
    p.push_back(centre + size * Vector<2>{std::cos(phi), std::sin(phi)});
  }
  return overlap(p);
}

TEST(Outline, IsCounterclockwiseForBothOrientations)
{
  const Flat<Quadrilateral> quad{{{0, 0}, {1, 0}, {0, 1}, {1, 1}}};
  const Flat<Quadrilateral> behind{quad[0], quad[2], quad[1], quad[3]};
  EXPECT_EQ(area(polygon(outline<Quadrilateral>(quad))), 1);
  EXPECT_EQ(area(polygon(outline<Quadrilateral>(behind))), 1);
  const Flat<Triangle> triangle{{{0, 0}, {2, 0}, {0, 1}}};
  const Flat<Triangle> other{triangle[0], triangle[2], triangle[1]};
  EXPECT_EQ(area(polygon(outline<Triangle>(triangle))), 1);
  EXPECT_EQ(area(polygon(outline<Triangle>(other))), 1);
  for (const auto& [a, b] : {std::pair{-1., 2.}, {2., -1.}})
  {
    EXPECT_EQ(interval(a, b).corner[0][0], -1);
    EXPECT_EQ(interval(a, b).corner[1][0], 2);
  }
}

TEST(Intervals, ShareTheirOverlap)
{
  const auto length = [](double a, double b, double c, double d)
  {
    const double one = area(polygon(clip(interval(a, b), interval(c, d))));
    EXPECT_EQ(area(polygon(clip(interval(c, d), interval(a, b)))), one);
    return one;
  };
  EXPECT_EQ(length(0, 2, 1, 4), 1);
  EXPECT_EQ(length(2, 0, 4, 1), 1); // traversed the other way
  EXPECT_EQ(length(0, 4, 1, 2), 1); // one inside the other
  EXPECT_EQ(length(0, 2, 0, 2), 2); // identical
  EXPECT_EQ(length(0, 1, 1, 2), 0); // touching
  EXPECT_EQ(length(0, 1, 2, 3), 0); // apart
  EXPECT_EQ(length(1, 1, 0, 2), 0); // a point
  EXPECT_EQ(clip(interval(0, 1), interval(1, 2)).size, 0);
}

TEST(Polygons, ShareKnownAreas)
{
  const auto unit = box(0, 0, 1, 1);
  EXPECT_EQ(shared_area(unit, unit), 1);
  EXPECT_EQ(shared_area(unit, box(0.5, 0.25, 2, 2)), 0.375);
  EXPECT_EQ(shared_area(unit, box(-1, -1, 2, 2)), 1);
  EXPECT_EQ(shared_area(unit, box(0.25, 0.25, 0.75, 0.5)), 0.125);
  EXPECT_EQ(shared_area(unit, box(-1, 0.25, 2, 0.5)), 0.25); // a cross
  const auto corner = overlap({{0, 0}, {1, 0}, {0, 1}});
  EXPECT_EQ(shared_area(unit, corner), 0.5); // three edges in common
  EXPECT_EQ(shared_area(corner, overlap({{1, 1}, {0, 1}, {1, 0}})), 0);
}

TEST(Polygons, ThatAreApartOrOnlyTouchShareNothing)
{
  const auto unit = box(0, 0, 1, 1);
  EXPECT_EQ(clip(unit, box(2, 0, 3, 1)).size, 0);
  EXPECT_EQ(clip(unit, box(2, 2, 3, 3)).size, 0);
  EXPECT_EQ(shared_area(unit, box(1, 0, 2, 1)), 0);   // an edge
  EXPECT_EQ(shared_area(unit, box(1, 0.5, 2, 3)), 0); // a part of it
  EXPECT_EQ(shared_area(unit, box(1, 1, 2, 2)), 0);   // a corner
  EXPECT_EQ(clip(unit, box(1, 1, 2, 2)).size, 0);
  // Without area
  for (const Vector<2>& p : {Vector<2>{0.2, 0.2}, {0.5, 0.5}})
    EXPECT_EQ(shared_area(unit, overlap({p, {1 - p[0], 1 - p[1]}, {0.5, 0.5}})),
              0);
  // A corner on an edge
  EXPECT_EQ(shared_area(unit, overlap({{1, 0.5}, {2, 0}, {2, 1}})), 0);
}

TEST(Polygons, TurnedSquaresShareAnOctagon)
{
  // The square [-1, 1]^2 and the same turned by phi: four corners are cut off
  const auto square = box(-1, -1, 1, 1);
  for (const double degrees : {1., 10., 30., 45., 60., 89.})
  {
    const double phi = degrees * std::numbers::pi / 180;
    Polygon<2> other;
    for (const auto& p : polygon(square))
      other.push_back({std::cos(phi) * p[0] - std::sin(phi) * p[1],
                       std::sin(phi) * p[0] + std::cos(phi) * p[1]});
    // Legs of the right triangles that are cut off: together with the
    // hypotenuse that is left of an edge they make up its length
    const double c = std::cos(phi), s = std::sin(phi), h = 2 / (1 + c + s);
    EXPECT_EQ(clip(square, overlap(other)).size, 8);
    EXPECT_NEAR(shared_area(square, overlap(other)), 4 - 2 * h * h * c * s,
                1e-13);
  }
}

TEST(Polygons, AgreeWithTheHullOfCornersAndCrossings)
{
  Generator random(1);
  int together = 0, most = 0;
  for (int i = 0; i < 5000; ++i)
  {
    const auto a = random_polygon(random, 3 + i % 2);
    const auto b = random_polygon(random, 3 + i / 2 % 2);
    const auto c = clip(a, b);
    const double expected = area(shared(polygon(a), polygon(b)));
    EXPECT_NEAR(area(polygon(c)), expected, 1e-13);
    shared_area(a, b);
    EXPECT_LE(c.size, a.size + b.size);
    most = std::max(most, c.size);
    for (int j = 0; j < c.size; ++j)
    {
      EXPECT_TRUE(holds(polygon(a), c.corner[j], 1e-13));
      EXPECT_TRUE(holds(polygon(b), c.corner[j], 1e-13));
      EXPECT_GT(turn(c.corner[j], c.corner[(j + 1) % c.size],
                     c.corner[(j + 2) % c.size]),
                -1e-14);
    }
    together += expected > 0;
  }
  EXPECT_GT(together, 2500);
  EXPECT_LT(together, 4900);
  EXPECT_EQ(most, 8);
}

TEST(Polygons, OnALatticeShareWhatTheHullSays)
{
  // Common corners, edges and corners on edges
  Generator random(2);
  const auto lattice = [&random] { return std::floor(random(0, 4)); };
  int tried = 0;
  while (tried < 2000)
  {
    Polygon<2> a, b;
    for (int k = 0; k < 4; ++k)
    {
      a.push_back({lattice(), lattice()});
      b.push_back({lattice(), lattice()});
    }
    a = hull(a);
    b = hull(b);
    if (a.size() < 3 or b.size() < 3)
      continue;
    ++tried;
    EXPECT_NEAR(shared_area(overlap(a), overlap(b)), area(shared(a, b)), 1e-13);
  }
}

TEST(Polygons, ThatAreSliversShareTheirPart)
{
  const auto unit = box(0, 0, 1, 1);
  for (const double d : {1e-3, 1e-8, 1e-14})
  {
    // Along an edge, and along the diagonal
    EXPECT_NEAR(shared_area(unit, box(-1, -d, 2, d)), d, 1e-15);
    const auto across = overlap({{-1, -1}, {2, 2}, {2 - d, 2 + d}});
    const double whole = area(polygon(across));
    EXPECT_GT(shared_area(unit, across), 0.1 * whole);
    EXPECT_LT(shared_area(unit, across), whole);
    EXPECT_NEAR(shared_area(across, across), whole, 1e-15);
  }
}

TEST(Polygons, NeverHaveMoreCornersThanFit)
{
  // Corners that are not convex, or cross: nothing is written past the end
  Generator random(3);
  for (int i = 0; i < 5000; ++i)
  {
    Overlap<2> a, b;
    for (int k = 0; k < 4; ++k)
    {
      a.push(random.vector<2>(-1, 1));
      b.push(random.vector<2>(-1, 1));
    }
    EXPECT_LE(clip(a, b).size, Overlap<2>::most + 1);
  }
}

TEST(Polygons, WithARepeatedCornerAreThoseWithout)
{
  const auto unit = box(0, 0, 1, 1);
  const auto triangle = overlap({{0.5, 0.5}, {2, 0.5}, {0.5, 2}});
  const auto same = overlap({{0.5, 0.5}, {2, 0.5}, {2, 0.5}, {0.5, 2}});
  EXPECT_EQ(shared_area(unit, same), shared_area(unit, triangle));
}

TEST(Outline, OfAFacetWithoutPositionIsEmpty)
{
  for (const double bad : {double(NAN), double(INFINITY), -double(INFINITY)})
  {
    EXPECT_EQ(interval(bad, 1).size, 0);
    EXPECT_EQ(interval(1, bad).size, 0);
    EXPECT_EQ(interval(bad, bad).size, 0);
    const auto lost
        = outline<Triangle>(Flat<Triangle>{{{0, 0}, {1, 0}, {0.5, bad}}});
    EXPECT_EQ(lost.size, 0);
    const auto quad = outline<Quadrilateral>(
        Flat<Quadrilateral>{{{0, 0}, {bad, 0}, {0, 1}, {1, 1}}});
    EXPECT_EQ(quad.size, 0);
    EXPECT_EQ(clip(lost, box(0, 0, 1, 1)).size, 0);
    EXPECT_EQ(clip(box(0, 0, 1, 1), lost).size, 0);
    EXPECT_EQ(clip(interval(bad, 1), interval(0, 2)).size, 0);
    EXPECT_EQ(clip(interval(0, 2), interval(bad, 1)).size, 0);
  }
}

TEST(Convex, AreTrianglesAndQuadrilateralsThatAreNotFolded)
{
  const auto with_corner = [](double x, double y)
  {
    const Flat<Quadrilateral> r{{{0, 0}, {1, 0}, {0, 1}, {x, y}}};
    const Flat<Quadrilateral> behind{r[0], r[2], r[1], r[3]};
    const bool one = is_convex<Quadrilateral>(r);
    EXPECT_EQ(is_convex<Quadrilateral>(behind), one);
    return one;
  };
  EXPECT_TRUE(with_corner(1, 1));
  EXPECT_TRUE(with_corner(0.51, 0.51));
  EXPECT_TRUE(with_corner(0.3, 0.7)); // three on a line
  EXPECT_TRUE(with_corner(0, 1));     // two in one place
  EXPECT_FALSE(with_corner(0.49, 0.49));
  EXPECT_FALSE(with_corner(-1, -1)); // at another corner
  EXPECT_FALSE(with_corner(1, -1));  // edges cross
  EXPECT_FALSE(with_corner(-1, 1));
  EXPECT_TRUE(is_convex<Triangle>({{{0, 0}, {1, 0}, {0, 1}}}));
  EXPECT_TRUE(is_convex<Segment>({{{0}, {1}}}));
}

/// int x^a y^b over the triangle (0, 0), (1, 0), (0, 1): a! b! / (a + b + 2)!.
double monomial(int a, int b)
{
  return std::tgamma(a + 1) * std::tgamma(b + 1) / std::tgamma(a + b + 3);
}

template <int D>
double integral(const Overlap<D>& o, int degree, auto&& f)
{
  double sum = 0;
  integrate(o, degree, [&](const Vector<D>& p, double w) { sum += w * f(p); });
  return sum;
}

TEST(Gauss, IsSymmetricAndExactUpToItsDegree)
{
  for (int n = 1; n <= max_points; ++n)
  {
    const auto rule = gauss(n);
    ASSERT_EQ(rule.size(), std::size_t(n));
    for (int i = 0; i < n; ++i)
    {
      EXPECT_GT(rule[i].x, i == 0 ? 0 : rule[i - 1].x);
      EXPECT_LT(rule[i].x, 1);
      EXPECT_GT(rule[i].weight, 0);
      EXPECT_NEAR(rule[i].x + rule[n - 1 - i].x, 1, 1e-15);
      EXPECT_NEAR(rule[i].weight, rule[n - 1 - i].weight, 1e-15);
    }
    for (int k = 0; k <= 2 * n; ++k)
    {
      double sum = 0;
      for (const auto& [x, w] : rule)
        sum += w * std::pow(x, k);
      const double error = std::abs(sum - 1. / (k + 1));
      if (k < 2 * n)
        EXPECT_LT(error, 1e-15) << n << " " << k;
      // The error of the next one, (n!)^4 / ((2 n + 1) (2 n)!^2)
      else if (n < 10)
      {
        const double next = std::pow(std::tgamma(n + 1), 4) / (k + 1)
                            / std::pow(std::tgamma(k + 1), 2);
        EXPECT_NEAR(error / next, 1, 1e-2);
      }
    }
  }
}

TEST(Integrate, IsExactOverAnInterval)
{
  const auto o = interval(-0.5, 1);
  for (int degree = 0; degree <= 2 * max_points - 1; ++degree)
    for (int k = 0; k <= degree; ++k)
    {
      const double expected = (1 - std::pow(-0.5, k + 1)) / (k + 1);
      EXPECT_NEAR(integral(o, degree, [k](const Vector<1>& p)
                           { return std::pow(p[0], k); }),
                  expected, 1e-14);
    }
}

TEST(Integrate, IsExactOverATriangle)
{
  const auto o = overlap({{0, 0}, {1, 0}, {0, 1}});
  for (int degree = 0; degree <= 2 * max_points - 2; ++degree)
    for (int a = 0; a <= degree; ++a)
      for (int b = 0; a + b <= degree; ++b)
      {
        const auto f = [a, b](const Vector<2>& p)
        { return std::pow(p[0], a) * std::pow(p[1], b); };
        EXPECT_NEAR(integral(o, degree, f), monomial(a, b), 1e-15);
      }
}

TEST(Integrate, IsExactOverPolygons)
{
  // By Green's theorem: int x^a y^b = int x^(a + 1) y^b dy / (a + 1)
  Generator random(1);
  for (int i = 0; i < 200; ++i)
  {
    Polygon<2> points;
    for (int k = 0; k < 12; ++k)
      points.push_back(random.vector<2>(-1, 1));
    points = hull(points);
    if (points.size() > 8)
      continue;
    for (int degree = 0; degree <= 12; ++degree)
    {
      const int a = static_cast<int>(random(0, degree + 1)), b = degree - a;
      double expected = 0;
      for (std::size_t j = 0; j < points.size(); ++j)
      {
        const Vector<2>& from = points[j];
        const Vector<2> e = points[(j + 1) % points.size()] - from;
        for (const auto& [s, w] : gauss(8))
        {
          const Vector<2> p = from + s * e;
          expected
              += w * e[1] * std::pow(p[0], a + 1) * std::pow(p[1], b) / (a + 1);
        }
      }
      const auto f = [a, b](const Vector<2>& p)
      { return std::pow(p[0], a) * std::pow(p[1], b); };
      EXPECT_NEAR(integral(overlap(points), degree, f), expected, 1e-14);
    }
  }
}

TEST(Integrate, HasPointsInsideAndPositiveWeights)
{
  const Polygon<2> p{{0, 0}, {2, 0}, {3, 1}, {1, 2}};
  for (int degree = 0; degree <= 40; ++degree)
    integrate(overlap(p), degree,
              [&p](const Vector<2>& q, double w)
              {
                EXPECT_GT(w, 0);
                EXPECT_TRUE(holds(p, q, 1e-15));
              });
}

TEST(Integrate, TakesTheLargestRuleForAHighDegree)
{
  const auto o = overlap({{0, 0}, {1, 0}, {0, 1}});
  const auto f = [](const Vector<2>& p) { return std::exp(p[0] + p[1]); };
  EXPECT_NEAR(integral(o, 1000, f), 1, 1e-15); // int s e^s ds
  EXPECT_NEAR(integral(interval(0, 1), 1000,
                       [](const Vector<1>& p) { return std::exp(p[0]); }),
              std::exp(1.) - 1, 1e-15);
}

TEST(Integrate, GivesNothingWhereThereIsNothing)
{
  const auto one = [](const auto&) { return 1.; };
  EXPECT_EQ(integral(Overlap<1>{}, 3, one), 0);
  EXPECT_EQ(integral(Overlap<2>{}, 3, one), 0);
  EXPECT_EQ(integral(overlap({{0, 0}, {1, 1}, {2, 2}}), 3, one), 0);
}
} // namespace
