// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#include "step_length.h"
#include "../math/scales.h"
#include <algorithm>
#include <cmath>

using namespace contactx::solve;

namespace
{
/// Trials of a damped step; the last one is taken
constexpr int max_trials = 6;
/// Successive steps without progress that end the loop
constexpr int max_negligible_steps = 3;
/// Bounds of the length of a trial step over the one before
constexpr double step_ratio_min = 0.1, step_ratio_max = 0.5;
} // namespace

void StepLength::begin_step(bool damped, double extent)
{
  *this = {};
  _is_damped = damped;
  _extent = extent;
}

void StepLength::begin(double size, double within_cells)
{
  _part = 1;
  _trials = 0;
  if (not std::isfinite(size))
    return;
  _size = size;
  _part = _within_cells = within_cells;
  _limited += within_cells < 1;
  if (_is_damped and (_changes or size > math::solved_length_tol * _extent))
    _trials = max_trials;
  else
    end();
}

void StepLength::judge(double next_size)
{
  if (_trials == 0)
    return;
  if (next_size <= (1 - _part / 4) * _size)
  {
    end();
    return;
  }
  double shorter = step_ratio_min;
  if (not std::isinf(next_size))
  {
    // It is (1 - t) times this one, and a part that grows with the square of t
    const double square
        = _size > 0
              ? 2 * std::abs(next_size / _size - (1 - _part)) / (_part * _part)
              : 0;
    shorter = square > 0 ? 1 / (square * _part) : 1;
  }
  _part *= std::min(std::max(shorter, step_ratio_min), step_ratio_max);
  if (--_trials == 0)
    end();
}

void StepLength::end()
{
  _trials = 0;
  _damped += _part < _within_cells;
  _tiny = _part < negligible_step ? _tiny + 1 : 0;
}

bool StepLength::is_stuck() const { return _tiny >= max_negligible_steps; }
