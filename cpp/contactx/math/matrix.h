// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#pragma once

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <optional>
#include <span>
#include <stdexcept>

/// @brief Small matrices are Eigen's. Headers that programs include do without
/// them: what is installed needs no Eigen.
namespace contactx::math
{
/// @brief Matrix of up to three rows and columns, as arrays hold it.
using Small = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic,
                            Eigen::RowMajor, 3, 3>;

/// @brief Values as a column.
inline Eigen::Map<const Eigen::VectorXd> column(std::span<const double> values)
{
  return {values.data(), static_cast<Eigen::Index>(values.size())};
}

/// @brief Eigenvalues of a symmetric matrix, ascending, and orthonormal
/// eigenvectors.
/// @param[in] A The matrix, of one row at least.
/// @throws std::invalid_argument if it has values that are not finite.
template <class Matrix>
Eigen::SelfAdjointEigenSolver<Matrix> symmetric_eigen(const Matrix& A)
{
  if (not A.allFinite())
    throw std::invalid_argument("a matrix has values that are not finite");
  return Eigen::SelfAdjointEigenSolver<Matrix>(A);
}

/// @brief Inverse of a symmetric matrix, nothing where it is not positive or
/// not finite.
template <class Matrix>
std::optional<Matrix> positive_inverse(const Matrix& A)
{
  const Eigen::LLT<Matrix> factors(A);
  if (factors.info() != Eigen::Success or not A.allFinite())
    return std::nullopt;
  return factors.solve(Matrix::Identity());
}
} // namespace contactx::math
