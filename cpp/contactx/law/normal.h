// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#pragma once

#include <cstdint>
#include <span>

/// @brief Contact laws, evaluated once a slave node.
namespace contactx::law
{
/// @brief Status of a slave node.
enum Status : std::int8_t
{
  open = 0,
  stick = 1,
  slip = 2 ///< also a closed node without friction
};

/// @brief Normal state of the slave nodes (each array of shape=(num_slaves)).
struct NormalState
{
  std::span<const double> pressure;
  std::span<const double> gap; ///< NaN where a node has no pair
  std::span<const double> c;   ///< complementarity factor, traction/length
};

/// @brief Pressure by which a node is closed, where it is positive.
///
/// Where a node is open it is p - c g (Hueeber & Wohlmuth 2005). Where it is
/// closed a step of Newton's method ends with g = 0 but for what is not linear
/// in g: that opens no node, however large c is against p / g. Slender bodies
/// slide far under small pressures.
inline double pressure_hat(double p, double c, double gap, bool is_closed)
{
  // NaN stays NaN
  return p - c * (is_closed and gap > 0 ? 0 : gap);
}

/// @brief Status that the complementarity asks for: closed where
/// p_hat > 0, else open.
/// @param[in] state Pressures and gaps.
/// @param[in,out] status Status of each node.
/// @return Number of nodes that changed.
std::int32_t normal_status(const NormalState& state,
                           std::span<std::int8_t> status);

/// @brief Complementarity function of the normal direction, times the area:
/// A c g on closed nodes and A p on open ones (Alart & Curnier 1991), both
/// forces.
/// @param[in] state Pressures and gaps.
/// @param[in] area Area of each node.
/// @param[in] status Status of each node.
/// @param[out] value Value.
/// @param[out] d_pressure Derivative with respect to the pressure.
/// @param[out] d_gap Derivative with respect to the gap.
void normal_complementarity(const NormalState& state,
                            std::span<const double> area,
                            std::span<const std::int8_t> status,
                            std::span<double> value,
                            std::span<double> d_pressure,
                            std::span<double> d_gap);
} // namespace contactx::law
