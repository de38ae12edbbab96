// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#include "expect.h"
#include "facets.h"
#include <contactx/geometry/ridge.h>

using namespace contactx;
using namespace contactx::geometry;
using namespace contactx::tests;

namespace
{
template <class>
using Shape = testing::Test;
TYPED_TEST_SUITE(Shape, FacetTypes);

TYPED_TEST_OF(Shape, IsAPartitionOfUnityWithItsDifferenceQuotientAsDerivative,
              F)
{
  Generator random(1);
  const double h = 0.25; // linear along each axis: any step is exact
  for (int i = 0; i < 100; ++i)
  {
    const Local<F> xi = random.vector<F::tdim>(-1, 2);
    const auto N = F::shape(xi);
    EXPECT_NEAR(std::accumulate(N.begin(), N.end(), 0.0), 1, 1e-14);
    const auto dN = F::derivative(xi);
    for (int a = 0; a < F::tdim; ++a)
    {
      EXPECT_NEAR(std::accumulate(dN[a].begin(), dN[a].end(), 0.0), 0, 1e-14);
      Local<F> e{};
      e[a] = h;
      const auto difference
          = (1 / (2 * h)) * (F::shape(xi + e) - F::shape(xi - e));
      EXPECT_LT(norm(difference - dN[a]), 1e-14);
    }
  }
}

TYPED_TEST_OF(Shape, IsOneAtItsOwnVertex, F)
{
  for (int i = 0; i < F::nodes; ++i)
    for (int j = 0; j < F::nodes; ++j)
      EXPECT_EQ(F::shape(F::vertices[i])[j], i == j);
}

TEST(ShapeOfQuadrilateral, HasItsMixedDerivative)
{
  using F = Quadrilateral;
  const double h = 0.25;
  const Vector<2> xi{0.3, 0.6}, s{h, 0}, t{0, h};
  const auto difference = F::shape(xi + s + t) - F::shape(xi + s - t)
                          - F::shape(xi - s + t) + F::shape(xi - s - t);
  EXPECT_LT(norm((1 / (4 * h * h)) * difference - F::mixed_derivative), 1e-14);
}

TYPED_TEST_OF(Shape, ExcessIsNegativeInside, F)
{
  Generator random(3);
  for (int i = 0; i < 100; ++i)
  {
    // Convex combinations of the vertices are all of the inside
    Vector<F::nodes> w = random.vector<F::nodes>(0.01, 1);
    const double sum = std::accumulate(w.begin(), w.end(), 0.0);
    Local<F> xi{};
    for (int l = 0; l < F::nodes; ++l)
      xi = xi + (w[l] / sum) * F::vertices[l];
    EXPECT_LT(F::excess(xi), 0);
  }
}

TYPED_TEST_OF(Shape, ExcessIsZeroOnTheBoundaryAndGrowsOutside, F)
{
  // By the width of the facet
  Local<F> beside{}, centre{};
  beside[0] = -0.07;
  EXPECT_DOUBLE_EQ(F::excess(beside), 0.07);
  for (const auto& v : F::vertices)
    centre = centre + (1. / F::nodes) * v;
  std::vector<Local<F>> boundary(F::vertices.begin(), F::vertices.end());
  if (F::num_edges > 0)
    for (const auto& [i, j] : F::edges)
      boundary.push_back(0.5 * (F::vertices[i] + F::vertices[j]));
  for (const auto& xi : boundary)
  {
    EXPECT_DOUBLE_EQ(F::excess(xi), 0);
    EXPECT_GT(F::excess(xi + 0.1 * (xi - centre)), 0.01);
    EXPECT_GT(F::excess(xi + 0.2 * (xi - centre)),
              F::excess(xi + 0.1 * (xi - centre)));
  }
}

TYPED_TEST_OF(Shape, EdgesRunAroundTheNormalInOneLoop, F)
{
  double area = 0;
  for (std::size_t e = 0; e < F::edges.size(); ++e)
  {
    const auto [i, j] = F::edges[e];
    EXPECT_EQ(j, F::edges[(e + 1) % F::edges.size()].first);
    if constexpr (F::num_edges > 0)
      area += 0.5
              * (F::vertices[i][0] * F::vertices[j][1]
                 - F::vertices[i][1] * F::vertices[j][0]);
  }
  if (F::num_edges > 0)
    EXPECT_DOUBLE_EQ(area, F::nodes == 3 ? 0.5 : 1);
  else
    EXPECT_EQ(F::edges[0], std::pair(0, 1));
  const int nodes = visit(F::nodes, []<class G>(G) { return G::nodes; });
  EXPECT_EQ(nodes, F::nodes) << "the facet is found by its number of nodes";
}

template <class>
using FrameOf = testing::Test;
TYPED_TEST_SUITE(FrameOf, FacetTypes);

TYPED_TEST_OF(FrameOf, RandomFacetsIsThatOfTheirPositions, F)
{
  Generator random(1);
  const double h = 0.25; // linear along each axis: any step is exact
  for (int i = 0; i < 200; ++i)
  {
    const auto x = random_facet<F>(random);
    const Local<F> xi = random.vector<F::tdim>(-0.1, 1.1);
    const auto f = frame<F>(x, xi);
    EXPECT_NEAR(norm(f.n), 1, 1e-14);
    for (int a = 0; a < F::tdim; ++a)
    {
      EXPECT_NEAR(dot(f.t[a], f.n), 0, 1e-14);
      Local<F> e{};
      e[a] = h;
      const auto difference
          = (1 / (2 * h)) * (position<F>(x, xi + e) - position<F>(x, xi - e));
      EXPECT_LT(norm(difference - tangents<F>(x, xi)[a]), 1e-13);
    }
    // The area that the metric gives
    const auto inner = frame<F>(x, inner_point<F>(random));
    const Vector<3> m = metric(inner.t);
    const double area2 = F::tdim == 1 ? m[0] : m[0] * m[2] - m[1] * m[1];
    EXPECT_NEAR(inner.jacobian, std::sqrt(area2), 1e-13);
    double largest = 0;
    for (const auto& a : x)
      for (const auto& b : x)
        largest = std::max(largest, norm(a - b));
    EXPECT_DOUBLE_EQ(diameter<F>(x), largest);
  }
}

TYPED_TEST_OF(FrameOf, NormalPointsOutOfTheBody, F)
{
  Generator random(4);
  for (int i = 0; i < 100; ++i)
  {
    const auto x = flat_facet<F>(random);
    const Motion<F::gdim> motion(random, 3);
    const auto n = frame<F>(motion(x), inner_point<F>(random)).n;
    EXPECT_LT(norm(n - motion.rotate(flat_normal<F>())), 1e-13);
  }
}

TYPED_TEST_OF(FrameOf, FacetWithoutAreaHasNoJacobian, F)
{
  Nodes<F> x;
  for (int l = 0; l < F::nodes; ++l)
    x[l].fill(F::tdim == 1 ? 1 : l);
  const auto f = frame<F>(x, F::vertices[0]);
  EXPECT_EQ(f.jacobian, 0);
  EXPECT_FALSE(std::isfinite(norm(f.n)));
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

template <class>
using Ridge = testing::Test;
TYPED_TEST_SUITE(Ridge, FacetTypes);

template <class F>
constexpr int all_features = 1 + F::num_edges + F::nodes;

template <class F>
Local<F> on_feature(int feature, double s)
{
  if (feature > F::num_edges)
    return F::vertices[feature - 1 - F::num_edges];
  const auto [i, j] = F::edges[feature - 1];
  return (1 - s) * F::vertices[i] + s * F::vertices[j];
}

TYPED_TEST_OF(Ridge,
              AxesAreOrthonormalFromTheEdgeToTheNormalAndTurnWithTheFacet, F)
{
  Generator random(1);
  for (int i = 0; i < 50; ++i)
    for (int feature = 1; feature < all_features<F>; ++feature)
    {
      const auto x = random_facet<F>(random);
      const Local<F> xi = on_feature<F>(feature, random(0, 1));
      const auto axes = ridge_axes<F>(x, feature, xi);
      const Motion<F::gdim> motion(random, 3);
      const auto after = ridge_axes<F>(motion(x), feature, xi);
      for (int a = 0; a < F::gdim; ++a)
      {
        for (int b = 0; b < F::gdim; ++b)
          EXPECT_NEAR(dot(axes[a], axes[b]), a == b, 1e-13);
        EXPECT_LT(norm(after[a] - motion.rotate(axes[a])), 1e-13);
      }
      const auto [from, to] = feature_edge<F>(feature);
      EXPECT_NEAR(dot(axes.front(), x[to] - x[from]), norm(x[to] - x[from]),
                  1e-14);
      EXPECT_EQ(axes.back(), frame<F>(x, xi).n);
    }
}

TYPED_TEST_OF(Ridge, EdgeOfAVertexStartsThere, F)
{
  for (int v = 0; v < F::nodes; ++v)
    EXPECT_EQ(feature_edge<F>(1 + F::num_edges + v).first, v);
  for (int e = 0; e < F::num_edges; ++e)
    EXPECT_EQ(feature_edge<F>(1 + e), F::edges[e]);
}

TYPED_TEST_OF(Ridge, SecondAxisPointsAwayFromTheFacet, F)
{
  Generator random(3);
  for (int e = 0; e < F::num_edges; ++e)
  {
    const auto x = Motion<F::gdim>(random, 3)(flat_facet<F>(random));
    const Local<F> xi = on_feature<F>(1 + e, 0.5);
    const auto axes = ridge_axes<F>(x, 1 + e, xi);
    const auto inwards
        = position<F>(x, inner_point<F>(random)) - position<F>(x, xi);
    EXPECT_LT(dot(axes[1], inwards), 0);
  }
  // In 2D there is no such axis; the first then points into the facet
  if constexpr (F::num_edges == 0)
  {
    const auto x = random_facet<F>(random);
    EXPECT_GT(dot(ridge_axes<F>(x, 2, {1})[0], x[0] - x[1]), 0);
  }
}

} // namespace
