// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#include "expect.h"
#include "generator.h"
#include <contactx/math/vec.h>
#include <contactx/mesh/cell.h>
#include <contactx/mesh/nodes.h>
#include <contactx/mesh/triquadratic.h>
#include <set>

using namespace contactx;
using namespace contactx::mesh;
using namespace contactx::tests;

namespace
{
using OfCells = testing::TestWithParam<CellType>;

/// Reference coordinates of a node, the middle of its vertices.
Vector<3> place_of(CellType cell, const std::vector<int>& vertices)
{
  const bool is_simplex = num_vertices(cell) == dimension(cell) + 1;
  Vector<3> sum{};
  for (const int v : vertices)
    for (int k = 0; k < dimension(cell); ++k)
      sum[k] += is_simplex ? v == k + 1 : v >> k & 1;
  return (1.0 / static_cast<double>(vertices.size())) * sum;
}

std::vector<Vector<3>> places(CellType cell, int degree,
                              std::span<const int> nodes)
{
  std::vector<Vector<3>> x;
  for (const int node : nodes)
    x.push_back(place_of(cell, node_vertices(cell, degree).at(node)));
  return x;
}

/// Volume of a parallelepiped or a simplex, or area in the plane.
double volume_of(std::span<const Vector<3>> x, int dim)
{
  const bool is_simplex = std::ssize(x) == dim + 1;
  const Vector<3> a = x[1] - x[0], b = x[2] - x[0];
  if (dim == 2)
    return norm(cross(a, b)) / (is_simplex ? 2 : 1);
  const Vector<3> c = x[is_simplex ? 3 : 4] - x[0];
  return std::abs(dot(cross(a, b), c)) / (is_simplex ? 6 : 1);
}

/// Vector area of a facet, from its local coordinates.
Vector<3> area_of(std::span<const Vector<3>> x, int dim)
{
  const Vector<3> t = x[1] - x[0];
  if (dim == 2)
    return {t[1], -t[0], 0};
  return (x.size() == 3 ? 0.5 : 1.0) * cross(t, x[2] - x[0]);
}

TEST_P(OfCells, PartsFillTheCellAndHaveItsShape)
{
  const CellType cell = GetParam();
  const int dim = dimension(cell), n = num_vertices(cell);
  const std::vector<int> parts = cell_parts(cell, 2);
  ASSERT_EQ(std::ssize(parts), n << dim);
  EXPECT_EQ(std::set<int>(parts.begin(), parts.end()).size(),
            std::size_t(num_nodes(cell, 2)));
  const double whole = volume_of(places(cell, 1, cell_parts(cell, 1)), dim);
  std::set<std::vector<int>> seen;
  for (int p = 0; p < 1 << dim; ++p)
  {
    const auto part = std::span(parts).subspan(std::size_t(n) * p, n);
    EXPECT_NEAR(volume_of(places(cell, 2, part), dim), whole / (1 << dim),
                1e-15);
    std::vector<int> nodes(part.begin(), part.end());
    std::ranges::sort(nodes);
    EXPECT_TRUE(seen.insert(nodes).second);
  }
}

TEST_P(OfCells, PartsOfAFacetLieOnItAndShareItsNormal)
{
  const CellType cell = GetParam();
  const int dim = dimension(cell);
  for (int f = 0; f < std::ssize(facet_vertices(cell)); ++f)
  {
    const std::size_t n = facet_vertices(cell)[f].size();
    for (const bool is_turned : {false, true})
    {
      const auto whole = places(cell, 1, facet_parts(cell, 1, f, is_turned));
      const Vector<3> area = area_of(whole, dim);
      const std::vector<int> parts = facet_parts(cell, 2, f, is_turned);
      ASSERT_EQ(parts.size(), n << (dim - 1));
      Vector<3> sum{};
      for (std::size_t at = 0; at < parts.size(); at += n)
      {
        const auto part = places(cell, 2, std::span(parts).subspan(at, n));
        const Vector<3> own = area_of(part, dim);
        EXPECT_GT(dot(own, area), 0);
        sum = sum + own;
        for (const Vector<3>& x : part)
          EXPECT_NEAR(dot(x - whole[0], area), 0, 1e-15);
      }
      EXPECT_NEAR(norm(sum - area), 0, 1e-15);
    }
    const auto one = facet_parts(cell, 1, f, false);
    const auto other = facet_parts(cell, 1, f, true);
    EXPECT_NEAR(norm(area_of(places(cell, 1, one), dim)
                     + area_of(places(cell, 1, other), dim)),
                0, 1e-15);
  }
}

TEST_P(OfCells, LinearFunctionsAreThoseOfTheVertices)
{
  const CellType cell = GetParam();
  const int dim = dimension(cell), n = num_vertices(cell);
  std::vector<double> points;
  for (const auto& vertices : node_vertices(cell, 2))
    for (int k = 0; k < dim; ++k)
      points.push_back(place_of(cell, vertices)[k]);
  const std::vector<double> values = linear_shape(cell, points);
  ASSERT_EQ(std::ssize(values), n * num_nodes(cell, 2));
  for (int i = 0; i < num_nodes(cell, 2); ++i)
  {
    const auto& vertices = node_vertices(cell, 2)[i];
    for (int v = 0; v < n; ++v)
      EXPECT_NEAR(values[n * i + v],
                  std::ranges::count(vertices, v)
                      / static_cast<double>(vertices.size()),
                  1e-15);
  }
}

TEST_P(OfCells, OtherDegreesAreRefused)
{
  for (const int degree : {0, 3})
    EXPECT_REFUSED(num_nodes(GetParam(), degree));
}

TEST(CellTypes, AreFoundByName)
{
  EXPECT_EQ(cell_type("interval"), CellType::interval);
  EXPECT_EQ(cell_type("hexahedron"), CellType::hexahedron);
  EXPECT_EQ(num_nodes(CellType::interval, 2), 3);
  EXPECT_TRUE(facet_vertices(CellType::interval).empty());
  EXPECT_REFUSED(cell_type("prism"));
}

/// A polynomial by its coefficients of powers.
double value(const mesh::Triquadratic& a, const Vector<3>& x)
{
  double sum = 0;
  for (int p = 0; p < 27; ++p)
    sum += a[p] * std::pow(x[0], p % 3) * std::pow(x[1], p / 3 % 3)
           * std::pow(x[2], p / 9);
  return sum;
}

/// A polynomial by its coefficients in Bernstein's basis.
double bernstein(const mesh::Triquadratic& b, const Vector<3>& x)
{
  const auto basis = [](double s) -> Vector<3>
  { return {(1 - s) * (1 - s), 2 * s * (1 - s), s * s}; };
  double sum = 0;
  for (int p = 0; p < 27; ++p)
    sum += b[p] * basis(x[0])[p % 3] * basis(x[1])[p / 3 % 3]
           * basis(x[2])[p / 9];
  return sum;
}

mesh::Triquadratic random_polynomial(Generator& random)
{
  mesh::Triquadratic a;
  for (double& c : a)
    c = random(-1, 1);
  return a;
}

mesh::Triquadratic coefficients_of(const mesh::Triquadratic& a)
{
  mesh::Triquadratic values;
  for (int p = 0; p < 27; ++p)
    values[p] = value(a, {0.5 * (p % 3), 0.5 * (p / 3 % 3), 0.5 * (p / 9)});
  return mesh::coefficients(values);
}

TEST(Triquadratic, CoefficientsGiveThePolynomial)
{
  Generator random(1);
  for (int i = 0; i < 100; ++i)
  {
    const auto a = random_polynomial(random);
    const auto b = coefficients_of(a);
    const auto x = random.vector<3>(0, 1);
    EXPECT_NEAR(bernstein(b, x), value(a, x), 1e-13);
  }
}

TEST(Triquadratic, HalvesAreTheSamePolynomial)
{
  Generator random(2);
  for (int i = 0; i < 100; ++i)
  {
    const auto a = random_polynomial(random);
    for (int variable = 0; variable < 3; ++variable)
      for (const bool upper : {false, true})
      {
        const auto b = mesh::half(coefficients_of(a), variable, upper);
        const auto x = random.vector<3>(0, 1);
        auto whole = x;
        whole[variable] = 0.5 * (x[variable] + upper);
        EXPECT_NEAR(bernstein(b, x), value(a, whole), 1e-13);
      }
  }
}

/// One cell of degree 2, its points those of order 1 or 2 and a little off.
struct OneCell
{
  CellType type;
  int order;
  std::vector<std::int32_t> nodes, points;
  std::vector<double> x;

