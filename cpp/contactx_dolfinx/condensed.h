// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#pragma once

#include "assembler.h"
#include <contactx/problem/condensed_solver.h>

namespace contactx_dolfinx
{
/// @brief Solves the system of the Jacobian with the multipliers eliminated, by
/// contactx::problem::CondensedSolver.
///
/// A loop reads as with `Assembler::jacobian`, but for the linear solve:
///
///     Condensed condensed(assembler, "condensed_");
///     ...
///       assembler.residual(x, b);
///       condensed.solve(b, dx);
///
/// or with a KSP that `condensed.set_up(ksp)` has given it to.
///
/// All ranks must take part in everything.
class Condensed final : public contactx::problem::LinearSolver
{
public:
  using Statistics = contactx::problem::CondensedSolver::Statistics;

  /// @brief Create the solver.
  /// @param[in] assembler The system; it must outlive the solver.
  /// @param[in] prefix Prefix of PETSc's options of the Krylov solver and its
  /// multigrid; with `bodies_` and `direct_` behind it those of other solvers.
  /// @throws std::invalid_argument if there are conductances.
  Condensed(Assembler& assembler, const std::string& prefix);

  /// @brief Solve J dx = b at the iterate that has settled last.
  /// @param[in] b Right-hand side in all unknowns.
  /// @param[out] dx Solution.
  void solve(::Vec b, ::Vec dx);

  void solve(std::span<const double> b, std::span<double> x) override;
  void update() override {}

  /// @brief Make this the preconditioner of a KSP of one's own, of type
  /// "preonly" best, for the Jacobian of the iterate that has settled last.
  ///
  /// What is thrown in its solves ends them as an error of PETSc of that text.
  /// @param[in] ksp The solver; this must outlive it.
  /// @throws std::logic_error if no iterate has settled since the last step was
  /// taken.
  void set_up(::KSP ksp);

  /// @brief What the solves of this step have done.
  Statistics statistics() { return _solver.statistics(); }

  /// @brief Costs and limits of the solver, which may be changed.
  contactx::condense::Tuning& tuning() { return _solver.tuning; }

  /// @brief Krylov iterations so far.
  int iterations() const { return _iterations + _of_step; }

  /// @brief Solves that went to the direct solver so far.
  int direct() const { return _direct + _direct_of_step; }

private:
  static PetscErrorCode multiply_by(::Mat A, ::Vec x, ::Vec y);
  static PetscErrorCode precondition_by(::PC pc, ::Vec b, ::Vec dx);

  Assembler* _assembler;
  contactx::problem::CondensedSolver _solver;
  petsc::OwnMat _A;
  // Of steps before, and of this one
  int _iterations = 0, _direct = 0, _of_step = 0, _direct_of_step = 0;
};
} // namespace contactx_dolfinx
