// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#include "algebra.h"
#include <algorithm>
#include <array>
#include <cmath>
#include <random>
#include <stdexcept>

namespace contactx_dolfinx
{
namespace
{
std::vector<std::int64_t> numbers(std::int64_t first,
                                  std::span<const std::int32_t> dofs)
{
  std::vector<std::int64_t> numbers;
  for (const std::int32_t dof : dofs)
    numbers.push_back(first + dof);
  return numbers;
}
} // namespace

DirectSolver::DirectSolver(Assembler& assembler, std::string prefix)
    : _assembler(&assembler), _prefix(std::move(prefix))
{
}

void DirectSolver::assemble(const contactx::condense::Springs& springs)
{
  if (_A.get() == nullptr)
  {
    *_A.put() = _assembler->create_matrix();
    _jacobian.emplace(_assembler->system(), _assembler->bulk());
  }
  _jacobian->assemble(_A.get(), springs);
}

bool DirectSolver::factorise()
{
  const ::Mat A = _A.get();
  PetscObjectState pattern = 0;
  petsc::check(MatGetNonzeroState(A, &pattern), "MatGetNonzeroState");
  // Two factorisations at once would be the largest part of the memory
  if (std::exchange(_pattern, pattern) != pattern)
    _krylov.reset();
  // The options of factors are read from the database when they are made
  petsc::Options options = petsc::direct_options();
  options["ksp_type"] = "gmres";
  options["ksp_pc_side"] = "right";
  options["ksp_gmres_restart"] = "60";
  const petsc::Defaults defaults(_prefix, options);
  if (not _krylov)
  {
    _krylov.emplace(petsc::comm_of(A), petsc::num_rows(A));
    petsc::check(KSPSetOptionsPrefix(_krylov->ksp(), _prefix.c_str()),
                 "KSPSetOptionsPrefix");
    petsc::check(KSPSetFromOptions(_krylov->ksp()), "KSPSetFromOptions");
  }
  // A matrix of the same pattern needs no new analysis
  petsc::keep_preconditioner(_krylov->pc(), false);
  petsc::set_operators(_krylov->ksp(), A, A);
  _krylov->set_up();
  petsc::keep_preconditioner(_krylov->pc(), true);
  if (_krylov->is_good())
    return true;
  // PETSc would keep the failure for matrices of this pattern, or solve
  // without factors
  _krylov.reset();
  return false;
}

contactx::condense::Iterations DirectSolver::solve(std::span<const double> b,
                                                   std::span<double> x,
                                                   double target, int most)
{
  if (not _krylov)
    throw std::logic_error("there are no factors to solve with");
  petsc::set_operators(_krylov->ksp(), _A.get(), _A.get());
  petsc::set_tolerances(_krylov->ksp(), target, most);
  std::ranges::fill(x, 0);
  return _krylov->solve(b, x);
}

void DirectSolver::reset()
{
  _krylov.reset();
  _A.put();
  _jacobian.reset();
}

Algebra::Algebra(Assembler& assembler, std::string prefix)
    : Matrices(assembler.bulk()->u()->function_space()->mesh()->comm()),
      _assembler(&assembler), _bulk(assembler.bulk()),
      _prefix(std::move(prefix))
{
}
bool Algebra::is_symmetric()
{
  const ::Mat K = stiffness();
  if (_symmetry_of == assemblies())
    return _is_symmetric;
  petsc::OwnVec x, y, work;
  for (auto* v : {&x, &y, &work})
    petsc::check(MatCreateVecs(K, v->put(), nullptr), "MatCreateVecs");
  std::mt19937_64 random(dolfinx::MPI::rank(comm()));
  std::normal_distribution<double> normal;
  for (::Vec v : {x.get(), y.get()})
  {
    const petsc::Values values(v);
    std::ranges::generate(values.span(), [&] { return normal(random); });
  }
  PetscReal size_of_x = 0, size = 0;
  PetscScalar one = 0, other = 0;
  petsc::check(MatMult(K, y.get(), work.get()), "MatMult");
  petsc::check(VecDot(x.get(), work.get(), &one), "VecDot");
  petsc::check(VecNorm(work.get(), NORM_2, &size), "VecNorm");
  petsc::check(VecNorm(x.get(), NORM_2, &size_of_x), "VecNorm");
  petsc::check(MatMult(K, x.get(), work.get()), "MatMult");
  petsc::check(VecDot(y.get(), work.get(), &other), "VecDot");
  _symmetry_of = assemblies();
  return _is_symmetric = std::abs(one - other) <= 1e-12 * size * size_of_x;
}

Algebra::MatrixPtr Algebra::bulk()
{
  const ::Mat K = stiffness();
  if (not _K or petsc::of(*_K) != K)
    _K = petsc::share(K);
  return _K;
}
Algebra::MatrixPtr Algebra::bulk_rows(std::span<const std::int32_t> dofs)
{
  const ::Mat K = stiffness();
  if (_rows and _rows_of == assemblies())
    return _rows;
  PetscInt first = 0, last = 0;
  petsc::check(MatGetOwnershipRange(K, &first, &last), "MatGetOwnershipRange");
  std::vector<PetscInt> numbers;
  for (const std::int32_t dof : dofs)
    numbers.push_back(first + dof);
  petsc::OwnIS some, every;
  make(some, numbers);
  petsc::check(ISCreateStride(comm(), last - first, first, 1, every.put()),
               "ISCreateStride");
  _rows = std::make_shared<petsc::Matrix>();
  petsc::check(MatCreateSubMatrix(K, some.get(), every.get(),
                                  MAT_INITIAL_MATRIX, _rows->A.put()),
               "MatCreateSubMatrix");
  _rows_of = assemblies();
  return _rows;
}

contactx::condense::FieldBlocks Algebra::field_blocks()
{
  const auto& blocks = parts();
  return {blocks[0][1], blocks[1][0], blocks[1][1]};
}

std::unique_ptr<contactx::condense::Factors>
Algebra::factorise(MatrixPtr A,
                   const contactx::condense::FactorOptions& options)
{
  return std::make_unique<petsc::Factors>(
      *A, options, _prefix + std::string(options.name) + "_");
}

std::unique_ptr<contactx::condense::Hierarchy>
Algebra::hierarchy(MatrixPtr A,
                   const std::vector<std::vector<double>>& near_null_space,
                   int block_size, Apply multiply)
{
  petsc::set_near_null_space(petsc::of(*A), near_null_space, block_size);
  return std::make_unique<petsc::Hierarchy>(petsc::of(*A), std::move(multiply),
                                            _prefix);
}

std::optional<contactx::condense::Aggregates>
Algebra::aggregate(MatrixPtr A,
                   const std::vector<std::vector<double>>& near_null_space,
                   int block_size)
{
  petsc::set_near_null_space(petsc::of(*A), near_null_space, block_size);
  return petsc::aggregate(petsc::of(*A), _prefix + "bodies_model_");
}

std::unique_ptr<contactx::condense::FlexibleGMRES>
Algebra::flexible_gmres(std::size_t size, Apply multiply, Apply precondition,
                        int restart)
{
  return std::make_unique<petsc::FlexibleGMRES>(
      comm(), size, std::move(multiply), std::move(precondition), restart);
}

std::unique_ptr<contactx::condense::DirectSolver> Algebra::direct_solver()
{
  return std::make_unique<DirectSolver>(*_assembler, _prefix + "direct_");
}

std::string Algebra::preconditioner() const
{
  std::array<char, 256> type{};
  petsc::check(PetscOptionsGetString(nullptr, _prefix.c_str(), "-pc_type",
                                     type.data(), type.size(), nullptr),
               "PetscOptionsGetString");
  return type.data();
}

::Mat Algebra::stiffness()
{
  return _bulk->fields() ? petsc::of(*parts()[0][0]) : _bulk->matrix();
}

const Algebra::Blocks& Algebra::parts()
{
  _bulk->assemble();
  if (std::exchange(_parts_of, assemblies()) == assemblies())
    return _parts;
  _parts.clear();
  Blocks all;
  _bulk->for_each_part(
      [&](int i, std::span<const std::int32_t> rows)
      {
        auto& row = all.emplace_back();
        _bulk->for_each_part(
            [&](int j, std::span<const std::int32_t> columns)
            {
              const MatrixPtr K = petsc::share(_bulk->block(i, j));
              const contactx::condense::Layout at = layout(*K);
              row.push_back(submatrix(*K, numbers(at.first_row, rows),
                                      numbers(at.first_column, columns)));
            });
      });
  for (const auto& [first, last] :
       {std::pair(std::size_t(0), std::size_t(1)), {1, all.size()}})
  {
    Blocks left, right;
    for (std::size_t i = first; i < last; ++i)
    {
      left.push_back({all[i].front()});
      right.emplace_back(all[i].begin() + 1, all[i].end());
    }
    _parts.push_back({joined(left), joined(right)});
  }
  return _parts;
}

Algebra::MatrixPtr Algebra::joined(const Blocks& blocks)
{
  return blocks.size() * blocks[0].size() == 1 ? blocks[0][0] : join(blocks);
}
} // namespace contactx_dolfinx
