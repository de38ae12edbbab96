// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#pragma once

namespace contactx::solve
{
/// @brief Accuracy of linear solves: no more than the next residual
/// will show.
///
/// While the active set changes, its change dominates the next residual. Once
/// it has converged, Newton's method leaves a multiple of the residual's
/// square, as seen in the last iteration. The first iterate of a step tells
/// from where nodes slip that touch within it, so that the solution depends on
/// this one, which is solved for exactly.
class Accuracy
{
public:
  /// @param[in] has_path Whether slip is measured in any contact.
  explicit Accuracy(bool has_path) : _has_path(has_path) {}

  /// @brief Start a step.
  void begin_step()
  {
    _before = 0;
    _solves = 0;
  }

  /// @brief Forget what iterations have shown.
  void reset() { _before = _curvature = 0; }

  /// @brief The last step was not a solution: its residual shows nothing of
  /// Newton's method.
  void skip() { _before = 0; }

  /// @brief Set the accuracy of the next solve.
  /// @param[in] residual Residual of the iterate.
  /// @param[in] tolerance Bound that it must fall below.
  /// @param[in] changing Part of the nodes in contact whose status or pair has
  /// changed.
  /// @param[in] forces Forces of the problem, as in Iterate.
  /// @param[in] has_cycled Whether an active set has come back in this step:
  /// only exact solves tell it from its successor.
  void set(double residual, double tolerance, double changing, double forces,
           bool has_cycled = false);

  /// @brief Residual that the next solve may leave; zero before `set`.
  double target() const { return _target; }

  /// @brief True if the next residual shall be below the tolerance.
  bool is_last() const { return _is_last; }

private:
  bool _has_path, _is_last = false;
  int _solves = 0; // in this step
  // Residual of the iterate before, and what Newton's method makes of its
  // square
  double _before = 0, _curvature = 0;
  double _target = 0;
};
} // namespace contactx::solve
