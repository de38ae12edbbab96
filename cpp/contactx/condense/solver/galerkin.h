// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#pragma once

#include "operator.h"

namespace contactx::condense
{
/// @brief Adds Q^T (T^T K T - K + springs) Q to the matrices of the coarser
/// levels of a hierarchy, T = I + right.
///
/// T differs from one in the rows of constrained displacements e alone: with
/// X = R_e Q, Y = K_e Q and M = X^T (Y + K_ee X / 2) it is M + M^T and the
/// springs, products of few rows, and projected further to coarser levels.
/// Where these displacements need one another the first terms of the series of
/// (I - C)^-1 R_e take the place of R_e. What the turning of normals adds to K
/// is left to the finest level. All ranks must take part in all of it.
class Galerkin
{
public:
  /// @brief Make the projections.
  /// @param[in] numbering Displacements of this rank.
  /// @param[in] slave_rows Rows of the bulk's matrix at the displacements of
  /// all slave nodes.
  /// @param[in] prolongations To the finest level, to the next coarser one, and
  /// so on.
  Galerkin(const Numbering& numbering, MatrixPtr slave_rows,
           std::vector<MatrixPtr> prolongations);

  /// @brief Whether few constrained displacements are others than in the last
  /// update, and there are no springs now or then; the same on all ranks.
  /// @param[in] update What contact changes now.
  /// @param[in] max_change Number of displacements that are constrained only
  /// now or only then, over those constrained now, up to which they are.
  bool serves(const ContactUpdate& update, double max_change) const;

  /// @brief Bring the matrices of the coarser levels from one state of the
  /// contacts to another.
  /// @param[in] update What contact changes now.
  /// @param[in] matrices Matrices of the levels, in the order of the
  /// prolongations.
  void update(const ContactUpdate& update, std::span<const MatrixPtr> matrices);

private:
  Algebra& _algebra;
  mesh::Ranks& _ranks;
  std::vector<MatrixPtr> _prolongations;
  // On the first coarser level: rows of the bulk's matrix at all slave nodes,
  // and what was added last
  MatrixPtr _rows, _added;
  std::vector<std::int32_t> _constrained;
  bool _has_springs = false;
};
} // namespace contactx::condense
