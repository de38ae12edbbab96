// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#pragma once

#include "../math/vec.h"
#include "nodal.h"

namespace contactx::geometry
{
/// @brief Normals t_1 x t_2 of a facet, not of unit length, at the corners
/// where they differ; in 2D the third component is zero.
struct CornerNormals
{
  int size;                          ///< 4 for a quadrilateral, else 1
  std::array<Vector<3>, 4> normal{}; ///< of which `size` count

  /// @brief Their mean.
  Vector<3> mean() const;
};

/// @brief Normals of a facet at its corners.
/// @param[in] nodes Nodes of the facet.
/// @param[in] x Node coordinates (shape=(num_nodes, gdim)), row-major.
CornerNormals corner_normals(std::span<const std::int32_t> nodes,
                             std::span<const double> x);

/// @brief Mean of a facet's nodes; in 2D the third component is zero.
/// @param[in] nodes Nodes of the facet.
/// @param[in] x Node coordinates (shape=(num_nodes, gdim)), row-major.
/// @param[in] gdim Geometric dimension, 2 or 3.
Vector<3> middle(std::span<const std::int32_t> nodes, std::span<const double> x,
                 int gdim);

/// @brief Middles of facets and unit normals there.
struct Middles
{
  std::vector<double> points;  ///< (shape=(num_facets, gdim)), row-major
  std::vector<double> normals; ///< zero where a facet has no area, as `points`
};

/// @brief Middles of facets and unit normals there.
/// @param[in] facets Facets of the surface.
/// @param[in] x Node coordinates (shape=(num_nodes, gdim)), row-major.
/// @param[in] gdim Geometric dimension, 2 or 3.
Middles middles(const FacetList& facets, std::span<const double> x, int gdim);
} // namespace contactx::geometry
