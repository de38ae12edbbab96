// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#include "expect.h"
#include "facets.h"
#include "scene.h"
#include <contactx/geometry/facets.h>
#include <contactx/geometry/gather.h>
#include <contactx/geometry/quadratic.h>
#include <contactx/geometry/quadratic_facets.h>
#include <contactx/geometry/smooth.h>

using namespace contactx;
using namespace contactx::geometry;
using namespace contactx::tests;

namespace
{
template <class>
using QuadraticFacet = testing::Test;

using Kinds = testing::Types<QuadraticSegment, QuadraticTriangle,
                             BiquadraticQuadrilateral>;
TYPED_TEST_SUITE(QuadraticFacet, Kinds);

template <class F>
Local<F> some_place(Generator& random)
{
  return random.vector<F::tdim>(0.05, 0.45);
}

TYPED_TEST_OF(QuadraticFacet, ShapeFunctionsAreOneAtTheirNodes, F)
{
  for (int l = 0; l < F::nodes; ++l)
  {
    const auto N = F::shape(F::points[l]);
    for (int k = 0; k < F::nodes; ++k)
      EXPECT_NEAR(N[k], k == l, 1e-15);
  }
}

TYPED_TEST_OF(QuadraticFacet, DerivativesAreThoseOfTheShapeFunctions, F)
{
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

TYPED_TEST_OF(QuadraticFacet, BasisGivesTheSameField, F)
{
  Generator random(2);
  const auto u = random.vector<F::nodes>(-1, 1);
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
struct Parts : Facets
{
  std::vector<std::int8_t> level;

  void add(const std::vector<std::int32_t>& part) { add_facet(*this, part); }
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
  EXPECT_REFUSED(quadratic_facets(p.list(), p.level));
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

/// A part of the mantle of a cylinder about the z axis, of triangles whose
/// diagonals go one way or the other in turn, or of quadrilaterals.
struct Mantle
{
  Mantle(int around, int along, bool is_triangular, double angle)
  {
    for (int j = 0; j <= along; ++j)
      for (int i = 0; i <= around; ++i)
      {
        const double a = angle * i / around;
        x.insert(x.end(), {std::cos(a), std::sin(a), 0.3 * j});
      }
    const auto at = [around](int i, int j)
    { return static_cast<std::int32_t>(j * (around + 1) + i); };
    for (int j = 0; j < along; ++j)
      for (int i = 0; i < around; ++i)
      {
        const auto a = at(i, j), b = at(i + 1, j), c = at(i, j + 1),
                   d = at(i + 1, j + 1);
        if (not is_triangular)
          facets.add({a, b, c, d});
        else if ((i + j) % 2)
        {
          facets.add({a, b, d});
          facets.add({a, d, c});
        }
        else
        {
          facets.add({a, b, c});
          facets.add({b, d, c});
        }
      }
  }

  Parts facets;
  std::vector<double> x;
};

double error_of(const Vector<3>& normal, const double* x, int gdim)
{
  return std::hypot(normal[0] - x[0], normal[1] - x[1],
                    gdim == 3 ? normal[2] : 0.0);
}

TEST(SmoothFacets, OfAPolygonAreThoseOfTheCircle)
{
  for (const double angle : {2 * std::numbers::pi, 1.5})
  {
    // A polygon about the origin, or an open part of it
    Scene arc = regular_polygon(24, 1);
    if (angle < 2)
      arc = line(
          6, [&](double s)
          { return Vector<3>{std::cos(angle * s), std::sin(angle * s)}; });
    const auto facets = arc.facets();
    const auto smooth = smooth_facets(facets, arc.x, 2);
    for (std::int32_t f = 0; f < facets.size(); ++f)
    {
      const auto nodes = facets[f];
      for (int l = 0; l < 2; ++l)
        EXPECT_LT(error_of(smooth[f].normal[l], &arc.x[2 * nodes[l]], 2), 3e-3);
      const auto x = gather<Segment>(nodes, arc.x);
      for (const double xi : {0.1, 0.5, 0.8})
      {
        const double chord = norm(combine<Segment>(Segment::shape({xi}), x));
        EXPECT_NEAR(chord + rise<Segment>(x, smooth[f], {xi}), 1,
                    0.03 * (1 - chord) + 1e-12);
      }
      // Open ends are sharp, all else is not
      const bool first = angle < 2 and f == 0,
                 last = angle < 2 and f == facets.size() - 1;
      EXPECT_EQ(smooth[f].sharp, (first ? 1 : 0) + (last ? 2 : 0));
    }
  }
}

TEST(SmoothFacets, OfAMantleAreThoseOfTheCylinder)
{
  for (const bool is_triangular : {true, false})
  {
    const Mantle mantle(8, 5, is_triangular, 2.0);
    const auto smooth = smooth_facets(mantle.facets.list(), mantle.x, 3);
    for (std::int32_t f = 0; f < mantle.facets.list().size(); ++f)
    {
      const auto nodes = mantle.facets.list()[f];
      for (std::size_t l = 0; l < nodes.size(); ++l)
        // Chords tilt by 0.125
        EXPECT_LT(error_of(smooth[f].normal[l], &mantle.x[3 * nodes[l]], 3),
                  0.012);
      visit(static_cast<int>(nodes.size()),
            [&]<class F>(F)
            {
              if constexpr (F::gdim == 3)
              {
                const auto x = gather<F>(nodes, mantle.x);
                const Local<F> xi{0.3, 0.45};
                const auto p = combine<F>(F::shape(xi), x);
                EXPECT_NEAR(std::hypot(p[0], p[1]) + rise<F>(x, smooth[f], xi),
                            1, 5e-4);
              }
            });
    }
  }
}

TEST(SmoothFacets, OfFlatOnesAreThemselvesAndEdgesStay)
{
  // Two squares that meet at a right angle
  const std::vector<double> x{0, 0, 0, 1, 0, 0,  0, 1, 0,
                              1, 1, 0, 1, 0, -1, 1, 1, -1};
  const Facets facets{{0, 4, 8}, {0, 1, 2, 3, 1, 4, 3, 5}};
  const auto smooth = smooth_facets(facets.list(), x, 3);
  for (int l = 0; l < 4; ++l)
  {
    EXPECT_NEAR(smooth[0].normal[l][2], 1, 1e-12);
    EXPECT_NEAR(smooth[1].normal[l][0], 1, 1e-12);
  }
  // All edges and vertices of both
  EXPECT_EQ(smooth[0].sharp, 0xff);
  EXPECT_EQ(smooth[1].sharp, 0xff);
}

TEST(SmoothFacets, TurnWithTheirFacets)
{
  const Scene arc = regular_polygon(20, 1);
  const auto smooth = smooth_facets(arc.facets(), arc.x, 2);
  const auto x = gather<Segment>(arc.facets()[3], arc.x);
  const double c = std::cos(0.7), s = std::sin(0.7);
  const auto turn = [c, s](const Vector<2>& p) -> Vector<2>
  { return {c * p[0] - s * p[1], s * p[0] + c * p[1]}; };
  const Nodes<Segment> turned{turn(x[0]), turn(x[1])};
  const auto before = smooth_point<Segment>(x, x, smooth[3], {0.2});
  const auto after = smooth_point<Segment>(x, turned, smooth[3], {0.2});
  EXPECT_LT(norm(after.normal - turn(before.normal)), 1e-14);
  EXPECT_EQ(after.rise, before.rise);
}

TEST(SmoothFacets, AreProjectedOnAlongTheirNormals)
{
  const Scene arc = regular_polygon(20, 1);
  const auto smooth = smooth_facets(arc.facets(), arc.x, 2);
  const auto x = gather<Segment>(arc.facets()[0], arc.x);
  for (const double angle : {0.02, 0.15, 0.3})
  {
    const Vector<2> way{std::cos(angle), std::sin(angle)};
    const Vector<2> point = 1.1 * way;
    const auto at = smooth_projection<Segment>(x, x, smooth[0], point, {0.5});
    // The patch has the circle's normals, about whose centre all is round
    EXPECT_LT(norm(at.normal - way), 1e-3);
    const auto foot = combine<Segment>(Segment::shape(at.xi), x);
    EXPECT_NEAR(dot(at.normal, point - foot) - at.rise, 0.1, 1e-4);
    const auto d = point - foot;
    EXPECT_NEAR(d[0] * at.normal[1] - d[1] * at.normal[0], 0, 1e-13);
  }
}
} // namespace
