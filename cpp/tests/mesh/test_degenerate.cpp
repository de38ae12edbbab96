// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#include "generator.h"
#include "thread_ranks.h"
#include <contactx/math/vec.h>
#include <contactx/mesh/degenerate.h>
#include <contactx/mesh/extent.h>
#include <contactx/mesh/straight.h>

using namespace contactx;
using namespace contactx::tests;
using mesh::check_straight;
using mesh::corner_determinants;

namespace
{
/// What is said of cells of some ranks, each of which has the first ones as
/// they are and the last one as it is given.
std::string said_of(int num_ranks, mesh::CellType cell,
                    const std::vector<double>& x,
                    const std::vector<std::int32_t>& nodes,
                    bool has_numbers = true)
{
  const int width = mesh::num_vertices(cell);
  return said_on(num_ranks,
                 [&](ThreadRanks& ranks)
                 {
                   // The last rank alone has cells, numbered from behind
                   std::vector<std::int64_t> original;
                   if (ranks.rank() + 1 == ranks.size())
                     for (std::size_t c = nodes.size() / width; c > 0; --c)
                       original.push_back(std::int64_t(c) + 6);
                   mesh::check_cells(
                       ranks, cell, {mesh::dimension(cell), 1, nodes, width, x},
                       static_cast<std::int32_t>(original.size()),
                       has_numbers ? original : std::vector<std::int64_t>());
                 });
}

TEST(Degenerate, DeterminantsOfAWarpedHexahedronAreThoseOfItsMap)
{
  Generator random(1);
  for (const double sign : {1.0, -1.0})
  {
    std::vector<double> x;
    for (int v = 0; v < 8; ++v)
    {
      x.push_back(sign * ((v & 1) + random(-0.2, 0.2)));
      x.push_back(((v >> 1) & 1) + random(-0.2, 0.2));
      x.push_back((v >> 2) + random(-0.2, 0.2));
    }
    const std::vector<double> found
        = corner_determinants(mesh::CellType::hexahedron, x);
    ASSERT_EQ(found.size(), 8u);
    for (int v = 0; v < 8; ++v)
    {
      // Differences of the trilinear map along its axes, where it is linear
      std::array<Vector<3>, 3> t{};
      for (int axis = 0; axis < 3; ++axis)
        for (int w = 0; w < 8; ++w)
          if ((w | 1 << axis) == (v | 1 << axis))
            t[axis]
                = t[axis] + ((w >> axis & 1) ? 1.0 : -1.0) * vector_at(x, w, 3);
      const double volume = dot(t[0], cross(t[1], t[2]));
      EXPECT_NEAR(found[v], volume / (norm(t[0]) * norm(t[1]) * norm(t[2])),
                  1e-14);
      EXPECT_GT(sign * found[v], 0);
    }
  }
}

TEST(Degenerate, TheFirstFlatCellIsNamedOnAllRanks)
{
  const std::vector<double> x{0, 0, 0, 1, 0, 0, 0, 1, 0, 2, 0, 0, 3, 0, 0};
  for (const int ranks : {1, 3})
  {
    const std::string text = said_of(ranks, mesh::CellType::triangle, x,
                                     {0, 1, 2, 0, 1, 3, 1, 3, 4});
    EXPECT_TRUE(text.starts_with("2 cells of the mesh are degenerate")) << text;
    expect_says(text, "The first is at (2, 0) and is cell 7 of");
    expect_says(said_of(ranks, mesh::CellType::triangle, x, {0, 1, 3}, false),
                "The first is at (1, 0): repair");
    // Whichever way round
    EXPECT_EQ(said_of(ranks, mesh::CellType::triangle, x, {0, 1, 2, 1, 0, 2}),
              "");
  }
}

TEST(Degenerate, AQuadrilateralNumberedRoundAboutIsFolded)
{
  const std::vector<double> x{0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0};
  expect_says(said_of(1, mesh::CellType::quadrilateral, x, {0, 1, 2, 3}),
              "row by row, not round about");
  EXPECT_EQ(said_of(1, mesh::CellType::quadrilateral, x, {0, 1, 3, 2}), "");
}

/// A square of order 2 on each rank, whose lower edge bulges by some length.
std::string said_of(int num_ranks, int degree, double by,
                    std::int32_t facet = 0)
{
  const std::vector<double> points{0, 0, 1,   0, 0,   1,   1, 1,   0.5,
                                   0, 0, 0.5, 1, 0.5, 0.5, 1, 0.5, 0.5};
  std::vector<double> x;
  for (std::size_t i = 0; i < points.size(); i += 2)
    x.insert(x.end(), {points[i], points[i + 1], 0});
  x[3 * 4 + 1] = -by;
  std::vector<std::int32_t> nodes(9);
  std::iota(nodes.begin(), nodes.end(), 0);
  return said_on(
      num_ranks,
      [&](ThreadRanks& ranks)
      {
        const mesh::Cells cells{
            mesh::CellType::quadrilateral, degree,
            std::span<const std::int32_t>(nodes).first(degree == 2 ? 9 : 4)};
        // The last rank alone has a facet
        const std::vector<std::int32_t> of(ranks.rank() + 1 == ranks.size(), 0);
        const std::vector<std::int32_t> local(of.size(), facet);
        check_straight(ranks, "slave A", cells, {2, 2, nodes, 9, x}, points, of,
                       local);
      });
}

TEST(Straight, CurvedFacetsAreRefusedWhereTheDisplacementIsLinear)
{
  for (const int ranks : {1, 2})
  {
    const std::string text = said_of(ranks, 1, 0.01);
    expect_says(text, "slave A is curved: the mesh is of order 2, and 1 of "
                      "these facets have nodes up to 0.01 away");
    expect_says(text, "first at (0.5, -0.01)");
    EXPECT_EQ(said_of(ranks, 1, 0), "");
    // What a mesh generator rounds
    EXPECT_EQ(said_of(ranks, 1, 1e-7), "");
    // Another one, or a displacement that follows it
    EXPECT_EQ(said_of(ranks, 1, 0.01, 3), "");
    EXPECT_EQ(said_of(ranks, 2, 0.01), "");
  }
}

using ExtentOnRanks = testing::TestWithParam<int>;

TEST_P(ExtentOnRanks, IsThatOfTheBox)
{
  on_ranks(
      GetParam(),
      [](ThreadRanks& ranks)
      {
        // Rank r has the points (r, -r) and (0, 1)
        const double r = ranks.rank(), last = ranks.size() - 1;
        const std::vector<double> x{r, -r, 0, 1};
        EXPECT_EQ(mesh::extent(ranks, x, 2), (Vector<3>{last, last + 1, 0}));
        // The first of them alone, and one rank has none
        std::vector<std::int32_t> nodes{0};
        if (ranks.rank() == 0 and ranks.size() > 1)
          nodes.clear();
        const double size = std::max(last - 1, 0.0);
        EXPECT_EQ(mesh::extent(ranks, nodes, x, 2), (Vector<3>{size, size, 0}));
        EXPECT_EQ(mesh::extent(ranks, std::vector<double>(), 3), Vector<3>{});
      });
}

TEST_P(ExtentOnRanks, ScalesAreTheLongestSideAndTheLargestCoordinate)
{
  on_ranks(GetParam(),
           [](ThreadRanks& ranks)
           {
             const double r = ranks.rank(), last = ranks.size() - 1;
             std::vector<double> x{r, -r - 7, 0, 1};
             const math::Scales found = mesh::scales(ranks, x, 2);
             EXPECT_EQ(found.length, last + 8);
             EXPECT_EQ(found.farthest, last + 7);
             EXPECT_EQ(mesh::scales(ranks, std::vector<double>(), 3).farthest,
                       0);
             x[0] = ranks.rank() == 0 ? infinity : 0;
             EXPECT_EQ(mesh::scales(ranks, x, 2).farthest, 0);
             EXPECT_EQ(mesh::scales(ranks, x, 2).length, 0);
           });
}

INSTANTIATE_TEST_SUITE_P(Extent, ExtentOnRanks, testing::Values(1, 2, 3, 4));
} // namespace
