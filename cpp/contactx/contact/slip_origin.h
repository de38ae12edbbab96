// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#pragma once

#include "touching.h"
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace contactx::contact
{
/// @brief Where slip starts in small sliding: the movement of each slave node
/// relative to its master, of which slip is the change.
class SlipOrigin
{
public:
  /// @brief Measure from a movement on, at a step's start or as it was saved.
  /// @param[in] moved Means of u_slave - u_master (shape=(n, gdim)).
  void start(std::vector<double> moved) { _moved = std::move(moved); }

  /// @brief Measure from where nodes touch.
  /// @param[in] which 1 at those slave nodes (shape=(n)).
  /// @param[in] apart Means of X_slave - X_master (shape=(n, gdim)).
  /// @param[in] moved Means of u_slave - u_master at the iterate that closes
  /// them (shape=(n, gdim)).
  /// @param[in] normals Unit normals (shape=(n, 3)).
  /// @param[in] offset Offset, a length that is taken off the gap (shape=(n)).
  void touch(std::span<const std::int8_t> which, std::span<const double> apart,
             std::span<const double> moved, std::span<const double> normals,
             std::span<const double> offset)
  {
    if (which.empty())
      return;
    const std::size_t g = moved.size() / which.size();
    for (std::size_t i = 0; i < which.size(); ++i)
    {
      if (not which[i])
        continue;
      double before = -offset[i], after = -offset[i];
      for (std::size_t k = 0; k < g; ++k)
      {
        const double n = normals[3 * i + k], rest = apart[g * i + k];
        before += n * (rest + _moved[g * i + k]);
        after += n * (rest + moved[g * i + k]);
      }
      const double part = touching(before, after);
      for (std::size_t k = g * i; k < g * (i + 1); ++k)
        _moved[k] += part * (moved[k] - _moved[k]);
    }
  }

  /// @brief The movement (shape=(n, gdim)); empty before the first step.
  const std::vector<double>& moved() const { return _moved; }

private:
  std::vector<double> _moved;
};
} // namespace contactx::contact
