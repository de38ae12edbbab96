// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>

namespace contactx::solve
{
/// @brief Tells when nothing will balance the loads on a free body any more.
class BalanceGuard
{
public:
  /// @brief Successive iterates with unbalanced forces and a status that does
  /// not change, after which it gives up.
  static constexpr int max_iterates = 10;

  /// @brief Largest residual of these, over that of the step's start, above
  /// which the iterates diverge.
  static constexpr double divergence_ratio = 10;

  /// @brief Start a step.
  void begin_step() { *this = {}; }

  /// @brief Take an iterate.
  /// @param[in] is_unbalanced Whether forces on a body are unbalanced.
  /// @param[in] changes Nodes that have changed their status.
  /// @param[in] residual Residual.
  /// @return Whether to give up. Not while the residual falls: in 3D nodes that
  /// all slip may balance a body by turning their friction.
  bool note(bool is_unbalanced, std::int64_t changes, double residual)
  {
    const bool falls = residual < 0.7 * _before;
    if (std::isinf(_before))
      _first = residual;
    _before = residual;
    if (not is_unbalanced)
      _count = 0, _largest = 0;
    else if (changes == 0)
      ++_count, _largest = std::max(_largest, residual);
    return _count >= max_iterates and not falls;
  }

  /// @brief True if iterates have diverged: where they are, unbalanced forces
  /// say nothing of the loads.
  bool has_diverged() const { return _largest > divergence_ratio * _first; }

private:
  int _count = 0;
  double _first = 0, _largest = 0;
  double _before = std::numeric_limits<double>::infinity();
};
} // namespace contactx::solve
