// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#pragma once

#include "master.h"
#include <cmath>

namespace contactx::contact
{
/// Part of a movement along an axis that is free, below which there is no
/// friction along it: a projection over an open gap on a tilted facet is not
/// exactly in a plane of symmetry
inline constexpr double mobile_fraction_min = 0.05;

/// @brief True if an axis is a surface's normal.
/// @param[in] component Of the unit normal along the axis.
constexpr bool is_normal(double component)
{
  return 1 - component * component < mobile_fraction_min * mobile_fraction_min;
}

/// @brief True if an axis is neither along the surface nor along its normal, so
/// that what holds a node along it is no plane of symmetry.
/// @param[in] component Of the unit normal along the axis.
inline bool is_inclined(double component)
{
  return std::abs(component) >= mobile_fraction_min
         and not is_normal(component);
}

/// @brief True if no displacement of some nodes is prescribed.
/// @param[in] nodes The nodes.
/// @param[in] free 1 at displacements of all nodes that are not prescribed
/// (shape=(num_nodes, gdim)).
/// @param[in] gdim Geometric dimension.
bool all_free(std::span<const std::int32_t> nodes,
              std::span<const std::int8_t> free, int gdim);

/// @brief kernel::Weights of a pair's nodes in the relative movement of its
/// slave node: 1, then -N_l of the facet's nodes.
/// @param[in] num_nodes Nodes of the facet: 2, 3 or 4.
/// @param[in] xi Local coordinates, two of them.
/// @param[out] weight The weights (shape=(1 + num_nodes)).
void pair_weights(int num_nodes, const double* xi, double* weight);

/// @brief Sums of squared weights of what may move, where slave nodes gather
/// from several facets: parts with the same node add up first.
/// @param[in] weights Relative movement of the slave nodes.
/// @param[in] free 1 at displacements of all nodes that are not prescribed
/// (shape=(num_nodes, gdim)).
/// @param[in] paired 1 at slave nodes with a pair (shape=(n)).
/// @param[in] gdim Geometric dimension.
/// @return Sums, one where nothing is prescribed (shape=(n, gdim)).
std::vector<double> free_squares(const kernel::Weights& weights,
                                 std::span<const std::int8_t> free,
                                 std::span<const std::int8_t> paired, int gdim);
} // namespace contactx::contact
