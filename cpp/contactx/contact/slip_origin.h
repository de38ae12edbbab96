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
/// @brief Where slip starts in small sliding: the way from the master to each
/// slave node, of which slip is the change.
class SlipOrigin
{
public:
  /// @brief Measure from a way on, at a step's start or as it was saved.
  /// @param[in] way Means of x_slave - x_master (shape=(n, gdim)).
  void start(std::vector<double> way) { _way = std::move(way); }

  /// @brief Measure from where nodes touch.
  /// @param[in] which 1 at those slave nodes (shape=(n)).
  /// @param[in] way Means of x_slave - x_master at the iterate that closes them
  /// (shape=(n, gdim)).
  /// @param[in] normals Unit normals (shape=(n, 3)).
  /// @param[in] offset Offset, a length that is taken off the gap (shape=(n)).
  void touch(std::span<const std::int8_t> which, std::span<const double> way,
             std::span<const double> normals, std::span<const double> offset)
  {
    if (which.empty())
      return;
    const std::size_t g = way.size() / which.size();
    for (std::size_t i = 0; i < which.size(); ++i)
    {
      if (not which[i])
        continue;
      double before = -offset[i], after = -offset[i];
      for (std::size_t k = 0; k < g; ++k)
      {
        before += normals[3 * i + k] * _way[g * i + k];
        after += normals[3 * i + k] * way[g * i + k];
      }
      const double part = touching(before, after);
      for (std::size_t k = g * i; k < g * (i + 1); ++k)
        _way[k] += part * (way[k] - _way[k]);
    }
  }

  /// @brief The way (shape=(n, gdim)); empty before the first step.
  const std::vector<double>& way() const { return _way; }

private:
  std::vector<double> _way;
};
} // namespace contactx::contact
