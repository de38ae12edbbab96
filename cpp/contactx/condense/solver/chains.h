// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#pragma once

#include "numbering.h"

namespace contactx::condense
{
/// @brief Solves (I - C) y = x, C being what eliminations need of one another.
///
/// C joins eliminated displacements of one facet, or of a slave node and its
/// master, so that its factors are sparse. All ranks must take part in all of
/// it.
class Chains
{
public:
  /// @brief Factorise the matrix.
  /// @param[in] numbering Displacements of this rank; it must outlive this.
  /// @param[in] entries Entries of C in local numbers.
  /// @param[in] dofs Owned displacements that its rows and columns stand for,
  /// in order.
  /// @throws NotCondensable on all ranks where the matrix is singular.
  Chains(const Numbering& numbering, const Triplets& entries,
         std::vector<std::int32_t> dofs);

  /// @brief Make a solver, or nothing where no rank has entries.
  static std::unique_ptr<Chains> of(const Numbering& numbering,
                                    const Triplets& entries,
                                    const std::vector<std::int32_t>& dofs);

  /// @brief The matrix C.
  const Matrix& C() const { return *_C; }

  /// @brief Solve in place.
  /// @param[in,out] x Right-hand side, then the solution.
  /// @param[in] transposed Whether with the matrix transposed.
  void solve(std::span<double> x, bool transposed = false);

  /// @brief Solve in place for the values of its displacements.
  /// @param[in,out] values Values of all (shape=(num_owned)).
  /// @param[in] transposed Whether with the matrix transposed.
  void solve_at(std::span<double> values, bool transposed = false);

private:
  std::vector<std::int32_t> _dofs;
  MatrixPtr _C;
  std::unique_ptr<Factors> _factors;
  std::vector<double> _b;
};

/// @brief Make a matrix the first terms of (I - C)^-1 X.
/// @param[in] algebra What multiplies.
/// @param[in,out] X The matrix.
/// @param[in] C What eliminations need of one another.
/// @param[in] is_left Whether of X (I - C)^-1.
void add_terms(Algebra& algebra, Matrix& X, const Matrix& C, bool is_left);
} // namespace contactx::condense
