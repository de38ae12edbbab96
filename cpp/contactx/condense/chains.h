// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#pragma once

#include "../parallel/ranks.h"
#include "elimination.h"

/// @brief What the eliminations of all ranks are together. All ranks must take
/// part in each of these.
namespace contactx::condense
{
/// @brief Mark some displacements wherever they are known.
/// @param[in] nodes Nodes of this rank.
/// @param[in] dofs Displacements that it owns.
/// @param[in] gdim Geometric dimension.
/// @return 1 at those of all nodes' displacements that their owners have given,
/// else 0 (shape=(num_local)).
std::vector<std::int8_t> marks(const parallel::NodeMap& nodes,
                               std::span<const std::int32_t> dofs, int gdim);

/// @brief Mark the slave nodes of each contact wherever they are known.
/// @param[in] nodes Nodes of this rank.
/// @param[in] contacts The contacts.
/// @return 1 where a node is slave in a contact, else 0 (shape=(num_nodes,
/// num_contacts)).
std::vector<std::int8_t> slave_marks(const parallel::NodeMap& nodes,
                                     std::span<const Nodes> contacts);

/// @brief Check that no elimination needs another one.
/// @param[in] elimination That of this rank.
/// @param[in] nodes Nodes of this rank.
/// @throws NotCondensable on all ranks, where a node is slave in one contact
/// and master in another.
void check_chains(const Elimination& elimination,
                  const parallel::NodeMap& nodes);

/// @brief Whether no node sticks or slips, and `left` is the transpose of
/// `right` but for eliminated rows and rounding, entry by entry: what is lumped
/// from several entries into one place is not compared by its sum.
/// @param[in] elimination That of this rank.
/// @param[in] nodes Nodes of this rank.
/// @return The same on all ranks.
bool is_symmetric(const Elimination& elimination,
                  const parallel::NodeMap& nodes);
} // namespace contactx::condense
