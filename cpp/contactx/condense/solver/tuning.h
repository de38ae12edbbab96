// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#pragma once

namespace contactx::condense
{
/// @brief Numbers of the condensed solver that cost or save time, and change no
/// answer.
struct Tuning
{
  /// Cost of a hierarchy, in Krylov iterations, as measured from 7,000 to
  /// 160,000 dofs
  int hierarchy_cost = 40;
  /// Cost of factorising a block of bodies, in Krylov iterations, at 200,000 to
  /// 400,000 dofs
  int block_cost = 15;
  /// Cost of factorising the system of all unknowns, in iterations with older
  /// factors, as measured from 24,000 to 176,000 displacements
  int system_cost = 40;
  /// Krylov iterations for a reduction of the residual by e, from which on
  /// multigrid is slow, as with thin stiff bodies; and where stiff bodies and
  /// soft ones can be told apart and have a block preconditioner
  int slow_rate = 12, slow_rate_of_mixed = 6;
  /// Krylov iterations with springs in the place of soft bodies after which a
  /// coarse model takes it
  int max_spring_iterations = 120;
  /// Difference between what contact adds to a block now and what it added when
  /// this was factorised, relative in the Frobenius norm, up to which the
  /// factors are kept: of soft bodies, and of stiff ones times ln(residual /
  /// target), as iterations with old factors grow with both
  double max_change_of_soft = 0.03, max_change_of_stiff = 0.15;
  /// Exponent of the stiffness for the shortest waves in the geometric mean of
  /// a spring's: on slabs of a dam's face 0 takes a fifth to two fifths more
  /// iterations, and one half between a tenth less and a quarter more
  double short_wave_exponent = 1.0 / 3;
  /// Residual that solves before the last one of a step may leave, over what
  /// the next residual will show
  double roughness = 1;
};
} // namespace contactx::condense
