// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#include "snes.h"

namespace contactx_dolfinx
{
SNESLoop::SNESLoop(Assembler& assembler, ::SNES snes)
    : _assembler(&assembler), _snes(snes), _A(assembler.create_matrix()),
      _b(assembler.create_vector())
{
  petsc::check(SNESSetFunction(_snes, _b.get(), &residual, this),
               "SNESSetFunction");
  petsc::check(SNESSetJacobian(_snes, _A.get(), _A.get(), &jacobian, this),
               "SNESSetJacobian");
  petsc::check(SNESSetConvergenceTest(_snes, &test, this, nullptr),
               "SNESSetConvergenceTest");
  ::SNESLineSearch search = nullptr;
  petsc::check(SNESGetLineSearch(_snes, &search), "SNESGetLineSearch");
  petsc::check(SNESLineSearchSetPreCheck(search, &shorten, this),
               "SNESLineSearchSetPreCheck");
}

void SNESLoop::solve()
{
  _error = nullptr;
  ::SNESLineSearch search = nullptr;
  petsc::check(SNESGetLineSearch(_snes, &search), "SNESGetLineSearch");
  PetscBool is_full = PETSC_FALSE;
  petsc::check(PetscObjectTypeCompare(reinterpret_cast<PetscObject>(search),
                                      SNESLINESEARCHBASIC, &is_full),
               "PetscObjectTypeCompare");
  // Other line searches would have nowhere to go on an interior point's path
  if (not is_full)
    _assembler->problem().loop().bar_path();
  petsc::check(SNESSolve(_snes, nullptr, _assembler->x()), "SNESSolve");
  if (_error)
    std::rethrow_exception(_error);
  SNESConvergedReason reason{};
  petsc::check(SNESGetConvergedReason(_snes, &reason),
               "SNESGetConvergedReason");
  if (reason == SNES_DIVERGED_LINEAR_SOLVE)
    throw ConvergenceError(
        "the linear solver failed: is a body free to move without touching "
        "anything? Support it; with a Krylov solver of your own try pc_type "
        "lu (manual: errors/linear-solver-failed)");
  if (reason <= 0 or not _assembler->problem().converged())
    throw ConvergenceError(
        "SNES stopped with reason " + std::to_string(int(reason))
        + ", before contact and bulk were in equilibrium: check the options "
          "of SNES, KSP and PC (manual: errors/snes-stopped)");
}

template <class Work>
void SNESLoop::keep(Work&& work, PetscErrorCode (*mark)(::SNES))
{
  try
  {
    work();
  }
  catch (...)
  {
    _error = std::current_exception();
    if (mark)
      petsc::check(mark(_snes), "SNES");
  }
}

PetscErrorCode SNESLoop::residual(::SNES, ::Vec x, ::Vec b, void* context)
{
  auto& self = *static_cast<SNESLoop*>(context);
  self.keep([&] { self._assembler->residual(x, b); },
            &SNESSetFunctionDomainError);
  return PETSC_SUCCESS;
}

PetscErrorCode SNESLoop::jacobian(::SNES, ::Vec x, ::Mat A, ::Mat,
                                  void* context)
{
  auto& self = *static_cast<SNESLoop*>(context);
  self.keep([&] { self._assembler->jacobian(x, A); },
            &SNESSetJacobianDomainError);
  return PETSC_SUCCESS;
}

PetscErrorCode SNESLoop::test(::SNES snes, PetscInt number, PetscReal,
                              PetscReal, PetscReal, SNESConvergedReason* reason,
                              void* context)
{
  auto& self = *static_cast<SNESLoop*>(context);
  Assembler& assembler = *self._assembler;
  *reason = SNES_DIVERGED_FUNCTION_DOMAIN;
  if (self._error)
    return PETSC_SUCCESS;
  self.keep(
      [&]
      {
        PetscReal atol = 0, rtol = 0, stol = 0;
        PetscInt max_it = 0, max_f = 0;
        petsc::check(
            SNESGetTolerances(snes, &atol, &rtol, &stol, &max_it, &max_f),
            "SNESGetTolerances");
        if (number > 0)
          assembler.problem().moved();
        const Settled& found
            = assembler.settle(rtol, atol, static_cast<int>(max_it));
        // Iterates may have been taken back, and pairs are others
        const ::Vec x = assembler.x();
        assembler.residual(x, self._b.get());
        PetscReal norm = 0;
        petsc::check(VecNorm(self._b.get(), NORM_2, &norm), "VecNorm");
        petsc::check(SNESSetFunctionNorm(snes, norm), "SNESSetFunctionNorm");
        *reason = found.converged ? SNES_CONVERGED_FNORM_ABS
                                  : SNES_CONVERGED_ITERATING;
      },
      nullptr);
  return PETSC_SUCCESS;
}

PetscErrorCode SNESLoop::shorten(::SNESLineSearch, ::Vec x, ::Vec step,
                                 PetscBool* is_changed, void* context)
{
  auto& self = *static_cast<SNESLoop*>(context);
  *is_changed = PETSC_TRUE;
  self.keep(
      [&]
      {
        if (self._assembler->problem().loop().corrects(
                petsc::ConstValues(step).span()))
        {
          ::KSP ksp = nullptr;
          self._assembler->residual(x, self._b.get());
          petsc::check(SNESGetKSP(self._snes, &ksp), "SNESGetKSP");
          petsc::check(KSPSolve(ksp, self._b.get(), step), "KSPSolve");
        }
        petsc::check(VecScale(step, -1), "VecScale");
        const double part = self._assembler->limit(step);
        petsc::check(VecScale(step, -part), "VecScale");
      },
      &SNESSetFunctionDomainError);
  return PETSC_SUCCESS;
}
} // namespace contactx_dolfinx
