// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#include <gtest/gtest.h>

#include "saddle.h"

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
  const Eigen::MatrixXd S = dense(blocks.stiffness, 2, 2),
                        T = dense(blocks.traction, 2, 2),
                        C = dense(blocks.constraint, 2, 2);
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
