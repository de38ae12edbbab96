// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#include "facing.h"
#include <contactx/geometry/projection_plane.h>

using namespace contactx;
using namespace contactx::geometry;
using namespace contactx::geometry;
using namespace contactx::tests;

namespace
{
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

template <class F>
class PlaneOf : public ::testing::Test
{
};
TYPED_TEST_SUITE(PlaneOf, FacetTypes);

TYPED_TEST(PlaneOf, GivesBackCoordinatesAndHeight)
{
  using F = TypeParam;
  Generator random(1);
  for (int i = 0; i < 200; ++i)
  {
    const auto x = random_facet<F>(random);
    const auto r = random.vector<F::tdim>(-2, 2);
    const double height = random(-2, 2);
    for (const ProjectionPlane<F>& plane :
         {ProjectionPlane<F>(x), ProjectionPlane<F>(x, oblique<F>(x, random))})
    {
      const auto p = point_of(plane, r, height);
      EXPECT_LT(norm(plane.project(p) - r), 1e-13);
      EXPECT_NEAR(plane.height(p), height, 1e-13);
    }
  }
}

TYPED_TEST(PlaneOf, HasTheNodesOfAnAffineFacetAtTheirLocalCoordinates)
{
  using F = TypeParam;
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

TYPED_TEST(PlaneOf, TouchesTheFacetAtItsOrigin)
{
  using F = TypeParam;
  Generator random(3);
  for (int i = 0; i < 100; ++i)
  {
    const auto x = random_facet<F>(random);
    const ProjectionPlane<F> plane(x);
    const auto frame = geometry::frame<F>(x, plane_origin<F>());
    EXPECT_LT(norm(plane.origin - position<F>(x, plane_origin<F>())), 1e-15);
    EXPECT_EQ(plane.n, frame.n);
    EXPECT_EQ(plane.t, frame.t);
    // A warped quadrilateral is as far above its centre's plane as below it
    double sum = 0;
    for (const auto& p : x)
      sum += plane.height(p);
    EXPECT_NEAR(sum, 0, 1e-14);
  }
}

TYPED_TEST(PlaneOf, ProjectsAlongItsDirection)
{
  using F = TypeParam;
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
  }
}

TYPED_TEST(PlaneOf, IsThatOfTheNormalItself)
{
  using F = TypeParam;
  Generator random(5);
  for (int i = 0; i < 50; ++i)
  {
    const auto x = random_facet<F>(random);
    const ProjectionPlane<F> plane(x), same(x, plane.n);
    const auto p = random.vector<F::gdim>(-2, 2);
    EXPECT_LT(norm(same.project(p) - plane.project(p)), 1e-13);
    EXPECT_NEAR(same.height(p), plane.height(p), 1e-14);
  }
}

TYPED_TEST(PlaneOf, MovesWithItsFacet)
{
  using F = TypeParam;
  Generator random(6);
  for (int i = 0; i < 100; ++i)
  {
    const auto x = random_facet<F>(random);
    const auto direction = oblique<F>(x, random);
    const Motion<F::gdim> motion(random, 3);
    const auto p = random.vector<F::gdim>(-2, 2);
    const ProjectionPlane<F> plane(x, direction);
    const ProjectionPlane<F> moved(motion(x), motion.rotate(direction));
    EXPECT_LT(norm(moved.project(motion(p)) - plane.project(p)), 1e-12);
    EXPECT_NEAR(moved.height(motion(p)), plane.height(p), 1e-12);
  }
}

TYPED_TEST(PlaneOf, LooksTheOtherWayFromBehind)
{
  using F = TypeParam;
  Generator random(7);
  const auto x = random_facet<F>(random);
  const ProjectionPlane<F> plane(x), behind(turned<F>(x));
  EXPECT_LT(norm(plane.n + behind.n), 1e-14);
  const auto p = random.vector<F::gdim>(-2, 2);
  EXPECT_NEAR(behind.height(p), -plane.height(p), 1e-13);
}
} // namespace
