// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#pragma once

#include "nodal.h"

namespace contactx::geometry
{
/// @brief Mark the slave nodes that face their master: their outward normal,
/// averaged over their facets by area, opposes the master's.
///
/// An obstacle has a closest point for every node, also for one on its far
/// side, where it would press the body the wrong way.
/// @param[in] facets Slave facets.
/// @param[in] x Positions (shape=(num_nodes, gdim)), row-major.
/// @param[in] normal Outward normal of the master at each node, zero where
/// there is none, which no node faces (shape=(num_nodes, gdim)).
/// @param[in] gdim Geometric dimension, 2 or 3.
/// @return 1 at the nodes that do, else 0 (shape=(num_nodes)).
/// @throws std::invalid_argument If the sizes do not fit.
std::vector<std::int8_t> facing_nodes(const FacetList& facets,
                                      std::span<const double> x,
                                      std::span<const double> normal, int gdim);

/// @brief Area of each slave node that faces its master.
///
/// A slave surface may go around an edge of its body. The traction acts on the
/// facets in front of the master alone: of a node's facets on those that face
/// it at least half as much as the one that faces it most, by the cosines of
/// their normals. A node without normal, or of which no facet faces the
/// master, keeps all of its area.
/// @param[in] facets Slave facets.
/// @param[in] reference Reference positions, of which the areas are
/// (shape=(num_nodes, gdim)), row-major.
/// @param[in] x Positions (shape=(num_nodes, gdim)).
/// @param[in] normal Outward normal of the master at each node, or zero
/// (shape=(num_nodes, gdim)).
/// @param[in] gdim Geometric dimension, 2 or 3.
/// @param[in] shares What areas are shared out by.
/// @return Area of each corner of each facet, zero where the facet does not
/// face the master there (shape=(facets.nodes.size())).
/// @throws std::invalid_argument If the sizes do not fit.
std::vector<double> facing_areas(const FacetList& facets,
                                 std::span<const double> reference,
                                 std::span<const double> x,
                                 std::span<const double> normal, int gdim,
                                 const Shares& shares = {});
} // namespace contactx::geometry
