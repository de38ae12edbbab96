// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#pragma once

#include "../math/vec.h"
#include <algorithm>

/// @brief Search for the master facet of each slave node.
namespace contactx::search
{
/// @brief Axis-aligned box in three dimensions; a plane problem leaves the
/// third extent at zero.
struct Box
{
  Vector<3> lower;
  Vector<3> upper;

  /// @brief A box that holds nothing.
  static constexpr Box empty()
  {
    return {{infinity, infinity, infinity}, {-infinity, -infinity, -infinity}};
  }

  /// @brief Grow the box so that it holds `p`.
  constexpr void add(const Vector<3>& p)
  {
    for (int k = 0; k < 3; ++k)
    {
      lower[k] = std::min(lower[k], p[k]);
      upper[k] = std::max(upper[k], p[k]);
    }
  }

  /// @brief Grow the box so that it holds `b`.
  constexpr void add(const Box& b)
  {
    for (int k = 0; k < 3; ++k)
    {
      lower[k] = std::min(lower[k], b.lower[k]);
      upper[k] = std::max(upper[k], b.upper[k]);
    }
  }

  /// @brief Squared distance from `p`, zero inside.
  constexpr double distance2(const Vector<3>& p) const
  {
    double d2 = 0;
    for (int k = 0; k < 3; ++k)
    {
      const double d = std::max({lower[k] - p[k], p[k] - upper[k], 0.0});
      d2 += d * d;
    }
    return d2;
  }

  /// @brief Squared distance of the farthest corner from `p`.
  constexpr double farthest2(const Vector<3>& p) const
  {
    double d2 = 0;
    for (int k = 0; k < 3; ++k)
    {
      const double d = std::max(p[k] - lower[k], upper[k] - p[k]);
      d2 += d * d;
    }
    return d2;
  }

  /// @brief Largest height over the plane through `p` across `normal`.
  constexpr double height(const Vector<3>& p, const Vector<3>& normal) const
  {
    double most = 0;
    for (int k = 0; k < 3; ++k)
      most += normal[k] * ((normal[k] > 0 ? upper : lower)[k] - p[k]);
    return most;
  }
};
} // namespace contactx::search
