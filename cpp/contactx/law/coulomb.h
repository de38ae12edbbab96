// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#pragma once

#include "normal.h"

namespace contactx::law
{
/// @brief State of the slave nodes with friction: one value a node, or vectors
/// (shape=(num_slaves, gdim)), row-major.
struct FrictionalState
{
  int gdim;
  std::span<const double> traction; ///< multiplier, vectors
  std::span<const double> gap;      ///< NaN where a node has no pair
  std::span<const double> normal;   ///< unit vectors
  std::span<const double> slip;     ///< increment of the step, vectors
  std::span<const double> c;        ///< complementarity factor
  /// Coefficient of friction: derivative of the bound by p_hat
  std::span<const double> friction;
  /// Bound of |t|, a traction; friction times p_hat if empty
  std::span<const double> bound = {};
  /// Its derivative by the length of the slip increment; zero if empty
  std::span<const double> bound_by_slip = {};
  /// Complementarity factor along the surface, as a part of c
  double along = 1;
};

/// @brief Complementarity function and its derivatives, forces: vectors and
/// matrices (shape=(num_slaves, gdim, gdim)), row-major.
struct FrictionalLaw
{
  std::span<double> value;
  std::span<double> by_traction; ///< matrices
  std::span<double> by_gap;      ///< vectors
  std::span<double> by_slip;     ///< matrices
  std::span<double> by_normal;   ///< matrices
};

/// @brief Status that Coulomb's law asks for.
///
/// With p_hat of the normal law and t_hat = t - c_t ds, c_t being c times
/// `along`: open where p_hat <= 0,
/// else stick where |t_hat| <= mu p_hat > 0, else slip (Alart & Curnier 1991;
/// there p_hat = p - c g, see `pressure_hat`). A node
/// whose trial friction opposes t sticks first, if t_hat is not too long; at a
/// solution both agree.
/// @param[in] state State.
/// @param[in] reach Length of t_hat, over mu p_hat, up to which it does.
/// @param[in,out] status Status of each node.
/// @return Number of nodes that changed.
std::int32_t frictional_status(const FrictionalState& state, double reach,
                               std::span<std::int8_t> status);

/// @brief Complementarity function of contact with Coulomb friction, times the
/// area: A lambda on open nodes, A c (g n + ds) on sticking ones and
/// A (c g n + t - mu p_hat t_hat / |t_hat|) on slipping ones, with consistent
/// derivatives (Alart & Curnier 1991; Hueeber & Wohlmuth 2005).
///
/// A bound of another law, tau(p_hat, |ds|), takes the place of mu p_hat.
///
/// Directions in which neither the slave node nor its master can move carry
/// no friction: there t takes the place of what is written after g n.
/// @param[in] state State.
/// @param[in] area Area of each node.
/// @param[in] status Status of each node.
/// @param[in] mobile 1 in directions that can move, else 0, vectors.
/// @param[out] law Value and derivatives.
void frictional_complementarity(const FrictionalState& state,
                                std::span<const double> area,
                                std::span<const std::int8_t> status,
                                std::span<const double> mobile,
                                const FrictionalLaw& law);
} // namespace contactx::law
