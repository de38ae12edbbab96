// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#include "closest_reference.h"
#include <contactx/geometry/closest_point.h>

using namespace contactx;
using namespace contactx::geometry;
using namespace contactx::tests;

namespace
{
template <class F>
class Degenerate : public ::testing::Test
{
};
TYPED_TEST_SUITE(Degenerate, FacetTypes);

TYPED_TEST(Degenerate, FacetThatIsAPoint)
{
  using F = TypeParam;
  Generator random(1);
  Nodes<F> x;
  x.fill(random.vector<F::gdim>(-1, 1));
  const auto p = random.vector<F::gdim>(-1, 1);
  const auto c = closest_point<F>(x, p);
  EXPECT_NEAR(std::sqrt(c.distance2), norm(p - x[0]), 1e-15);
  EXPECT_LE(F::excess(c.xi), 0);
}

TYPED_TEST(Degenerate, FacetThatIsALine)
{
  using F = TypeParam;
  Generator random(2);
  for (int i = 0; i < 200; ++i)
  {
    const auto a = random.vector<F::gdim>(-1, 1);
    const auto b = random.vector<F::gdim>(-1, 1);
    Nodes<F> x;
    for (auto& node : x)
      node = a + random(0, 0.9) * (b - a);
    x.front() = a;
    x.back() = b;
    const auto p = random.vector<F::gdim>(-2, 2);
    const auto e = b - a;
    const double s = std::clamp(dot(p - a, e) / dot(e, e), 0.0, 1.0);
    const auto c = closest_point<F>(x, p);
    EXPECT_NEAR(std::sqrt(c.distance2), norm(p - a - s * e), 1e-13);
    EXPECT_LE(F::excess(c.xi), 1e-12);
  }
}

TEST(DegenerateQuadrilateral, WithAnEdgeWithoutLengthIsATriangle)
{
  Generator random(3);
  for (int i = 0; i < 500; ++i)
  {
    const auto t = random_facet<Triangle>(random);
    const Nodes<Quadrilateral> x{t[0], t[1], t[2], t[2]};
    const auto p = t[0] + random.vector<3>(-2, 2);
    const auto c = closest_point<Quadrilateral>(x, p);
    EXPECT_NEAR(std::sqrt(c.distance2), long_distance(t, p), 1e-13);
    EXPECT_LE(Quadrilateral::excess(c.xi), 1e-12);
  }
}

/// Random slivers of an aspect ratio, long in any of the three directions.
void compare_slivers(double aspect, unsigned seed)
{
  Generator random(seed);
  // The interior reaches 1e-12 beyond the edges; the tangents are as close to
  // parallel as the aspect says
  const double tolerance = 3e-12 + 1e-15 * aspect;
  for (int i = 0; i < 3000; ++i)
  {
    Nodes<Triangle> x{
        {{0, 0, 0}, {1, 0, 0}, {random(-0.5, 1.5), 1 / aspect, 0}}};
    std::rotate(x.begin(), x.begin() + i % 3, x.end());
    const Motion<3> motion(random, 1);
    const auto xm = motion(x);
    const double height = std::pow(10, random(-9, 1));
    const auto p = motion(position<Triangle>(x, random.vector<2>(-0.5, 1))
                          + Vector<3>{0, 0, height});
    const auto c = closest_point<Triangle>(xm, p);
    const double distance = long_distance(xm, p);
    EXPECT_NEAR(std::sqrt(c.distance2), distance, tolerance);
    EXPECT_NEAR(norm(p - position<Triangle>(xm, c.xi)), distance, tolerance);
  }
}

TEST(Sliver, OfAspect1e2) { compare_slivers(1e2, 4); }

TEST(Sliver, OfAspect1e4) { compare_slivers(1e4, 5); }

TEST(Sliver, OfAspect1e6) { compare_slivers(1e6, 6); }

TEST(Sliver, QuadrilateralIsTwoTriangles)
{
  Generator random(7);
  for (double aspect : {1e2, 1e4, 1e6})
    for (int i = 0; i < 1000; ++i)
    {
      const double w = 1 / aspect, shear = random(-0.3, 0.3);
      const Nodes<Quadrilateral> flat{
          {{0, 0, 0}, {1, 0, 0}, {shear, w, 0}, {1 + shear, w, 0}}};
      const Motion<3> motion(random, 1);
      const auto x = motion(flat);
      const double height = std::pow(10, random(-9, 1));
      const auto p
          = motion(position<Quadrilateral>(flat, random.vector<2>(-0.5, 1.5))
                   + Vector<3>{0, 0, height});
      const double distance = std::min(long_distance({x[0], x[1], x[2]}, p),
                                       long_distance({x[1], x[3], x[2]}, p));
      const auto c = closest_point<Quadrilateral>(x, p);
      EXPECT_NEAR(std::sqrt(c.distance2), distance, 3e-12);
    }
}

TYPED_TEST(Degenerate, PointThatIsNotANumberHasNoDistance)
{
  using F = TypeParam;
  Generator random(8);
  for (int k = 0; k < F::gdim; ++k)
  {
    Vector<F::gdim> p{};
    p[k] = std::nan("");
    const auto c = closest_point<F>(random_facet<F>(random), p);
    EXPECT_TRUE(std::isinf(c.distance2));
  }
}
} // namespace
