// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#pragma once

#include <cstdint>
#include <dolfinx/mesh/utils.h>
#include <vector>

namespace contactx_dolfinx
{
/// @brief Make a partitioner that gives each rank as many cells and as much of
/// the contact, for the meshes that DOLFINx creates; see
/// contactx::mesh::parts_with_contact. It makes no ghost cells.
/// @param[in] x Positions of the nodes as they are handed to
/// dolfinx::mesh::create_mesh: on each rank those that it gives, if only none
/// (shape=(n, gdim)), row-major.
/// @param[in] gdim Geometric dimension, 2 or 3.
/// @param[in] near 1 at nodes on surfaces where they may come into contact
/// (shape=(n)).
/// @return A function that throws std::invalid_argument on all ranks if there
/// is more than one kind of cells, or what it is given does not fit.
dolfinx::mesh::CellPartitionFunction
partitioner(std::vector<double> x, int gdim, std::vector<std::int8_t> near);
} // namespace contactx_dolfinx
