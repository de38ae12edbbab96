// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#include <algorithm>
#include <contactx/math/vec.h>
#include <contactx/mesh/nodes.h>
#include <gtest/gtest.h>
#include <numeric>
#include <set>
#include <stdexcept>

using namespace contactx;
using namespace contactx::mesh;

namespace
{
class OfNodes : public testing::TestWithParam<CellType>
{
};

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
    const int dim = dimension(cell), n = num_vertices(cell);
    for (const auto& vertices : node_vertices(cell, order))
    {
      Vector<3> at{};
      for (const int v : vertices)
        for (int k = 0; k < dim; ++k)
          at[k] += (n == dim + 1 ? v == k + 1 : v >> k & 1)
                   / static_cast<double>(vertices.size());
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
} // namespace

TEST_P(OfNodes, AreWhereTheMeshHasThemOrInTheMiddleOfVertices)
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

TEST_P(OfNodes, HaveNumbersThatDoNotDependOnWhereACellBeginsToCount)
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

TEST_P(OfNodes, LevelsAreThoseOfWhatTheyAreTheMiddleOf)
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

TEST_P(OfNodes, FacetsPointOutOfTheirCellWhicheverWayItIsRound)
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

TEST_P(OfNodes, SizesAndNumbersThatDoNotFitAreRefused)
{
  const OneCell one(GetParam(), 1);
  const Geometry geometry = one.geometry();
  EXPECT_THROW(reference_positions(one.cells(), one.size() - 1, geometry),
               std::invalid_argument);
  Geometry other = geometry;
  other.x = other.x.first(3);
  EXPECT_THROW(reference_positions(one.cells(), one.size(), other),
               std::invalid_argument);
  other = geometry;
  other.degree = 2;
  EXPECT_THROW(reference_positions(one.cells(), one.size(), other),
               std::invalid_argument);
  const std::vector<std::int32_t> none, first{0}, beyond{99};
  EXPECT_THROW(facets(one.cells(), first, beyond, geometry),
               std::invalid_argument);
  EXPECT_THROW(facets(one.cells(), beyond, first, geometry),
               std::invalid_argument);
  EXPECT_THROW(facets(one.cells(), first, none, geometry),
               std::invalid_argument);
  EXPECT_THROW(original_nodes(one.cells(), one.size(), geometry, {}, 1),
               std::invalid_argument);
}

INSTANTIATE_TEST_SUITE_P(AllKinds, OfNodes,
                         testing::Values(CellType::triangle,
                                         CellType::quadrilateral,
                                         CellType::tetrahedron,
                                         CellType::hexahedron));
