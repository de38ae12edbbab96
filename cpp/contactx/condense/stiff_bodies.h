// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#pragma once

#include "../mesh/bodies.h"
#include "condensation.h"

namespace contactx::condense
{
/// @brief Tells stiff bodies from soft ones by what they show at their
/// contacts, a stiffness for each unit of area; collective.
///
/// Of each body this is the sum of the bulk's diagonal over the sum of the
/// contact areas, over the nodes whose contacts are closed. The widest gap
/// between the bodies' stiffnesses parts them, if it is a factor of 10 at
/// least. A body without closed contact counts as stiff.
///
/// No body is stiff where that gap is too narrow, or a stiff body's node is
/// slave of a soft one: condensation folds the slave's stiffness into its
/// master, so that the two cannot be parted.
///
/// @param[in] condensation The contacts, multipliers eliminated.
/// @param[in] bodies The bodies.
/// @param[in] diagonal The bulk's diagonal at the owned nodes' displacements,
/// zero where they are prescribed (shape=(num_owned)).
/// @return 1 for each stiff body, 0 for each soft one, in the order of their
/// names, the same on all ranks (shape=(num_bodies)).
/// @throws std::invalid_argument on all ranks if the diagonal does not fit on
/// one of them.
std::vector<std::int8_t> stiff_bodies(const Condensation& condensation,
                                      const mesh::Bodies& bodies,
                                      std::span<const double> diagonal);
} // namespace contactx::condense
