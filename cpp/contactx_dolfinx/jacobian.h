// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#pragma once

#include "bulk.h"
#include <contactx/condense/coupled_rows.h>
#include <contactx/newton/system.h>
#include <contactx/parallel/spread.h>

namespace contactx::dolfinx
{
/// @brief Jacobian of bulk and contacts as a matrix of PETSc: a saddle point.
///
/// Each rank's unknowns are its displacements, followed by its multipliers. All
/// ranks must take part in everything.
class Jacobian
{
public:
  /// @brief Lay out the unknowns.
  /// @param[in] system The system.
  /// @param[in] bulk Its bulk.
  Jacobian(std::shared_ptr<newton::System> system, std::shared_ptr<Bulk> bulk)
      : _system(std::move(system)), _bulk(std::move(bulk))
  {
    parallel::Ranks& ranks = _system->halo()->ranks();
    const std::array mine{static_cast<double>(_system->num_displacements()),
                          static_cast<double>(_system->size())};
    const std::vector<double> sizes = ranks.gather(mine);
    std::int64_t of_bulk = 0, of_all = 0;
    for (int r = 0; r < ranks.size(); ++r)
    {
      _bulk_starts.push_back(of_bulk);
      _starts.push_back(of_all);
      of_bulk += static_cast<std::int64_t>(sizes[2 * r]);
      of_all += static_cast<std::int64_t>(sizes[2 * r + 1]);
    }
    _start = _starts[ranks.rank()];
  }

  /// @brief Assemble the Jacobian at the state of now.
  /// @param[in] A Matrix of the system's sizes, as `Assembler::create_matrix`
  /// makes it: written to, with another pattern if pairs have changed.
  /// @param[in] springs Stiffness that is added to the diagonal of the
  /// displacements (shape=(num_displacements)), or nothing.
  void assemble(::Mat A, const std::optional<std::vector<double>>& springs)
  {
    const parallel::Halo& halo = *_system->halo();
    const condense::ContactBlock contact(_system->contacts(), markers(), true);
    const condense::Rows& bulk = bulk_rows();
    const condense::CoupledRows rows
        = condense::coupled(bulk.offsets, bulk.columns, bulk.values, contact,
                            places(), _system->num_displacements(),
                            std::size_t(halo.num_nodes()) * halo.gdim());

    PetscObjectId id = 0;
    petsc::check(PetscObjectGetId(reinterpret_cast<PetscObject>(A), &id),
                 "PetscObjectGetId");
    Pattern pattern{id,          rows.own.offsets,   rows.own.columns,
                    rows.others, rows.added.offsets, rows.added.columns};
    const bool same = parallel::everywhere(halo.ranks(), pattern == _pattern);
    _pattern = std::move(pattern);
    if (same)
      petsc::check(MatZeroEntries(A), "MatZeroEntries");
    else
      petsc::check(MatResetHash(A), "MatResetHash");
    std::vector<std::int64_t> own(_system->size());
    std::iota(own.begin(), own.end(), _start);
    add(A, own, rows.own);
    add(A, rows.others, rows.added);
    petsc::check(MatAssemblyBegin(A, MAT_FINAL_ASSEMBLY), "MatAssemblyBegin");
    petsc::check(MatAssemblyEnd(A, MAT_FINAL_ASSEMBLY), "MatAssemblyEnd");

    petsc::OwnVec diagonal;
    petsc::check(MatCreateVecs(A, nullptr, diagonal.put()), "MatCreateVecs");
    const std::size_t n = _system->num_displacements();
    if (springs)
    {
      petsc::check(VecZeroEntries(diagonal.get()), "VecZeroEntries");
      std::ranges::copy(*springs, petsc::Values(diagonal.get()).span().begin());
      petsc::check(MatDiagonalSet(A, diagonal.get(), ADD_VALUES),
                   "MatDiagonalSet");
    }
    {
      const petsc::Values values(diagonal.get());
      std::ranges::fill(values.span().first(n), 1);
      std::ranges::copy(_system->factors(), values.span().begin() + n);
    }
    petsc::check(MatDiagonalScale(A, nullptr, diagonal.get()),
                 "MatDiagonalScale");
  }

private:
  struct Pattern
  {
    PetscObjectId matrix = 0;
    std::vector<std::int64_t> offsets, columns, others, added_offsets,
        added_columns;
    bool operator==(const Pattern&) const = default;
  };

