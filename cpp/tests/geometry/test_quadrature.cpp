// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#include "polygons.h"
#include <contactx/geometry/quadrature.h>

using namespace contactx;
using namespace contactx::geometry;
using namespace contactx::tests;

namespace
{
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

Overlap<2> region(const Polygon<2>& p)
{
  Overlap<2> o;
  for (const auto& corner : p)
    o.push(corner);
  return o;
}

TEST(Gauss, IsExactUpToItsDegree)
{
  for (int n = 1; n <= max_points; ++n)
  {
    ASSERT_EQ(gauss(n).size(), std::size_t(n));
    for (int k = 0; k <= 2 * n; ++k)
    {
      double sum = 0;
      for (const auto& [x, w] : gauss(n))
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

TEST(Gauss, IsSymmetricWithPointsInside)
{
  for (int n = 1; n <= max_points; ++n)
  {
    const auto rule = gauss(n);
    for (int i = 0; i < n; ++i)
    {
      EXPECT_GT(rule[i].x, i == 0 ? 0 : rule[i - 1].x);
      EXPECT_LT(rule[i].x, 1);
      EXPECT_GT(rule[i].weight, 0);
      EXPECT_NEAR(rule[i].x + rule[n - 1 - i].x, 1, 1e-15);
      EXPECT_NEAR(rule[i].weight, rule[n - 1 - i].weight, 1e-15);
    }
  }
}

TEST(Gauss, KnowsTheRulesOfTheBooks)
{
  EXPECT_NEAR(gauss(1)[0].x, 0.5, 1e-16);
  EXPECT_NEAR(gauss(2)[0].x, 0.5 - std::sqrt(3.) / 6, 1e-16);
  EXPECT_NEAR(gauss(3)[0].x, 0.5 - std::sqrt(0.15), 1e-16);
  EXPECT_NEAR(gauss(3)[0].weight, 5. / 18, 1e-15);
  EXPECT_NEAR(gauss(3)[1].weight, 8. / 18, 1e-15);
}

TEST(Integrate, IsExactOverAnInterval)
{
  Overlap<1> o;
  o.push({-0.5});
  o.push({1});
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
  const auto o = region({{0, 0}, {1, 0}, {0, 1}});
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
      EXPECT_NEAR(integral(region(points), degree, f), expected, 1e-14);
    }
  }
}

TEST(Integrate, HasPointsInsideAndPositiveWeights)
{
  const Polygon<2> p{{0, 0}, {2, 0}, {3, 1}, {1, 2}};
  for (int degree = 0; degree <= 40; ++degree)
    integrate(region(p), degree,
              [&p](const Vector<2>& q, double w)
              {
                EXPECT_GT(w, 0);
                EXPECT_TRUE(holds(p, q, 1e-15));
              });
}

TEST(Integrate, TakesTheLargestRuleForAHighDegree)
{
  const auto o = region({{0, 0}, {1, 0}, {0, 1}});
  const auto f = [](const Vector<2>& p) { return std::exp(p[0] + p[1]); };
  EXPECT_NEAR(integral(o, 1000, f), 1, 1e-15); // int s e^s ds
  Overlap<1> line;
  line.push({0});
  line.push({1});
  EXPECT_NEAR(
      integral(line, 1000, [](const Vector<1>& p) { return std::exp(p[0]); }),
      std::exp(1.) - 1, 1e-15);
}

TEST(Integrate, GivesNothingWhereThereIsNothing)
{
  const auto one = [](const auto&) { return 1.; };
  EXPECT_EQ(integral(Overlap<1>{}, 3, one), 0);
  EXPECT_EQ(integral(Overlap<2>{}, 3, one), 0);
  EXPECT_EQ(integral(region({{0, 0}, {1, 1}, {2, 2}}), 3, one), 0);
}
} // namespace
