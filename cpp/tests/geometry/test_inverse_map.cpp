// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#include "expect.h"
#include "facing.h"
#include <contactx/geometry/inverse_map.h>
#include <contactx/geometry/projection_plane.h>

using namespace contactx;
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

template <class>
using InverseMapOf = testing::Test;
TYPED_TEST_SUITE(InverseMapOf, FacetTypes);

TYPED_TEST_OF(InverseMapOf, GivesBackLocalCoordinatesOfAllSizes, F)
{
  Generator random(1);
  for (const double size : {1., 1e-6, 1e-3, 1e6})
    for (int i = 0; i < 500; ++i)
    {
      auto r = random_flat<F>(random);
      for (auto& p : r)
        p = size * p;
      const InverseMap<F> map(r);
      const auto xi = inner_point<F>(random);
      const auto s = map.at(combined<F>(F::shape(xi), r));
      const double tolerance = size == 1 ? 1e-13 : 1e-12;
      EXPECT_LT(norm(s.xi - xi), tolerance) << size;
      EXPECT_LT(norm(s.N - F::shape(xi)), tolerance) << size;
      for (int l = 0; l < F::nodes; ++l)
        EXPECT_LT(norm(map.at(r[l]).xi - F::vertices[l]), tolerance) << size;
    }
}

