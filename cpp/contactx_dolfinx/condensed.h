// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#pragma once

#include "algebra.h"
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
  Condensed(Assembler& assembler, const std::string& prefix)
      : _solver(checked(assembler).problem(),
                std::make_shared<Algebra>(assembler, prefix))
  {
  }

  /// @brief Solve J dx = b at the iterate that has settled last.
  /// @param[in] b Right-hand side in all unknowns.
  /// @param[out] dx Solution.
  void solve(::Vec b, ::Vec dx)
  {
    const petsc::ConstValues given(b);
    const petsc::Values found(dx);
    solve(given.span(), found.span());
  }

  void solve(std::span<const double> b, std::span<double> x) override
  {
    _solver.solve(b, x);
    const Statistics now = _solver.statistics();
    if (now.solves == 1)
    {
      _iterations += std::exchange(_of_step, 0);
      _direct += std::exchange(_direct_of_step, 0);
    }
    _of_step = now.iterations;
    _direct_of_step = static_cast<int>(now.direct.size());
  }

  void update() override {}

  /// @brief What the solves of this step have done.
  Statistics statistics() { return _solver.statistics(); }

  /// @brief Costs and limits of the solver, which may be changed.
  contactx::condense::Tuning& tuning() { return _solver.tuning; }

  /// @brief Krylov iterations so far.
  int iterations() const { return _iterations + _of_step; }

  /// @brief Solves that went to the direct solver so far.
  int direct() const { return _direct + _direct_of_step; }

private:
  static Assembler& checked(Assembler& assembler)
  {
    if (not assembler.bulk()->conductances().empty())
      throw std::invalid_argument(
          "the condensed solver is for fields that do not flow across "
          "contacts: "
          "where there are conductances take a KSPSolver, with a direct one");
    return assembler;
  }

  contactx::problem::CondensedSolver _solver;
  // Of steps before, and of this one
  int _iterations = 0, _direct = 0, _of_step = 0, _direct_of_step = 0;
};
} // namespace contactx_dolfinx
