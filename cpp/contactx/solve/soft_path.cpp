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
/// Number of closed nodes that a step must be about to open, and part of them
/// over the stiffness of the bodies: the softer they are, the fewer
constexpr double least = 5, per_stiffness = 10;
/// Stiffness of bodies, over that of their surfaces, from which on the active
/// set settles fast enough: stout bodies in contact over as many as 200 cells
constexpr double stiff = 0.005;
/// By how much a level is harder than the one before, and the most iterations
/// that it takes. With 10 and 2 a beam of 1,600 cells takes up to 47 % more
/// iterations than one of 100, with 20 and 3 up to 31 %
constexpr double harder = 20;
constexpr int most_iterations = 3;
/// Part of the closed nodes that may still change where a level has settled
constexpr double settled = 0.02;
/// The last level is softer than this: the surfaces are no harder
constexpr double last = 1;
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
  const double part = per_stiffness * _stiffness;
  if (!(step.opening > std::max(least, part * step.closed)) or !(_stiffness > 0)
      or _stiffness >= stiff)
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
  if (_iterations < most_iterations
      and changes > std::max(1.0, settled * closed))
    return;
  _iterations = 0;
  _compliance /= harder;
  if (_compliance <= last)
    harden();
}
