// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#pragma once

#include <cstdint>
#include <span>
#include <vector>

namespace contactx::mesh
{
/// @brief Convex hulls of the vertices of cells of one kind.
///
/// By Caratheodory a point of the hull is in the simplex of some of its
/// vertices, whatever the kind of the cell.
class Hull
{
public:
  /// @brief Prepare for cells of a kind.
  /// @param[in] num_vertices Vertices of a cell, at least gdim + 1.
  /// @param[in] gdim Geometric dimension, 2 or 3.
  /// @throws std::invalid_argument if these do not fit.
  Hull(int num_vertices, int gdim);

  /// @brief True if a point is in the hull of a cell, the boundary included.
  /// @param[in] point Point (shape=(gdim)).
  /// @param[in] vertices Nodes of the cell's vertices (shape=(num_vertices)).
  /// @param[in] x Positions of all nodes (shape=(num_nodes, gdim)), row-major.
  /// @param[in] tolerance How negative a barycentric coordinate may be.
  bool contains(std::span<const double> point,
                std::span<const std::int32_t> vertices,
                std::span<const double> x, double tolerance);

private:
  int _num_vertices, _gdim;
  // Vertices of the faces, gdim each, and the faces opposite to the vertices
  // of the simplices, gdim + 1 each
  std::vector<int> _faces, _simplices;
  std::vector<double> _arms, _volumes; // scratch
};
} // namespace contactx::mesh
