// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#pragma once

#include "nodal.h"

namespace contactx::geometry
{
/// @brief Curvature of a surface at its nodes: how much the nodal normal turns
/// to a neighbour, over the distance; the largest.
/// @param[in] facets Facets of the surface.
/// @param[in] x Positions (shape=(num_nodes, gdim)), row-major.
/// @param[in] normal Nodal normals (shape=(num_nodes, gdim)).
/// @param[in] gdim Geometric dimension, 2 or 3.
/// @return Curvatures, 1/length, zero off the surface (shape=(num_nodes)).
/// @throws std::invalid_argument If the sizes do not fit.
std::vector<double> nodal_curvatures(const FacetList& facets,
                                     std::span<const double> x,
                                     std::span<const double> normal, int gdim);

/// @brief Curvature of each facet: turn of a field of normals over the
/// distance from node to node; the largest.
/// @param[in] facets Facets.
/// @param[in] x Positions (shape=(num_nodes, gdim)), row-major.
/// @param[in] normal Unit normals (shape=(num_nodes, gdim)).
/// @param[in] gdim Geometric dimension, 2 or 3.
/// @return Curvatures, 1/length (shape=(num_facets)).
/// @throws std::invalid_argument If the sizes do not fit.
std::vector<double> facet_turns(const FacetList& facets,
                                std::span<const double> x,
                                std::span<const double> normal, int gdim);

/// @brief Longest distance between two nodes of each facet.
/// @param[in] facets Facets.
/// @param[in] x Positions (shape=(num_nodes, gdim)), row-major.
/// @param[in] gdim Geometric dimension, 2 or 3.
std::vector<double> facet_sizes(const FacetList& facets,
                                std::span<const double> x, int gdim);

/// @brief The same, but no more than it was in the reference configuration: a
/// facet that has been stretched resolves no more than before.
/// @param[in] facets Facets.
/// @param[in] x Positions (shape=(num_nodes, gdim)), row-major.
/// @param[in] reference Reference positions of the same nodes.
/// @param[in] gdim Geometric dimension, 2 or 3.
std::vector<double> unstretched_sizes(const FacetList& facets,
                                      std::span<const double> x,
                                      std::span<const double> reference,
                                      int gdim);
} // namespace contactx::geometry
