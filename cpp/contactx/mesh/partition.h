// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#pragma once

#include "ranks.h"
#include <cstdint>
#include <span>
#include <vector>

namespace contactx::mesh
{
/// @brief Nodes as they are handed to whoever makes a mesh: each rank has some
/// of them, numbered through rank after rank.
struct InputNodes
{
  std::span<const double> x; ///< positions (shape=(n, gdim)), row-major
  int gdim;                  ///< 2 or 3
  /// 1 at those at contact, where surfaces may touch (shape=(n))
  std::span<const std::int8_t> at_contact;
};

/// @brief Part of each cell, such that all parts have about as many cells, and
/// as much of the contact; collective.
///
/// Search, integrals and condensation go with the contact, all else with the
/// cells: each phase waits for who has most of it. The cells are halved by a
/// plane, and the halves again. A plane across the contact that halves the
/// cells can be turned until it halves the contact, too, as on its way round
/// both sides change places (Stone and Tukey 1942). It contains the direction
/// in which the contact extends least, so that both bodies' sides of it go to
/// one part. Cells with too little contact to share are halved across their
/// longest extent.
/// @param[in] ranks The ranks.
/// @param[in] cells Vertices of this rank's cells, by their numbers among the
/// nodes of all ranks (shape=(num_cells, width)), row-major.
/// @param[in] width Vertices a cell.
/// @param[in] nodes This rank's share of the nodes.
/// @param[in] parts Number of parts.
/// @return shape=(num_cells).
/// @throws std::invalid_argument on all ranks if the arrays do not fit, or a
/// vertex is not among the nodes.
std::vector<std::int32_t>
parts_with_contact(Ranks& ranks, std::span<const std::int64_t> cells, int width,
                   const InputNodes& nodes, int parts);
} // namespace contactx::mesh
