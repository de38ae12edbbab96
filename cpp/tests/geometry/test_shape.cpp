// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#include "facets.h"
#include <numeric>

using namespace contactx;
using namespace contactx::geometry;
using namespace contactx::tests;

namespace
{
template <class F>
class Shape : public ::testing::Test
{
};
TYPED_TEST_SUITE(Shape, FacetTypes);

TYPED_TEST(Shape, IsAPartitionOfUnity)
{
  using F = TypeParam;
  Generator random(1);
  for (int i = 0; i < 100; ++i)
  {
    const Local<F> xi = random.vector<F::tdim>(-1, 2);
    const auto N = F::shape(xi);
    EXPECT_NEAR(std::accumulate(N.begin(), N.end(), 0.0), 1, 1e-14);
    for (const auto& dN : F::derivative(xi))
      EXPECT_NEAR(std::accumulate(dN.begin(), dN.end(), 0.0), 0, 1e-14);
  }
}

TYPED_TEST(Shape, IsOneAtItsOwnVertex)
{
  using F = TypeParam;
  for (int i = 0; i < F::nodes; ++i)
    for (int j = 0; j < F::nodes; ++j)
      EXPECT_EQ(F::shape(F::vertices[i])[j], i == j);
}

TYPED_TEST(Shape, HasItsDifferenceQuotientAsDerivative)
{
  using F = TypeParam;
  Generator random(2);
  const double h = 0.25; // linear along each axis: any step is exact
  for (int i = 0; i < 100; ++i)
  {
    const Local<F> xi = random.vector<F::tdim>(-1, 2);
    const auto dN = F::derivative(xi);
    for (int a = 0; a < F::tdim; ++a)
    {
      Local<F> e{};
      e[a] = h;
      const auto difference
          = (1 / (2 * h)) * (F::shape(xi + e) - F::shape(xi - e));
      EXPECT_LT(norm(difference - dN[a]), 1e-14);
    }
  }
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

TYPED_TEST(Shape, ExcessIsNegativeInside)
{
  using F = TypeParam;
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

TYPED_TEST(Shape, ExcessIsZeroOnTheBoundaryAndGrowsOutside)
{
  using F = TypeParam;
  Local<F> centre{};
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

TYPED_TEST(Shape, ExcessMeasuresTheWidthOfTheFacet)
{
  using F = TypeParam;
  Local<F> xi{};
  xi[0] = -0.07;
  EXPECT_DOUBLE_EQ(F::excess(xi), 0.07);
}

template <class F>
class Edges : public ::testing::Test
{
};
TYPED_TEST_SUITE(Edges, FacetTypes);

TYPED_TEST(Edges, FormOneLoop)
{
  using F = TypeParam;
  for (std::size_t e = 0; e < F::edges.size(); ++e)
    EXPECT_EQ(F::edges[e].second, F::edges[(e + 1) % F::edges.size()].first);
}

TYPED_TEST(Edges, RunAroundTheNormal)
{
  using F = TypeParam;
  if constexpr (F::num_edges > 0)
  {
    double area = 0;
    for (const auto& [i, j] : F::edges)
      area += 0.5
              * (F::vertices[i][0] * F::vertices[j][1]
                 - F::vertices[i][1] * F::vertices[j][0]);
    EXPECT_DOUBLE_EQ(area, F::nodes == 3 ? 0.5 : 1);
  }
  else
    EXPECT_EQ(F::edges[0], std::pair(0, 1));
}

TYPED_TEST(Edges, FacetIsFoundByItsNumberOfNodes)
{
  const int nodes
      = visit(TypeParam::nodes, []<class G>(G) { return G::nodes; });
  EXPECT_EQ(nodes, TypeParam::nodes);
}
} // namespace
