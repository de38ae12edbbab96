// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#pragma once

#include <span>
#include <vector>

namespace contactx::tests
{
/// @brief Conductance of touching asperities, and of a gas in the gap.
/// @param[in] p Pressures (shape=(n)).
/// @param[in] gap Gaps (shape=(n)).
inline std::vector<double> asperities(std::span<const double> p,
                                      std::span<const double> gap)
{
  std::vector<double> h(p.size());
  for (std::size_t i = 0; i < h.size(); ++i)
    h[i] = 3 * p[i] * p[i] + 0.5 / (1 + gap[i] / 0.2);
  return h;
}
} // namespace contactx::tests
