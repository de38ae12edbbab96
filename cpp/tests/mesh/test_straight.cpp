// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#include "thread_ranks.h"
#include <contactx/mesh/straight.h>
#include <gtest/gtest.h>
#include <numeric>

using namespace contactx;
using namespace contactx::tests;
using contactx::mesh::check_straight;

namespace
{
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
  std::vector<std::string> texts(num_ranks);
  on_ranks(
      num_ranks,
      [&](ThreadRanks& ranks)
      {
        const mesh::Cells cells{
            mesh::CellType::quadrilateral, degree,
            std::span<const std::int32_t>(nodes).first(degree == 2 ? 9 : 4)};
        // The last rank alone has a facet
        const std::vector<std::int32_t> of(ranks.rank() + 1 == ranks.size(), 0);
        const std::vector<std::int32_t> local(of.size(), facet);
        try
        {
          check_straight(ranks, "slave A", cells, {2, 2, nodes, 9, x}, points,
                         of, local);
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

TEST(Straight, CurvedFacetsAreRefusedWhereTheDisplacementIsLinear)
{
  for (const int ranks : {1, 2})
  {
    const std::string text = said_of(ranks, 1, 0.01);
    EXPECT_NE(text.find("slave A is curved: the mesh is of order 2, and 1 of "
                        "these facets have nodes up to 0.01 away"),
              std::string::npos)
        << text;
    EXPECT_NE(text.find("first at (0.5, -0.01)"), std::string::npos) << text;
    EXPECT_EQ(said_of(ranks, 1, 0), "");
    // What a mesh generator rounds
    EXPECT_EQ(said_of(ranks, 1, 1e-7), "");
    // Another one, or a displacement that follows it
    EXPECT_EQ(said_of(ranks, 1, 0.01, 3), "");
    EXPECT_EQ(said_of(ranks, 2, 0.01), "");
  }
}
