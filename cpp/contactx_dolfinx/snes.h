// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#pragma once

#include "assembler.h"
#include <exception>
#include <petscsnes.h>

namespace contactx_dolfinx
{
/// @brief Lets a SNES solve the system of an assembler, once a step:
///
///     SNESLoop loop(assembler, snes);
///     ...
///       assembler.begin_step();
///       loop.solve();
///       assembler.accept();
///
/// The SNES keeps its tolerances, line search, KSP and PC; its residual,
/// Jacobian, convergence test and the check before its line search are set.
/// With another line search than "basic", PETSc's default is "bt", no interior
/// point takes over where the active set changes without end.
/// Its rtol is relative to the forces of the problem: 1e-11 is usual. Pairs and
/// status change in its convergence test alone.
class SNESLoop
{
public:
  /// @brief Set the callbacks of a SNES.
  /// @param[in] assembler The system; it must outlive this.
  /// @param[in] snes The solver, which must outlive this and not be used
  /// without it.
  SNESLoop(Assembler& assembler, ::SNES snes);
  SNESLoop(const SNESLoop&) = delete;
  SNESLoop& operator=(const SNESLoop&) = delete;

  /// @brief Solve the step that the assembler has begun.
  /// @throws ConvergenceError if there is no solution; `Assembler::restore`
  /// goes back to the step's start.
  void solve();

private:
  /// Does something inside PETSc, which errors of C++ must not cross.
  template <class Work>
  void keep(Work&& work, PetscErrorCode (*mark)(::SNES));

  static PetscErrorCode residual(::SNES, ::Vec x, ::Vec b, void* context);
  static PetscErrorCode jacobian(::SNES, ::Vec x, ::Mat A, ::Mat,
                                 void* context);

  /// Updates pairs and the active set at an iterate, and judges it.
  static PetscErrorCode test(::SNES snes, PetscInt number, PetscReal, PetscReal,
                             PetscReal, SNESConvergedReason* reason,
                             void* context);

  /// Shortens a step, which is taken off the iterate.
  static PetscErrorCode shorten(::SNESLineSearch, ::Vec x, ::Vec step,
                                PetscBool* is_changed, void* context);

  Assembler* _assembler;
  ::SNES _snes;
  petsc::OwnMat _A;
  petsc::OwnVec _b;
  std::exception_ptr _error;
};
} // namespace contactx_dolfinx
