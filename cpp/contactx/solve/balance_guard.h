// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#pragma once

#include <cstdint>

namespace contactx::solve
{
/// @brief Tells when nothing will balance the loads on a free body any more.
class BalanceGuard
{
public:
  /// @brief Successive iterates with unbalanced forces and a status that does
  /// not change, after which it gives up.
  static constexpr int max_iterates = 10;

  /// @brief Start a step.
  void begin_step() { *this = {}; }

  /// @brief Take an iterate.
  /// @param[in] is_unbalanced Whether forces on a body are unbalanced.
  /// @param[in] changes Nodes that have changed their status.
  /// @return Whether to give up.
  bool note(bool is_unbalanced, std::int64_t changes)
  {
    if (not is_unbalanced)
      _count = 0;
    else if (changes == 0)
      ++_count;
    return _count >= max_iterates;
  }

private:
  int _count = 0;
};
} // namespace contactx::solve
