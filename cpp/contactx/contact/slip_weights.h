// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#pragma once

#include "mortar_sides.h"

namespace contactx::contact
{
/// @brief kernel::Weights by which slave nodes have their points of the master
/// right before them.
///
/// Where the nodes on the edges of quadratic facets are not in the middle,
/// shape functions take points elsewhere than the parts of the facets do
/// between which integrals are, so that the mean of x_slave - x_master is not
/// along the normal. A slip would have that for a movement. The master's
/// weights are changed by what sums to zero and takes it off; so they measure
/// the same in any frame.
/// @param[in] now kernel::Pairs, divided by the slave nodes' areas.
/// @param[in] sides Both surfaces.
/// @param[in] distances Means of x_slave - x_master (shape=(n, gdim)).
/// @param[in] normals Unit normals (shape=(n, 3)).
/// @param[in] x Positions (shape=(num_nodes, gdim)).
/// @param[in] gdim Geometric dimension.
Mortar slip_weights(Mortar now, const MortarSides& sides,
                    std::span<const double> distances,
                    std::span<const double> normals, std::span<const double> x,
                    int gdim);
} // namespace contactx::contact
