// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#pragma once

#include <optional>
#include <string>
#include <vector>

namespace contactx::problem
{
/// @brief Energy and momentum at the end of a time step, and the work done in
/// it; the same on all ranks.
///
/// For linear elastic bodies energy is balanced to round-off: kinetic and
/// strain energy grow by work_of_loads + work_of_supports - contact_loss. In a
/// nonlinear body the rest is the error of the midpoint rule. Momentum grows by
/// the impulses of loads, supports and contacts.
struct Balance
{
  double dt = 0;                ///< length of the step, a time
  double kinetic = 0;           ///< kinetic energy at its end
  std::optional<double> strain; ///< strain energy at its end, where it is known
  std::vector<double> momentum; ///< at its end (shape=(gdim))
  /// Moment of momentum about the origin at its end (shape=(1) in 2D,
  /// shape=(3) in 3D)
  std::vector<double> angular_momentum;
  double work_of_loads = 0;    ///< work of loads in the step
  double work_of_supports = 0; ///< work of Dirichlet conditions in the step
  /// Energy that contact has taken in the step, by impact and friction;
  /// negative where rigid obstacles that move have done work, or nodes have
  /// slid over curved or faceted surfaces, which turn in the step
  double contact_loss = 0;
  /// Impulse on the slave side of each contact in the step, impacts included
  /// (shape=(gdim) each); over dt it is the mean force
  std::vector<std::vector<double>> impulse;

  /// @brief Kinetic and, where it is known, strain energy.
  double energy() const { return kinetic + strain.value_or(0); }

  /// @brief The balance as lines of text.
  std::vector<std::string> lines() const;
};
} // namespace contactx::problem
