// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#pragma once

#include <cstddef>
#include <span>
#include <vector>

/// @brief Algebra of small dense matrices, such as those of the rigid modes of
/// a few bodies.
namespace contactx::dense
{
/// @brief A matrix, row-major.
struct Matrix
{
  Matrix() = default;

  /// @brief Create a matrix of zeros.
  Matrix(std::size_t rows, std::size_t cols)
      : rows(rows), cols(cols), values(rows * cols)
  {
  }

  double& operator()(std::size_t i, std::size_t j)
  {
    return values[i * cols + j];
  }
  double operator()(std::size_t i, std::size_t j) const
  {
    return values[i * cols + j];
  }

  /// @brief One of its rows.
  std::span<const double> row(std::size_t i) const
  {
    return std::span(values).subspan(i * cols, cols);
  }

  std::size_t rows = 0, cols = 0;
  std::vector<double> values; ///< shape=(rows, cols)
};

/// @brief A B.
/// @throws std::invalid_argument if the sizes do not fit.
Matrix product(const Matrix& A, const Matrix& B);

/// @brief A^T B.
/// @throws std::invalid_argument if the sizes do not fit.
Matrix product_transposed(const Matrix& A, const Matrix& B);

/// @brief A x.
/// @throws std::invalid_argument if the sizes do not fit.
std::vector<double> product(const Matrix& A, std::span<const double> x);

/// @brief A^T x.
/// @throws std::invalid_argument if the sizes do not fit.
std::vector<double> product_transposed(const Matrix& A,
                                       std::span<const double> x);

/// @brief Some columns of a matrix.
/// @param[in] A The matrix.
/// @param[in] which The columns.
/// @throws std::invalid_argument if one is not there.
Matrix columns(const Matrix& A, std::span<const std::size_t> which);

/// @brief Euclidean norm.
double norm(std::span<const double> x);

/// @brief Eigenvalues of a symmetric matrix, ascending, and orthonormal
/// eigenvectors.
struct Eigen
{
  std::vector<double> values;
  Matrix vectors; ///< in its columns
};

/// @brief Eigenvalues and eigenvectors of a symmetric matrix.
///
/// By Householder's tridiagonal form and QL with implicit shifts (Bowdler,
/// Martin, Reinsch & Wilkinson, Numer. Math. 11, 1968): errors of the values
/// are about round-off times the largest one.
/// @param[in] A The matrix, of which the lower half is read.
/// @throws std::invalid_argument if it is not square, or has a value that is
/// not finite.
Eigen symmetric_eigen(const Matrix& A);

/// @brief Solve A x = b by elimination with partial pivots.
/// @param[in] A A square matrix.
/// @param[in] b Right-hand side.
/// @throws std::invalid_argument if the sizes do not fit.
/// @throws std::domain_error if the matrix is singular.
std::vector<double> solve(Matrix A, std::span<const double> b);
} // namespace contactx::dense
