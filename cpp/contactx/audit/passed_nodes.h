// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#pragma once

#include "../geometry/nodal.h"
#include "findings.h"

namespace contactx::audit
{
/// @brief Find the nodes that pass through a surface in a step, see `passed`;
/// all ranks must take part.
///
/// Nothing is searched where there is no candidate on any rank, and only boxes
/// where candidates and facets do not come near each other. All arrays are
/// row-major.
/// @param[in] halo Nodes of this rank.
/// @param[in] own Facets of the candidates' surface that this rank has.
/// @param[in] facets Facets of the other surface that this rank has.
/// @param[in] x0 Positions of all nodes at the step's start (shape=(num_nodes,
/// gdim)).
/// @param[in] x1 Positions at its end (shape=(num_nodes, gdim)).
/// @param[in] candidates Nodes that this rank owns.
/// @param[in] tolerance Depth that each may be behind the surface and still be
/// on it, larger than zero, the same on all ranks.
/// @return The nodes, and where the first of them is at the end.
FoundNodes passed_nodes(const mesh::Halo& halo, const geometry::FacetList& own,
                        const geometry::FacetList& facets,
                        std::span<const double> x0, std::span<const double> x1,
                        std::span<const std::int32_t> candidates,
                        double tolerance);

/// @brief Area times normal, and area, of the owned nodes.
struct AreaVectors
{
  std::vector<double> vectors; ///< shape=(num_owned, gdim)
  std::vector<double> areas;   ///< shape=(num_owned)
};

/// @brief Area vectors of a surface at owned nodes, to which the facets that
/// other ranks have around them count; all ranks must take part.
/// @param[in] halo Nodes of this rank.
/// @param[in] own Facets that this rank has.
/// @param[in] x Positions of all nodes (shape=(num_nodes, gdim)), row-major.
/// @return Area vectors and areas, zero off the surface.
AreaVectors area_vectors_of_all(const mesh::Halo& halo,
                                const geometry::FacetList& own,
                                std::span<const double> x);

/// @brief Unit normals of a surface at owned nodes, to which the facets that
/// other ranks have around them count; all ranks must take part.
/// @param[in] halo Nodes of this rank.
/// @param[in] own Facets that this rank has.
/// @param[in] x Positions of all nodes (shape=(num_nodes, gdim)), row-major.
/// @return Normals, zero off the surface (shape=(num_owned, gdim)).
std::vector<double> normals_of_all(const mesh::Halo& halo,
                                   const geometry::FacetList& own,
                                   std::span<const double> x);

/// @brief Mean unit normals of a surface at the nodes of this rank, to which
/// the facets that other ranks have around them count; all ranks must take
/// part.
/// @param[in] halo Nodes of this rank.
/// @param[in] own Facets that this rank has.
/// @param[in] x Positions of all nodes (shape=(num_nodes, gdim)), row-major.
/// @return Normals, zero off the surface and at its edges, see
/// geometry::cosine_at_edges (shape=(num_nodes, gdim)).
std::vector<double> even_normals(const mesh::Halo& halo,
                                 const geometry::FacetList& own,
                                 std::span<const double> x);
} // namespace contactx::audit
