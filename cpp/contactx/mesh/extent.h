// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#pragma once

#include "../math/scales.h"
#include "../math/vec.h"
#include "ranks.h"

namespace contactx::mesh
{
/// @brief Size of the box around points that each rank has some of; all ranks
/// must take part.
/// @param[in] ranks The ranks.
/// @param[in] x Points of this rank (shape=(n, gdim)), row-major.
/// @param[in] gdim Geometric dimension, 2 or 3.
/// @return Lengths, in 2D the third is zero; zero where there are no
/// points.
Vector<3> extent(Ranks& ranks, std::span<const double> x, int gdim);

/// @brief Size of the box around some nodes.
/// @param[in] ranks The ranks.
/// @param[in] nodes Nodes of this rank.
/// @param[in] x Positions of all nodes (shape=(num_nodes, gdim)), row-major.
/// @param[in] gdim Geometric dimension, 2 or 3.
Vector<3> extent(Ranks& ranks, std::span<const std::int32_t> nodes,
                 std::span<const double> x, int gdim);

/// @brief Length of the box around points and their largest coordinate, both
/// zero without points, or where one is infinite.
/// @param[in] ranks The ranks.
/// @param[in] x Points of this rank (shape=(n, gdim)), row-major.
/// @param[in] gdim Geometric dimension, 2 or 3.
math::Scales scales(Ranks& ranks, std::span<const double> x, int gdim);
} // namespace contactx::mesh
