// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#include <gtest/gtest.h>

#include "saddle.h"

using namespace contactx;
using namespace contactx::condense;
using namespace contactx::tests;

namespace
{
/// Random entries, some places twice, some rows and columns empty
Triplets random_entries(Generator& random, std::size_t rows,
                        std::size_t columns, int count)
{
  Triplets A;
  for (int e = 0; e < count; ++e)
    A.add(static_cast<std::int32_t>(random(0, double(rows))),
          static_cast<std::int32_t>(random(0, double(columns))), random(-1, 1));
  return A;
}
} // namespace

TEST(Triplets, ProductsAreThoseOfDenseMatrices)
{
  Generator random(1);
  for (int count : {0, 5, 40})
  {
    const Triplets A = random_entries(random, 9, 7, count);
    const Triplets B = random_entries(random, 7, 11, count);
    const Triplets AB = product(A, B, 9, 7, 11);
    const Eigen::MatrixXd found = dense(AB, 9, 11);
    const Eigen::MatrixXd wanted = dense(A, 9, 7) * dense(B, 7, 11);
    for (std::size_t i = 0; i < 9; ++i)
      for (std::size_t j = 0; j < 11; ++j)
        EXPECT_NEAR(found(i, j), wanted(i, j), 1e-14);
    // Row by row, each place once and in order
    for (std::size_t e = 1; e < AB.size(); ++e)
      EXPECT_LT(std::pair(AB.rows[e - 1], AB.columns[e - 1]),
                std::pair(AB.rows[e], AB.columns[e]));
  }
}

TEST(Triplets, AProductHasNoZeros)
{
  Triplets A, B;
  A.add(0, 0, 1);
  A.add(0, 1, 1);
  B.add(0, 2, 3);
  B.add(1, 2, -3);
  B.add(1, 1, 2);
  const Triplets AB = product(A, B, 1, 2, 3);
  ASSERT_EQ(AB.size(), 1u);
  EXPECT_EQ(AB.columns[0], 1);
  EXPECT_EQ(AB.values[0], 2);
}

TEST(Triplets, OneEntryForEachPlace)
{
  Generator random(5);
  Triplets A = random_entries(random, 4, 3, 40);
  A.add(2, 1, 0.5 - dense(A, 4, 3)(2, 1));
  A.add(2, 1, -0.5);
  const Eigen::MatrixXd wanted = dense(A, 4, 3),
                        found = dense(merged(A, 4, 3), 4, 3);
  for (std::size_t i = 0; i < 4; ++i)
    for (std::size_t j = 0; j < 3; ++j)
      EXPECT_NEAR(found(i, j), wanted(i, j), 1e-15);
  EXPECT_LE(merged(A, 4, 3).size(), 12u);
}

TEST(Triplets, ProductWithAColumnIsAdded)
{
  Generator random(2);
  const Triplets A = random_entries(random, 6, 8, 30);
  Column x(8), y(6, 1);
  for (double& value : x)
    value = random(-1, 1);
  A.multiply(x, y, -2);
  const Column wanted = product(dense(A, 6, 8), x);
  for (std::size_t i = 0; i < 6; ++i)
    EXPECT_NEAR(y[i], 1 - 2 * wanted[i], 1e-14);
}

TEST(Triplets, JoinedSelectedAndGrouped)
{
  Generator random(3);
  const Triplets A = random_entries(random, 5, 5, 20);
  Triplets both = A;
  both.join(A, -1);
  ASSERT_EQ(both.size(), 40u);
  const Eigen::MatrixXd zero = dense(both, 5, 5);
  for (std::size_t i = 0; i < 5; ++i)
    for (std::size_t j = 0; j < 5; ++j)
      EXPECT_NEAR(zero(i, j), 0, 1e-15);

  const Triplets upper = A.select([](std::int32_t row, std::int32_t column,
                                     double) { return row < column; });
  const Eigen::MatrixXd some = dense(upper, 5, 5), all = dense(A, 5, 5);
  for (std::size_t i = 0; i < 5; ++i)
    for (std::size_t j = 0; j < 5; ++j)
      EXPECT_EQ(some(i, j), i < j ? all(i, j) : 0);

  const Groups rows = grouped(A.rows, 5);
  std::size_t count = 0;
  for (std::int32_t i = 0; i < 5; ++i)
  {
    const auto entries = rows[i];
    EXPECT_TRUE(std::ranges::is_sorted(entries));
    for (const std::int32_t e : entries)
      EXPECT_EQ(A.rows[e], i);
    count += entries.size();
  }
  EXPECT_EQ(count, A.size());
}
