// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#include "facets.h"
#include <contactx/geometry/closest_point.h>

using namespace contactx;
using namespace contactx::geometry;
using namespace contactx::tests;

namespace
{
template <class F>
class Project : public ::testing::Test
{
};
TYPED_TEST_SUITE(Project, FacetTypes);

/// Largest cosine between the tangents and the way to the point, measured
/// with the way from the facet's first node.
template <class F>
double obliqueness(const Nodes<F>& x, const Vector<F::gdim>& p,
                   const Local<F>& xi)
{
  const auto d = p - position<F>(x, xi);
  double largest = 0;
  for (const auto& t : tangents<F>(x, xi))
    largest = std::max(largest,
                       std::abs(dot(d, t)) / (norm(t) * (1 + norm(p - x[0]))));
  return largest;
}

TYPED_TEST(Project, IsOrthogonalBeyondTheEdges)
{
  using F = TypeParam;
  Generator random(1);
  for (double height : {0.0, 1e-12, 1e-4, 0.5, -0.5})
    for (int i = 0; i < 500; ++i)
    {
      const auto x = random_facet<F>(random, 0.1);
      const Local<F> foot = random.vector<F::tdim>(-0.5, 1.5);
      const auto f = frame<F>(x, foot);
      const auto p = position<F>(x, foot) + height * f.n;
      Local<F> xi = projection_start<F>(x, p);
      ASSERT_TRUE(project<F>(x, p, xi));
      EXPECT_LT(obliqueness<F>(x, p, xi), 1e-13);
    }
}

TYPED_TEST(Project, IsOrthogonalFarAway)
{
  using F = TypeParam;
  Generator random(2);
  for (double height : {1e3, 1e6})
    for (int i = 0; i < 200; ++i)
    {
      const auto x = Motion<F::gdim>(random, 3)(flat_facet<F>(random));
      const Local<F> foot = random.vector<F::tdim>(-0.5, 1.5);
      const auto p = position<F>(x, foot) + height * frame<F>(x, foot).n;
      Local<F> xi = projection_start<F>(x, p);
      ASSERT_TRUE(project<F>(x, p, xi));
      EXPECT_LT(obliqueness<F>(x, p, xi), 1e-13);
    }
}

TYPED_TEST(Project, ForgetsItsStart)
{
  using F = TypeParam;
  Generator random(3);
  for (int i = 0; i < 500; ++i)
  {
    const auto x = random_facet<F>(random, 0.1);
    const Local<F> foot = random.vector<F::tdim>(-0.05, 1.05);
    const auto p
        = position<F>(x, foot) + random(-0.3, 0.3) * frame<F>(x, foot).n;
    Local<F> xi = foot + random.vector<F::tdim>(-0.2, 0.2);
    ASSERT_TRUE(project<F>(x, p, xi));
    EXPECT_LT(norm(xi - foot), 1e-12);
  }
}

TYPED_TEST(Project, KeepsItsDigitsFarFromTheOrigin)
{
  using F = TypeParam;
  Generator random(4);
  for (double distance : {1e3, 1e6, 1e9, 1e12})
    for (int i = 0; i < 200; ++i)
    {
      // Coordinates that the translation does not round
      auto x = flat_facet<F>(random);
      for (auto& node : x)
        for (double& c : node)
          c = std::round(64 * c) / 64;
      auto p = position<F>(x, inner_point<F>(random));
      for (double& c : p)
        c = std::round(64 * c) / 64;
      Local<F> near = projection_start<F>(x, p);
      ASSERT_TRUE(project<F>(x, p, near));
      Vector<F::gdim> shift;
      shift.fill(distance);
      for (auto& node : x)
        node = node + shift;
      Local<F> xi = projection_start<F>(x, p + shift);
      ASSERT_TRUE(project<F>(x, p + shift, xi));
      EXPECT_LT(norm(xi - near), 1e-13);
    }
}

TYPED_TEST(Project, TellsThatThereIsNone)
{
  using F = TypeParam;
  Nodes<F> x; // no area
  for (auto& node : x)
    node.fill(1);
  Local<F> xi{};
  EXPECT_FALSE(project<F>(x, {}, xi));
  Generator random(5);
  Vector<F::gdim> p{};
  p[0] = std::nan("");
  xi = {};
  EXPECT_FALSE(project<F>(flat_facet<F>(random), p, xi));
}
} // namespace
