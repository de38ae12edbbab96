// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#pragma once

#include "dependent_constraints.h"

namespace contactx::condense
{
/// @brief Diagonal with which the matrix (I + right)^T K (I + right) has no
/// larger eigenvalue than K has with its own; all ranks must take part.
///
/// With K <= lambda D_K and displacements sum_l T_sl v_l, T = I + right,
/// Cauchy's inequality gives D = sum_s D_s (sum_l |T_sl|) |T_s|.
/// @param[in] elimination That of this rank.
/// @param[in] nodes Nodes of this rank.
/// @param[in] diagonal Diagonal of K, not negative (shape=(num_owned)).
/// @return D (shape=(num_owned)).
std::vector<double> bound(const Elimination& elimination,
                          const mesh::NodeMap& nodes,
                          std::span<const double> diagonal);

/// @brief Springs without rows and columns of eliminated displacements; all
/// ranks must take part.
/// @param[in] elimination That of this rank.
/// @param[in] nodes Nodes of this rank.
/// @param[in] soft Springs of soft nodes, (dof, dof).
/// @param[in] diagonal Springs of single displacements (shape=(num_owned)), or
/// nothing.
/// @return Entries (dof, dof).
Triplets elastic(const Elimination& elimination, const mesh::NodeMap& nodes,
                 const Triplets& soft, std::span<const double> diagonal);
} // namespace contactx::condense
