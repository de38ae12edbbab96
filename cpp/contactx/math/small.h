// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#pragma once

#include <array>
#include <cmath>
#include <utility>

namespace contactx::math
{
/// @brief Square matrix of one node, of which the first rows and columns count.
using Small = std::array<std::array<double, 3>, 3>;

/// @brief Invert a matrix by elimination with partial pivoting.
/// @param[in] n Number of rows.
/// @param[in] A Matrix.
/// @param[out] inverse Its inverse, where it has one.
/// @return Its determinant.
inline double invert(int n, Small A, Small& inverse)
{
  double determinant = 1;
  inverse = {};
  for (int i = 0; i < n; ++i)
    inverse[i][i] = 1;
  for (int k = 0; k < n; ++k)
  {
    int pivot = k;
    for (int i = k + 1; i < n; ++i)
      if (std::abs(A[i][k]) > std::abs(A[pivot][k]))
        pivot = i;
    if (pivot != k)
    {
      std::swap(A[k], A[pivot]);
      std::swap(inverse[k], inverse[pivot]);
      determinant = -determinant;
    }
    determinant *= A[k][k];
    if (A[k][k] == 0)
      return 0;
    for (int i = 0; i < n; ++i)
    {
      const double factor = A[i][k] / A[k][k];
      if (i == k or factor == 0)
        continue;
      for (int j = 0; j < n; ++j)
      {
        A[i][j] -= factor * A[k][j];
        inverse[i][j] -= factor * inverse[k][j];
      }
    }
  }
  for (int i = 0; i < n; ++i)
    for (int j = 0; j < n; ++j)
      inverse[i][j] /= A[i][i];
  return determinant;
}

/// @brief Product of two matrices of n rows.
inline Small product(int n, const Small& A, const Small& B)
{
  Small C{};
  for (int i = 0; i < n; ++i)
    for (int j = 0; j < n; ++j)
      for (int k = 0; k < n; ++k)
        C[i][j] += A[i][k] * B[k][j];
  return C;
}
} // namespace contactx::math
