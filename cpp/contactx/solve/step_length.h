// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#pragma once

namespace contactx::solve
{
/// @brief Part of a step that leads nowhere.
inline constexpr double negligible_step = 0.01;

/// @brief Length of Newton steps.
///
/// A step of a nonlinear bulk turns no cell inside out. Where steps are damped
/// they also pass the natural monotonicity test (Deuflhard, Newton Methods for
/// Nonlinear Problems, 2004, ch. 3): the next correction, by the same Jacobian,
/// must be shorter. Residuals say little of slender bodies, whose stiffnesses
/// differ by orders of magnitude. Steps as short as rounding errors make them
/// are not tested, as the next one is no shorter, unless contacts still change.
///
/// A solver begins a step and tries parts of it while that is asked for:
///
///     length.begin(size, within_cells);
///     while (length.has_trial())
///       length.judge(size of the correction after length.part() of the step);
///     step *= length.part();
///
/// Sizes are norms of displacements over all ranks; multipliers are no lengths.
class StepLength
{
public:
  /// @brief Fraction of min(det F, 1) that a step leaves in each cell. Measured
  /// from 0.1 to 0.5: rollers on soft blocks take the fewest iterations, and
  /// most of them converge.
  static constexpr double det_fraction_min = 0.4;

  /// @brief Start a load step.
  /// @param[in] damped Whether steps are damped.
  /// @param[in] extent Size of the scene, a length.
  void begin_step(bool damped, double extent);

  /// @brief Take note of an iterate.
  /// @param[in] changes Whether its contacts are others than those before.
  void note(bool changes) { _changes = changes; }

  /// @brief Begin a Newton step.
  /// @param[in] size Its size. One that is not finite is taken in full: the
  /// loop ends at the next residual.
  /// @param[in] within_cells Part of it that turns no cell inside out, at most
  /// 1.
  void begin(double size, double within_cells);

  /// @brief True if `part` of the step must be tried.
  bool has_trial() const { return _trials > 0; }

  /// @brief Judge the part that was tried.
  /// @param[in] next_size Size of the next correction by the same Jacobian,
  /// infinite if the residual is not finite there.
  void judge(double next_size);

  /// @brief Part of the step that is to be taken, or tried.
  double part() const { return _part; }

  /// @brief Number of steps of this load step that cells have limited.
  int limited() const { return _limited; }

  /// @brief Number of steps of this load step that the test has shortened.
  int damped() const { return _damped; }

  /// @brief True if the last steps were all too short to lead on.
  bool is_stuck() const;

private:
  void end();

  bool _is_damped = false, _changes = false;
  double _extent = 0;
  double _size = 0, _within_cells = 1, _part = 1;
  int _trials = 0; // that are left
  int _limited = 0, _damped = 0;
  int _tiny = 0; // successive steps without progress
};
} // namespace contactx::solve
