// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#pragma once

#include "../contact/slave_nodes.h"
#include "../mesh/mesh.h"

namespace contactx::problem
{
/// @brief Check that facets have an area and are not turned inside out at a
/// corner; all ranks must take part.
/// @param[in] halo Nodes of this rank.
/// @param[in] surface The facets.
/// @param[in] role "slave" or "master".
/// @throws std::invalid_argument on all ranks if a facet of any rank is
/// degenerate.
void check_facets(const mesh::Halo& halo, const mesh::NamedSurface& surface,
                  const std::string& role);

/// @brief Check that a slave surface is not folded onto itself, so that its
/// nodes have a normal; all ranks must take part.
/// @param[in] halo Nodes of this rank.
/// @param[in] slaves Slave nodes.
/// @param[in] name What messages call the surface.
/// @throws std::invalid_argument on all ranks if the normals of the facets at
/// a node of any rank cancel.
void check_folds(const mesh::Halo& halo, const contact::SlaveNodes& slaves,
                 const std::string& name);
} // namespace contactx::problem
