// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#pragma once

#include "system.h"

namespace contactx::solve
{
/// @brief Relative difference of the bulk's stiffness from a difference
/// quotient of its forces; collective. The displacements are those of before
/// at the end.
/// @param[in,out] system The system.
/// @param[in] direction Displacements of the owned nodes, of which prescribed
/// ones do not count (shape=(num_displacements)).
/// @param[in] size Displacement up to which forces are as good as linear.
/// @param[in] ahead Displacement along the direction after which both are
/// taken: forces with kinks, such as those of plastic bodies, have no
/// derivative where these are.
/// @return Norm of the difference of both products with the direction over the
/// larger of their norms, at free displacements; 0 where there is none or it is
/// not finite, and small where the direction is a rigid motion.
double derivative_error(System& system, std::span<const double> direction,
                        double size, double ahead = 0);

/// @brief Smallest of such differences for some sizes and places; collective.
///
/// One size may be too large where a material is about to fail, or too small
/// for round-off. An iterate may lie on kinks of the forces: one of its
/// derivatives there is as right as another, but none is a quotient across the
/// kink.
/// @param[in,out] system The system.
/// @param[in] direction Displacements of the owned nodes
/// (shape=(num_displacements)).
/// @param[in] extent Size of the scene.
double least_derivative_error(System& system, std::span<const double> direction,
                              double extent);

/// @brief Difference of a Jacobian from the derivative that is no round-off.
constexpr double wrong_derivative = 1e-3;
} // namespace contactx::solve
