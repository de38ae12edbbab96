// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#pragma once

#include "assembler.h"
#include <functional>

namespace contactx_dolfinx
{
/// @brief Let a fluid spread along a surface from where it enters up to closed
/// contacts, as they are now, see contactx::results::wetted_nodes; all ranks
/// must take part.
///
/// What is wetted is a factor of the fluid's pressure in the residual. Call it
/// between steps, and solve again while it returns true.
/// @param[in] assembler The bodies and the contacts that stop the fluid.
/// @param[in] surface Facets that may be wetted, of all bodies.
/// @param[in] enters Whether the fluid enters at a vertex, by its reference
/// position: on each body that it wets.
/// @param[in,out] wet 1 at vertices that are wetted, 0 at others; of the scalar
/// linear Lagrange space on the displacement's mesh.
/// @return Whether it has changed on any rank.
/// @throws std::invalid_argument on all ranks if `wet` is of another space, or
/// the surface does not fit.
bool penetrate(const Assembler& assembler, const Surface& surface,
               const std::function<bool(const contactx::Vector<3>&)>& enters,
               Function& wet);
} // namespace contactx_dolfinx
