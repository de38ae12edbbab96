// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#include "soft_path.h"
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>

using namespace contactx;
using namespace contactx::solve;

namespace
{
/// Number of closed nodes that a step must be about to open, and their fraction
/// over the stiffness ratio of the bodies: the softer they are, the fewer
constexpr double opening_nodes_min = 5, opening_fraction_per_stiffness = 10;
/// Stiffness of bodies, over that of their surfaces, from which on the active
/// set converges fast enough: stout bodies in contact over as many as 200 cells
constexpr double stiffness_ratio_max = 0.005;
/// Compliance of a level over that of the next, and the most iterations of a
/// level. With 10 and 2 a beam of 1,600 cells takes up to 47 % more
/// iterations than one of 100, with 20 and 3 up to 31 %
constexpr double compliance_reduction = 20;
constexpr int max_level_iterations = 3;
/// Number of nodes that may still change, over that of closed ones, at the end
/// of a level
constexpr double level_change_fraction = 0.02;
/// Compliance, times the stiffness of the surfaces, below which contact is hard
constexpr double last_compliance = 1;
} // namespace

HardStep contactx::solve::look_at_step(const law::NormalState& state,
                                       std::span<const double> area,
                                       std::span<const std::int8_t> status,
                                       std::span<const double> change)
{
  HardStep step;
  for (std::size_t i = 0; i < status.size(); ++i)
  {
    if (status[i] == law::open)
      continue;
    const double force = area[i] * state.gap[i];
    step.work += force * change[i];
    step.local += force * state.c[i] * state.gap[i];
    step.closed += 1;
    step.opening += state.pressure[i] + change[i] < 0;
  }
  return step;
}

void SoftPath::begin_step() { *this = {}; }

bool SoftPath::begins(const HardStep& step)
{
  if (_has_begun or !(step.local > 0))
    return false;
  _stiffness = std::min(_stiffness, std::abs(step.work) / step.local);
  const double part = opening_fraction_per_stiffness * _stiffness;
  if (!(step.opening > std::max(opening_nodes_min, part * step.closed))
      or !(_stiffness > 0) or _stiffness >= stiffness_ratio_max)
    return false;
  _has_begun = _is_fresh = true;
  _compliance = 1 / _stiffness;
  return true;
}

void SoftPath::advance(std::int64_t changes, std::int64_t closed, bool is_full)
{
  // The iterate at which the path began has not moved
  if (std::exchange(_is_fresh, false) or !(_compliance > 0) or !is_full)
    return;
  ++_iterations;
  if (_iterations < max_level_iterations
      and changes > std::max(1.0, level_change_fraction * closed))
    return;
  _iterations = 0;
  _compliance /= compliance_reduction;
  if (_compliance <= last_compliance)
    harden();
}
