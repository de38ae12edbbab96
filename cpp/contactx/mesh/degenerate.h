// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#pragma once

#include "nodes.h"
#include "ranks.h"

namespace contactx::mesh
{
/// @brief Determinants of the unit tangents of a cell at its corners: one of a
/// simplex, which has the same at all; 0 where an edge has no length.
/// @param[in] cell Type of the cell, of the dimension of space.
/// @param[in] x Its vertices (shape=(num_vertices, gdim)).
/// @return Determinants (shape=(c)).
std::vector<double> corner_determinants(CellType cell,
                                        std::span<const double> x);

/// @brief Check that cells have a volume and are not turned inside out at some
/// of their corners; all ranks must take part.
///
/// Which way round a cell is numbered does not matter.
/// @param[in] ranks The ranks.
/// @param[in] cell Type of the cells.
/// @param[in] geometry The mesh.
/// @param[in] num_owned Number of cells that this rank owns, which come first.
/// @param[in] original Numbers in the mesh as it was made (shape=(at least
/// num_owned)); empty on all ranks where they are not known.
/// @throws std::invalid_argument on all ranks if a cell of any rank is
/// degenerate.
void check_cells(Ranks& ranks, CellType cell, const Geometry& geometry,
                 std::int32_t num_owned,
                 std::span<const std::int64_t> original);
} // namespace contactx::mesh
