// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#pragma once

#include <cstdint>
#include <limits>
#include <span>

namespace contactx::mesh
{
/// @brief Smallest det F of cells, and how many are turned inside out.
struct DeformedCells
{
  /// Smallest det F, infinity where there is none
  double smallest = std::numeric_limits<double>::infinity();
  std::int32_t cell = -1;    ///< the first cell that has it, -1 without cells
  std::int64_t inverted = 0; ///< number of cells with det F <= 0 somewhere
};

/// @brief Find the smallest det F = det(dx/dxi) / det(dX/dxi) of linear,
/// bilinear and trilinear cells, and the cells that are turned inside out.
///
/// X are the reference positions and x = X + u the current ones. Which way
/// round a cell is numbered does not matter.
///
/// - Triangles and tetrahedra: F is constant. Both answers are exact.
/// - Quadrilaterals: both determinants are linear in xi, so that their ratio is
///   smallest at a corner. det F is taken at the 4 corners; both answers are
///   exact.
/// - Hexahedra: both determinants are of degree two in each variable. det F is
///   taken at 27 points: the 8 corners, the middles of the 12 edges and of the
///   6 faces, and the centre. A value <= 0 proves a cell inverted. det(dx/dxi)
///   is a sum of Bernstein polynomials, which are positive, with 27
///   coefficients that follow from its 27 values exactly: one sign of all of
///   them proves a cell sound throughout. Where neither is so, the cell is
///   halved along each axis, again and again, until each part is proven sound
///   or has a corner with det F <= 0; the corners of the parts then count as
///   points, too. What is still open when parts are 1/256 of an edge long, or
///   after 512 of them, counts as sound: its det F nearly vanishes somewhere.
///   So the count is exact but for those, and `smallest` is the smallest at the
///   points; in between det F may be smaller, but not negative.
///
/// "Exact" means up to round-off, of which det F has as much as the edges of
/// cells have. A det(dx/dxi) that is not finite counts as det F of minus
/// infinity. det F is not evaluated where the reference cell has no volume, and
/// between the points of a hexahedron not where the reference cell is folded.
///
/// @param[in] cells Nodes of the cells, in DOLFINx's order
/// (shape=(num_cells, nodes_per_cell)), row-major.
/// @param[in] nodes_per_cell 3 or 4 in 2D: triangles or quadrilaterals; 4 or 8
/// in 3D: tetrahedra or hexahedra.
/// @param[in] X Reference positions (shape=(num_nodes, gdim)), row-major.
/// @param[in] u Displacements, as many as positions or more.
/// @param[in] gdim Geometric dimension, 2 or 3.
/// @throws std::invalid_argument if there are no such cells, a size is wrong or
/// a node does not exist.
DeformedCells deformed_cells(std::span<const std::int32_t> cells,
                             int nodes_per_cell, std::span<const double> X,
                             std::span<const double> u, int gdim);

/// @brief Find the fraction of an increment that squeezes no cell too much.
///
/// det F is evaluated where `deformed_cells` does, but not between the 27
/// points of hexahedra. Along X + u + t du it is a polynomial in t; from t = 0
/// on it must stay above a part of what it is there, or of 1 if it is more.
/// Cells that are inside out at t = 0 are left out.
///
/// @param[in] cells Nodes of the cells, as above.
/// @param[in] nodes_per_cell As above.
/// @param[in] X Reference positions.
/// @param[in] u Displacements at t = 0, as many as positions or more.
/// @param[in] du The polynomial, as many as displacements.
/// @param[in] gdim Geometric dimension, 2 or 3.
/// @param[in] part Part of min(det F, 1) that must be left, of [0, 1).
/// @return The largest such t, at most 1; it is too small by 1/1024 of it at
/// most.
/// @throws std::invalid_argument as above, if `du` is shorter than `u` or the
/// part is out of its range.
double max_step_without_inversion(std::span<const std::int32_t> cells,
                                  int nodes_per_cell, std::span<const double> X,
                                  std::span<const double> u,
                                  std::span<const double> du, int gdim,
                                  double part);
} // namespace contactx::mesh
