// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#include "facing.h"

using namespace contactx;
using namespace contactx::tests;
using geometry::most_nodes;

namespace
{
/// Wavy surfaces, the slave's partly covered.
Facing wavy(int gdim)
{
  const auto at = [gdim](double height)
  {
    return [gdim, height](double s, double t)
    {
      const double z = height + 0.05 * std::sin(4 * s) * std::cos(3 * t);
      return gdim == 2 ? Vector<3>{s, z, 0} : Vector<3>{s, t, z};
    };
  };
  return {sheet(gdim, 3, Cells::mixed, false, 0, 1, at(0.1)),
          sheet(gdim, 4, Cells::mixed, true, 0.12, 1.2, at(0))};
}

void expect_near(const std::vector<double>& a, const std::vector<double>& b,
                 double factor, double tolerance)
{
  ASSERT_EQ(a.size(), b.size());
  for (std::size_t i = 0; i < a.size(); ++i)
    EXPECT_NEAR(a[i], factor * b[i], factor * tolerance);
}

class MortarInvariance : public ::testing::TestWithParam<int>
{
};

TEST_P(MortarInvariance, RigidMotionsChangeNothing)
{
  const int gdim = GetParam();
  Generator random(1);
  const Facing scene = wavy(gdim);
  const auto pairs = scene.find();
  const auto found = scene.integrals(pairs);
  for (int i = 0; i < 10; ++i)
  {
    Facing moved = scene;
    const Motion<3> motion(random, 5);
    const Motion<2> in_plane(random, 5);
    const auto rotate = [&](const Vector<3>& v)
    {
      if (gdim == 3)
        return motion.rotate(v);
      const auto w = in_plane.rotate({v[0], v[1]});
      return Vector<3>{w[0], w[1], 0};
    };
    const Vector<3> shift = motion.shift;
    moved.move([&](const Vector<3>& p) { return shift + rotate(p); });
    EXPECT_EQ(moved.find(), pairs);
    const auto other = moved.integrals(pairs);
    expect_near(other.area, found.area, 1, 1e-13);
    expect_near(other.weight, found.weight, 1, 1e-10);
    expect_near(other.dual, found.dual, 1, 1e-8);
    expect_near(other.gap, found.gap, 1, 1e-11);
    for (std::size_t f = 0; f < found.normal.size(); f += 3)
    {
      const Vector<3> n{found.normal[f], found.normal[f + 1],
                        found.normal[f + 2]};
      const Vector<3> m{other.normal[f], other.normal[f + 1],
                        other.normal[f + 2]};
      EXPECT_LT(norm(m - rotate(n)), 1e-13);
    }
  }
}

TEST_P(MortarInvariance, LengthsScaleEverything)
{
  const int gdim = GetParam();
  const Facing scene = wavy(gdim);
  const auto pairs = scene.find(0.5, 0.1);
  const auto found = scene.integrals(pairs);
  for (const double length : {1e-6, 1e-3, 1e3, 1e6})
  {
    Facing scaled = scene;
    scaled.move([length](const Vector<3>& p) { return length * p; });
    EXPECT_EQ(scaled.find(0.5 * length, 0.1), pairs);
    const auto other = scaled.integrals(pairs);
    const double area = std::pow(length, gdim - 1);
    expect_near(other.area, found.area, area, 1e-13);
    expect_near(other.weight, found.weight, area, 1e-10);
    expect_near(other.gap, found.gap, area * length, 1e-11);
    expect_near(other.dual, found.dual, 1, 1e-8);
    expect_near(other.normal, found.normal, 1, 1e-14);
  }
}

TEST_P(MortarInvariance, FacetsFarFromTheOriginKeepTheirDigits)
{
  const int gdim = GetParam();
  const Facing scene = wavy(gdim);
  Facing far = scene;
  far.move([](const Vector<3>& p) { return p + Vector<3>{1e4, -1e4, 1e4}; });
  const auto pairs = scene.find();
  EXPECT_EQ(far.find(), pairs);
  const auto found = scene.integrals(pairs), other = far.integrals(pairs);
  expect_near(other.area, found.area, 1, 1e-11);
  expect_near(other.weight, found.weight, 1, 1e-8);
}

TEST_P(MortarInvariance, AFacetCoveredBelowTheLeastPartHasZeros)
{
  const int gdim = GetParam();
  for (const double part : {0.9, 1.1})
    for (const Cells cells : {Cells::triangles, Cells::quadrilaterals})
    {
      // The master ends so that it covers a strip along an edge. One of two
      // triangles has that edge, the other one just a tip there
      const bool triangles = gdim == 3 and cells == Cells::triangles;
      const double width
          = part * geometry::covered_fraction_min * (triangles ? 0.5 : 1);
      const Facing scene(sheet(gdim, 1, cells, false, 0, 1, level(gdim, 0.1)),
                         sheet(gdim, 1, cells, true, -1, 1,
                               [gdim, width](double s, double t)
                               {
                                 const double x = s > 0 ? width : s;
                                 return gdim == 2 ? Vector<3>{x, 0, 0}
                                                  : Vector<3>{x, 2 * t, 0};
                               }));
      const auto pairs = scene.find();
      ASSERT_GT(pairs.size(), 0u);
      const auto found = scene.integrals(pairs);
      const double tip = triangles ? 0.5 * width * width : 0;
      const double expected = part > 1 ? width - tip : 0;
      double area = 0, weights = 0;
      for (const double a : found.area)
        area += a;
      for (const double w : found.weight)
        weights += w;
      EXPECT_NEAR(area, expected, 1e-14);
      EXPECT_NEAR(weights, expected, 1e-13);
      for (const auto& values : {found.weight, found.gap, found.dual})
        EXPECT_EQ(std::ranges::count(values, 0.0) < std::ssize(values),
                  part > 1);
    }
}

INSTANTIATE_TEST_SUITE_P(Dimensions, MortarInvariance, ::testing::Values(2, 3));
} // namespace
