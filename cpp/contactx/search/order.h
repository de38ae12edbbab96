// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#pragma once

#include <cstdint>
#include <span>
#include <vector>

namespace contactx::search
{
/// @brief Order in which points that are close come soon after each other,
/// along Morton's curve: who visits points in this order finds in the cache
/// what the last ones have read.
/// @param[in] nodes Nodes to order.
/// @param[in] x Node coordinates (shape=(num_nodes, gdim)), row-major.
/// @param[in] gdim Geometric dimension, 2 or 3.
/// @return Places in `nodes`.
std::vector<std::int32_t> spatial_order(std::span<const std::int32_t> nodes,
                                        std::span<const double> x, int gdim);
} // namespace contactx::search
