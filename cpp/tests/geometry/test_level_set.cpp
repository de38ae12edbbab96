// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#include "generator.h"
#include "obstacles.h"
#include <numbers>

using namespace contactx;
using namespace contactx::geometry;
using namespace contactx::tests;

namespace
{
/// Distance from a sphere of radius r about the origin, times a factor.
LevelSet round_set(double r, double factor, bool has_hessian = true)
{
  return LevelSet(
      [=](std::span<const double> x, int gdim, int)
      {
        LevelValues at;
        for (std::size_t i = 0; i < x.size() / gdim; ++i)
        {
          double square = 0;
          for (int k = 0; k < gdim; ++k)
            square += x[gdim * i + k] * x[gdim * i + k];
          const double d = std::sqrt(square);
          at.value.push_back(factor * (d - r));
          for (int j = 0; j < gdim; ++j)
          {
            const double u = x[gdim * i + j] / d;
            at.gradient.push_back(factor * u);
            for (int k = 0; has_hessian and k < gdim; ++k)
              at.hessian.push_back(factor / d
                                   * ((j == k) - u * x[gdim * i + k] / d));
          }
        }
        return at;
      });
}

/// Faces b_i . x - d_i + |x|^2 / 2 * bend of a body, each times another factor.
LevelSet faced(std::vector<Vector<3>> normal, double bend,
               bool has_hessian = true)
{
  return LevelSet(
      [=](std::span<const double> x, int gdim, int)
      {
        LevelValues at;
        for (std::size_t f = 0; f < normal.size(); ++f)
          for (std::size_t i = 0; i < x.size(); i += gdim)
          {
            const double factor = 1.0 + f;
            double value = 0;
            for (int k = 0; k < gdim; ++k)
            {
              const double c = x[i + k];
              value += normal[f][k] * c + bend * c * c / 2;
              at.gradient.push_back(factor * (normal[f][k] + bend * c));
              for (int j = 0; has_hessian and j < gdim; ++j)
                at.hessian.push_back(factor * bend * (j == k));
            }
            at.value.push_back(factor * value);
          }
        return at;
      });
}

/// Of a pyramid whose apex is the origin: its slope is 1 : 2.
std::vector<Vector<3>> pyramid()
{
  return {{1, 0, 2}, {0, 1, 2}, {-1, 0, 2}, {0, -1, 2}};
}

TEST(LevelSet, OnAnApexTheNormalIsTheAxisOfTheConeOfNormals)
{
  LevelSet set = faced(pyramid(), 0.3);
  set.extent = 1;
  // On the apex but for rounding, and inside below it
  for (const double height : {0., 1e-12, -1e-12, -0.1})
  {
    const Geometry at = set.evaluate(std::vector<double>{1e-14, 0, height}, 3);
    EXPECT_NEAR(at.normal[0], 0, 1e-12);
    EXPECT_NEAR(at.normal[1], 0, 1e-12);
    EXPECT_NEAR(at.normal[2], 1, 1e-12);
  }
  // Three faces at unequal angles: the narrowest cone, whose axis is as far
  // from each of those that bound it
  const std::vector<Vector<3>> sharp{{1, 0, 1}, {-1, 0.3, 1}, {0, -1, 0.5}};
  LevelSet odd = faced(sharp, 0);
  odd.extent = 1;
  const auto n = odd.evaluate(std::vector<double>{0, 0, 0}, 3).normal;
  std::vector<double> cosine;
  for (const Vector<3>& b : sharp)
    cosine.push_back(dot(b, Vector<3>{n[0], n[1], n[2]}) / norm(b));
  EXPECT_NEAR(cosine[0], cosine[1], 1e-14);
  EXPECT_NEAR(cosine[0], cosine[2], 1e-14);
  EXPECT_GT(cosine[0], 0);
}

TEST(LevelSet, BeyondARidgeTheNormalIsAlongTheWayFromIt)
{
  LevelSet set = faced(pyramid(), 0);
  // In the cone of normals above the apex, above a ridge, beside a face
  const std::vector<double> x{0.02, -0.03, 0.4, 0.3, 0.3, 0, 0.5, 0.1, 0};
  const Geometry at = set.evaluate(x, 3);
  const double way = std::sqrt(0.02 * 0.02 + 0.03 * 0.03 + 0.4 * 0.4);
  EXPECT_NEAR(at.gap[0], way, 1e-15);
  EXPECT_NEAR(at.normal[0], 0.02 / way, 1e-14);
  EXPECT_NEAR(at.normal[1], -0.03 / way, 1e-14);
  // The ridge z = -x / 2, x = y has a direction (2, 2, -1) / 3
  EXPECT_NEAR(at.normal[3], at.normal[4], 1e-15);
  EXPECT_NEAR(2 * at.normal[3] + 2 * at.normal[4] - at.normal[5], 0, 1e-14);
  EXPECT_NEAR(at.gap[1], std::sqrt(0.18 - 0.4 * 0.4), 1e-14);
  EXPECT_NEAR(at.gap[2], 0.5 / std::sqrt(5), 1e-15);
  EXPECT_EQ(set.distance(x, 3), at.gap);
  EXPECT_EQ(set.normals(x, 3), at.normal);
}

TEST_2D_3D(LevelSet, BeyondARidgeDerivativesAreThoseOfDifferences, gdim)
{
  Generator random(5);
  for (bool has_hessian : {true, false})
  {
    std::vector<Vector<3>> normal = pyramid();
    if (gdim == 2)
      normal = {{1, 2, 0}, {-1, 1, 0}};
    LevelSet set = faced(normal, 0.4, has_hessian);
    set.extent = 1;
    std::vector<double> x;
    for (int i = 0; i < 40; ++i)
    {
      for (int k = 0; k + 1 < gdim; ++k)
        x.push_back(random(-0.1, 0.1));
      x.push_back(random(-0.02, 0.3));
    }
    expect_differences(set, x, gdim, 1e-6, [](const Geometry& at, int i)
                       { return 1e-7 * (1 + 1 / std::abs(at.gap[i])); });
  }
}

TEST(LevelSet, AlongARidgeTheAxisOfItsConeTurnsAsDifferencesSay)
{
  // A lens: two balls about (0, 0, -1) and (0, 0, 1), cut by a cylinder
  LevelSet lens(
      [](std::span<const double> x, int, int)
      {
        LevelValues at;
        for (const double c : {-1., 1.})
        {
          at.value.push_back(x[0] * x[0] + x[1] * x[1] + (x[2] - c) * (x[2] - c)
                             - 2);
          at.gradient.insert(at.gradient.end(),
                             {2 * x[0], 2 * x[1], 2 * (x[2] - c)});
          at.hessian.insert(at.hessian.end(), {2, 0, 0, 0, 2, 0, 0, 0, 2});
        }
        return at;
      });
  lens.extent = 1;
  const double a = 0.4, h = 1e-5;
  const auto rim = [&](double angle)
  {
    return lens.evaluate(
        std::vector<double>{std::cos(angle), std::sin(angle), 0}, 3);
  };
  const Geometry at = rim(a), up = rim(a + h), down = rim(a - h);
  const Vector<3> along{-std::sin(a), std::cos(a), 0};
  EXPECT_NEAR(at.normal[0], std::cos(a), 1e-14);
  for (int j = 0; j < 3; ++j)
    EXPECT_NEAR(dot(vector_at(at.curvature, j, 3), along),
                (up.normal[j] - down.normal[j]) / (2 * h), 1e-9);
}

TEST(LevelSet, FacesThatBoundNothingOrFaceAwayFromOneAnotherHaveNoRidge)
{
  // A plate about z = 0, and a constant
  LevelSet plate(
      [](std::span<const double> x, int, int)
      {
        return LevelValues{{x[2] - 1, -x[2] - 1, -3},
                           {0, 0, 1, 0, 0, -1, 0, 0, 0},
                           std::vector<double>(27, 0.0)};
      });
  plate.extent = 1;
  const Geometry middle = plate.evaluate(std::vector<double>{0, 0, 0}, 3);
  EXPECT_EQ(middle.gap[0], -1);
  EXPECT_EQ(middle.normal[2], 1);
  EXPECT_EQ(plate.distance(std::vector<double>{0, 0, -4}, 3)[0], 3);
  EXPECT_EQ(plate.level(std::vector<double>{0, 0, -4}, 3)[0], 3);
}

TEST(LevelSet, OfADistanceIsASphere)
{
  Generator random(2);
  for (int gdim : {2, 3})
    for (bool has_hessian : {true, false})
    {
      LevelSet set = round_set(0.7, 2.5, has_hessian);
      Sphere sphere(std::vector<double>(gdim, 0.0), 0.7);
      const std::vector<double> x = random.numbers(30 * gdim, 0.3, 1.5);
      const Geometry a = set.evaluate(x, gdim), b = sphere.evaluate(x, gdim);
      const double tolerance = has_hessian ? 1e-14 : 1e-9;
      expect_near(a.gap, b.gap, 1e-14);
      expect_near(a.normal, b.normal, 1e-14);
      expect_near(a.gradient, b.gradient, tolerance);
      expect_near(a.curvature, b.curvature, tolerance);
      expect_near(set.distance(x, gdim), b.gap, 1e-14);
      auto level = b.gap;
      for (double& value : level)
        value *= 2.5;
      expect_near(set.level(x, gdim), level, 1e-14);
      EXPECT_EQ(set.normals(x, gdim), a.normal);
      EXPECT_FALSE(set.knows_its_motion());
    }
}

TEST(LevelSet, ThatIsNoDistanceMeasuresToFirstOrder)
{
  LevelSet square(
      [](std::span<const double> x, int, int)
      {
        return LevelValues{{5 * (x[0] * x[0] + x[1] * x[1] - 1)},
                           {10 * x[0], 10 * x[1]},
                           {10, 0, 0, 10}};
      });
  EXPECT_NEAR(square.distance(std::vector<double>{1.001, 0}, 2)[0], 1e-3, 1e-6);
  EXPECT_NEAR(square.evaluate(std::vector<double>{0, 0.999}, 2).gap[0], -1e-3,
              1e-6);
}

TEST(LevelSet, ACurvatureDoesNotDependOnOtherPoints)
{
  LevelSet wave(
      [](std::span<const double> x, int gdim, int)
      {
        LevelValues at;
        for (std::size_t i = 0; i < x.size(); i += gdim)
        {
          at.value.push_back(x[i + 1] + std::sin(x[i]));
          at.gradient.push_back(std::cos(x[i]));
          at.gradient.push_back(1);
        }
        return at;
      });
  wave.extent = 2;
  const std::vector<double> x{0, 0, 0.3, 0.1, -0.7, 1};
  const auto every = wave.evaluate(x, 2).curvature;
  for (int i = 0; i < 3; ++i)
  {
    const auto one = wave.evaluate(std::span(x).subspan(2 * i, 2), 2).curvature;
    EXPECT_TRUE(std::equal(one.begin(), one.end(), every.begin() + 4 * i));
  }
}

TEST(LevelSet, ItsFunctionIsNotAskedAboutNoPoints)
{
  LevelSet set([](std::span<const double>, int, int) -> LevelValues
               { throw std::runtime_error("asked"); });
  EXPECT_TRUE(set.evaluate({}, 2).gap.empty());
  EXPECT_TRUE(set.level({}, 2).empty());
  EXPECT_THROW(set.level(std::vector<double>{1, 2}, 2), std::runtime_error);
}

TEST(LevelSet, WhereItMeansNothingNothingIsNear)
{
  const double nan = std::nan("");
  // Fine, without gradient outside and inside, not finite, a bad gradient
  const LevelValues values{{2, 1, -1, nan, 1},
                           {4, 0, 0, 0, 0, 0, 1, 0, nan, 1},
                           std::vector<double>(20, 0.0)};
  LevelSet set([&](std::span<const double>, int, int) { return values; });
  const std::vector<double> x{0, 0, 0.25, 1, 0, 0, 0, 0, 0, 0};
  EXPECT_EQ(set.distance(x, 2), (std::vector<double>{0.5, infinity, -infinity,
                                                     infinity, infinity}));
  EXPECT_EQ(set.normals(x, 2),
            (std::vector<double>{1, 0, 0, 0, 0, 0, 0, 0, 0, 0}));
  EXPECT_EQ(refusal([&] { set.evaluate(x, 2); }),
            "the function of a LevelSet or its gradient is not finite, or the "
            "gradient zero, at 4 slave nodes, first at [0.25, 1]: the gradient "
            "must point outward wherever a slave node may come "
            "(manual: errors/level-set-values)");
}

TEST(LevelSet, RefusesValuesOfAnotherNumber)
{
  LevelSet set([](std::span<const double>, int, int)
               { return LevelValues{{1, 2, 3}, {1, 0}, {}}; });
  EXPECT_REFUSED(set.level(std::vector<double>{1, 2, 3, 4}, 2));
}

TEST(LevelSet, TellsItsParameters)
{
  double height = 1;
  LevelSet set([](std::span<const double>, int, int) { return LevelValues{}; },
               [&](int gdim)
               { return std::vector<double>{height, 1. * gdim}; });
  height = 2;
  EXPECT_EQ(set.parameters(3), (std::vector<double>{2, 3}));
}

/// A round set that turns about the origin, one radian a unit of time.
struct Turning
{
  double time = 0;
  LevelSet set;

