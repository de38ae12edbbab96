// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#include "accuracy.h"
#include <algorithm>

using namespace contactx::solve;

namespace
{
/// Part of the residual that the next iterate has while the active set changes,
/// at least and at most
constexpr double rough_least = 1e-5, rough_most = 0.1;
/// Part of it that a linear solve leaves
constexpr double part = 0.3;
/// How many solves of a step are finer, and by how much: rougher ones do not
/// show that the bodies are slender
constexpr int num_first = 2;
constexpr double finer = 0.3;
/// Part of the tolerance that the last solves leave: far less where slip is
/// measured, as errors must not decide between stick and slip
constexpr double least_part = 0.1, least_of_path = 0.01;
/// The same as of a change for the first iterate of a step, where a contact has
/// friction
constexpr double exact = 1e-10;
} // namespace

void Accuracy::set(double residual, double tolerance, double changing,
                   bool has_cycled)
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
    left = exact * residual;
  else if (not settled)
    left = std::max(left, (_solves < num_first ? finer : 1.0)
                              * std::clamp(changing, rough_least, rough_most)
                              * residual);
  const double least = (_has_path ? least_of_path : least_part) * tolerance;
  _target = std::max(part * left, least);
  ++_solves;
  _is_last = _target <= least_part * tolerance;
}
