// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#pragma once

#include "../mesh/ranks.h"
#include <functional>
#include <span>
#include <vector>

/// @brief Flow of heat, charge or fluid across a contact.
namespace contactx::law
{
/// @brief Derivatives of a coefficient, one value a node (shape=(n)).
struct Gradient
{
  std::vector<double> by_pressure;
  std::vector<double> by_gap;
};

/// @brief Coefficients from pressures (force/area) and gaps (a length) of some
/// nodes, all of which are at least 0 (shape=(n)).
///
/// They must be finite and not negative.
using Function = std::function<std::vector<double>(
    std::span<const double> pressure, std::span<const double> gap)>;

/// @brief Their derivatives, from the same.
using GradientFunction = std::function<Gradient(
    std::span<const double> pressure, std::span<const double> gap)>;

/// @brief Coefficient h(p, g) of the flow across a contact: flow per area and
/// difference of the field.
///
/// Iterates of Newton's method may pull or penetrate: negative pressures and
/// gaps count as zero. Derivatives there are those from the right.
class Coefficient
{
public:
  /// @brief A number.
  /// @throws std::invalid_argument if it is negative or not finite.
  explicit Coefficient(double value);

  /// @brief A function of pressure and gap.
  /// @param[in] function The function; it is not called for no nodes.
  /// @param[in] gradient Its derivatives; central differences if empty. Given
  /// on all ranks or on none.
  /// @throws std::invalid_argument if the function is empty.
  explicit Coefficient(Function function, GradientFunction gradient = {});

  /// @brief Coefficients of some nodes.
  /// @param[in] pressure Pressures (shape=(n)).
  /// @param[in] gap Gaps (shape=(n)).
  /// @return Coefficients (shape=(n)).
  /// @throws std::invalid_argument if a function returns another number of
  /// values, negative ones, or some that are not finite.
  std::vector<double> values(std::span<const double> pressure,
                             std::span<const double> gap) const;

  /// @brief Derivatives of the coefficients; collective.
  ///
  /// Steps of the differences are relative to the largest pressure, or gap, of
  /// all ranks; where that is zero, so is the derivative.
  /// @param[in] pressure Pressures of this rank (shape=(n)).
  /// @param[in] gap Gaps (shape=(n)).
  /// @param[in] ranks The ranks.
  /// @return Derivatives (shape=(n) each).
  /// @throws std::invalid_argument on all ranks as `values` does.
  Gradient gradient(std::span<const double> pressure,
                    std::span<const double> gap, mesh::Ranks& ranks) const;

private:
  std::vector<double> evaluate(std::span<const double> pressure,
                               std::span<const double> gap) const;
  Gradient evaluate_gradient(std::span<const double> pressure,
                             std::span<const double> gap) const;

  double _value = 0;
  Function _function;
  GradientFunction _gradient;
};
} // namespace contactx::law