  /// Places of the displacements of all nodes, then of this rank's multipliers.
  std::vector<std::int64_t> places() const
  {
    const parallel::Halo& halo = *_system->halo();
    const int g = halo.gdim();
    std::vector<std::int64_t> first(halo.num_nodes());
    for (std::int32_t i = 0; i < halo.num_owned(); ++i)
      first[i] = _start + std::int64_t(g) * i;
    halo.forward(std::span<std::int64_t>(first), 1);
    std::vector<std::int64_t> places;
    places.reserve(first.size() * g + _system->size());
    for (std::int64_t place : first)
      for (int k = 0; k < g; ++k)
        places.push_back(place + k);
    for (std::size_t i = _system->num_displacements(); i < _system->size(); ++i)
      places.push_back(_start + static_cast<std::int64_t>(i));
    return places;
  }

  /// 1 at prescribed displacements of all nodes.
  std::vector<std::int8_t> markers() const
  {
    const parallel::Halo& halo = *_system->halo();
    std::vector<std::int64_t> all(std::size_t(halo.num_nodes()) * halo.gdim());
    std::ranges::copy(_bulk->markers(), all.begin());
    halo.forward(std::span<std::int64_t>(all), halo.gdim());
    return {all.begin(), all.end()};
  }

  /// Rows of the bulk's Jacobian, kept while it stays.
  const condense::Rows& bulk_rows()
  {
    const ::Mat K = _bulk->matrix();
    if (_bulk->assemblies() == _assemblies)
      return _rows;
    PetscInt begin = 0, end = 0;
    petsc::check(MatGetOwnershipRange(K, &begin, &end), "MatGetOwnershipRange");
    _rows = {{0}, {}, {}};
    for (PetscInt i = begin; i < end; ++i)
    {
      PetscInt count = 0;
      const PetscInt* columns = nullptr;
      const PetscScalar* values = nullptr;
      petsc::check(MatGetRow(K, i, &count, &columns, &values), "MatGetRow");
      for (PetscInt j = 0; j < count; ++j)
      {
        const auto next = std::ranges::upper_bound(_bulk_starts, columns[j]);
        const auto rank = next - _bulk_starts.begin() - 1;
        _rows.columns.push_back(columns[j] + _starts[rank]
                                - _bulk_starts[rank]);
      }
      _rows.values.insert(_rows.values.end(), values, values + count);
      _rows.offsets.push_back(static_cast<std::int64_t>(_rows.columns.size()));
      petsc::check(MatRestoreRow(K, i, &count, &columns, &values),
                   "MatRestoreRow");
    }
    _assemblies = _bulk->assemblies();
    return _rows;
  }

  static void add(::Mat A, std::span<const std::int64_t> numbers,
                  const condense::Rows& rows)
  {
    std::vector<PetscInt> columns;
    for (std::size_t i = 0; i < numbers.size(); ++i)
    {
      const auto row = static_cast<PetscInt>(numbers[i]);
      const auto begin = rows.offsets[i], end = rows.offsets[i + 1];
      columns.assign(rows.columns.begin() + begin, rows.columns.begin() + end);
      petsc::check(
          MatSetValues(A, 1, &row, static_cast<PetscInt>(columns.size()),
                       columns.data(), rows.values.data() + begin, ADD_VALUES),
          "MatSetValues");
    }
  }

  std::shared_ptr<newton::System> _system;
  std::shared_ptr<Bulk> _bulk;
  // Where the displacements of each rank start in the bulk, and in all
  std::vector<std::int64_t> _bulk_starts, _starts;
  std::int64_t _start;
  condense::Rows _rows;
  int _assemblies = -1;
  Pattern _pattern;
};
} // namespace contactx::dolfinx
