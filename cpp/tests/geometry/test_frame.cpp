// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#include "facets.h"

using namespace contactx;
using namespace contactx::geometry;
using namespace contactx::tests;

namespace
{
template <class F>
class FrameOf : public ::testing::Test
{
};
TYPED_TEST_SUITE(FrameOf, FacetTypes);

TYPED_TEST(FrameOf, NormalIsAUnitVectorAcrossTheTangents)
{
  using F = TypeParam;
  Generator random(1);
  for (int i = 0; i < 200; ++i)
  {
    const auto x = random_facet<F>(random);
    const auto f = frame<F>(x, random.vector<F::tdim>(-0.1, 1.1));
    EXPECT_NEAR(norm(f.n), 1, 1e-14);
    for (const auto& t : f.t)
      EXPECT_NEAR(dot(t, f.n), 0, 1e-14);
  }
}

TYPED_TEST(FrameOf, TangentsAreDifferenceQuotients)
{
  using F = TypeParam;
  Generator random(2);
  const double h = 0.25; // linear along each axis: any step is exact
  for (int i = 0; i < 200; ++i)
  {
    const auto x = random_facet<F>(random);
    const Local<F> xi = random.vector<F::tdim>(-0.1, 1.1);
    const auto t = tangents<F>(x, xi);
    for (int a = 0; a < F::tdim; ++a)
    {
      Local<F> e{};
      e[a] = h;
      const auto difference
          = (1 / (2 * h)) * (position<F>(x, xi + e) - position<F>(x, xi - e));
      EXPECT_LT(norm(difference - t[a]), 1e-13);
    }
  }
}

TYPED_TEST(FrameOf, JacobianIsTheAreaThatTheMetricGives)
{
  using F = TypeParam;
  Generator random(3);
  for (int i = 0; i < 200; ++i)
  {
    const auto x = random_facet<F>(random);
    const auto f = frame<F>(x, inner_point<F>(random));
    const Vector<3> m = metric(f.t);
    const double area2 = F::tdim == 1 ? m[0] : m[0] * m[2] - m[1] * m[1];
    EXPECT_NEAR(f.jacobian, std::sqrt(area2), 1e-13);
  }
}

TYPED_TEST(FrameOf, NormalPointsOutOfTheBody)
{
  using F = TypeParam;
  Generator random(4);
  for (int i = 0; i < 100; ++i)
  {
    const auto x = flat_facet<F>(random);
    const Motion<F::gdim> motion(random, 3);
    const auto n = frame<F>(motion(x), inner_point<F>(random)).n;
    EXPECT_LT(norm(n - motion.rotate(flat_normal<F>())), 1e-13);
  }
}

TYPED_TEST(FrameOf, FacetWithoutAreaHasNoJacobian)
{
  using F = TypeParam;
  Nodes<F> x;
  for (int l = 0; l < F::nodes; ++l)
    x[l].fill(F::tdim == 1 ? 1 : l);
  const auto f = frame<F>(x, F::vertices[0]);
  EXPECT_EQ(f.jacobian, 0);
  EXPECT_FALSE(std::isfinite(norm(f.n)));
}

TYPED_TEST(FrameOf, DiameterIsTheLargestDistance)
{
  using F = TypeParam;
  Generator random(5);
  for (int i = 0; i < 100; ++i)
  {
    const auto x = random_facet<F>(random);
    double largest = 0;
    for (const auto& a : x)
      for (const auto& b : x)
        largest = std::max(largest, norm(a - b));
    EXPECT_DOUBLE_EQ(diameter<F>(x), largest);
  }
}

TEST(Diameter, OfKnownFacets)
{
  EXPECT_DOUBLE_EQ(diameter<Segment>({{{1, 1}, {4, 5}}}), 5);
  EXPECT_DOUBLE_EQ(diameter<Triangle>({{{0, 0, 1}, {3, 0, 1}, {0, 4, 1}}}), 5);
  EXPECT_DOUBLE_EQ(
      diameter<Quadrilateral>({{{0, 0, 0}, {3, 0, 0}, {0, 4, 0}, {3, 4, 12}}}),
      13);
}

TEST(Solve, GivesTheSolution)
{
  Generator random(6);
  for (int i = 0; i < 100; ++i)
  {
    const Vector<3> H{random(1, 2), random(-0.9, 0.9), random(1, 2)};
    const Vector<2> r = random.vector<2>(-1, 1);
    const Vector<2> y = solve(H, r);
    EXPECT_NEAR(H[0] * y[0] + H[1] * y[1], r[0], 1e-13);
    EXPECT_NEAR(H[1] * y[0] + H[2] * y[1], r[1], 1e-13);
    EXPECT_DOUBLE_EQ(H[0] * solve(H, Vector<1>{r[0]})[0], r[0]);
  }
}
} // namespace
