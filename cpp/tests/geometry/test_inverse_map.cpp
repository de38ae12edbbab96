// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#include "facing.h"
#include <contactx/geometry/inverse_map.h>

using namespace contactx;
using namespace contactx::geometry;
using namespace contactx::geometry;
using namespace contactx::tests;

namespace
{
/// A random convex facet in a plane, of either orientation.
template <class F>
Flat<F> random_flat(Generator& random)
{
  const auto x = flat_facet<F>(random);
  const bool over = random(0, 1) < 0.5;
  const auto y = over ? turned<F>(x) : x;
  const Motion<2> motion(random, 1);
  Flat<F> r;
  for (int l = 0; l < F::nodes; ++l)
    if constexpr (F::tdim == 1)
      r[l] = {y[l][0] + motion.shift[0]};
    else
      r[l] = motion(Vector<2>{y[l][0], y[l][1]});
  return r;
}

template <class F>
Local<F> combined(const Vector<F::nodes>& w, const Flat<F>& r)
{
  Local<F> p{};
  for (int l = 0; l < F::nodes; ++l)
    p = p + w[l] * r[l];
  return p;
}

/// A quadrilateral with corner (1, 1) moved to (1 + c, 1 + d).
Flat<Quadrilateral> kite(double c, double d)
{
  return {{{0, 0}, {1, 0}, {0, 1}, {1 + c, 1 + d}}};
}

template <class F>
class InverseMapOf : public ::testing::Test
{
};
TYPED_TEST_SUITE(InverseMapOf, FacetTypes);

TYPED_TEST(InverseMapOf, GivesBackLocalCoordinates)
{
  using F = TypeParam;
  Generator random(1);
  for (int i = 0; i < 500; ++i)
  {
    const auto r = random_flat<F>(random);
    const auto xi = inner_point<F>(random);
    const auto s = InverseMap<F>(r).at(combined<F>(F::shape(xi), r));
    EXPECT_LT(norm(s.xi - xi), 1e-13);
    EXPECT_LT(norm(s.N - F::shape(xi)), 1e-13);
  }
}

TYPED_TEST(InverseMapOf, KnowsItsNodes)
{
  using F = TypeParam;
  Generator random(2);
  for (int i = 0; i < 100; ++i)
  {
    const auto r = random_flat<F>(random);
    const InverseMap<F> map(r);
    for (int l = 0; l < F::nodes; ++l)
      EXPECT_LT(norm(map.at(r[l]).xi - F::vertices[l]), 1e-13);
  }
}

TYPED_TEST(InverseMapOf, InterpolatesThePlane)
{
  using F = TypeParam;
  Generator random(3);
  for (int i = 0; i < 200; ++i)
  {
    const auto r = random_flat<F>(random);
    const auto p = combined<F>(F::shape(inner_point<F>(random)), r);
    const auto s = InverseMap<F>(r).at(p);
    EXPECT_LT(norm(combined<F>(s.N, r) - p), 1e-13);
    for (int k = 0; k < F::tdim; ++k)
    {
      Local<F> e{};
      e[k] = 1;
      EXPECT_LT(norm(combined<F>(s.slope[k], r) - e), 1e-12);
    }
  }
}

TYPED_TEST(InverseMapOf, SlopesAreDifferenceQuotients)
{
  using F = TypeParam;
  Generator random(4);
  const double h = 1e-5;
  for (int i = 0; i < 200; ++i)
  {
    const auto r = random_flat<F>(random);
    const InverseMap<F> map(r);
    const auto p = combined<F>(F::shape(inner_point<F>(random)), r);
    const auto s = map.at(p);
    for (int k = 0; k < F::tdim; ++k)
    {
      Local<F> e{};
      e[k] = h;
      const auto difference
          = (1 / (2 * h)) * (map.at(p + e).N - map.at(p - e).N);
      EXPECT_LT(norm(difference - s.slope[k]), 1e-7);
    }
  }
}

TYPED_TEST(InverseMapOf, JacobianIsThatOfTheMap)
{
  using F = TypeParam;
  Generator random(5);
  for (int i = 0; i < 200; ++i)
  {
    const auto r = random_flat<F>(random);
    const auto xi = inner_point<F>(random);
    const auto dN = F::derivative(xi);
    const auto s = InverseMap<F>(r).at(combined<F>(F::shape(xi), r));
    const auto t = combined<F>(dN[0], r);
    double det = t[0];
    if constexpr (F::tdim == 2)
    {
      const auto u = combined<F>(dN[1], r);
      det = t[0] * u[1] - t[1] * u[0];
    }
    EXPECT_NEAR(s.jacobian, std::abs(det), 1e-12);
  }
}

TYPED_TEST(InverseMapOf, IsTheSameForAllSizes)
{
  using F = TypeParam;
  Generator random(6);
  for (const double size : {1e-6, 1e-3, 1e6})
    for (int i = 0; i < 50; ++i)
    {
      auto r = random_flat<F>(random);
      for (auto& p : r)
        p = size * p;
      const auto xi = inner_point<F>(random);
      const auto s = InverseMap<F>(r).at(combined<F>(F::shape(xi), r));
      EXPECT_LT(norm(s.xi - xi), 1e-12);
    }
}

TEST(Distortion, IsNoneOfParallelograms)
{
  Generator random(7);
  for (int i = 0; i < 100; ++i)
  {
    const auto o = random.vector<2>(-1, 1);
    const auto a = random.vector<2>(-1, 1), b = random.vector<2>(-1, 1);
    if (std::abs(a[0] * b[1] - a[1] * b[0]) < 0.1)
      continue;
    const Flat<Quadrilateral> r{o, o + a, o + b, o + a + b};
    EXPECT_LT(InverseMap<Quadrilateral>(r).distortion(), 1e-14);
  }
  EXPECT_EQ(InverseMap<Triangle>({{{0, 0}, {3, 1}, {1, 2}}}).distortion(), 0);
  EXPECT_EQ(InverseMap<Segment>({{{2}, {1}}}).distortion(), 0);
}

TEST(Distortion, IsTheTwistInUnitsOfTheTangents)
{
  // A trapezium, its upper edge shorter by the part 2 c / (1 + c)
  for (const double c : {0.1, 0.5, 0.9})
  {
    const Flat<Quadrilateral> r{
        {{-1 - c, -1}, {1 + c, -1}, {-1 + c, 1}, {1 - c, 1}}};
    EXPECT_NEAR(InverseMap<Quadrilateral>(r).distortion(), 2 * c, 1e-14);
  }
}

TEST(Distortion, IsNotChangedByAffineMaps)
{
  Generator random(8);
  for (int i = 0; i < 100; ++i)
  {
    const auto r = random_flat<Quadrilateral>(random);
    const auto a = random.vector<2>(-1, 1), b = random.vector<2>(-1, 1);
    if (std::abs(a[0] * b[1] - a[1] * b[0]) < 0.1)
      continue;
    Flat<Quadrilateral> q;
    for (int l = 0; l < 4; ++l)
      q[l] = r[l][0] * a + r[l][1] * b;
    EXPECT_NEAR(InverseMap<Quadrilateral>(q).distortion(),
                InverseMap<Quadrilateral>(r).distortion(), 1e-12);
  }
}

TEST(DistortedQuadrilateral, IsInvertedEverywhere)
{
  // From kites that all but fold to long ones
  for (const double c : {-0.499, -0.4, 1., 10., 100.})
    for (const double d : {-0.499, 0., 10.})
    {
      const auto r = kite(c, d);
      const InverseMap<Quadrilateral> map(r);
      for (int i = 0; i <= 20; ++i)
        for (int j = 0; j <= 20; ++j)
        {
          const Vector<2> xi{i / 20., j / 20.};
          const auto p = combined<Quadrilateral>(Quadrilateral::shape(xi), r);
          const auto s = map.at(p);
          EXPECT_LT(norm(s.xi - xi), 1e-11) << c << " " << d;
        }
    }
}

TEST(DistortedQuadrilateral, ThatIsATriangleIsInvertedOffItsTip)
{
  // Two nodes in one: all points of that edge are one point
  const Flat<Quadrilateral> r{{{0, 0}, {1, 0}, {0, 1}, {0, 1}}};
  const InverseMap<Quadrilateral> map(r);
  for (int i = 0; i <= 20; ++i)
    for (int j = 0; j < 20; ++j)
    {
      const Vector<2> xi{i / 20., j / 20.};
      const auto p = combined<Quadrilateral>(Quadrilateral::shape(xi), r);
      EXPECT_LT(norm(map.at(p).xi - xi), 1e-12);
    }
}
} // namespace
