// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#include <algorithm>
#include <array>
#include <contactx/math/vec.h>
#include <contactx/mesh/cell.h>
#include <gtest/gtest.h>
#include <numeric>
#include <set>
#include <stdexcept>

using namespace contactx;
using namespace contactx::mesh;

namespace
{
class OfCells : public testing::TestWithParam<CellType>
{
};

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

/// Places of nodes of a cell.
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
} // namespace

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
    EXPECT_THROW(num_nodes(GetParam(), degree), std::invalid_argument);
}

INSTANTIATE_TEST_SUITE_P(AllKinds, OfCells,
                         testing::Values(CellType::triangle,
                                         CellType::quadrilateral,
                                         CellType::tetrahedron,
                                         CellType::hexahedron));

TEST(CellTypes, AreFoundByName)
{
  EXPECT_EQ(cell_type("interval"), CellType::interval);
  EXPECT_EQ(cell_type("hexahedron"), CellType::hexahedron);
  EXPECT_EQ(num_nodes(CellType::interval, 2), 3);
  EXPECT_TRUE(facet_vertices(CellType::interval).empty());
  EXPECT_THROW(cell_type("prism"), std::invalid_argument);
}
