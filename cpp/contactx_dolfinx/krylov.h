// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#pragma once

#include "matrices.h"
#include <exception>
#include <limits>
#include <petscksp.h>

/// @brief Solvers of PETSc for contactx::condense::Algebra.
namespace contactx_dolfinx::petsc
{
using condense::Apply;
using condense::Iterations;

using OwnKSP = Owner<::KSP, KSPDestroy>;

/// @brief Name of a direct solver for saddle-point matrices, the best that
/// PETSc has; empty where PETSc's own LU must do.
inline std::string direct_package()
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

/// @brief Options of a direct solver of a saddle point.
inline Options direct_options()
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

/// @brief Options of a direct solver of a block, in single precision where the
/// solver has it.
/// @param[in] is_symmetric Whether the block is symmetric.
/// @param[in] group Number of successive unknowns that are coupled to the same
/// others; the solver orders groups.
inline Options block_options(bool is_symmetric, int group)
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

/// @brief Give a solver its matrices anew.
inline void set_operators(::KSP ksp, ::Mat A, ::Mat P)
{
  check(KSPSetOperators(ksp, A, P), "KSPSetOperators");
}

/// @brief Say whether a preconditioner stays when its matrix changes.
inline void keep_preconditioner(::PC pc, bool keeps)
{
  check(PCSetReusePreconditioner(pc, keeps ? PETSC_TRUE : PETSC_FALSE),
        "PCSetReusePreconditioner");
}

/// @brief Preconditioner of a solver.
inline ::PC pc_of(::KSP ksp)
{
  ::PC pc = nullptr;
  check(KSPGetPC(ksp, &pc), "KSPGetPC");
  return pc;
}

/// @brief Matrix of a solver.
inline ::Mat matrix_of(::KSP ksp)
{
  ::Mat A = nullptr;
  check(KSPGetOperators(ksp, &A, nullptr), "KSPGetOperators");
  return A;
}

/// @brief Number of levels of a multigrid hierarchy.
inline int num_levels(::PC pc)
{
  PetscInt levels = 0;
  check(PCMGGetLevels(pc, &levels), "PCMGGetLevels");
  return static_cast<int>(levels);
}

/// @brief Prolongation to a level from the next coarser one.
inline MatrixPtr prolongation(::PC pc, int level)
{
  ::Mat P = nullptr;
  check(PCMGGetInterpolation(pc, level, &P), "PCMGGetInterpolation");
  return share(P);
}

/// @brief PETSc keeps a matrix, but nothing in it is used again.
inline void drop_entries(::Mat A)
{
  check(MatSeqAIJSetPreallocation(A, 0, nullptr), "MatSeqAIJSetPreallocation");
  check(MatMPIAIJSetPreallocation(A, 0, nullptr, 0, nullptr),
        "MatMPIAIJSetPreallocation");
}

/// @brief Say what a matrix all but maps to zero, and how many unknowns belong
/// together.
inline void set_near_null_space(::Mat A,
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

/// @brief Set when iterations end: by the norm of the residual itself, also at
/// what rounding leaves of it.
inline void set_tolerances(::KSP ksp, double target, int most)
{
  check(KSPSetTolerances(ksp, condense::Algebra::rounding, target,
                         PETSC_DEFAULT, most),
        "KSPSetTolerances");
}

/// @brief Calls functions for PETSc, through which nothing may be thrown.
class Quiet
{
public:
  /// @brief Call y = f(x). After an error PETSc gets NaN, with which it soon
  /// ends.
  PetscErrorCode call(const Apply& f, ::Vec x, ::Vec y)
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

  /// @brief Keep the error that is handled now.
  void keep() { _error = std::current_exception(); }

  /// @brief Throw what was thrown.
  void end()
  {
    if (const std::exception_ptr error = std::exchange(_error, nullptr))
      std::rethrow_exception(error);
  }

private:
  std::exception_ptr _error;
};

/// @brief A solver of PETSc for arrays.
class Krylov
{
public:
  /// @brief Make it.
  /// @param[in] comm The ranks.
  /// @param[in] size Number of unknowns of this rank.
  /// @param[in] multiply The matrix, if it is none of PETSc's.
  Krylov(MPI_Comm comm, std::size_t size, Apply multiply = {})
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
  Krylov(const Krylov&) = delete;
  Krylov& operator=(const Krylov&) = delete;

  ::KSP ksp() const { return _ksp.get(); }
  ::PC pc() const { return pc_of(ksp()); }

  /// @brief The matrix that `multiply` is.
  ::Mat A() const { return _A.get(); }

  /// @brief What calls functions for the solver.
  Quiet& quiet() { return _quiet; }

  /// @brief Set it up; what functions have thrown comes at the end.
  void set_up()
  {
    const Defaults defaults = reproducible();
    const PetscErrorCode error = KSPSetUp(ksp());
    _quiet.end();
    check(error, "KSPSetUp");
  }

  /// @brief Solve A x = b, from what x is; what functions have thrown comes at
  /// the end.
  Iterations solve(std::span<const double> b, std::span<double> x)
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

  /// @brief Apply its preconditioner, x = M b; what functions have thrown comes
  /// at the end.
  void precondition(std::span<const double> b, std::span<double> x)
  {
    const Placed right(_b.get(), b), found(_x.get(), x);
    const PetscErrorCode error = PCApply(pc(), _b.get(), _x.get());
    _quiet.end();
    check(error, "PCApply");
  }

  /// @brief Apply factors, x = A^-1 b or x = A^-T b; NaN where there are none.
  /// @return Whether there are.
  bool apply(std::span<const double> b, std::span<double> x, bool transposed)
  {
    const Placed right(_b.get(), b), found(_x.get(), x);
    check(
        (transposed ? KSPSolveTranspose : KSPSolve)(ksp(), _b.get(), _x.get()),
        "KSPSolve");
    if (reason() > 0)
      return true;
    check(VecSet(_x.get(), std::numeric_limits<double>::quiet_NaN()), "VecSet");
    return false;
  }

  /// @brief Whether its preconditioner could be made; the same on all ranks.
  bool is_good() const
  {
    PCFailedReason reason = PC_NOERROR;
    check(PCGetFailedReason(pc(), &reason), "PCGetFailedReason");
    return not anywhere(comm_of(ksp()), reason != PC_NOERROR);
  }

private:
  static PetscErrorCode called(::Mat A, ::Vec x, ::Vec y)
  {
    void* context = nullptr;
    if (const PetscErrorCode error = MatShellGetContext(A, &context))
      return error;
    auto& self = *static_cast<Krylov*>(context);
    return self._quiet.call(self._multiply, x, y);
  }

  KSPConvergedReason reason() const
  {
    KSPConvergedReason reason = KSP_CONVERGED_ITERATING;
    check(KSPGetConvergedReason(ksp(), &reason), "KSPGetConvergedReason");
    return reason;
  }

  Apply _multiply;
  Quiet _quiet;
  OwnMat _A;
  OwnVec _b, _x;
  OwnKSP _ksp;
};

/// @brief Factors of a matrix.
class Factors final : public condense::Factors
{
public:
  /// @brief Factorise a matrix, whose entries are gone then.
  /// @param[in] given The matrix.
  /// @param[in] options Which factors are wanted.
  /// @param[in] prefix Prefix of PETSc's options of these factors.
  Factors(const condense::Matrix& given, const condense::FactorOptions& options,
          const std::string& prefix)
      : _krylov(comm_of(of(given)), num_rows(of(given)))
  {
    const ::KSP ksp = _krylov.ksp();
    const ::Mat A = of(given);
    if (options.is_rough)
    {
      const Defaults defaults(
          prefix, block_options(options.is_symmetric, options.group));
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

  void solve(std::span<const double> b, std::span<double> x,
             bool transposed) override
  {
    _krylov.apply(b, x, transposed);
  }

  bool is_good() const override { return _is_good; }

private:
  Krylov _krylov;
  bool _is_good = true;
};

/// @brief CG and GMRES with a hierarchy of PETSc's smoothed aggregation.
class Hierarchy final : public condense::Hierarchy
{
public:
  /// @brief Make the hierarchy.
  /// @param[in] P Matrix with its near null space; its entries are gone then.
  /// @param[in] multiply The matrix that is solved with.
  /// @param[in] prefix Prefix of PETSc's options.
  Hierarchy(::Mat P, Apply multiply, const std::string& prefix)
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

  const std::vector<MatrixPtr>& prolongations() const override
  {
    return _prolongations;
  }

  const std::vector<MatrixPtr>& matrices() const override { return _matrices; }

  void set_diagonal(std::span<const double> diagonal) override
  {
    const ::Vec v = vectors(_D).second;
    const Placed placed(v, diagonal);
    check(MatDiagonalSet(_D.A.get(), v, INSERT_VALUES), "MatDiagonalSet");
    // PETSc reads a matrix that has changed in place only where it is set
    // again
    set_operators(_smoothers.front(), _krylov.A(), _D.A.get());
  }

  void update() override
  {
    if (_matrices.empty())
      return;
    // Nor does it see that a pattern has changed
    check(PCReset(pc_of(_smoothers.back())), "PCReset");
    for (std::size_t k = 0; k < _matrices.size(); ++k)
      set_operators(_smoothers[k + 1], of(*_matrices[k]), of(*_matrices[k]));
  }

  void cycle(std::span<const double> b, std::span<double> x) override
  {
    _krylov.precondition(b, x);
  }

  Iterations solve(std::span<const double> b, std::span<double> x,
                   bool is_symmetric, double target, int most) override
  {
    // Preconditioned from where the norm of the residual itself is at hand
    const ::KSP ksp = _krylov.ksp();
    check(KSPSetType(ksp, is_symmetric ? KSPCG : KSPGMRES), "KSPSetType");
    check(KSPSetPCSide(ksp, is_symmetric ? PC_LEFT : PC_RIGHT), "KSPSetPCSide");
    check(KSPSetNormType(ksp, KSP_NORM_UNPRECONDITIONED), "KSPSetNormType");
    set_tolerances(ksp, target, most);
    return _krylov.solve(b, x);
  }

private:
  Krylov _krylov;
  Matrix _D;                     // the finest level's diagonal
  std::vector<::KSP> _smoothers; // the finest level's first
  std::vector<MatrixPtr> _prolongations, _matrices;
};

/// @brief PETSc's flexible GMRES.
class FlexibleGMRES final : public condense::FlexibleGMRES
{
public:
  /// @brief Make it, see contactx::condense::Algebra::flexible_gmres.
  FlexibleGMRES(MPI_Comm comm, std::size_t size, Apply multiply,
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

  Iterations solve(std::span<const double> b, std::span<double> x,
                   const Test& test, int most) override
  {
    _test = &test;
    check(KSPSetTolerances(_krylov.ksp(), PETSC_DEFAULT, PETSC_DEFAULT,
                           PETSC_DEFAULT, most),
          "KSPSetTolerances");
    return _krylov.solve(b, x);
  }

private:
  static PetscErrorCode precondition_by(::PC pc, ::Vec r, ::Vec z)
  {
    void* context = nullptr;
    if (const PetscErrorCode error = PCShellGetContext(pc, &context))
      return error;
    auto& self = *static_cast<FlexibleGMRES*>(context);
    return self._krylov.quiet().call(self._precondition, r, z);
  }

  static PetscErrorCode test(::KSP, PetscInt count, PetscReal norm,
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

  Krylov _krylov;
  Apply _precondition;
  const Test* _test = nullptr;
};

/// @brief Make the first coarser level of a matrix, and nothing else.
/// @param[in] A The matrix with its near null space.
/// @param[in] prefix Prefix of PETSc's options.
inline std::optional<condense::Aggregates> aggregate(::Mat A,
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
