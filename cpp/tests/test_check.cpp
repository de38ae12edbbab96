// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#include "expect.h"
#include <contactx/check.h>
#include <limits>

using namespace contactx;
using tests::refusal;

namespace
{
using Numbers = std::vector<std::int32_t>;

TEST(Check, Dimensions)
{
  for (const int gdim : {-1, 0, 1, 2, 3, 4})
    EXPECT_EQ(refusal([=] { check::dimension(gdim); }),
              gdim == 2 or gdim == 3
                  ? ""
                  : "gdim must be 2 or 3, not " + std::to_string(gdim));
}

TEST(Check, Facets)
{
  const auto said = [](const Numbers& offsets, const Numbers& nodes, int gdim)
  { return refusal([&] { check::facets(offsets, nodes, gdim, "slave_"); }); };
  EXPECT_EQ(said({0, 3, 7}, {0, 1, 2, 2, 1, 3, 4}, 3), "");
  EXPECT_EQ(said({0, 2}, {5, 0}, 2), "");
  EXPECT_EQ(said({0}, {}, 2), "");
  EXPECT_EQ(said({}, {}, 2), "slave_offsets must begin with 0");
  EXPECT_EQ(said({1, 3}, {0, 1, 2}, 2), "slave_offsets must begin with 0");
  EXPECT_EQ(said({0, 2}, {0, 1, 2}, 2),
            "slave_offsets must end at 3, the number of slave_nodes, not at 2");
  EXPECT_EQ(said({0, 4, 3}, {0, 1, 2}, 3),
            "slave_offsets must give a facet two nodes in 2D, and three or "
            "four in 3D: facet 1 has -1 in 3D");
  EXPECT_EQ(said({0, 3}, {0, 1, 2}, 2),
            "slave_offsets must give a facet two nodes in 2D, and three or "
            "four in 3D: facet 0 has 3 in 2D");
  const std::int32_t most = std::numeric_limits<std::int32_t>::max();
  for (const std::int32_t bad : {-1, most})
    EXPECT_EQ(said({0, 2}, {0, bad}, 2),
              "slave_nodes must be node numbers, from 0 to "
                  + std::to_string(most - 1) + ": there is "
                  + std::to_string(bad));
}

TEST(Check, Positions)
{
  EXPECT_EQ(check::num_nodes(Numbers{}), 0);
  EXPECT_EQ(check::num_nodes(Numbers{3, 7, 0}), 8);
  EXPECT_EQ(refusal([] { check::positions(6, 2, 3); }), "");
  EXPECT_EQ(refusal([] { check::positions(9, 2, 3); }), "");
  for (const int size : {0, 3, 7})
    EXPECT_EQ(refusal([=] { check::positions(size, 2, 3, "x0"); }),
              "x0 must hold 3 coordinates for each of 2 nodes or more: it has "
                  + std::to_string(size) + " values");
  const Numbers offsets{0, 2}, nodes{4, 1};
  EXPECT_EQ(refusal([&] { check::surface(offsets, nodes, 10, 2); }), "");
  EXPECT_EQ(refusal([&] { check::surface(offsets, nodes, 8, 2); }),
            "x must hold 2 coordinates for each of 5 nodes or more: it has 8 "
            "values");
}

TEST(Check, Rows)
{
  EXPECT_EQ(refusal([] { check::rows(6, 2, 3, "xi"); }), "");
  EXPECT_EQ(refusal([] { check::rows(0, 2, 0, "xi"); }), "");
  EXPECT_EQ(refusal([] { check::rows(5, 2, 3, "xi", "point"); }),
            "xi must have 6 values, 3 for each point, not 5");
  // Not the product of two that are negative
  EXPECT_NE(refusal([] { check::rows(6, -2, -3, "xi"); }), "");
}

TEST(Check, NumbersAndRanges)
{
  EXPECT_EQ(refusal([] { check::numbers(Numbers{0, 2}, 3, "f", "facets"); }),
            "");
  for (const std::int32_t bad : {-1, 3})
    EXPECT_EQ(
        refusal([=] { check::numbers(Numbers{0, bad}, 3, "f", "facets"); }),
        "f must be numbers of facets, of which there are 3: there is "
            + std::to_string(bad));
  EXPECT_EQ(
      refusal([] { check::numbers(Numbers{-1, 2}, 3, "f", "facets", -1); }),
      "");
  EXPECT_EQ(refusal([] { check::between(4, 2, 4, "n"); }), "");
  EXPECT_EQ(refusal([] { check::between(2, 2, 4, "n"); }), "");
  EXPECT_EQ(refusal([] { check::between(5, 2, 4, "n"); }),
            "n must be from 2 to 4, not 5");
  EXPECT_EQ(refusal([] { check::between(1, 2, 4, "n"); }),
            "n must be from 2 to 4, not 1");
  EXPECT_EQ(refusal([] { check::require(true, "no"); }), "");
  EXPECT_EQ(refusal([] { check::require(false, "no"); }), "no");
}
} // namespace
