// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#pragma once

#include "../mesh/bodies.h"
#include <span>

namespace contactx::condense
{
/// Ratio of the stiffnesses of two bodies up to which they count as alike
inline constexpr double alike_stiffness_ratio = 10;

/// @brief Part of a residual that counts for the softest body; collective.
///
/// A residual r of a body of stiffness k leaves an error of its displacements
/// of the size r / k. Where a stiff body is loaded, a small part of its
/// residual is a large force for a soft one. So a linear solve may leave a part
/// of
///
///     sqrt(sum_b (w_b |r_b|)^2),  w_b = min_a k_a / k_b
///
/// over the bodies b, k_b the mean of the bulk's diagonal in a body, and w_b
/// one where that is at least 0.1. Ten times as much in stiff slabs left soft
/// ground between stick and slip for half as many iterations more.
///
/// @param[in] bodies The bodies.
/// @param[in] diagonal The bulk's diagonal at the owned nodes' displacements,
/// zero where they are prescribed (shape=(num_owned, gdim)), row-major.
/// @param[in] residual Residual of the same.
/// @param[in] gdim Geometric dimension.
/// @return That over |r|, at most one; one where the residual is zero.
/// @throws std::invalid_argument on all ranks if an array does not fit on one
/// of them.
double residual_weight(const mesh::Bodies& bodies,
                       std::span<const double> diagonal,
                       std::span<const double> residual, int gdim);
} // namespace contactx::condense
