// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#pragma once

#include "condensation.h"

namespace contactx::condense
{
/// @brief Springs at masters that stand for the bodies of their slaves.
///
/// A closed slave node has a spring along each axis, its stiffness for each
/// unit of contact area times its contact area. The masters that its
/// eliminated displacements follow share it as they share the displacement, so
/// that no entry off the diagonal couples them. Along directions in which the
/// node slips its masters have the spring, too: without it nothing would hold
/// a body there that lies on others by contact alone.
///
/// @param[in] condensation The contacts of this rank, multipliers eliminated.
/// @param[in] stiffness Stiffness for each unit of area of the displacements
/// of all nodes, zero where a slave node's body needs no spring
/// (shape=(num_local)).
/// @return Springs at the displacements of all nodes, of this rank's slave
/// nodes alone: the sum over all ranks counts (shape=(num_local)).
/// @throws std::invalid_argument if the stiffnesses do not fit.
std::vector<double> master_springs(const Condensation& condensation,
                                   std::span<const double> stiffness);
} // namespace contactx::condense