TYPED_TEST_OF(InverseMapOf, InterpolatesThePlaneWithItsSlopesAndJacobian, F)
{
  Generator random(3);
  const double h = 1e-5;
  for (int i = 0; i < 200; ++i)
  {
    const auto r = random_flat<F>(random);
    const InverseMap<F> map(r);
    const auto xi = inner_point<F>(random);
    const auto p = combined<F>(F::shape(xi), r);
    const auto s = map.at(p);
    EXPECT_LT(norm(combined<F>(s.N, r) - p), 1e-13);
    for (int k = 0; k < F::tdim; ++k)
    {
      Local<F> e{};
      e[k] = 1;
      EXPECT_LT(norm(combined<F>(s.slope[k], r) - e), 1e-12);
      const auto difference
          = (1 / (2 * h)) * (map.at(p + h * e).N - map.at(p - h * e).N);
      EXPECT_LT(norm(difference - s.slope[k]), 1e-7);
    }
    const auto dN = F::derivative(xi);
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

TEST(Distortion, IsNoneOfParallelogramsAndNotChangedByAffineMaps)
{
  Generator random(7);
  for (int i = 0; i < 100; ++i)
  {
    const auto o = random.vector<2>(-1, 1);
    const auto a = random.vector<2>(-1, 1), b = random.vector<2>(-1, 1);
    if (std::abs(a[0] * b[1] - a[1] * b[0]) < 0.1)
      continue;
    EXPECT_LT(
        InverseMap<Quadrilateral>({o, o + a, o + b, o + a + b}).distortion(),
        1e-14);
    const auto r = random_flat<Quadrilateral>(random);
    Flat<Quadrilateral> q;
    for (int l = 0; l < 4; ++l)
      q[l] = r[l][0] * a + r[l][1] * b;
    EXPECT_NEAR(InverseMap<Quadrilateral>(q).distortion(),
                InverseMap<Quadrilateral>(r).distortion(), 1e-12);
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

/// A unit vector on the outer side of a facet, up to 70 degrees off its normal.
template <class F>
Vector<F::gdim> oblique(const Nodes<F>& x, Generator& random)
{
  const auto n = frame<F>(x, plane_origin<F>()).n;
  auto v = random.unit<F::gdim>();
  while (dot(v, n) < 0.35)
    v = random.unit<F::gdim>();
  return v;
}

/// Point of a plane's coordinates and height.
template <class F>
Vector<F::gdim> point_of(const ProjectionPlane<F>& plane, const Local<F>& r,
                         double height)
{
  auto p = plane.origin + height * plane.n;
  for (int a = 0; a < F::tdim; ++a)
    p = p + r[a] * plane.t[a];
  return p;
}

template <class>
using PlaneOf = testing::Test;
TYPED_TEST_SUITE(PlaneOf, FacetTypes);

TYPED_TEST_OF(PlaneOf, GivesBackCoordinatesAndHeightAndTouchesTheFacet, F)
{
  Generator random(1);
  for (int i = 0; i < 200; ++i)
  {
    const auto x = random_facet<F>(random);
    const auto r = random.vector<F::tdim>(-2, 2);
    const double height = random(-2, 2);
    const ProjectionPlane<F> upright(x);
    for (const auto& plane :
         {upright, ProjectionPlane<F>(x, oblique<F>(x, random))})
    {
      const auto p = point_of(plane, r, height);
      EXPECT_LT(norm(plane.project(p) - r), 1e-13);
      EXPECT_NEAR(plane.height(p), height, 1e-13);
    }
    const auto frame = geometry::frame<F>(x, plane_origin<F>());
    EXPECT_LT(norm(upright.origin - position<F>(x, plane_origin<F>())), 1e-15);
    EXPECT_EQ(upright.n, frame.n);
    EXPECT_EQ(upright.t, frame.t);
    // A warped quadrilateral is as far above its centre's plane as below it
    double sum = 0;
    for (const auto& p : x)
      sum += upright.height(p);
    EXPECT_NEAR(sum, 0, 1e-14);
  }
}

TYPED_TEST_OF(PlaneOf, HasTheNodesOfAnAffineFacetAtTheirLocalCoordinates, F)
{
  Generator random(2);
  for (int i = 0; i < 100; ++i)
  {
    auto x = random_facet<F>(random);
    if constexpr (F::nodes == 4)
      x[3] = x[1] + x[2] - x[0];
    const ProjectionPlane<F> plane(x, oblique<F>(x, random));
    const auto r = project<F>(plane, x);
    for (int l = 0; l < F::nodes; ++l)
    {
      EXPECT_LT(norm(r[l] - (F::vertices[l] - plane_origin<F>())), 1e-13);
      EXPECT_NEAR(plane.height(x[l]), 0, 1e-14);
    }
  }
}

TYPED_TEST_OF(PlaneOf, ProjectsAlongItsDirectionAndMovesWithItsFacet, F)
{
  Generator random(4);
  for (int i = 0; i < 200; ++i)
  {
    const auto x = random_facet<F>(random);
    const auto direction = oblique<F>(x, random);
    const ProjectionPlane<F> plane(x, direction), upright(x);
    EXPECT_EQ(plane.n, direction);
    const auto p = random.vector<F::gdim>(-2, 2);
    const double step = random(-1, 1);
    const auto q = p + step * direction;
    EXPECT_LT(norm(plane.project(q) - plane.project(p)), 1e-13);
    EXPECT_NEAR(plane.height(q) - plane.height(p), step, 1e-13);
    // It is the same plane: where the ray meets it, both agree
    const auto foot = p - plane.height(p) * direction;
    EXPECT_NEAR(upright.height(foot), 0, 1e-13);
    EXPECT_LT(norm(upright.project(foot) - plane.project(p)), 1e-12);

    const Motion<F::gdim> motion(random, 3);
    const ProjectionPlane<F> moved(motion(x), motion.rotate(direction));
    EXPECT_LT(norm(moved.project(motion(p)) - plane.project(p)), 1e-12);
    EXPECT_NEAR(moved.height(motion(p)), plane.height(p), 1e-12);
    // Along the normal itself, and from behind
    const ProjectionPlane<F> same(x, upright.n), behind(turned<F>(x));
    EXPECT_LT(norm(same.project(p) - upright.project(p)), 1e-13);
    EXPECT_NEAR(same.height(p), upright.height(p), 1e-14);
    EXPECT_LT(norm(upright.n + behind.n), 1e-14);
    EXPECT_NEAR(behind.height(p), -upright.height(p), 1e-13);
  }
}

} // namespace
