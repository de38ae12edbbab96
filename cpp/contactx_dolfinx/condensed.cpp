// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#include "condensed.h"
#include "algebra.h"
#include <stdexcept>

namespace contactx_dolfinx
{
namespace
{
/// Nothing may be thrown through PETSc
template <class Work>
PetscErrorCode call(Work&& work)
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

Assembler& checked(Assembler& assembler)
{
  if (not assembler.bulk()->conductances().empty())
    throw std::invalid_argument(
        "the condensed solver is for fields that do not flow across "
        "contacts: "
        "where there are conductances take a KSPSolver, with a direct one");
  return assembler;
}
} // namespace

Condensed::Condensed(Assembler& assembler, const std::string& prefix)
    : _assembler(&assembler),
      _solver(checked(assembler).problem(),
              std::make_shared<Algebra>(assembler, prefix))
{
}

void Condensed::solve(::Vec b, ::Vec dx)
{
  const petsc::ConstValues given(b);
  const petsc::Values found(dx);
  solve(given.span(), found.span());
}

void Condensed::solve(std::span<const double> b, std::span<double> x)
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

void Condensed::set_up(::KSP ksp)
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

PetscErrorCode Condensed::multiply_by(::Mat A, ::Vec x, ::Vec y)
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

PetscErrorCode Condensed::precondition_by(::PC pc, ::Vec b, ::Vec dx)
{
  void* context = nullptr;
  if (const PetscErrorCode error = PCShellGetContext(pc, &context))
    return error;
  return call([&] { static_cast<Condensed*>(context)->solve(b, dx); });
}
} // namespace contactx_dolfinx
