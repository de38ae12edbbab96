// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#include "facets.h"
#include <contactx/geometry/ridge.h>

using namespace contactx;
using namespace contactx::geometry;
using namespace contactx::tests;

namespace
{
template <class F>
class Ridge : public ::testing::Test
{
};
TYPED_TEST_SUITE(Ridge, FacetTypes);

template <class F>
constexpr int all_features = 1 + F::num_edges + F::nodes;

/// A point on a feature.
template <class F>
Local<F> on_feature(int feature, double s)
{
  if (feature > F::num_edges)
    return F::vertices[feature - 1 - F::num_edges];
  const auto [i, j] = F::edges[feature - 1];
  return (1 - s) * F::vertices[i] + s * F::vertices[j];
}

TYPED_TEST(Ridge, AxesAreOrthonormal)
{
  using F = TypeParam;
  Generator random(1);
  for (int i = 0; i < 50; ++i)
    for (int feature = 1; feature < all_features<F>; ++feature)
    {
      const auto x = random_facet<F>(random);
      const auto axes
          = ridge_axes<F>(x, feature, on_feature<F>(feature, random(0, 1)));
      for (int a = 0; a < F::gdim; ++a)
        for (int b = 0; b < F::gdim; ++b)
          EXPECT_NEAR(dot(axes[a], axes[b]), a == b, 1e-13);
    }
}

TYPED_TEST(Ridge, FirstAxisRunsAlongTheEdgeAndTheLastIsTheNormal)
{
  using F = TypeParam;
  Generator random(2);
  for (int feature = 1; feature < all_features<F>; ++feature)
  {
    const auto x = random_facet<F>(random);
    const Local<F> xi = on_feature<F>(feature, 0.3);
    const auto axes = ridge_axes<F>(x, feature, xi);
    const auto [i, j] = feature_edge<F>(feature);
    EXPECT_NEAR(dot(axes.front(), x[j] - x[i]), norm(x[j] - x[i]), 1e-14);
    EXPECT_EQ(axes.back(), frame<F>(x, xi).n);
  }
}

TYPED_TEST(Ridge, EdgeOfAVertexStartsThere)
{
  using F = TypeParam;
  for (int v = 0; v < F::nodes; ++v)
    EXPECT_EQ(feature_edge<F>(1 + F::num_edges + v).first, v);
  for (int e = 0; e < F::num_edges; ++e)
    EXPECT_EQ(feature_edge<F>(1 + e), F::edges[e]);
}

TYPED_TEST(Ridge, SecondAxisPointsAwayFromTheFacet)
{
  using F = TypeParam;
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

TYPED_TEST(Ridge, AxesTurnWithTheFacet)
{
  using F = TypeParam;
  Generator random(4);
  for (int feature = 1; feature < all_features<F>; ++feature)
  {
    const auto x = random_facet<F>(random);
    const Motion<F::gdim> motion(random, 3);
    const Local<F> xi = on_feature<F>(feature, 0.6);
    const auto before = ridge_axes<F>(x, feature, xi);
    const auto after = ridge_axes<F>(motion(x), feature, xi);
    for (int a = 0; a < F::gdim; ++a)
      EXPECT_LT(norm(after[a] - motion.rotate(before[a])), 1e-13);
  }
}
} // namespace
