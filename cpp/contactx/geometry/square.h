// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#pragma once

#include "../math/vec.h"

namespace contactx::geometry
{
/// @brief Matrix of N rows.
template <int N>
using Square = std::array<Vector<N>, N>;

/// @brief Inverse of a symmetric positive matrix, by Cholesky's factors.
/// @param[in] m The matrix.
/// @param[out] inverse Its inverse.
/// @return False where the matrix is not positive.
template <int N>
bool invert(const Square<N>& m, Square<N>& inverse)
{
  Square<N> L{};
  for (int i = 0; i < N; ++i)
    for (int j = 0; j <= i; ++j)
    {
      double s = m[i][j];
      for (int k = 0; k < j; ++k)
        s -= L[i][k] * L[j][k];
      if (i == j)
      {
        if (not(s > 0))
          return false;
        L[i][i] = std::sqrt(s);
      }
      else
        L[i][j] = s / L[j][j];
    }
  for (int c = 0; c < N; ++c)
  {
    Vector<N> y{};
    y[c] = 1;
    for (int i = 0; i < N; ++i)
    {
      for (int k = 0; k < i; ++k)
        y[i] -= L[i][k] * y[k];
      y[i] /= L[i][i];
    }
    for (int i = N; i-- > 0;)
    {
      for (int k = i + 1; k < N; ++k)
        y[i] -= L[k][i] * y[k];
      y[i] /= L[i][i];
    }
    inverse[c] = y;
  }
  return true;
}
} // namespace contactx::geometry