  OneCell(CellType cell, int degree_of_mesh, bool is_mirrored = false)
      : type(cell), order(degree_of_mesh)
  {
    for (const auto& vertices : node_vertices(cell, order))
    {
      Vector<3> at = place_of(cell, vertices);
      // No two points have the same coordinates
      at[0] += 0.1 * at[1] + 0.01 * static_cast<double>(points.size());
      if (is_mirrored)
        at[0] = -at[0];
      x.insert(x.end(), at.begin(), at.end());
      points.push_back(static_cast<std::int32_t>(points.size()));
    }
    nodes.resize(num_nodes(cell, 2));
    // Nodes are numbered backward
    std::iota(nodes.rbegin(), nodes.rend(), 0);
  }

  mesh::Cells cells() const { return {type, 2, nodes}; }
  Geometry geometry() const
  {
    return {dimension(type), order, points, static_cast<int>(points.size()), x};
  }
  std::int32_t size() const { return static_cast<std::int32_t>(nodes.size()); }
};

TEST_P(OfCells, AreWhereTheMeshHasThemOrInTheMiddleOfVertices)
{
  const CellType cell = GetParam();
  const int dim = dimension(cell);
  for (const int order : {1, 2})
  {
    const OneCell one(cell, order);
    const std::vector<double> x
        = reference_positions(one.cells(), one.size(), one.geometry());
    ASSERT_EQ(std::ssize(x), dim * one.size());
    for (int i = 0; i < one.size(); ++i)
    {
      const auto& vertices = node_vertices(cell, 2)[i];
      for (int k = 0; k < dim; ++k)
      {
        double expected = 0;
        for (const int v : vertices)
          expected += one.x[3 * v + k] / static_cast<double>(vertices.size());
        if (order == 2)
          expected = one.x[3 * i + k];
        EXPECT_NEAR(x[dim * one.nodes[i] + k], expected, 1e-15);
      }
    }
  }
}

TEST_P(OfCells, HaveNumbersThatDoNotDependOnWhereACellBeginsToCount)
{
  const CellType cell = GetParam();
  const OneCell one(cell, 1);
  const int n = num_vertices(cell);
  std::vector<std::int64_t> numbers(n);
  std::iota(numbers.begin(), numbers.end(), 7);
  const auto found
      = original_nodes(one.cells(), one.size(), one.geometry(), numbers, 100);
  EXPECT_EQ(std::set(found.begin(), found.end()).size(), one.nodes.size());
  for (int v = 0; v < n; ++v)
    EXPECT_EQ(found[one.nodes[v]], 7 + v);
  // Counted from the other end, the same vertices lie opposite to one another
  OneCell turned = one;
  if (n > dimension(cell) + 1)
    std::ranges::reverse(turned.points);
  else
    std::swap(turned.points[0], turned.points[1]);
  const auto other = original_nodes(turned.cells(), one.size(),
                                    turned.geometry(), numbers, 100);
  EXPECT_EQ(std::set(found.begin(), found.end()),
            std::set(other.begin(), other.end()));
  const auto x = reference_positions(one.cells(), one.size(), one.geometry());
  const auto y
      = reference_positions(turned.cells(), one.size(), turned.geometry());
  const int dim = dimension(cell);
  for (int i = 0; i < one.size(); ++i)
  {
    const auto same = std::ranges::find(other, found[i]) - other.begin();
    for (int k = 0; k < dim; ++k)
      EXPECT_EQ(x[dim * i + k], y[dim * same + k]);
  }
}

TEST_P(OfCells, LevelsAreThoseOfWhatTheyAreTheMiddleOf)
{
  const CellType cell = GetParam();
  const OneCell one(cell, 1);
  const auto levels = node_levels(one.cells(), one.size());
  for (int i = 0; i < one.size(); ++i)
  {
    const std::size_t count = node_vertices(cell, 2)[i].size();
    EXPECT_EQ(levels[one.nodes[i]], count == 1 ? 0 : count == 2 ? 1 : 2);
  }
  const auto linear = std::span(one.nodes).first(num_vertices(cell));
  EXPECT_TRUE(node_levels({cell, 1, linear}, one.size()).empty());
}

TEST_P(OfCells, FacetsPointOutOfTheirCellWhicheverWayItIsRound)
{
  const CellType cell = GetParam();
  const int dim = dimension(cell);
  for (const bool is_mirrored : {false, true})
    for (const int order : {1, 2})
    {
      const OneCell one(cell, order, is_mirrored);
      const auto x
          = reference_positions(one.cells(), one.size(), one.geometry());
      std::vector<std::int32_t> of, local;
      for (int f = 0; f < std::ssize(facet_vertices(cell)); ++f)
      {
        of.push_back(0);
        local.push_back(f);
      }
      const geometry::Facets found
          = facets(one.cells(), of, local, one.geometry());
      EXPECT_EQ(found.list().size(), std::ssize(of) << (dim - 1));
      Vector<3> middle{};
      for (int v = 0; v < num_vertices(cell); ++v)
        middle = middle
                 + (1.0 / num_vertices(cell)) * vector_at(x, one.nodes[v], dim);
      for (std::int32_t f = 0; f < found.list().size(); ++f)
      {
        const auto nodes = found.list()[f];
        const auto at = [&](int i) { return vector_at(x, nodes[i], dim); };
        const Vector<3> t = at(1) - at(0);
        const Vector<3> normal
            = dim == 2 ? Vector<3>{t[1], -t[0], 0} : cross(t, at(2) - at(0));
        EXPECT_GT(dot(normal, at(0) - middle), 0);
      }
    }
}

TEST_P(OfCells, SizesAndNumbersThatDoNotFitAreRefused)
{
  const OneCell one(GetParam(), 1);
  const Geometry geometry = one.geometry();
  EXPECT_REFUSED(reference_positions(one.cells(), one.size() - 1, geometry));
  Geometry other = geometry;
  other.x = other.x.first(3);
  EXPECT_REFUSED(reference_positions(one.cells(), one.size(), other));
  other = geometry;
  other.degree = 2;
  EXPECT_REFUSED(reference_positions(one.cells(), one.size(), other));
  const std::vector<std::int32_t> none, first{0}, beyond{99};
  EXPECT_REFUSED(facets(one.cells(), first, beyond, geometry));
  EXPECT_REFUSED(facets(one.cells(), beyond, first, geometry));
  EXPECT_REFUSED(facets(one.cells(), first, none, geometry));
  EXPECT_REFUSED(original_nodes(one.cells(), one.size(), geometry, {}, 1));
}

INSTANTIATE_TEST_SUITE_P(AllKinds, OfCells,
                         testing::Values(CellType::triangle,
                                         CellType::quadrilateral,
                                         CellType::tetrahedron,
                                         CellType::hexahedron));
} // namespace
