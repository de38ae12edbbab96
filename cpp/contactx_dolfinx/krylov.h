// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#pragma once

#include "matrices.h"
#include <exception>

/// @brief Solvers of PETSc for contactx::condense::Algebra.
namespace contactx_dolfinx::petsc
{
using condense::Apply;
using condense::Iterations;

/// @brief Name of a direct solver for saddle-point matrices, the best that
/// PETSc has; empty where PETSc's own LU must do.
std::string direct_package();

/// @brief Options of a direct solver of a saddle point.
Options direct_options();

/// @brief Options of a direct solver of a block, in single precision where the
/// solver has it.
/// @param[in] is_symmetric Whether the block is symmetric.
/// @param[in] group Number of successive unknowns that are coupled to the same
/// others; the solver orders groups.
Options block_options(bool is_symmetric, int group);

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
::PC pc_of(::KSP ksp);

/// @brief Matrix of a solver.
::Mat matrix_of(::KSP ksp);

/// @brief Number of levels of a multigrid hierarchy.
int num_levels(::PC pc);

/// @brief Prolongation to a level from the next coarser one.
MatrixPtr prolongation(::PC pc, int level);

/// @brief PETSc keeps a matrix, but nothing in it is used again.
void drop_entries(::Mat A);

/// @brief Say what a matrix all but maps to zero, and how many unknowns belong
/// together.
void set_near_null_space(::Mat A,
                         const std::vector<std::vector<double>>& vectors,
                         int block_size);

/// @brief Set when iterations end: by the norm of the residual itself, also at
/// what rounding leaves of it.
void set_tolerances(::KSP ksp, double target, int most);

/// @brief Calls functions for PETSc, through which nothing may be thrown.
class Quiet
{
public:
  /// @brief Call y = f(x). After an error PETSc gets NaN, with which it soon
  /// ends.
  PetscErrorCode call(const Apply& f, ::Vec x, ::Vec y);

  /// @brief Keep the error that is handled now.
  void keep() { _error = std::current_exception(); }

  /// @brief Throw what was thrown.
  void end();

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
  Krylov(MPI_Comm comm, std::size_t size, Apply multiply = {});
  Krylov(const Krylov&) = delete;
  Krylov& operator=(const Krylov&) = delete;

  ::KSP ksp() const { return _ksp.get(); }
  ::PC pc() const { return pc_of(ksp()); }

  /// @brief The matrix that `multiply` is.
  ::Mat A() const { return _A.get(); }

  /// @brief What calls functions for the solver.
  Quiet& quiet() { return _quiet; }

  /// @brief Set it up; what functions have thrown comes at the end.
  void set_up();

  /// @brief Solve A x = b, from what x is; what functions have thrown comes at
  /// the end.
  Iterations solve(std::span<const double> b, std::span<double> x);

  /// @brief Apply its preconditioner, x = M b; what functions have thrown comes
  /// at the end.
  void precondition(std::span<const double> b, std::span<double> x);

  /// @brief Apply factors, x = A^-1 b or x = A^-T b; NaN where there are none.
  /// @return Whether there are.
  bool apply(std::span<const double> b, std::span<double> x, bool transposed);

  /// @brief Whether its preconditioner could be made; the same on all ranks.
  bool is_good() const;

private:
  static PetscErrorCode called(::Mat A, ::Vec x, ::Vec y);
  KSPConvergedReason reason() const;

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
          const std::string& prefix);

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
  Hierarchy(::Mat P, Apply multiply, const std::string& prefix);

  const std::vector<MatrixPtr>& prolongations() const override
  {
    return _prolongations;
  }

  const std::vector<MatrixPtr>& matrices() const override { return _matrices; }
  void set_diagonal(std::span<const double> diagonal) override;
  void update() override;
  void cycle(std::span<const double> b, std::span<double> x) override
  {
    _krylov.precondition(b, x);
  }

  Iterations solve(std::span<const double> b, std::span<double> x,
                   bool is_symmetric, double target, int most) override;

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
                Apply precondition, int restart);

  Iterations solve(std::span<const double> b, std::span<double> x,
                   const Test& test, int most) override;

private:
  static PetscErrorCode precondition_by(::PC pc, ::Vec r, ::Vec z);
  static PetscErrorCode test(::KSP, PetscInt count, PetscReal norm,
                             KSPConvergedReason* reason, void* context);

  Krylov _krylov;
  Apply _precondition;
  const Test* _test = nullptr;
};

/// @brief Make the first coarser level of a matrix, and nothing else.
/// @param[in] A The matrix with its near null space.
/// @param[in] prefix Prefix of PETSc's options.
std::optional<condense::Aggregates> aggregate(::Mat A,
                                              const std::string& prefix);
} // namespace contactx_dolfinx::petsc
