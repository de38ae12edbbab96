// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#pragma once

namespace contactx::condense
{
/// Part of its right-hand side that each solve leaves at most, and that tells
/// whether iterations are slow
inline constexpr double one_digit = 0.1;

/// @brief Numbers of the condensed solver that cost or save time, and change no
/// answer. `bench_tuning.py` measures what others cost.
struct Tuning
{
  /// Cost of making a hierarchy, or factors of a block or of the whole, in
  /// Krylov iterations with an older one
  int renewal_cost = 40;
  /// Krylov iterations for a reduction of the residual by e, from which on
  /// multigrid is slow, as with thin stiff bodies
  int slow_rate = 12;
  /// Krylov iterations with springs in the place of soft bodies after which a
  /// coarse model takes it
  int max_iterations = 120;
  /// Difference between what contact is now and what it was when a block was
  /// factorised or multigrid's coarser levels were brought up to it, up to
  /// which these are kept: of a block what contact adds, relative in the
  /// Frobenius norm and times ln(residual / target), as iterations with old
  /// factors grow with both; of the levels the part of the constrained
  /// displacements that are others
  double max_change = 0.15;
  /// Exponent of the stiffness for the shortest waves in the geometric mean of
  /// a spring's: on slabs of a dam's face 0 takes a fifth to two fifths more
  /// iterations, and one half between a tenth less and a quarter more
  double short_wave_exponent = 1.0 / 3;
  /// Residual that solves before the last one of a step may leave, over what
  /// the next residual will show
  double roughness = 1;
};
} // namespace contactx::condense
