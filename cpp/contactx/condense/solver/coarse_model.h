// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#pragma once

#include "dof_block.h"

namespace contactx::condense
{
/// @brief Stands for soft bodies where stiff ones are solved for.
///
/// Smoothed aggregation gives the soft bodies few unknowns g, with u_c = P g
/// and the stiffness K_g = P^T K_cc P. At each eliminated displacement of
/// theirs, which follows the masters' by R, a spring joins both, of stiffness
/// D. With the springs' forces q as unknowns the matrix
///
///     [ A_mm   0     R^T  ]
///     [  0    K_g   -P^T  ]
///     [  R    -P   -D^-1  ]
///
/// has few entries, where R^T D R would couple all masters of a slave node.
/// All ranks must take part in all of it.
class CoarseModel
{
public:
  /// @brief Make a model of soft bodies, or nothing where there are too few
  /// unknowns to aggregate.
  /// @param[in] numbering Displacements of this rank; it must outlive the
  /// model.
  /// @param[in] soft Displacements of the soft bodies.
  /// @param[in] slave_dofs Displacements of all slave nodes, in order.
  static std::unique_ptr<CoarseModel>
  of(const Numbering& numbering, const DofBlock& soft,
     std::span<const std::int32_t> slave_dofs);

  /// @brief Number of successive unknowns that belong together, those of a node
  /// or of an aggregate; one if there are none such.
  int group() const { return _group; }

  /// @brief The matrix of stiff bodies, the model and the springs.
  /// @param[in] A A_mm, without couplings of what is eliminated; its unknowns
  /// come first.
  /// @param[in] right Eliminated displacements by the others.
  /// @param[in] stiff Displacements of the stiff bodies.
  /// @param[in] eliminated Owned displacements that are eliminated.
  MatrixPtr block(MatrixPtr A, const Matrix& right, const DofBlock& stiff,
                  std::span<const std::int32_t> eliminated) const;

private:
  CoarseModel(const Numbering& numbering, MatrixPtr stiffness, MatrixPtr P,
              const DofBlock& soft, std::vector<std::int32_t> slaves);

  const Numbering& _numbering;
  std::vector<std::int64_t> _rows; // of the soft bodies' slave nodes
  MatrixPtr _stiffness, _P;
  std::vector<double> _springs;
  int _group;
};
} // namespace contactx::condense
