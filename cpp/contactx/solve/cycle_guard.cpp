// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#include "cycle_guard.h"
#include <algorithm>
#include <array>
#include <cmath>

using namespace contactx;
using namespace contactx::solve;

namespace
{
/// Relative difference of residuals up to which two iterates are the same
constexpr double equal_residual_rel_tol = 1e-3;

/// Mix the bits of a number (Steele, Lea & Flood, Fast splittable pseudorandom
/// number generators, OOPSLA 2014).
std::uint64_t mixed(std::uint64_t z)
{
  z += 0x9e3779b97f4a7c15;
  z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9;
  z = (z ^ (z >> 27)) * 0x94d049bb133111eb;
  return z ^ (z >> 31);
}
} // namespace

std::uint64_t contactx::solve::fingerprint(
    mesh::Ranks& ranks, const std::vector<std::span<const std::int8_t>>& status)
{
  // Two ranks that swap their status are no cycle
  auto mine = mixed(static_cast<std::uint64_t>(ranks.rank()));
  for (const auto& nodes : status)
  {
    mine = mixed(mine ^ nodes.size());
    // Eight nodes at a time
    for (std::size_t i = 0; i < nodes.size(); i += 8)
    {
      std::uint64_t word = 0;
      for (std::size_t k = i; k < std::min(i + 8, nodes.size()); ++k)
        word = word << 8 | static_cast<std::uint8_t>(nodes[k]);
      mine = mixed(mine ^ word);
    }
  }
  // Halves, as sums of signed numbers must not overflow
  std::array<std::int64_t, 2> halves{
      static_cast<std::int64_t>(mine >> 32),
      static_cast<std::int64_t>(mine & 0xffffffff)};
  if (ranks.size() > 1)
    ranks.reduce(std::span<std::int64_t>(halves), mesh::Reduction::sum);
  return (static_cast<std::uint64_t>(halves[0]) << 32)
         + static_cast<std::uint64_t>(halves[1]);
}

bool CycleGuard::shortens()
{
  if (_short == 0)
    return false;
  --_short;
  return true;
}

bool CycleGuard::note(std::uint64_t status, double residual)
{
  std::vector<double>& before = _seen[status];
  bool again = false;
  if (status == _status)
    // It may converge slowly; with the same residual slip chatters
    again = std::ranges::any_of(
        before, [residual](double r)
        { return std::abs(residual - r) < equal_residual_rel_tol * r; });
  else if (not before.empty())
    again = residual > step_fraction * std::ranges::min(before);
  _status = status;
  before.push_back(residual);
  if (not again or _short > 0)
    return false;
  ++_cycles;
  // Longer each time
  _short = 1 + _cycles;
  _seen.clear();
  return true;
}
