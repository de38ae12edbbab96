// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#pragma once

#include "../mesh/ranks.h"
#include <cstdint>
#include <optional>
#include <span>
#include <unordered_map>
#include <vector>

namespace contactx::solve
{
/// @brief Number that stands for the status of all nodes of all contacts and
/// ranks, the same on any machine; collective.
/// @param[in] ranks The ranks.
/// @param[in] status Status of this rank's nodes in each contact.
std::uint64_t
fingerprint(mesh::Ranks& ranks,
            const std::vector<std::span<const std::int8_t>>& status);

/// @brief Shortens steps when the same active set comes back without a smaller
/// residual.
///
/// The residual is piecewise smooth, with a piece for each active set: Newton
/// steps that return to an active set would return to it for ever. A shortened
/// step ends between the pieces and leads out of the cycle. The solution stays
/// the same: full steps follow, and the residual alone decides convergence.
class CycleGuard
{
public:
  /// @brief Fraction of a step that is taken where the active set cycles.
  static constexpr double step_fraction = 0.5;

  /// @brief Start a load step: nothing has been seen yet.
  void begin_step() { *this = {}; }

  /// @brief True if only `step_fraction` of the last step is to be taken. Asked
  /// once a step.
  bool shortens();

  /// @brief Remember an iterate.
  /// @param[in] status Fingerprint of its status.
  /// @param[in] residual Its residual.
  /// @return Whether the active set cycles, so that the next steps are
  /// shortened: two at first, and one more each time.
  bool note(std::uint64_t status, double residual);

  /// @brief Number of times that a status has come back.
  int cycles() const { return _cycles; }

private:
  int _cycles = 0;
  int _short = 0; // number of steps that are still to be shortened
  // Residuals of each status
  std::unordered_map<std::uint64_t, std::vector<double>> _seen;
  std::optional<std::uint64_t> _status;
};
} // namespace contactx::solve
