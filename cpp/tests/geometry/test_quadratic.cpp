// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#include "facets.h"
#include <contactx/geometry/quadratic.h>
#include <contactx/geometry/quadratic_facets.h>
#include <gtest/gtest.h>
#include <numeric>

using namespace contactx;
using namespace contactx::geometry;
using namespace contactx::tests;

namespace
{
template <class F>
class QuadraticFacet : public ::testing::Test
{
};

using Kinds = ::testing::Types<QuadraticSegment, QuadraticTriangle,
                               BiquadraticQuadrilateral>;
TYPED_TEST_SUITE(QuadraticFacet, Kinds);

template <class F>
Local<F> some_place(Generator& random)
{
  Local<F> xi;
  for (double& c : xi)
    c = random(0.05, 0.45);
  return xi;
}

TYPED_TEST(QuadraticFacet, ShapeFunctionsAreOneAtTheirNodes)
{
  using F = TypeParam;
  for (int l = 0; l < F::nodes; ++l)
  {
    const auto N = F::shape(F::points[l]);
    for (int k = 0; k < F::nodes; ++k)
      EXPECT_NEAR(N[k], k == l, 1e-15);
  }
}

TYPED_TEST(QuadraticFacet, DerivativesAreThoseOfTheShapeFunctions)
{
  using F = TypeParam;
  Generator random(1);
  const auto xi = some_place<F>(random);
  constexpr double h = 1e-5;
  const auto dN = F::derivative(xi);
  for (int a = 0; a < F::tdim; ++a)
  {
    auto high = xi, low = xi;
    high[a] += h;
    low[a] -= h;
    const auto d = (1 / (2 * h)) * (F::shape(high) - F::shape(low));
    for (int l = 0; l < F::nodes; ++l)
      EXPECT_NEAR(dN[a][l], d[l], 1e-9);
  }
}

TYPED_TEST(QuadraticFacet, BasisGivesTheSameField)
{
  using F = TypeParam;
  Generator random(2);
  Vector<F::nodes> u;
  for (double& c : u)
    c = random(-1, 1);
  const auto N = F::shape(some_place<F>(random));
  const auto M = Basis<F>::functions(N);
  double field = 0, sum = 0;
  for (int s = 0; s < F::nodes; ++s)
  {
    field += M[s] * Basis<F>::template coefficient<double>(s, u);
    sum += M[s];
    double parts = 0;
    Basis<F>::for_each_part(s, [&parts](int, double part) { parts += part; });
    EXPECT_NEAR(parts, 1, 1e-15);
  }
  EXPECT_NEAR(field, dot(N, u), 1e-14);
  EXPECT_NEAR(sum, 1, 1e-14);
}

TEST(QuadraticTriangle, BasisHasPositiveIntegralsAtVertices)
{
  // The midpoints of the edges, exact for quadratic functions
  Vector<6> area{};
  for (int e = 3; e < 6; ++e)
    area = area
           + (1. / 3)
                 * Basis<QuadraticTriangle>::functions(
                     QuadraticTriangle::shape(QuadraticTriangle::points[e]));
  for (int v = 0; v < 3; ++v)
  {
    EXPECT_NEAR(area[v], 2. / 15, 1e-15);
    EXPECT_NEAR(area[3 + v], 1. / 5, 1e-15);
  }
}

/// Two triangles, a segment and a quadrilateral each with nodes numbered from
/// what follows, in parts that are out of order.
struct Parts
{
  std::vector<std::int32_t> offsets{0}, nodes;
  std::vector<std::int8_t> level;

  void add(std::initializer_list<std::int32_t> part)
  {
    nodes.insert(nodes.end(), part);
    offsets.push_back(static_cast<std::int32_t>(nodes.size()));
  }

