// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#pragma once

#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

/// @brief Cells and facets of a mesh whose displacement is of degree 1 or 2.
///
/// Contact sees a quadratic displacement at its nodes: cells and facets are
/// split at the middles of their edges into linear ones. Vertices and nodes of
/// a cell are numbered as in Basix and UFCx, the vertices first.
namespace contactx::mesh
{
/// @brief Kinds of cells; an interval is one of a part of a mesh, without
/// facets.
enum class CellType : std::int8_t
{
  interval,
  triangle,
  quadrilateral,
  tetrahedron,
  hexahedron
};

/// @brief Kind of a cell by its name, such as "triangle".
/// @throws std::invalid_argument if it is none of those above.
CellType cell_type(std::string_view name);

/// @brief Dimension of a cell.
int dimension(CellType cell);

/// @brief Number of the vertices of a cell.
int num_vertices(CellType cell);

/// @brief Vertices of each facet of a cell; none of an interval.
const std::vector<std::vector<int>>& facet_vertices(CellType cell);

/// @brief Vertices whose middle each node of a cell is at.
/// @param[in] cell The cell.
/// @param[in] degree Degree of the displacement, 1 or 2.
/// @throws std::invalid_argument if the degree is another one.
const std::vector<std::vector<int>>& node_vertices(CellType cell, int degree);

/// @brief Nodes of a cell.
/// @throws std::invalid_argument if the degree is neither 1 nor 2.
int num_nodes(CellType cell, int degree);

/// @brief Linear functions of the vertices of a cell at points in it.
/// @param[in] cell The cell.
/// @param[in] points Reference coordinates (shape=(n, dimension)).
/// @return Values (shape=(n, num_vertices)).
std::vector<double> linear_shape(CellType cell, std::span<const double> points);

/// @brief Linear parts of a cell.
/// @param[in] cell The cell.
/// @param[in] degree Degree of the displacement, 1 or 2.
/// @return Nodes of the parts among those of the cell (shape=(num_parts,
/// num_vertices)); of degree 1 the cell itself.
std::vector<int> cell_parts(CellType cell, int degree);

/// @brief Linear parts of a facet of a cell.
/// @param[in] cell The cell.
/// @param[in] degree Degree of the displacement, 1 or 2.
/// @param[in] facet Number of the facet in the cell.
/// @param[in] is_turned Whether its normal, t_1 x t_2 of its local coordinates,
/// is turned around.
/// @return Nodes of the parts among those of the cell (shape=(num_parts,
/// vertices of the facet)); of degree 1 the facet itself.
std::vector<int> facet_parts(CellType cell, int degree, int facet,
                             bool is_turned);
} // namespace contactx::mesh
