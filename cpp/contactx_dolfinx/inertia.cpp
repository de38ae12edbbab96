// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#include "inertia.h"
#include <algorithm>
#include <cmath>
#include <contactx/mesh/ranks.h>
#include <dolfinx/fem/assembler.h>
#include <dolfinx/fem/petsc.h>
#include <functional>

namespace contactx_dolfinx
{
namespace
{
// Row sums of a diagonal matrix differ from its diagonal by round-off
constexpr double rel_tol = 1e-10;

std::vector<double> copied(::Vec x)
{
  const petsc::ConstValues values(x);
  return {values.span().begin(), values.span().end()};
}
} // namespace

Inertia::Inertia(const Form& mass, std::shared_ptr<const Form> loads,
                 std::shared_ptr<const Form> strain_energy,
                 contactx::mesh::Ranks& ranks)
    : _loads(std::move(loads)), _strain_energy(std::move(strain_energy)),
      _A(dolfinx::fem::petsc::create_matrix(mass))
{
  const ::Mat A = _A.get();
  dolfinx::fem::assemble_matrix(
      dolfinx::la::petsc::Matrix::set_block_fn(A, ADD_VALUES), mass, {});
  petsc::check(MatAssemblyBegin(A, MAT_FINAL_ASSEMBLY), "MatAssemblyBegin");
  petsc::check(MatAssemblyEnd(A, MAT_FINAL_ASSEMBLY), "MatAssemblyEnd");
  petsc::check(MatCreateVecs(A, _x.put(), _y.put()), "MatCreateVecs");
  petsc::check(MatGetDiagonal(A, _y.get()), "MatGetDiagonal");
  _diagonal = copied(_y.get());

  const std::vector<double> ones(_diagonal.size(), 1);
  const std::span<const double> sums = product(ones);
  bool is_diagonal = true;
  for (std::size_t i = 0; i < sums.size(); ++i)
    is_diagonal = is_diagonal
                  and std::abs(sums[i] - _diagonal[i])
                          <= rel_tol * std::abs(_diagonal[i]);
  _is_lumped = contactx::mesh::everywhere(ranks, is_diagonal);

  const auto& dofs = *mass.function_spaces()[0]->dofmap();
  _b.emplace(dofs.index_map, dofs.index_map_bs());
}

std::span<const double> Inertia::product(std::span<const double> velocity)
{
  std::ranges::copy(velocity, petsc::Values(_x.get()).span().begin());
  petsc::check(MatMult(_A.get(), _x.get(), _y.get()), "MatMult");
  return _product = copied(_y.get());
}

void Inertia::constrain(std::span<const std::int8_t> markers)
{
  _markers.assign(markers.begin(), markers.end());
  petsc::check(MatDuplicate(_A.get(), MAT_COPY_VALUES, _free.put()),
               "MatDuplicate");
  const ::Mat A = _free.get();
  PetscInt first = 0;
  petsc::check(MatGetOwnershipRange(A, &first, nullptr),
               "MatGetOwnershipRange");
  std::vector<PetscInt> rows;
  for (std::size_t i = 0; i < _markers.size(); ++i)
    if (_markers[i])
      rows.push_back(first + static_cast<PetscInt>(i));
  petsc::check(MatZeroRowsColumns(A, static_cast<PetscInt>(rows.size()),
                                  rows.data(), 1, nullptr, nullptr),
               "MatZeroRowsColumns");
  MPI_Comm comm = MPI_COMM_NULL;
  petsc::check(PetscObjectGetComm(reinterpret_cast<PetscObject>(A), &comm),
               "PetscObjectGetComm");
  petsc::check(KSPCreate(comm, _ksp.put()), "KSPCreate");
  petsc::check(KSPSetOperators(_ksp.get(), A, A), "KSPSetOperators");
  petsc::set_lu(_ksp.get());
}

void Inertia::solve(std::span<double> values)
{
  {
    const petsc::Values b(_x.get());
    for (std::size_t i = 0; i < values.size(); ++i)
      b.span()[i] = _markers[i] ? 0 : values[i];
  }
  petsc::check(KSPSolve(_ksp.get(), _x.get(), _y.get()), "KSPSolve");
  std::ranges::copy(petsc::ConstValues(_y.get()).span(), values.begin());
}

std::optional<double> Inertia::strain_energy()
{
  if (not _strain_energy)
    return std::nullopt;
  return dolfinx::fem::assemble_scalar(*_strain_energy);
}

std::span<const double> Inertia::loads()
{
  if (not _loads)
    return {};
  std::ranges::fill(_b->array(), 0);
  dolfinx::fem::assemble_vector(_b->array(), *_loads);
  _b->scatter_rev(std::plus<double>());
  return std::span<const double>(_b->array()).first(_diagonal.size());
}
} // namespace contactx_dolfinx
