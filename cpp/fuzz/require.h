// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#pragma once

#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <span>

namespace contactx::fuzz
{
/// @brief End the run where something that must hold does not.
inline void require(bool holds, const char* what)
{
  if (holds)
    return;
  std::fprintf(stderr, "does not hold: %s\n", what);
  std::abort();
}

/// @brief Whether all values are finite.
inline bool all_finite(std::span<const double> values)
{
  for (const double v : values)
    if (!std::isfinite(v))
      return false;
  return true;
}

/// @brief Largest magnitude.
inline double largest(std::span<const double> values)
{
  double most = 0;
  for (const double v : values)
    most = std::max(most, std::abs(v));
  return most;
}

/// @brief Whether a vector has length one.
inline bool is_unit(std::span<const double> v)
{
  double square = 0;
  for (const double c : v)
    square += c * c;
  return std::abs(square - 1) < 1e-9;
}
} // namespace contactx::fuzz
