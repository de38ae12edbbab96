// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#include "generator.h"
#include <algorithm>
#include <array>
#include <cmath>
#include <contactx/math/dense.h>
#include <gtest/gtest.h>
#include <limits>
#include <numbers>
#include <stdexcept>

using namespace contactx;
using namespace contactx::dense;

namespace
{
Matrix random_matrix(tests::Generator& random, std::size_t rows,
                     std::size_t cols)
{
  Matrix A(rows, cols);
  for (double& a : A.values)
    a = random(-1, 1);
  return A;
}

/// Orthogonal matrix by Gram and Schmidt, twice.
Matrix random_rotation(tests::Generator& random, std::size_t n)
{
  Matrix Q = random_matrix(random, n, n);
  for (std::size_t j = 0; j < n; ++j)
  {
    for (int twice = 0; twice < 2; ++twice)
      for (std::size_t k = 0; k < j; ++k)
      {
        double along = 0;
        for (std::size_t i = 0; i < n; ++i)
          along += Q(i, j) * Q(i, k);
        for (std::size_t i = 0; i < n; ++i)
          Q(i, j) -= along * Q(i, k);
      }
    double size = 0;
    for (std::size_t i = 0; i < n; ++i)
      size += Q(i, j) * Q(i, j);
    for (std::size_t i = 0; i < n; ++i)
      Q(i, j) /= std::sqrt(size);
  }
  return Q;
}

void expect_eigen(const Matrix& A, const std::vector<double>& values,
                  double tolerance)
{
  const Eigen found = symmetric_eigen(A);
  const std::size_t n = A.rows;
  ASSERT_EQ(found.values.size(), n);
  const Matrix AV = product(A, found.vectors);
  const Matrix VV = product_transposed(found.vectors, found.vectors);
  for (std::size_t k = 0; k < n; ++k)
  {
    EXPECT_NEAR(found.values[k], values[k], tolerance);
    for (std::size_t i = 0; i < n; ++i)
    {
      EXPECT_NEAR(AV(i, k), found.values[k] * found.vectors(i, k), tolerance);
      EXPECT_NEAR(VV(i, k), i == k, 1e-13);
    }
  }
}

TEST(Dense, EigenvaluesOfTwoByTwo)
{
  Matrix A(2, 2);
  A.values = {2, 1, 1, 2};
  expect_eigen(A, {1, 3}, 1e-15);
  A.values = {1, 0, 0, -5};
  expect_eigen(A, {-5, 1}, 0);
  // Only the lower half is read
  A.values = {2, 99, 1, 2};
  EXPECT_NEAR(symmetric_eigen(A).values[1], 3, 1e-15);
  EXPECT_EQ(symmetric_eigen(Matrix(1, 1)).values, std::vector<double>{0});
  EXPECT_TRUE(symmetric_eigen(Matrix()).values.empty());
}

TEST(Dense, EigenvaluesOfAChainOfSprings)
{
  for (const std::size_t n : {3, 10, 60})
  {
    Matrix A(n, n);
    std::vector<double> values;
    for (std::size_t i = 0; i < n; ++i)
    {
      A(i, i) = 2;
      if (i > 0)
        A(i, i - 1) = A(i - 1, i) = -1;
      values.push_back(2 - 2 * std::cos((i + 1) * std::numbers::pi / (n + 1)));
    }
    expect_eigen(A, values, 1e-13);
  }
}

TEST(Dense, EigenvaluesThatRepeatAndVanish)
{
  tests::Generator random(1);
  for (const std::size_t n : {2, 3, 5, 6, 12, 33})
  {
    const Matrix Q = random_rotation(random, n);
    std::vector<double> values(n);
    // The null space of Gram matrices: a third zero, the others of all sizes
    for (std::size_t k = n / 3; k < n; ++k)
      values[k] = k % 2 == 0 ? 1 : std::pow(10, random(-8, 2));
    std::ranges::sort(values);
    Matrix scaled = Q;
    for (std::size_t i = 0; i < n; ++i)
      for (std::size_t k = 0; k < n; ++k)
        scaled(i, k) *= values[k];
    Matrix A(n, n);
    for (std::size_t i = 0; i < n; ++i)
      for (std::size_t j = 0; j < n; ++j)
        for (std::size_t k = 0; k < n; ++k)
          A(i, j) += scaled(i, k) * Q(j, k);
    expect_eigen(A, values, 1e-12 * std::max(values.back(), 1.0));
  }
}

TEST(Dense, BlocksThatAreApartStayApart)
{
  // Bodies that do not touch: no eigenvector mixes what no row couples
  Matrix A(6, 6);
  for (std::size_t b = 0; b < 3; ++b)
  {
    A(2 * b, 2 * b) = A(2 * b + 1, 2 * b + 1) = 1 + double(b);
    A(2 * b, 2 * b + 1) = A(2 * b + 1, 2 * b) = 1 + double(b);
  }
  expect_eigen(A, {0, 0, 0, 2, 4, 6}, 1e-14);
}

TEST(Dense, Solve)
{
  tests::Generator random(2);
  for (const std::size_t n : {1, 2, 3, 8, 30})
  {
    const Matrix A = random_matrix(random, n, n);
    std::vector<double> x(n);
    for (double& value : x)
      value = random(-1, 1);
    const std::vector<double> found = solve(A, product(A, x));
    for (std::size_t i = 0; i < n; ++i)
      EXPECT_NEAR(found[i], x[i], 1e-11);
  }
  // A pivot of zero
  Matrix A(2, 2);
  A.values = {0, 2, 4, 0};
  EXPECT_EQ(solve(A, std::array{6.0, 8.0}), (std::vector{2.0, 3.0}));
  A.values = {1, 2, 2, 4};
  EXPECT_THROW(solve(A, std::array{1.0, 1.0}), std::domain_error);
}

TEST(Dense, Products)
{
  Matrix A(2, 3), B(3, 2);
  A.values = {1, 2, 3, 4, 5, 6};
  B.values = {1, 0, 0, 1, 1, 1};
  EXPECT_EQ(product(A, B).values, (std::vector<double>{4, 5, 10, 11}));
  EXPECT_EQ(product_transposed(B, B).values, (std::vector<double>{2, 1, 1, 2}));
  EXPECT_EQ(product(A, std::array{1.0, 0.0, -1.0}),
            (std::vector<double>{-2, -2}));
  EXPECT_EQ(product_transposed(A, std::array{1.0, -1.0}),
            (std::vector<double>{-3, -3, -3}));
  const std::size_t last[] = {2, 0};
  EXPECT_EQ(columns(A, last).values, (std::vector<double>{3, 1, 6, 4}));
  EXPECT_EQ(norm(std::array{3.0, 4.0}), 5);
}

TEST(Dense, WhatDoesNotFitIsRefused)
{
  const Matrix A(2, 3);
  const std::size_t none[] = {3};
  EXPECT_THROW(product(A, A), std::invalid_argument);
  EXPECT_THROW(product_transposed(A, Matrix(3, 2)), std::invalid_argument);
  EXPECT_THROW(product(A, std::array{1.0}), std::invalid_argument);
  EXPECT_THROW(product_transposed(A, std::array{1.0}), std::invalid_argument);
  EXPECT_THROW(columns(A, none), std::invalid_argument);
  EXPECT_THROW(symmetric_eigen(A), std::invalid_argument);
  EXPECT_THROW(solve(A, std::array{1.0, 1.0}), std::invalid_argument);
  Matrix B(2, 2);
  B(1, 0) = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW(symmetric_eigen(B), std::invalid_argument);
}
} // namespace
