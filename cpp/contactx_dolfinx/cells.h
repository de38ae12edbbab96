// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#pragma once

#include "input.h"
#include <contactx/mesh/nodes.h>
#include <cstdint>
#include <initializer_list>
#include <span>

namespace contactx::mesh
{
class Ranks;
}

/// @brief Arrays of DOLFINx for the functions of contactx/mesh.
namespace contactx_dolfinx
{
/// @brief Number of this rank's nodes of a space, ghosts included.
std::int32_t num_nodes(const FunctionSpace& V);

/// @brief Cells of this rank, ghosts included; a view of the space's dofs.
/// @param[in] V Lagrange space of degree 1 or 2, whose blocks of dofs are the
/// nodes.
contactx::mesh::Cells cells_of(const FunctionSpace& V);

/// @brief Node of a space of numbers at each node of one of vectors of the same
/// degree, on the same mesh (shape=(num_nodes)).
std::vector<std::int32_t> matching_nodes(const FunctionSpace& V,
                                         const FunctionSpace& Q);

/// @brief Whether a space is the continuous scalar Lagrange space of one of
/// some degrees, each 1 or 2.
bool is_scalar_lagrange(const FunctionSpace& Q,
                        std::initializer_list<int> degrees);

/// @brief The mesh of these cells; a view of it.
contactx::mesh::Geometry geometry_of(const dolfinx::mesh::Mesh<double>& mesh);

/// @brief Numbers of this rank's cells in the mesh as it was made; empty where
/// a mesh was made of another one.
std::span<const std::int64_t>
original_cells(const dolfinx::mesh::Mesh<double>& mesh);

/// @brief Reference coordinates of the points of a cell of the mesh
/// (shape=(points_per_cell, tdim)).
std::vector<double> points_of_cell(const dolfinx::mesh::Mesh<double>& mesh);

/// @brief Reference positions of the nodes of a space, ghosts included, see
/// contactx::mesh::reference_positions (shape=(num_nodes, gdim)).
std::vector<double> reference_positions(const FunctionSpace& V);

/// @brief Number of each node in the mesh as it was made, see
/// contactx::mesh::original_nodes (shape=(num_nodes)). All ranks must take
/// part.
/// @param[in] V Lagrange space of degree 1 or 2.
/// @param[in] ranks The ranks.
std::vector<std::int64_t> original_nodes(const FunctionSpace& V,
                                         contactx::mesh::Ranks& ranks);
} // namespace contactx_dolfinx
