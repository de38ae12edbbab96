// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#include "generator.h"
#include "thread_ranks.h"
#include <cmath>
#include <contactx/math/vec.h>
#include <contactx/mesh/degenerate.h>
#include <gtest/gtest.h>

using namespace contactx;
using namespace contactx::tests;
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
  std::vector<std::string> texts(num_ranks);
  on_ranks(num_ranks,
           [&](ThreadRanks& ranks)
           {
             // The last rank alone has cells, numbered from behind
             std::vector<std::int64_t> original;
             if (ranks.rank() + 1 == ranks.size())
               for (std::size_t c = nodes.size() / width; c > 0; --c)
                 original.push_back(std::int64_t(c) + 6);
             try
             {
               mesh::check_cells(
                   ranks, cell, {mesh::dimension(cell), 1, nodes, width, x},
                   static_cast<std::int32_t>(original.size()),
                   has_numbers ? original : std::vector<std::int64_t>());
             }
             catch (const std::invalid_argument& error)
             {
               texts[ranks.rank()] = error.what();
             }
           });
  EXPECT_EQ(texts.front(), texts.back());
  return texts.front();
}
} // namespace

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
    EXPECT_NE(text.find("The first is at (2, 0) and is cell 7 of"),
              std::string::npos)
        << text;
    const std::string without
        = said_of(ranks, mesh::CellType::triangle, x, {0, 1, 3}, false);
    EXPECT_NE(without.find("The first is at (1, 0): repair"), std::string::npos)
        << without;
    // Whichever way round
    EXPECT_EQ(said_of(ranks, mesh::CellType::triangle, x, {0, 1, 2, 1, 0, 2}),
              "");
  }
}

TEST(Degenerate, AQuadrilateralNumberedRoundAboutIsFolded)
{
  const std::vector<double> x{0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0};
  EXPECT_NE(said_of(1, mesh::CellType::quadrilateral, x, {0, 1, 2, 3})
                .find("row by row, not round about"),
            std::string::npos);
  EXPECT_EQ(said_of(1, mesh::CellType::quadrilateral, x, {0, 1, 3, 2}), "");
}