  FacetList list() const { return {offsets, nodes}; }
};

/// Triangles 0 1 2 and 1 3 2 with the middles 4 (12), 5 (02), 6 (01), 7 (23)
/// and 8 (13).
Parts two_triangles()
{
  Parts p;
  p.level = {0, 0, 0, 0, 1, 1, 1, 1, 1};
  p.add({8, 3, 7});
  p.add({0, 6, 5});
  p.add({6, 4, 5});
  p.add({1, 8, 4});
  p.add({6, 1, 4});
  p.add({8, 7, 4});
  p.add({5, 4, 2});
  p.add({4, 7, 2});
  return p;
}

TEST(QuadraticFacets, OfTrianglesAreFoundByTheirEdges)
{
  const Parts p = two_triangles();
  const QuadraticFacets w = quadratic_facets(p.list(), p.level);
  ASSERT_EQ(w.size(), 2);
  EXPECT_EQ(w.width, 9);
  for (std::int32_t f = 0; f < p.list().size(); ++f)
  {
    const auto whole = w.of(f);
    ASSERT_EQ(whole.size(), 6U);
    for (int k = 0; k < 3; ++k)
      EXPECT_EQ(whole[w.places[4 * f + k]], p.list()[f][k]);
    // Vertices first, then the middles of the edges opposite to them
    for (int v = 0; v < 3; ++v)
    {
      EXPECT_EQ(p.level[whole[v]], 0);
      EXPECT_EQ(p.level[whole[3 + v]], 1);
    }
    EXPECT_EQ(w.parts_of(f).size(), 4U);
  }
  const auto first = w.of(1);
  EXPECT_EQ(std::vector(first.begin(), first.end()),
            (std::vector<std::int32_t>{0, 1, 2, 4, 5, 6}));
}

TEST(QuadraticFacets, OfSegmentsAndQuadrilaterals)
{
  Parts line;
  line.level = {0, 0, 1, 0, 1};
  line.add({2, 1});
  line.add({1, 4});
  line.add({0, 2});
  line.add({4, 3});
  const QuadraticFacets w = quadratic_facets(line.list(), line.level);
  ASSERT_EQ(w.size(), 2);
  EXPECT_EQ(w.of(0)[0], 0);
  EXPECT_EQ(w.of(0)[1], 1);
  EXPECT_EQ(w.of(0)[2], 2);
  EXPECT_EQ(w.of(3)[0], 1);

  Parts square;
  square.level = {0, 0, 0, 0, 1, 1, 1, 1, 2};
  square.add({8, 6, 7, 3});
  square.add({0, 4, 5, 8});
  square.add({4, 1, 8, 6});
  square.add({5, 8, 2, 7});
  const QuadraticFacets q = quadratic_facets(square.list(), square.level);
  ASSERT_EQ(q.size(), 1);
  const auto nodes = q.of(0);
  EXPECT_EQ(std::vector(nodes.begin(), nodes.end()),
            (std::vector<std::int32_t>{0, 1, 2, 3, 4, 5, 6, 7, 8}));
}

TEST(QuadraticFacets, OfLinearFacetsAreThese)
{
  Parts p = two_triangles();
  const QuadraticFacets w = quadratic_facets(p.list(), {});
  EXPECT_EQ(w.size(), p.list().size());
  EXPECT_EQ(w.width, 4);
  for (std::int32_t f = 0; f < w.size(); ++f)
    EXPECT_TRUE(std::ranges::equal(w.of(f), p.list()[f]));
}

TEST(QuadraticFacets, LackNoPart)
{
  Parts p = two_triangles();
  p.offsets.pop_back();
  p.nodes.resize(p.offsets.back());
  EXPECT_THROW(quadratic_facets(p.list(), p.level), std::invalid_argument);
}

TEST(CornerAreas, OfPartsAreTheIntegralsOfQuadraticShapeFunctions)
{
  const Parts p = two_triangles();
  // The middles are those of straight edges
  std::vector<double> x{0, 0, 0, 2, 0, 0, 0, 1, 0, 2, 1, 0};
  for (const auto& [a, b] : {std::pair{1, 2}, {0, 2}, {0, 1}, {2, 3}, {1, 3}})
    for (int k = 0; k < 3; ++k)
      x.push_back(0.5 * (x[3 * a + k] + x[3 * b + k]));
  for (const bool of_basis : {false, true})
  {
    const auto corners = corner_areas(p.list(), x, 3, {{}, p.level, of_basis});
    std::vector<double> area(9, 0);
    for (std::size_t c = 0; c < corners.size(); ++c)
      area[p.nodes[c]] += corners[c];
    // Each triangle has the area 1
    const double vertex = of_basis ? 2. / 15 : 0,
                 edge = of_basis ? 0.2 : 1. / 3;
    EXPECT_NEAR(area[0], vertex, 1e-15);
    EXPECT_NEAR(area[1], 2 * vertex, 1e-15);
    EXPECT_NEAR(area[4], 2 * edge, 1e-15);
    EXPECT_NEAR(area[6], edge, 1e-15);
    EXPECT_NEAR(std::accumulate(area.begin(), area.end(), 0.0), 2, 1e-14);
  }
}
} // namespace
