// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#pragma once

#include "../../math/triplets.h"
#include "../../mesh/halo.h"
#include "algebra.h"
#include <memory>
#include <span>
#include <vector>

namespace contactx::condense
{
/// @brief Where the displacements of a rank are in matrices of the bulk.
///
/// A rank's contact entries are in its local numbers: displacements of its own
/// nodes first, then those of nodes of other ranks. All ranks must take part in
/// making it, and in what is not const.
class Numbering
{
public:
  /// @brief Take the numbers of a halo as it is now.
  /// @param[in] halo Nodes of this rank; it must outlive this.
  /// @param[in] algebra What makes matrices; it must outlive this.
  Numbering(const mesh::Halo& halo, Algebra& algebra);

  /// @brief Nodes of this rank.
  const mesh::Halo& halo() const { return _halo; }
  /// @brief The ranks.
  mesh::Ranks& ranks() const { return _halo.ranks(); }
  /// @brief What makes matrices.
  Algebra& algebra() const { return _algebra; }
  /// @brief Geometric dimension.
  int gdim() const { return _halo.gdim(); }
  /// @brief Number of displacements that this rank owns.
  std::size_t num_owned() const { return _num_owned; }
  /// @brief Number of displacements of all nodes.
  std::size_t num_local() const { return _num_local; }

  /// @brief Numbers of displacements in the bulk's matrix.
  std::vector<std::int64_t> numbers(std::span<const std::int32_t> dofs) const;

  /// @brief Give all displacements what their owners have.
  /// @param[in] values Values of owned ones (shape=(num_owned)).
  /// @return Those of all (shape=(num_local)).
  std::vector<double> forward(std::span<const double> values) const;

  /// @brief Add what all ranks have for a displacement on its owner.
  /// @param[in] values What this rank has (shape=(num_local)).
  /// @return Sums at the owned ones (shape=(num_owned)).
  std::vector<double> reverse(std::vector<double> values) const;

  /// @brief Matrix of all displacements by all of them.
  /// @param[in] entries Entries in local numbers.
  MatrixPtr matrix(const Triplets& entries) const;

  /// @brief Matrix of some rows by all displacements.
  /// @param[in] entries Entries in local numbers, none in other rows.
  /// @param[in] rows Owned displacements that its rows stand for, in order.
  MatrixPtr rows(const Triplets& entries,
                 std::span<const std::int32_t> rows) const;

  /// @brief Matrix of some displacements by themselves.
  /// @param[in] entries Entries in local numbers; others are left out.
  /// @param[in] dofs The displacements, owned, in order.
  MatrixPtr square(const Triplets& entries,
                   std::span<const std::int32_t> dofs) const;

private:
  std::vector<std::int64_t> places(std::span<const std::int32_t> dofs) const;
  std::vector<std::int64_t> picked(std::span<const std::int64_t> numbers,
                                   std::span<const std::int32_t> which) const;

  const mesh::Halo& _halo;
  Algebra& _algebra;
  std::size_t _num_owned, _num_local;
  std::vector<std::int64_t> _numbers; // of all displacements
};

/// @brief Numbers from a first one on.
std::vector<std::int64_t> successive(std::int64_t first, std::size_t count);

/// @brief A matrix with nothing but a diagonal.
/// @param[in] algebra What makes it.
/// @param[in] ranks The ranks.
/// @param[in] values The diagonal in this rank's rows.
MatrixPtr diagonal_matrix(Algebra& algebra, mesh::Ranks& ranks,
                          std::span<const double> values);

/// @brief Euclidean norm over all ranks.
double norm(mesh::Ranks& ranks, std::span<const double> x);

/// @brief Scalar product over all ranks.
double dot(mesh::Ranks& ranks, std::span<const double> x,
           std::span<const double> y);
} // namespace contactx::condense
