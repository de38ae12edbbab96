// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#pragma once

#include "../geometry/facets.h"
#include "cell.h"

namespace contactx::mesh
{
/// @brief Cells of this rank, ghosts included, by the nodes of the
/// displacement.
struct Cells
{
  CellType type;
  int degree; ///< of the displacement, 1 or 2
  /// Nodes of the cells (shape=(num_cells, num_nodes(type, degree)))
  std::span<const std::int32_t> nodes;

  /// @brief Nodes of one cell.
  std::span<const std::int32_t> operator[](std::int32_t cell) const
  {
    const auto width = static_cast<std::size_t>(num_nodes(type, degree));
    return nodes.subspan(width * cell, width);
  }

  /// @brief Number of cells.
  std::int32_t size() const
  {
    return static_cast<std::int32_t>(std::ssize(nodes)
                                     / num_nodes(type, degree));
  }

  /// @brief Number of linear parts of a cell.
  int num_parts() const { return degree == 1 ? 1 : 1 << dimension(type); }
};

/// @brief The mesh of the same cells, of any order.
struct Geometry
{
  int gdim;   ///< geometric dimension, 2 or 3
  int degree; ///< order of the mesh
  /// Points of the cells, vertices first (shape=(num_cells, points_per_cell))
  std::span<const std::int32_t> points;
  int points_per_cell;       ///< width of `points`
  std::span<const double> x; ///< positions (shape=(num_points, 3))

  /// @brief Points of one cell.
  std::span<const std::int32_t> operator[](std::int32_t cell) const
  {
    const auto width = static_cast<std::size_t>(points_per_cell);
    return points.subspan(width * cell, width);
  }
};

/// @brief Cells of the linear mesh that has all nodes as its vertices, those of
/// a cell in turn.
/// @return Nodes (shape=(num_cells * num_parts, num_vertices)).
std::vector<std::int32_t> linear_cells(const Cells& cells);

/// @brief Where the nodes of a quadratic displacement are on its facets, see
/// geometry::Shares: 0 at vertices, 1 on edges, 2 elsewhere.
/// @param[in] cells Cells.
/// @param[in] num_nodes Number of nodes.
/// @return Levels (shape=(num_nodes)); empty of degree 1.
std::vector<std::int8_t> node_levels(const Cells& cells,
                                     std::int32_t num_nodes);

/// @brief Reference positions of the nodes.
///
/// They are the mesh's own to the last bit, and do not depend on where a cell
/// begins to count: which of two facets is the nearer one must not depend on
/// the ranks. Nodes that the mesh does not have are in the middle of vertices.
/// @param[in] cells Cells.
/// @param[in] num_nodes Number of nodes.
/// @param[in] geometry The mesh.
/// @return Positions (shape=(num_nodes, gdim)).
std::vector<double> reference_positions(const Cells& cells,
                                        std::int32_t num_nodes,
                                        const Geometry& geometry);

/// @brief Number of each node in the mesh as it was made, the same on any
/// number of ranks.
///
/// Nodes in the middle of vertices get numbers from two of these, unless they
/// are points of the mesh.
/// @param[in] cells Cells.
/// @param[in] num_nodes Number of nodes.
/// @param[in] geometry The mesh.
/// @param[in] numbers Number of each point of the mesh as it was made
/// (shape=(num_points)).
/// @param[in] count More than the largest of these on any rank.
/// @return Numbers (shape=(num_nodes)).
std::vector<std::int64_t> original_nodes(const Cells& cells,
                                         std::int32_t num_nodes,
                                         const Geometry& geometry,
                                         std::span<const std::int64_t> numbers,
                                         std::int64_t count);

/// @brief Facets on the boundary of cells, as their linear parts, oriented: the
/// normal t_1 x t_2 of a facet's local coordinates points out of its cell.
/// @param[in] cells Cells.
/// @param[in] of Cell of each facet (shape=(n)).
/// @param[in] local Number of each facet in its cell (shape=(n)).
/// @param[in] geometry The mesh.
/// @return The parts of the facets in turn.
/// @throws std::invalid_argument if sizes or numbers do not fit.
geometry::Facets facets(const Cells& cells, std::span<const std::int32_t> of,
                        std::span<const std::int32_t> local,
                        const Geometry& geometry);
} // namespace contactx::mesh