  explicit Turning(int gdim)
      : set([](std::span<const double> x, int g, int)
            { return bump(x, g, true); }, {},
            LevelSet::Velocity{[](std::span<const double> x, int g)
                               {
                                 std::vector<double> v(x.size(), 0);
                                 for (std::size_t i = 0; i < x.size(); i += g)
                                 {
                                   v[i] = -x[i + 1];
                                   v[i + 1] = x[i];
                                 }
                                 return v;
                               },
                               [this] { return time; }}),
        from(set.placement(gdim))
  {
  }

  Placement from;
};

TEST(LevelSet, AVelocityCarriesItsMaterial)
{
  Generator random(3);
  for (int gdim : {2, 3})
  {
    Turning turning(gdim);
    EXPECT_TRUE(turning.set.knows_its_motion());
    const std::vector<double> x = random.numbers(10 * gdim, -1, 1);
    EXPECT_EQ(turning.set.carry(x, turning.from, turning.from), x);
    for (double angle : {0.1, 0.5 * std::numbers::pi})
    {
      turning.time = angle;
      const Placement to = turning.set.placement(gdim);
      const auto y = turning.set.carry(x, turning.from, to);
      const double c = std::cos(angle), s = std::sin(angle);
      // The error of the method goes with the fifth power
      const double tolerance = 2e-4 * std::pow(angle, 5);
      for (std::size_t i = 0; i < x.size(); i += gdim)
      {
        EXPECT_NEAR(y[i], c * x[i] - s * x[i + 1], tolerance);
        EXPECT_NEAR(y[i + 1], s * x[i] + c * x[i + 1], tolerance);
        if (gdim == 3)
        {
          EXPECT_EQ(y[i + 2], x[i + 2]);
        }
      }
      expect_near(turning.set.carry(y, to, turning.from), x, 2 * tolerance);
    }
    EXPECT_TRUE(
        turning.set.carry({}, turning.from, {turning.from.point, {}, {}, 1})
            .empty());
  }
}

TEST(LevelSet, RefusesAVelocityThatIsNone)
{
  double time = 0;
  std::vector<double> v{0, std::nan("")};
  LevelSet set([](std::span<const double>, int, int) { return LevelValues{}; },
               {},
               LevelSet::Velocity{[&](std::span<const double>, int)
                                  { return v; }, [&] { return time; }});
  const Placement from = set.placement(2);
  time = 1;
  const Placement to = set.placement(2);
  const std::vector<double> x{1, 2};
  EXPECT_REFUSED(set.carry(x, from, to));
  v = {1};
  EXPECT_REFUSED(set.carry(x, from, to));
  v = {1, 2};
  EXPECT_NEAR(set.carry(x, from, to)[1], 4, 1e-15);
  time = std::nan("");
  EXPECT_REFUSED(set.placement(2));
}
} // namespace
