// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#pragma once

#include <limits>
#include <optional>

/// @brief Round-off and the quantities that it is relative to. Tolerances of
/// other quantities have names where they are used.
namespace contactx::math
{
/// @brief Round-off of a sum of a few terms, over the largest one.
inline constexpr double sum_round_off
    = 16 * std::numeric_limits<double>::epsilon();

/// @brief Length, determinant, entry, eigenvalue, cosine, velocity or residual
/// that is zero but for round-off, over its largest terms.
inline constexpr double round_off = 1e-12;

/// @brief Length that is zero up to the error of a solve, over the size of a
/// facet, a search or the scene; difference from a Dirichlet value, over the
/// largest one.
inline constexpr double solved_length_tol = 1e-10;

/// @brief Relative difference of values that are equal in exact arithmetic,
/// such as weights, areas, rigid modes and the times of a rigid motion, up to
/// which they count as equal. From 1e-10 to 1e-8 no scene of 259 differs.
inline constexpr double equal_rel_tol = 1e-9;

/// @brief Part of a length, a direction, an area, a speed or a force that makes
/// no difference: a mesh generator's round-off, and what solvers leave. From
/// 1e-7 to 1e-5 no outcome of 259 scenes differs.
inline constexpr double negligible_part = 1e-6;

/// @brief Stiffness of what stands where nothing resists, over the bulk's: so
/// little that nothing else feels it. From 1e-8 to 1e-6 iterates are the same,
/// by 1e-4 bodies that friction holds take three times as many.
inline constexpr double weak_spring = 1e-6;

/// @brief Whether a value is zero but for round-off.
/// @param[in] value The value.
/// @param[in] terms Size of the largest terms it is made of.
inline bool is_zero(double value, double terms)
{
  return value <= round_off * terms and value >= -round_off * terms;
}

/// @brief Whether a value is as large as the largest one but for round-off.
inline bool is_largest(double value, double largest)
{
  return value >= (1 - equal_rel_tol) * largest;
}

/// @brief Difference of distances up to which they are equal: the order of the
/// facets decides then, not the units or the place of the scene.
/// @param[in] distance Distance of a point from a facet.
/// @param[in] size Size of the facet.
inline double distance_round_off(double distance, double size)
{
  return round_off * (distance + size);
}

/// @brief Scales of the scene in a load step.
struct Scales
{
  double length = 0;    ///< longest side of the box around it
  double farthest = 0;  ///< largest coordinate
  double stiffness = 0; ///< norm of the stiffness of its nodes, force/length
  /// Forces that residuals are relative to, at least; from the step's first
  /// residual on
  std::optional<double> force = {};

  /// @brief Forces that would deform bodies by the size of the scene.
  double deforming_force() const { return stiffness * length; }

  /// @brief Gap up to which nodes touch but for round-off, a length.
  double gap_round_off() const
  {
    return round_off * length + sum_round_off * farthest;
  }
};
} // namespace contactx::math
