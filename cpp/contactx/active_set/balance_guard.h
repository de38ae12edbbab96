// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#pragma once

#include <cstdint>
#include <limits>

namespace contactx::active_set
{
/// @brief Tells when nothing will balance the loads on a free body any more.
class BalanceGuard
{
public:
  /// @brief Iterates with unbalanced forces and settled status after which it
  /// gives up.
  static constexpr int most = 10;

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
    _before = residual;
    if (not is_unbalanced)
      _count = 0;
    else if (changes == 0)
      ++_count;
    return _count >= most and not falls;
  }

private:
  int _count = 0;
  double _before = std::numeric_limits<double>::infinity();
};
} // namespace contactx::active_set
