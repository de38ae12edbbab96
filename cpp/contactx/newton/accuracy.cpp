// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#include "accuracy.h"
#include <algorithm>

using namespace contactx::newton;

namespace
{
/// Part of the residual that the next iterate has while the active set changes,
/// at least and at most: a linear solve leaves a tenth of it
constexpr double rough_least = 1e-5, rough_most = 0.1;
/// The same for the first iterate of a step, where a contact has friction
constexpr double exact = 1e-10;
/// Part of the target of solves that leave no gap where a node is closed, for
/// those that do
constexpr double finer = 0.1;
} // namespace

void Accuracy::set(double residual, double tolerance, double changing,
                   bool has_cycled)
{
  const bool settled = has_cycled or changing == 0;
  if (settled and _before > 0)
  {
    const double seen = residual / (_before * _before);
    // What the solve itself has left says no more than that it is not larger
    const bool shown = residual > 10 * _target;
    _curvature = shown ? seen : std::min(seen, _curvature);
  }
  _before = settled ? residual : 0;
  double left = std::min(_curvature * residual * residual, 0.1 * residual);
  if (_has_path and _is_first)
    left = exact * residual;
  else if (not settled)
    left = std::max(left,
                    std::clamp(changing, rough_least, rough_most) * residual);
  // At the end far below the tolerance: errors must not decide between stick
  // and slip
  _target = std::max(0.3 * left, 0.01 * tolerance);
  _finer_target = std::max(finer * _target, 0.01 * tolerance);
  _is_first = false;
  _is_last = _target < 0.1 * tolerance;
}
