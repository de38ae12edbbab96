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
  Condensed(Assembler& assembler, const std::string& prefix)
      : _assembler(&assembler),
        _solver(checked(assembler).problem(),
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

  /// @brief Make this the preconditioner of a KSP of one's own, of type
  /// "preonly" best, for the Jacobian of the iterate that has settled last.
  ///
  /// What is thrown in its solves ends them as an error of PETSc of that text.
  /// @param[in] ksp The solver; this must outlive it.
  /// @throws std::logic_error if no iterate has settled since the last step was
  /// taken.
  void set_up(::KSP ksp)
  {
    using petsc::check;
    _assembler->problem().enter("set_up", {{"condensed", 1}});
    if (_A.get() == nullptr)
    {
      const auto n = static_cast<PetscInt>(_assembler->system()->size());
      check(MatCreateShell(petsc::comm_of(ksp), n, n, PETSC_DETERMINE,
                           PETSC_DETERMINE, this, _A.put()),
            "MatCreateShell");
      check(MatShellSetOperation(_A.get(), MATOP_MULT,
                                 reinterpret_cast<void (*)()>(&multiply_by)),
            "MatShellSetOperation");
    }
    check(KSPSetOperators(ksp, _A.get(), _A.get()), "KSPSetOperators");
    const ::PC pc = petsc::pc_of(ksp);
    check(PCSetType(pc, PCSHELL), "PCSetType");
    check(PCShellSetContext(pc, this), "PCShellSetContext");
    check(PCShellSetApply(pc, &precondition_by), "PCShellSetApply");
  }

  /// @brief What the solves of this step have done.
  Statistics statistics() { return _solver.statistics(); }

  /// @brief Costs and limits of the solver, which may be changed.
  contactx::condense::Tuning& tuning() { return _solver.tuning; }

  /// @brief Krylov iterations so far.
  int iterations() const { return _iterations + _of_step; }

  /// @brief Solves that went to the direct solver so far.
  int direct() const { return _direct + _direct_of_step; }

private:
  static PetscErrorCode multiply_by(::Mat A, ::Vec x, ::Vec y)
  {
    void* context = nullptr;
    if (const PetscErrorCode error = MatShellGetContext(A, &context))
      return error;
    return call(
        [&]
        {
          static_cast<Condensed*>(context)->_solver.multiply(
              petsc::ConstValues(x).span(), petsc::Values(y).span());
        });
  }

  static PetscErrorCode precondition_by(::PC pc, ::Vec b, ::Vec dx)
  {
    void* context = nullptr;
    if (const PetscErrorCode error = PCShellGetContext(pc, &context))
      return error;
    return call([&] { static_cast<Condensed*>(context)->solve(b, dx); });
  }

  /// Nothing may be thrown through PETSc
  template <class Work>
  static PetscErrorCode call(Work&& work)
  {
    try
    {
      work();
      return PETSC_SUCCESS;
    }
    catch (const std::exception& error)
    {
      return PetscError(PETSC_COMM_SELF, __LINE__, __func__, __FILE__,
                        PETSC_ERR_LIB, PETSC_ERROR_INITIAL, "%s", error.what());
    }
  }

  static Assembler& checked(Assembler& assembler)
  {
    if (not assembler.bulk()->conductances().empty())
      throw std::invalid_argument(
          "the condensed solver is for fields that do not flow across "
          "contacts: "
          "where there are conductances take a KSPSolver, with a direct one");
    return assembler;
  }

  Assembler* _assembler;
  contactx::problem::CondensedSolver _solver;
  petsc::OwnMat _A;
  // Of steps before, and of this one
  int _iterations = 0, _direct = 0, _of_step = 0, _direct_of_step = 0;
};
} // namespace contactx_dolfinx
