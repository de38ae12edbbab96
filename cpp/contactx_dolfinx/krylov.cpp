// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#include "krylov.h"
#include <algorithm>
#include <limits>
#include <stdexcept>

namespace contactx_dolfinx::petsc
{
std::string direct_package()
{
  for (const char* name : {"mumps", "superlu_dist"})
  {
    PetscBool is_there = PETSC_FALSE;
    check(PetscHasExternalPackage(name, &is_there), "PetscHasExternalPackage");
    if (is_there)
      return name;
  }
  return {};
}

Options direct_options()
{
  // Where SuperLU_DIST is taken: it moves no pivots while it factorises, and
  // stops at zero ones
  Options options{{"ksp_type", "preonly"},
                  {"pc_type", "lu"},
                  {"mat_superlu_dist_replacetinypivot", "true"}};
  const std::string package = direct_package();
  if (package.empty())
    // PETSc's own LU does not pivot: the multipliers, whose diagonal is zero,
    // must come last
    options["pc_factor_mat_ordering_type"] = "natural";
  else
    options["pc_factor_mat_solver_type"] = package;
  if (package == "mumps")
    // Room for pivoting on the zero diagonal of the multipliers
    options["mat_mumps_icntl_14"] = "200";
  return options;
}

Options block_options(bool is_symmetric, int group)
{
  Options options = direct_options();
  if (direct_package() != "mumps")
    return options;
  // Iterations correct the round-off
  options["pc_precision"] = "single";
  options["mat_mumps_icntl_14"] = "30";
  if (group > 1)
    options["mat_mumps_icntl_15"] = std::to_string(-group);
  if (is_symmetric)
    options["pc_type"] = "cholesky";
  return options;
}

::PC pc_of(::KSP ksp)
{
  ::PC pc = nullptr;
  check(KSPGetPC(ksp, &pc), "KSPGetPC");
  return pc;
}

::Mat matrix_of(::KSP ksp)
{
  ::Mat A = nullptr;
  check(KSPGetOperators(ksp, &A, nullptr), "KSPGetOperators");
  return A;
}

int num_levels(::PC pc)
{
  PetscInt levels = 0;
  check(PCMGGetLevels(pc, &levels), "PCMGGetLevels");
  return static_cast<int>(levels);
}

MatrixPtr prolongation(::PC pc, int level)
{
  ::Mat P = nullptr;
  check(PCMGGetInterpolation(pc, level, &P), "PCMGGetInterpolation");
  return share(P);
}

void drop_entries(::Mat A)
{
  check(MatSeqAIJSetPreallocation(A, 0, nullptr), "MatSeqAIJSetPreallocation");
  check(MatMPIAIJSetPreallocation(A, 0, nullptr, 0, nullptr),
        "MatMPIAIJSetPreallocation");
}

void set_near_null_space(::Mat A,
                         const std::vector<std::vector<double>>& vectors,
                         int block_size)
{
  check(MatSetBlockSize(A, block_size), "MatSetBlockSize");
  std::vector<OwnVec> own(vectors.size());
  std::vector<::Vec> modes;
  for (std::size_t k = 0; k < vectors.size(); ++k)
  {
    check(MatCreateVecs(A, own[k].put(), nullptr), "MatCreateVecs");
    std::ranges::copy(vectors[k], Values(own[k].get()).span().begin());
    modes.push_back(own[k].get());
  }
  Owner<MatNullSpace, MatNullSpaceDestroy> near;
  check(MatNullSpaceCreate(comm_of(A), PETSC_FALSE,
                           static_cast<PetscInt>(modes.size()), modes.data(),
                           near.put()),
        "MatNullSpaceCreate");
  check(MatSetNearNullSpace(A, near.get()), "MatSetNearNullSpace");
}

void set_tolerances(::KSP ksp, double target, int most)
{
  check(KSPSetTolerances(ksp, contactx::math::round_off, target, PETSC_DEFAULT,
                         most),
        "KSPSetTolerances");
}

PetscErrorCode Quiet::call(const Apply& f, ::Vec x, ::Vec y)
{
  try
  {
    if (not _error)
    {
      const ConstValues from(x);
      const Values to(y);
      f(from.span(), to.span());
      return PETSC_SUCCESS;
    }
  }
  catch (...)
  {
    keep();
  }
  return VecSet(y, std::numeric_limits<double>::quiet_NaN());
}
void Quiet::end()
{
  if (const std::exception_ptr error = std::exchange(_error, nullptr))
    std::rethrow_exception(error);
}

Krylov::Krylov(MPI_Comm comm, std::size_t size, Apply multiply)
    : _multiply(std::move(multiply))
{
  check(KSPCreate(comm, _ksp.put()), "KSPCreate");
  create_empty(comm, size, _b);
  create_empty(comm, size, _x);
  const auto n = static_cast<PetscInt>(size);
  check(MatCreateShell(comm, n, n, PETSC_DETERMINE, PETSC_DETERMINE, this,
                       _A.put()),
        "MatCreateShell");
  check(MatShellSetOperation(_A.get(), MATOP_MULT,
                             reinterpret_cast<void (*)()>(&called)),
        "MatShellSetOperation");
}
void Krylov::set_up()
{
  const Defaults defaults = reproducible();
  const PetscErrorCode error = KSPSetUp(ksp());
  _quiet.end();
  check(error, "KSPSetUp");
}

Iterations Krylov::solve(std::span<const double> b, std::span<double> x)
{
  const Defaults defaults = reproducible();
  const Placed right(_b.get(), b), found(_x.get(), x);
  PetscReal size = 0;
  check(VecNorm(_x.get(), NORM_2, &size), "VecNorm");
  // A start of zero costs no product
  check(KSPSetInitialGuessNonzero(ksp(), size > 0 ? PETSC_TRUE : PETSC_FALSE),
        "KSPSetInitialGuessNonzero");
  const PetscErrorCode error = KSPSolve(ksp(), _b.get(), _x.get());
  _quiet.end();
  check(error, "KSPSolve");
  PetscInt count = 0;
  check(KSPGetIterationNumber(ksp(), &count), "KSPGetIterationNumber");
  const KSPConvergedReason reason = this->reason();
  using enum Iterations::End;
  const bool is_indefinite = reason == KSP_DIVERGED_INDEFINITE_MAT
                             or reason == KSP_DIVERGED_INDEFINITE_PC;
  return {static_cast<int>(count), reason > 0      ? converged
                                   : is_indefinite ? indefinite
                                                   : failed};
}

void Krylov::precondition(std::span<const double> b, std::span<double> x)
{
  const Placed right(_b.get(), b), found(_x.get(), x);
  const PetscErrorCode error = PCApply(pc(), _b.get(), _x.get());
  _quiet.end();
  check(error, "PCApply");
}

bool Krylov::apply(std::span<const double> b, std::span<double> x,
                   bool transposed)
{
  const Placed right(_b.get(), b), found(_x.get(), x);
  check((transposed ? KSPSolveTranspose : KSPSolve)(ksp(), _b.get(), _x.get()),
        "KSPSolve");
  if (reason() > 0)
    return true;
  check(VecSet(_x.get(), std::numeric_limits<double>::quiet_NaN()), "VecSet");
  return false;
}

bool Krylov::is_good() const
{
  PCFailedReason reason = PC_NOERROR;
  check(PCGetFailedReason(pc(), &reason), "PCGetFailedReason");
  return not anywhere(comm_of(ksp()), reason != PC_NOERROR);
}

PetscErrorCode Krylov::called(::Mat A, ::Vec x, ::Vec y)
{
  void* context = nullptr;
  if (const PetscErrorCode error = MatShellGetContext(A, &context))
    return error;
  auto& self = *static_cast<Krylov*>(context);
  return self._quiet.call(self._multiply, x, y);
}

KSPConvergedReason Krylov::reason() const
{
  KSPConvergedReason reason = KSP_CONVERGED_ITERATING;
  check(KSPGetConvergedReason(ksp(), &reason), "KSPGetConvergedReason");
  return reason;
}

Factors::Factors(const condense::Matrix& given,
                 const condense::FactorOptions& options,
                 const std::string& prefix)
    : _krylov(comm_of(of(given)), num_rows(of(given)))
{
  const ::KSP ksp = _krylov.ksp();
  const ::Mat A = of(given);
  if (options.is_rough)
  {
    const Defaults defaults(prefix,
                            block_options(options.is_symmetric, options.group));
    check(KSPSetOptionsPrefix(ksp, prefix.c_str()), "KSPSetOptionsPrefix");
    check(KSPSetFromOptions(ksp), "KSPSetFromOptions");
    if (options.is_symmetric)
      check(MatSetOption(A, MAT_SYMMETRIC, PETSC_TRUE), "MatSetOption");
    set_operators(ksp, A, A);
    _krylov.set_up();
    _is_good = _krylov.is_good();
    keep_preconditioner(_krylov.pc(), true);
    drop_entries(A);
  }
  else
  {
    // Of a matrix whose pattern has grown PETSc's LU reads sizes of inodes
    // that were never set
    const MatrixPtr copy = duplicate(A);
    set_operators(ksp, of(*copy), of(*copy));
    check(KSPSetType(ksp, KSPPREONLY), "KSPSetType");
    // Iterations would wait for one another
    check(PCSetType(_krylov.pc(),
                    num_ranks(comm_of(A)) == 1 ? PCLU : PCREDUNDANT),
          "PCSetType");
    _krylov.set_up();
    // Factors of several ranks tell it at a solve alone
    std::vector<double> zero(num_rows(A), 0), x(zero);
    _is_good = not anywhere(comm_of(A), not _krylov.apply(zero, x, false));
  }
}
Hierarchy::Hierarchy(::Mat P, Apply multiply, const std::string& prefix)
    : _krylov(comm_of(P), num_rows(P), std::move(multiply))
{
  const ::KSP ksp = _krylov.ksp();
  const bool is_serial = num_ranks(comm_of(P)) == 1;
  check(KSPSetOptionsPrefix(ksp, prefix.c_str()), "KSPSetOptionsPrefix");
  const ::PC pc = _krylov.pc();
  check(PCSetType(pc, PCGAMG), "PCSetType");
  set_operators(ksp, _krylov.A(), P);
  {
    // One smoothing step measured fastest, on the finest level with the
    // condensed matrix as it is. Two products in turn take half the time of
    // PETSc's choice for all three; of several ranks it knows others
    const Defaults defaults(
        prefix, {{"mg_levels_ksp_max_it", "1"}, {"pc_use_amat", "true"}}),
        products("", is_serial ? Options{{"matptap_via", "rap"},
                                         {"mat_product_clear", "true"}}
                               : Options{});
    check(KSPSetFromOptions(ksp), "KSPSetFromOptions");
    PCType type = nullptr;
    check(PCGetType(pc, &type), "PCGetType");
    if (std::string(type) != PCGAMG)
      throw std::invalid_argument(
          "option " + prefix
          + "pc_type: the condensed solver knows gamg and bodies, not " + type
          + "; for a direct solver of the whole set pc_type to lu");
    _krylov.set_up();
  }
  // From here on the finest level needs a diagonal alone
  OwnVec diagonal;
  check(MatCreateVecs(P, diagonal.put(), nullptr), "MatCreateVecs");
  check(MatGetDiagonal(P, diagonal.get()), "MatGetDiagonal");
  check(MatCreateDiagonal(diagonal.get(), _D.A.put()), "MatCreateDiagonal");
  set_operators(ksp, _krylov.A(), _D.A.get());
  const int levels = num_levels(pc);
  _smoothers.resize(levels, ksp);
  if (levels == 1)
    // A handful of unknowns
    check(PCSetType(pc, PCJACOBI), "PCSetType");
  else
  {
    keep_preconditioner(pc, true);
    for (int k = 0; k + 1 < levels; ++k)
      check(PCMGGetSmoother(pc, levels - 1 - k, &_smoothers[k]),
            "PCMGGetSmoother");
    check(PCMGGetCoarseSolve(pc, &_smoothers.back()), "PCMGGetCoarseSolve");
    if (is_serial)
    {
      // Of several ranks the first has all of the coarsest level, as one
      // block
      const ::PC direct = pc_of(_smoothers.back());
      check(PCSetType(direct, PCLU), "PCSetType");
      check(PCFactorSetShiftType(direct, MAT_SHIFT_INBLOCKS),
            "PCFactorSetShiftType");
    }
  }
  for (int k = 0; k < levels; ++k)
  {
    const ::PC smoother = pc_of(_smoothers[k]);
    keep_preconditioner(smoother, false);
    if (k == 0 or k + 1 == levels)
      continue;
    // Contact adds eigenvalues that no estimate of the bulk foresees; this
    // needs none
    check(KSPSetType(_smoothers[k], KSPRICHARDSON), "KSPSetType");
    check(PCSetType(smoother, PCSOR), "PCSetType");
  }
  set_operators(_smoothers.front(), _krylov.A(), _D.A.get());
  drop_entries(P);
  check(MatSetNearNullSpace(P, nullptr), "MatSetNearNullSpace");
  for (int k = 1; k < levels; ++k)
  {
    _prolongations.push_back(prolongation(pc, levels - k));
    _matrices.push_back(share(matrix_of(_smoothers[k])));
  }
}

void Hierarchy::set_diagonal(std::span<const double> diagonal)
{
  const ::Vec v = vectors(_D).second;
  const Placed placed(v, diagonal);
  check(MatDiagonalSet(_D.A.get(), v, INSERT_VALUES), "MatDiagonalSet");
  // PETSc reads a matrix that has changed in place only where it is set
  // again
  set_operators(_smoothers.front(), _krylov.A(), _D.A.get());
}

void Hierarchy::update()
{
  if (_matrices.empty())
    return;
  // Nor does it see that a pattern has changed
  check(PCReset(pc_of(_smoothers.back())), "PCReset");
  for (std::size_t k = 0; k < _matrices.size(); ++k)
    set_operators(_smoothers[k + 1], of(*_matrices[k]), of(*_matrices[k]));
}
Iterations Hierarchy::solve(std::span<const double> b, std::span<double> x,
                            bool is_symmetric, double target, int most)
{
  // Preconditioned from where the norm of the residual itself is at hand
  const ::KSP ksp = _krylov.ksp();
  check(KSPSetType(ksp, is_symmetric ? KSPCG : KSPGMRES), "KSPSetType");
  check(KSPGMRESSetRestart(ksp, condense::gmres_restart), "KSPGMRESSetRestart");
  check(KSPSetPCSide(ksp, is_symmetric ? PC_LEFT : PC_RIGHT), "KSPSetPCSide");
  check(KSPSetNormType(ksp, KSP_NORM_UNPRECONDITIONED), "KSPSetNormType");
  set_tolerances(ksp, target, most);
  return _krylov.solve(b, x);
}

FlexibleGMRES::FlexibleGMRES(MPI_Comm comm, std::size_t size, Apply multiply,
                             Apply precondition, int restart)
    : _krylov(comm, size, std::move(multiply)),
      _precondition(std::move(precondition))
{
  const ::KSP ksp = _krylov.ksp();
  const ::PC pc = _krylov.pc();
  check(KSPSetType(ksp, KSPFGMRES), "KSPSetType");
  check(KSPGMRESSetRestart(ksp, restart), "KSPGMRESSetRestart");
  check(KSPSetConvergenceTest(ksp, &test, this, nullptr),
        "KSPSetConvergenceTest");
  set_operators(ksp, _krylov.A(), _krylov.A());
  check(PCSetType(pc, PCSHELL), "PCSetType");
  check(PCShellSetContext(pc, this), "PCShellSetContext");
  check(PCShellSetApply(pc, &precondition_by), "PCShellSetApply");
}

Iterations FlexibleGMRES::solve(std::span<const double> b, std::span<double> x,
                                const Test& test, int most)
{
  _test = &test;
  check(KSPSetTolerances(_krylov.ksp(), PETSC_DEFAULT, PETSC_DEFAULT,
                         PETSC_DEFAULT, most),
        "KSPSetTolerances");
  return _krylov.solve(b, x);
}

PetscErrorCode FlexibleGMRES::precondition_by(::PC pc, ::Vec r, ::Vec z)
{
  void* context = nullptr;
  if (const PetscErrorCode error = PCShellGetContext(pc, &context))
    return error;
  auto& self = *static_cast<FlexibleGMRES*>(context);
  return self._krylov.quiet().call(self._precondition, r, z);
}

PetscErrorCode FlexibleGMRES::test(::KSP, PetscInt count, PetscReal norm,
                                   KSPConvergedReason* reason, void* context)
{
  auto& self = *static_cast<FlexibleGMRES*>(context);
  using enum Iterations::End;
  try
  {
    const auto end = (*self._test)(static_cast<int>(count), norm);
    *reason = not end              ? KSP_CONVERGED_ITERATING
              : *end == converged  ? KSP_CONVERGED_ATOL
              : *end == indefinite ? KSP_DIVERGED_INDEFINITE_MAT
                                   : KSP_DIVERGED_DTOL;
  }
  catch (...)
  {
    self._krylov.quiet().keep();
    *reason = KSP_DIVERGED_NANORINF;
  }
  return PETSC_SUCCESS;
}

std::optional<condense::Aggregates> aggregate(::Mat A,
                                              const std::string& prefix)
{
  PetscInt size = 0;
  check(MatGetSize(A, &size, nullptr), "MatGetSize");
  Krylov krylov(comm_of(A), num_rows(A));
  check(KSPSetOptionsPrefix(krylov.ksp(), prefix.c_str()),
        "KSPSetOptionsPrefix");
  set_operators(krylov.ksp(), A, A);
  {
    const Defaults defaults(prefix,
                            {{"pc_type", "gamg"},
                             {"pc_gamg_coarse_eq_limit",
                              std::to_string(std::max<PetscInt>(1, size - 1))},
                             {"mg_levels_ksp_type", "richardson"},
                             {"mg_levels_pc_type", "jacobi"},
                             {"mg_coarse_pc_type", "jacobi"}});
    check(KSPSetFromOptions(krylov.ksp()), "KSPSetFromOptions");
    krylov.set_up();
  }
  if (num_levels(krylov.pc()) < 2)
    return std::nullopt;
  ::KSP coarse = nullptr;
  check(PCMGGetCoarseSolve(krylov.pc(), &coarse), "PCMGGetCoarseSolve");
  return condense::Aggregates{prolongation(krylov.pc(), 1),
                              duplicate(matrix_of(coarse))};
}
} // namespace contactx_dolfinx::petsc
