// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#include <gtest/gtest.h>

#include "dense.h"

using namespace contactx;
using namespace contactx::condense;
using namespace contactx::tests;

TEST(Blocks, SortedFromRows)
{
  // Two displacements and two multipliers
  const std::vector<std::int32_t> offsets{0, 3, 4, 6, 7};
  const std::vector<std::int32_t> columns{0, 1, 3, 2, 0, 2, 1};
  const std::vector<double> values{1, 0, 2, 3, 4, 5, 6};
  const Blocks blocks = sorted({offsets, columns, values}, 2);
  const Dense S(blocks.stiffness, 2, 2), T(blocks.traction, 2, 2),
      C(blocks.constraint, 2, 2);
  // Zeros and what joins multipliers are left out
  EXPECT_EQ(blocks.stiffness.size(), 1u);
  EXPECT_EQ(S(0, 0), 1);
  EXPECT_EQ(blocks.traction.size(), 2u);
  EXPECT_EQ(T(0, 1), 2);
  EXPECT_EQ(T(1, 0), 3);
  EXPECT_EQ(blocks.constraint.size(), 2u);
  EXPECT_EQ(C(0, 0), 4);
  EXPECT_EQ(C(1, 1), 6);
}

TEST(Blocks, ArraysThatAreNoMatrixAreRefused)
{
  const std::vector<std::int32_t> offsets{0, 1, 2}, columns{0, 1};
  const std::vector<double> values{1, 2};
  EXPECT_NO_THROW(sorted({offsets, columns, values}, 1));
  const std::vector<std::int32_t> falling{0, 2, 1}, late{1, 1, 2}, far{0, 2},
      low{0, -1};
  const std::vector<double> few{1};
  EXPECT_THROW(sorted({falling, columns, values}, 1), std::invalid_argument);
  EXPECT_THROW(sorted({late, columns, values}, 1), std::invalid_argument);
  EXPECT_THROW(sorted({{}, columns, values}, 0), std::invalid_argument);
  EXPECT_THROW(sorted({offsets, far, values}, 1), std::invalid_argument);
  EXPECT_THROW(sorted({offsets, low, values}, 1), std::invalid_argument);
  EXPECT_THROW(sorted({offsets, columns, few}, 1), std::invalid_argument);
  EXPECT_THROW(sorted({offsets, columns, values}, 3), std::invalid_argument);
}

TEST(Blocks, ASlaveNodeStandsForOthersOfItsContact)
{
  // Nodes 0 and 1 are slave in the first contact, 2 in the second, 3 is master
  for (const int gdim : {2, 3})
  {
    const Contact first{{0, 1}, {3}, gdim, {1, 1}}, second{{2}, {3}, 1, {2}};
    const std::vector<Nodes> contacts{first.nodes(), second.nodes()};
    const std::vector<std::int8_t> is_slave{1, 0, 1, 0, 0, 1, 0, 0};
    const std::size_t n = 4 * gdim, m = 2 * gdim + 1;
    Generator random(4);
    Blocks blocks;
    Dense C(m, n), T(n, m);
    for (std::size_t i = 0; i < m; ++i)
    {
      const std::size_t home = i < 2u * gdim ? i / gdim : 2;
      for (std::size_t j = 0; j < n; ++j)
      {
        const double c = random(-1, 1), t = random(-1, 1);
        blocks.constraint.add(int(i), int(j), c);
        blocks.traction.add(int(j), int(i), t);
        // The other slave node of the same contact
        const bool is_moved = home < 2 and j / gdim == 1 - home;
        const std::size_t place = is_moved ? home * gdim + j % gdim : j;
        C(i, place) += c;
        T(place, i) += t;
      }
    }
    EXPECT_TRUE(lump(blocks, contacts, is_slave, gdim));
    const Dense found_C(blocks.constraint, m, n),
        found_T(blocks.traction, n, m);
    for (std::size_t i = 0; i < m; ++i)
      for (std::size_t j = 0; j < n; ++j)
      {
        EXPECT_NEAR(found_C(i, j), C(i, j), 1e-15);
        EXPECT_NEAR(found_T(j, i), T(j, i), 1e-15);
      }
    // Now the slave side is diagonal
    EXPECT_FALSE(lump(blocks, contacts, is_slave, gdim));
  }
}
