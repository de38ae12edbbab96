// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#pragma once

#include "records.h"

namespace contactx::search
{
/// @brief Facets of a slave surface that this rank needs: all around its own
/// nodes. All ranks must take part.
/// @param[in,out] halo Nodes of this rank, to which those of the facets are
/// added for good.
/// @param[in] offsets First node of each facet that this rank has, and end.
/// @param[in] nodes Nodes of these facets.
/// @param[in] level Where nodes are on quadratic facets that these are parts
/// of, see geometry::Shares: all parts of one are needed then; empty otherwise.
/// @return The facets: as they are on one rank, in the order of their keys on
/// several.
geometry::Facets slave_facets(mesh::Halo& halo,
                              std::span<const std::int32_t> offsets,
                              std::span<const std::int32_t> nodes,
                              std::span<const std::int8_t> level = {});

/// @brief Facets in the order of their nodes' numbers in the mesh as it was
/// made, the same on any number of ranks.
/// @param[in] halo Nodes of this rank.
/// @param[in] offsets First node of each facet, and end.
/// @param[in] nodes Nodes of the facets.
geometry::Facets in_order(const mesh::Halo& halo,
                          std::span<const std::int32_t> offsets,
                          std::span<const std::int32_t> nodes);
} // namespace contactx::search
