// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#pragma once

#include <cstdint>
#include <span>
#include <vector>

namespace contactx::audit
{
/// @brief Slave nodes that came to the far side of a rigid obstacle in a step.
///
/// A node did whose own normal opposed the obstacle's before the step and does
/// not after it, although it has turned by less than a right angle, while the
/// obstacle's, seen from the node, has turned by more: the body has not rolled
/// off the obstacle but gone through it. A node that slides around an obstacle
/// turns with it and still faces it.
/// @param[in] own_before Nodal normals before (shape=(n, gdim)), row-major.
/// @param[in] own_after Nodal normals after.
/// @param[in] before Normals of the obstacle at the nodes before, as they have
/// turned with it since.
/// @param[in] after Normals of the obstacle at the nodes after.
/// @param[in] gdim Geometric dimension, 2 or 3.
/// @return 1 for nodes that did, else 0 (shape=(n)).
/// @throws std::invalid_argument If the sizes do not fit.
std::vector<std::int8_t> far_side(std::span<const double> own_before,
                                  std::span<const double> own_after,
                                  std::span<const double> before,
                                  std::span<const double> after, int gdim);
} // namespace contactx::audit
