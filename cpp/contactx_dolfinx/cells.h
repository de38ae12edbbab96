// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#pragma once

#include "input.h"
#include <algorithm>
#include <basix/finite-element.h>
#include <contactx/mesh/nodes.h>
#include <contactx/mesh/ranks.h>
#include <dolfinx/common/IndexMap.h>
#include <dolfinx/fem/CoordinateElement.h>
#include <dolfinx/fem/DofMap.h>
#include <dolfinx/mesh/Geometry.h>
#include <vector>

/// @brief Arrays of DOLFINx for the functions of contactx/mesh.
namespace contactx_dolfinx
{
/// @brief Number of this rank's nodes of a space, ghosts included.
inline std::int32_t num_nodes(const FunctionSpace& V)
{
  const auto& map = *V.dofmap()->index_map;
  return map.size_local() + map.num_ghosts();
}

/// @brief Cells of this rank, ghosts included; a view of the space's dofs.
/// @param[in] V Lagrange space of degree 1 or 2, whose blocks of dofs are the
/// nodes.
inline contactx::mesh::Cells cells_of(const FunctionSpace& V)
{
  const auto dofs = V.dofmap()->map();
  return {contactx::mesh::cell_type(
              dolfinx::mesh::to_string(V.mesh()->topology()->cell_type())),
          V.element()->basix_element().degree(),
          {dofs.data_handle(), dofs.size()}};
}

/// @brief Node of a space of numbers at each node of one of vectors of the same
/// degree, on the same mesh (shape=(num_nodes)).
inline std::vector<std::int32_t> matching_nodes(const FunctionSpace& V,
                                                const FunctionSpace& Q)
{
  const auto of_vectors = V.dofmap()->map(), of_numbers = Q.dofmap()->map();
  std::vector<std::int32_t> match(num_nodes(V));
  for (std::size_t c = 0; c < of_vectors.extent(0); ++c)
    for (std::size_t i = 0; i < of_vectors.extent(1); ++i)
      match[of_vectors(c, i)] = of_numbers(c, i);
  return match;
}

/// @brief Whether a space is the continuous scalar Lagrange space of one of
/// some degrees, each 1 or 2.
inline bool is_scalar_lagrange(const FunctionSpace& Q,
                               std::initializer_list<int> degrees)
{
  if (not is_lagrange(Q) or Q.dofmap()->bs() != 1)
    return false;
  const int degree = Q.element()->basix_element().degree();
  return std::ranges::find(degrees, degree) != degrees.end();
}

/// @brief The mesh of these cells; a view of it.
inline contactx::mesh::Geometry
geometry_of(const dolfinx::mesh::Mesh<double>& mesh)
{
  const auto& geometry = mesh.geometry();
  const auto points = geometry.dofmaps().front();
  return {geometry.dim(),
          geometry.cmaps().front().degree(),
          {points.data_handle(), points.size()},
          static_cast<int>(points.extent(1)),
          geometry.x()};
}

/// @brief Numbers of this rank's cells in the mesh as it was made; empty where
/// a mesh was made of another one.
inline std::span<const std::int64_t>
original_cells(const dolfinx::mesh::Mesh<double>& mesh)
{
  const auto& numbers = mesh.topology()->original_cell_index;
  if (numbers.empty())
    return {};
  return numbers.front();
}

/// @brief Reference coordinates of the points of a cell of the mesh
/// (shape=(points_per_cell, tdim)).
inline std::vector<double>
points_of_cell(const dolfinx::mesh::Mesh<double>& mesh)
{
  const auto& map = mesh.geometry().cmaps().front();
  return basix::create_element<double>(
             basix::element::family::P,
             dolfinx::mesh::cell_type_to_basix_type(map.cell_shape()),
             map.degree(), map.variant(), basix::element::dpc_variant::unset,
             false)
      .points()
      .first;
}

/// @brief Reference positions of the nodes of a space, ghosts included, see
/// contactx::mesh::reference_positions (shape=(num_nodes, gdim)).
inline std::vector<double> reference_positions(const FunctionSpace& V)
{
  return contactx::mesh::reference_positions(cells_of(V), num_nodes(V),
                                             geometry_of(*V.mesh()));
}

/// @brief Number of each node in the mesh as it was made, see
/// contactx::mesh::original_nodes (shape=(num_nodes)). All ranks must take
/// part.
/// @param[in] V Lagrange space of degree 1 or 2.
/// @param[in] ranks The ranks.
inline std::vector<std::int64_t> original_nodes(const FunctionSpace& V,
                                                contactx::mesh::Ranks& ranks)
{
  const auto& numbers = V.mesh()->geometry().input_global_indices();
  std::int64_t most = -1;
  for (const std::int64_t number : numbers)
    most = std::max(most, number);
  return contactx::mesh::original_nodes(
      cells_of(V), num_nodes(V), geometry_of(*V.mesh()), numbers,
      contactx::mesh::largest(ranks, most) + 1);
}
} // namespace contactx_dolfinx
