// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#pragma once

#include "mesh.h"

namespace contactx::mesh
{
/// @brief Nodes that two surfaces share; their facets there may be on
/// different ranks. All ranks must take part.
/// @param[in] nodes Nodes of this rank.
/// @param[in] slave Slave facets of this rank.
/// @param[in] master Master facets of this rank.
/// @return 1 at nodes of both, else 0 (shape=(num_nodes)).
std::vector<std::int8_t> shared_nodes(const NodeMap& nodes,
                                      const geometry::FacetList& slave,
                                      const geometry::FacetList& master);

/// @brief Owned nodes that are at the edge of a surface; all ranks must take
/// part.
/// @param[in] halo Nodes of this rank.
/// @param[in] facets Facets of this rank, each on one rank alone.
/// @return 1 at nodes that are, else 0 (shape=(num_owned)).
std::vector<std::int8_t> edge_nodes(const Halo& halo,
                                    const geometry::FacetList& facets);

/// @brief Check that slave and master share no nodes but those of a crack's
/// tip; all ranks must take part.
///
/// These have no gap, ever, as long as they are on the edge of both surfaces
/// and each facet has another node that the other surface has not.
/// @param[in] halo Nodes of this rank.
/// @param[in] slave Slave surface.
/// @param[in] master Master surface.
/// @throws std::invalid_argument on all ranks if they share others.
void check_shared(const Halo& halo, const NamedSurface& slave,
                  const NamedSurface& master);
} // namespace contactx::mesh
