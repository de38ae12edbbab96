// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#pragma once

#include "nodes.h"
#include "ranks.h"
#include <string>

namespace contactx::mesh
{
/// @brief Check that the facets of a contact surface are as the displacement
/// has them; all ranks must take part.
///
/// Contact sees a facet at the nodes of the displacement: a linear one
/// straight, a quadratic one curved where the mesh is of order 2. The bulk may
/// be curved elsewhere.
/// @param[in] ranks The ranks.
/// @param[in] name What the message calls the surface.
/// @param[in] cells Cells of this rank.
/// @param[in] geometry The mesh.
/// @param[in] points Reference coordinates of the points of a cell
/// (shape=(points_per_cell, gdim)).
/// @param[in] of Cell of each facet, each on one rank alone (shape=(n)).
/// @param[in] local Number of each facet in its cell (shape=(n)).
/// @throws std::invalid_argument on all ranks if the mesh is of another order
/// than 1 and the degree of the displacement, and a facet of any rank is
/// curved.
void check_straight(Ranks& ranks, const std::string& name, const Cells& cells,
                    const Geometry& geometry, std::span<const double> points,
                    std::span<const std::int32_t> of,
                    std::span<const std::int32_t> local);
} // namespace contactx::mesh
