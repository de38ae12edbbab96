// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#include "accuracy.h"
#include <algorithm>

using namespace contactx::solve;

namespace
{
/// Part of the residual that an iterate leaves at most while the active set
/// changes
constexpr double next_residual_max = 0.1;
/// The upper bound in a step's first iterate. What is left of a prescribed
/// displacement is large against the forces of contact: it would decide which
/// nodes close
constexpr double first_residual_max = 1e-3;
/// What a solve may leave over the forces of the problem, than which the
/// residual is far larger where bodies are far from balance: errors decide
/// which nodes close, and with friction which stick. Long beams without
/// friction take the same iterations from 1 to 100, and are not solved by 1000
constexpr double forces_left = 30, forces_left_friction = 1;
/// Residual of a linear solve over that of the next iterate
constexpr double solve_fraction = 0.3;
/// Residual of the last solves over Newton's tolerance: far less with friction,
/// as errors must not decide between stick and slip
constexpr double last_solve_fraction = 0.1, last_solve_fraction_friction = 0.01;
/// Residual of a step's first solve over that of its iterate, with friction
constexpr double first_solve_fraction_friction = 1e-10;
} // namespace

void Accuracy::set(double residual, double tolerance, double changing,
                   double forces, bool has_cycled)
{
  const bool settled = has_cycled or changing == 0;
  if (settled and _before > 0)
  {
    const double seen = residual / (_before * _before);
    // A residual as small as the linear solve leaves is an upper bound only
    const bool shown = residual > 10 * _target;
    _curvature = shown ? seen : std::min(seen, _curvature);
  }
  _before = settled ? residual : 0;
  double left = std::min(_curvature * residual * residual, 0.1 * residual);
  if (_has_path and _solves == 0)
    left = first_solve_fraction_friction * residual;
  else if (not settled)
  {
    const double most = _solves == 0 ? first_residual_max : next_residual_max;
    left = std::max(left, std::min(changing, most) * residual);
    left = std::min(left,
                    (_has_path ? forces_left_friction : forces_left) * forces);
  }
  // Where Newton's method leaves less than the tolerance, errors of the solve
  // alone could make another iterate necessary
  if (left <= tolerance)
    left = 0;
  const double least
      = (_has_path ? last_solve_fraction_friction : last_solve_fraction)
        * tolerance;
  _target = std::max(solve_fraction * left, least);
  ++_solves;
  _is_last = _target <= last_solve_fraction * tolerance;
}
