// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#pragma once

#include "../contact/slave_nodes.h"
#include "../geometry/obstacle.h"
#include "../mesh/mesh.h"

namespace contactx::problem
{
/// @brief Check that neither body of a contact lies wholly inside the other
/// one, where nothing can push it out; all ranks must take part.
///
/// Bodies may overlap in part, by however much.
/// @param[in] mesh The mesh.
/// @param[in] slave Slave surface.
/// @param[in] master Master surface.
/// @throws std::invalid_argument on all ranks if one does.
void check_nested(const mesh::Mesh& mesh, const mesh::NamedSurface& slave,
                  const mesh::NamedSurface& master);

/// @brief Check that no slave body lies wholly inside a rigid obstacle; all
/// ranks must take part.
/// @param[in] mesh The mesh.
/// @param[in] slaves Slave nodes.
/// @param[in] name What messages call the slave surface.
/// @param[in] gap Gaps of the owned slave nodes (shape=(n)).
/// @param[in] obstacle The obstacle; an error of it on any rank is thrown on
/// all of them.
/// @throws std::invalid_argument on all ranks if one does.
void check_outside(const mesh::Mesh& mesh, const contact::SlaveNodes& slaves,
                   const std::string& name, std::span<const double> gap,
                   geometry::Obstacle& obstacle);
} // namespace contactx::problem
