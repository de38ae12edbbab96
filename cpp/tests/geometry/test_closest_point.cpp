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
class ClosestPointOn : public ::testing::Test
{
};
TYPED_TEST_SUITE(ClosestPointOn, FacetTypes);

constexpr std::array offsets{0.0, 1e-12, 1e-4, 1.0, 1000.0};

template <class F>
constexpr int num_features = 1 + F::num_edges + F::nodes;

/// Direction in the plane of a flat facet in which its edge faces.
template <class F>
Vector<F::gdim> edge_normal(const Nodes<F>& x, std::pair<int, int> edge)
{
  const auto e = x[edge.second] - x[edge.first];
  if constexpr (F::gdim == 2)
    return (-1 / norm(e)) * e; // away from the vertex that it starts at
  else
    return (1 / norm(e)) * cross(e, flat_normal<F>());
}

/// A point of a feature and a direction in the plane of the facet in which
/// the feature stays the closest one.
template <class F>
std::pair<Vector<F::gdim>, Vector<F::gdim>> away(const Nodes<F>& x, int feature,
                                                 Generator& random)
{
  if (feature == interior)
    return {position<F>(x, inner_point<F>(random)), {}};
  if (F::num_edges > 0 and feature <= F::num_edges)
  {
    const auto [i, j] = F::edges[feature - 1];
    const double s = random(0.05, 0.95);
    return {(1 - s) * x[i] + s * x[j], edge_normal<F>(x, {i, j})};
  }
  const int vertex = feature - 1 - F::num_edges;
  Vector<F::gdim> direction{};
  for (const auto& edge : F::edges)
    if (edge.first == vertex or (F::gdim == 3 and edge.second == vertex))
      direction = direction + random(0.2, 1) * edge_normal<F>(x, edge);
  return {x[vertex], (1 / norm(direction)) * direction};
}

TYPED_TEST(ClosestPointOn, EachVoronoiRegion)
{
  using F = TypeParam;
  Generator random(1);
  for (int i = 0; i < 40; ++i)
    for (int feature = 0; feature < num_features<F>; ++feature)
      for (double beside : offsets)
        for (double height : offsets)
        {
          const auto x = flat_facet<F>(random);
          const Motion<F::gdim> motion(random, 10);
          const auto [foot, direction] = away<F>(x, feature, random);
          const double side = i % 2 ? height : -height;
          const auto p
              = motion(foot + beside * direction + side * flat_normal<F>());
          const double distance
              = std::hypot(feature == interior ? 0 : beside, height);

          const auto c = closest_point<F>(motion(x), p);
          // The interior reaches 1e-12 beyond the edges
          const double tolerance = 2e-12 + 1e-13 * distance;
          EXPECT_NEAR(std::sqrt(c.distance2), distance, tolerance);
          EXPECT_LT(norm(position<F>(motion(x), c.xi) - motion(foot)),
                    tolerance);
          if (feature == interior or beside > 1e-6)
          {
            EXPECT_EQ(c.feature, feature);
          }
        }
}

TYPED_TEST(ClosestPointOn, ItsVerticesAndEdges)
{
  using F = TypeParam;
  Generator random(2);
  for (int i = 0; i < 200; ++i)
  {
    const auto x = random_facet<F>(random);
    for (const auto& [a, b] : F::edges)
      for (double s : {0.0, 1e-15, 0.25, 0.5, 1.0})
      {
        const auto p = (1 - s) * x[a] + s * x[b];
        const auto c = closest_point<F>(x, p);
        EXPECT_LT(std::sqrt(c.distance2), 2e-15);
        EXPECT_LT(norm(position<F>(x, c.xi) - p), 4e-15);
        EXPECT_LE(F::excess(c.xi), 1e-12);
      }
  }
}

TYPED_TEST(ClosestPointOn, AScaledFacetIsTheScaledOne)
{
  using F = TypeParam;
  Generator random(3);
  for (double scale : {0x1p-40, 0x1p40}) // exact, so that nothing may differ
    for (int i = 0; i < 200; ++i)
    {
      auto x = random_facet<F>(random);
      auto p = position<F>(x, random.vector<F::tdim>(-0.5, 1.5))
               + random.vector<F::gdim>(-1, 1);
      const auto c = closest_point<F>(x, p);
      for (auto& node : x)
        node = scale * node;
      const auto scaled = closest_point<F>(x, scale * p);
      EXPECT_EQ(scaled.xi, c.xi);
      EXPECT_EQ(scaled.feature, c.feature);
      EXPECT_EQ(scaled.distance2, scale * scale * c.distance2);
    }
}

/// Rounding must not decide between the facets at an edge: their distances
/// are equal to the last bit.
template <class F>
void expect_tie(const Nodes<F>& x, const Nodes<Triangle>& y, const Vector<3>& p)
{
  EXPECT_EQ(closest_point<F>(x, p).distance2,
            closest_point<Triangle>(y, p).distance2);
}

TEST(ClosestPoint, OnASharedEdgeIsTheSameForBothFacets)
{
  Generator random(4);
  for (int i = 0; i < 500; ++i)
  {
    // A roof with its ridge from a to b
    const Motion<3> motion(random, 3);
    const Vector<3> a = motion({0, 0, 0}), b = motion({0, random(0.5, 2), 0});
    const Vector<3> left = motion({-1, 0, -1}), right = motion({1, 0, -1});
    const Vector<3> back = motion({-1, 0.5, -1});
    const Vector<3> p
        = motion({random(-0.1, 0.1), random(-1, 2), random(0.2, 2)});
    expect_tie<Triangle>({a, left, b}, {right, a, b}, p);
    expect_tie<Triangle>({b, a, left}, {a, b, right}, p);
    expect_tie<Quadrilateral>({a, b, left, back}, {b, right, a}, p);
  }
}
} // namespace
