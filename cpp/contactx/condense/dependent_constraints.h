// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#pragma once

#include "../mesh/ranks.h"
#include "elimination.h"

/// @brief Chains of eliminations: displacements that are eliminated by others
/// that are eliminated, too, over all ranks. All ranks must take part in each
/// of these.
namespace contactx::condense
{
/// @brief Mark some displacements wherever they are known.
/// @param[in] nodes Nodes of this rank.
/// @param[in] dofs Displacements that it owns.
/// @param[in] gdim Geometric dimension.
/// @return 1 at those of all nodes' displacements that their owners have given,
/// else 0 (shape=(num_local)).
std::vector<std::int8_t> marks(const mesh::NodeMap& nodes,
                               std::span<const std::int32_t> dofs, int gdim);

/// @brief Entries by which eliminations need one another; see Elimination.
struct DependentConstraints
{
  Triplets right; ///< of `right` between two eliminated displacements
  Triplets left;  ///< of `left` between two rows that give multipliers
};

/// @brief Find what eliminations need of one another.
/// @param[in] elimination That of this rank.
/// @param[in] nodes Nodes of this rank.
/// @return This rank's entries, in its numbers.
DependentConstraints dependent_constraints(const Elimination& elimination,
                                           const mesh::NodeMap& nodes);

/// @brief Whether no node sticks or slips, and `left` is the transpose of
/// `right` but for round-off.
/// @param[in] elimination That of this rank.
/// @param[in] nodes Nodes of this rank.
/// @return The same on all ranks.
bool is_symmetric(const Elimination& elimination, const mesh::NodeMap& nodes);
} // namespace contactx::condense
