// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#include "petsc.h"
#include <dolfinx/la/petsc.h>

namespace contactx_dolfinx::petsc
{
void check(PetscErrorCode error, const char* function)
{
  if (error != PETSC_SUCCESS)
    dolfinx::la::petsc::error(error, __FILE__, function);
}

void set_lu(::KSP ksp)
{
  check(KSPSetType(ksp, KSPPREONLY), "KSPSetType");
  ::PC pc = nullptr;
  check(KSPGetPC(ksp, &pc), "KSPGetPC");
  check(PCSetType(pc, PCLU), "PCSetType");
#ifdef PETSC_HAVE_MUMPS
  check(PCFactorSetMatSolverType(pc, MATSOLVERMUMPS),
        "PCFactorSetMatSolverType");
#endif
}

Values::Values(::Vec x) : _x(x)
{
  PetscInt size = 0;
  check(VecGetLocalSize(x, &size), "VecGetLocalSize");
  check(VecGetArray(x, &_values), "VecGetArray");
  _size = size;
}

ConstValues::ConstValues(::Vec x) : _x(x)
{
  PetscInt size = 0;
  check(VecGetLocalSize(x, &size), "VecGetLocalSize");
  check(VecGetArrayRead(x, &_values), "VecGetArrayRead");
  _size = size;
}
} // namespace contactx_dolfinx::petsc
