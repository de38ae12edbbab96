// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#pragma once

#include "bulk.h"
#include <contactx/condense/coupled_rows.h>
#include <contactx/mesh/spread.h>
#include <contactx/solve/system.h>

namespace contactx_dolfinx
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
  Jacobian(std::shared_ptr<contactx::solve::System> system,
           std::shared_ptr<Bulk> bulk)
      : _system(std::move(system)), _bulk(std::move(bulk))
  {
    const std::array mine{static_cast<double>(_system->size())};
    contactx::mesh::Ranks& ranks = _system->halo()->ranks();
    const std::vector<double> sizes = ranks.gather(mine);
    for (int r = 0; r < ranks.rank(); ++r)
      _start += static_cast<std::int64_t>(sizes[r]);
  }

  /// @brief Assemble the Jacobian at the state of now.
  /// @param[in] A Matrix of the system's sizes, as `Assembler::create_matrix`
  /// makes it: written to, with another pattern if pairs have changed.
  /// @param[in] springs Stiffness that is added to the diagonal of the
  /// displacements (shape=(num_displacements)), or nothing.
  void assemble(::Mat A, const std::optional<std::vector<double>>& springs)
  {
    const contactx::mesh::Halo& halo = *_system->halo();
    const contactx::condense::ContactBlock contact(_system->contacts(),
                                                   _system->markers(), true);
    const contactx::condense::Rows& bulk = bulk_rows();
    const std::vector<std::int64_t> places = this->places();
    const contactx::condense::CoupledRows rows = contactx::condense::coupled(
        bulk.offsets, bulk.columns, bulk.values, contact, places,
        _system->num_displacements(),
        std::size_t(halo.num_nodes()) * halo.gdim());

    PetscObjectId id = 0;
    petsc::check(PetscObjectGetId(reinterpret_cast<PetscObject>(A), &id),
                 "PetscObjectGetId");
    Pattern pattern{id,          rows.own.offsets,   rows.own.columns,
                    rows.others, rows.added.offsets, rows.added.columns};
    // That of a flow goes with gaps and pressures, too
    const bool same
        = _bulk->conductances().empty()
          and contactx::mesh::everywhere(halo.ranks(), pattern == _pattern);
    _pattern = std::move(pattern);
    if (same)
      petsc::check(MatZeroEntries(A), "MatZeroEntries");
    else
      petsc::check(MatResetHash(A), "MatResetHash");
    std::vector<std::int64_t> own(_system->size());
    std::iota(own.begin(), own.end(), _start);
    add(A, own, rows.own);
    add(A, rows.others, rows.added);
    for (const auto& conductance : _bulk->conductances())
      add(A, *conductance, places);
    petsc::check(MatAssemblyBegin(A, MAT_FINAL_ASSEMBLY), "MatAssemblyBegin");
    petsc::check(MatAssemblyEnd(A, MAT_FINAL_ASSEMBLY), "MatAssemblyEnd");

    finish(A, *_system, springs);
  }

  /// @brief Add what holds free bodies to an assembled Jacobian, and take the
  /// units of the unknowns.
  /// @param[in] A Jacobian by displacements and multipliers.
  /// @param[in] system The system.
  /// @param[in] springs As for `assemble`.
  static void finish(::Mat A, const contactx::solve::System& system,
                     const std::optional<std::vector<double>>& springs)
  {
    petsc::OwnVec diagonal;
    petsc::check(MatCreateVecs(A, nullptr, diagonal.put()), "MatCreateVecs");
    const std::size_t n = system.num_bulk();
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
      std::ranges::copy(system.factors(), values.span().begin() + n);
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
    const contactx::mesh::Halo& halo = *_system->halo();
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
    for (std::size_t i = _system->num_bulk(); i < _system->size(); ++i)
      places.push_back(_start + static_cast<std::int64_t>(i));
    return places;
  }

  /// Rows of the bulk's Jacobian, kept while it stays: displacements, then
  /// other fields.
  const contactx::condense::Rows& bulk_rows()
  {
    _bulk->assemble();
    if (_bulk->assemblies() == _assemblies)
      return _rows;
    const int n = static_cast<int>(_bulk->functions().size());
    std::vector<std::int64_t> firsts{0};
    for (const auto& w : _bulk->functions())
    {
      const auto& dofs = *w->function_space()->dofmap();
      firsts.push_back(firsts.back()
                       + dofs.index_map_bs() * dofs.index_map->size_global());
    }
    contactx::condense::Rows rows{{0}, {}, {}};
    _bulk->for_each_part(
        [&](int k, const std::vector<std::int32_t>& dofs)
        {
          for (const std::int32_t dof : dofs)
          {
            for (int j = 0; j < n; ++j)
              append(rows, _bulk->block(k, j), dof, firsts[j]);
            rows.offsets.push_back(
                static_cast<std::int64_t>(rows.columns.size()));
          }
        });
    if (contactx::mesh::everywhere(_system->halo()->ranks(),
                                   rows.offsets == _rows.offsets))
      rows.columns = std::move(_rows.columns);
    else
      find_places(rows, firsts);
    if (not _order.empty())
    {
      std::vector<double> values(rows.values.size());
      for (std::size_t i = 0; i < values.size(); ++i)
        values[i] = rows.values[_order[i]];
      rows.values = std::move(values);
    }
    _rows = std::move(rows);
    _assemblies = _bulk->assemblies();
    return _rows;
  }

  /// Appends a row of a block, its columns counted over all functions.
  static void append(contactx::condense::Rows& rows, ::Mat K, std::int32_t row,
                     std::int64_t first_column)
  {
    PetscInt first = 0, count = 0;
    petsc::check(MatGetOwnershipRange(K, &first, nullptr),
                 "MatGetOwnershipRange");
    const PetscInt* columns = nullptr;
    const PetscScalar* values = nullptr;
    petsc::check(MatGetRow(K, first + row, &count, &columns, &values),
                 "MatGetRow");
    for (PetscInt j = 0; j < count; ++j)
      rows.columns.push_back(first_column + columns[j]);
    rows.values.insert(rows.values.end(), values, values + count);
    petsc::check(MatRestoreRow(K, first + row, &count, &columns, &values),
                 "MatRestoreRow");
  }

  /// Puts places where columns are, in each row in their order.
  void find_places(contactx::condense::Rows& rows,
                   std::span<const std::int64_t> firsts)
  {
    std::vector<std::int64_t> wanted = rows.columns;
    std::ranges::sort(wanted);
    wanted.erase(std::ranges::unique(wanted).begin(), wanted.end());
    std::vector<std::int64_t> places;
    for (std::size_t j = 0; j + 1 < firsts.size(); ++j)
    {
      const auto begin = std::ranges::lower_bound(wanted, firsts[j]);
      const auto end = std::ranges::lower_bound(wanted, firsts[j + 1]);
      const auto some = places_of(static_cast<int>(j), firsts[j], {begin, end});
      places.insert(places.end(), some.begin(), some.end());
    }
    for (std::int64_t& column : rows.columns)
      column
          = places[std::ranges::lower_bound(wanted, column) - wanted.begin()];
    _order.resize(rows.columns.size());
    std::iota(_order.begin(), _order.end(), 0);
    for (std::size_t r = 0; r + 1 < rows.offsets.size(); ++r)
      std::sort(_order.begin() + rows.offsets[r],
                _order.begin() + rows.offsets[r + 1],
                [&](std::size_t a, std::size_t b)
                { return rows.columns[a] < rows.columns[b]; });
    // As they are for a displacement alone
    if (std::ranges::is_sorted(_order))
    {
      _order.clear();
      return;
    }
    std::vector<std::int64_t> columns(_order.size());
    for (std::size_t i = 0; i < columns.size(); ++i)
      columns[i] = rows.columns[_order[i]];
    rows.columns = std::move(columns);
  }

  /// Places of the dofs of a function that this rank owns.
  std::vector<std::int64_t> places_of(int function) const
  {
    std::vector<std::int64_t> places(
        Unknowns::num_owned(*_bulk->functions()[function]));
    std::int64_t place = _start;
    _bulk->for_each_part(
        [&](int k, const std::vector<std::int32_t>& dofs)
        {
          for (const std::int32_t dof : dofs)
          {
            if (k == function)
              places[dof] = place;
            ++place;
          }
        });
    return places;
  }

  /// Places of some dofs of a function, of any ranks.
  /// @param[in] function Number of the function.
  /// @param[in] first What its first dof is counted as.
  /// @param[in] wanted The dofs.
  std::vector<std::int64_t> places_of(int function, std::int64_t first,
                                      std::span<const std::int64_t> wanted)
  {
    const std::vector<std::int64_t> own = places_of(function);
    petsc::OwnVec every, found;
    petsc::check(VecCreateMPI(_bulk->u()->function_space()->mesh()->comm(),
                              static_cast<PetscInt>(own.size()),
                              PETSC_DETERMINE, every.put()),
                 "VecCreateMPI");
    // Numbers up to 2^53 are exact
    std::ranges::copy(own, petsc::Values(every.get()).span().begin());
    std::vector<PetscInt> numbers;
    for (const std::int64_t number : wanted)
      numbers.push_back(static_cast<PetscInt>(number - first));
    const auto count = static_cast<PetscInt>(numbers.size());
    petsc::check(VecCreateSeq(PETSC_COMM_SELF, count, found.put()),
                 "VecCreateSeq");
    petsc::Owner<IS, ISDestroy> from;
    petsc::check(ISCreateGeneral(PETSC_COMM_SELF, count, numbers.data(),
                                 PETSC_COPY_VALUES, from.put()),
                 "ISCreateGeneral");
    petsc::Owner<VecScatter, VecScatterDestroy> scatter;
    petsc::check(VecScatterCreate(every.get(), from.get(), found.get(), nullptr,
                                  scatter.put()),
                 "VecScatterCreate");
    for (const auto& [step, name] :
         {std::pair{VecScatterBegin, "VecScatterBegin"},
          std::pair{VecScatterEnd, "VecScatterEnd"}})
      petsc::check(step(scatter.get(), every.get(), found.get(), INSERT_VALUES,
                        SCATTER_FORWARD),
                   name);
    const petsc::ConstValues values(found.get());
    return {values.span().begin(), values.span().end()};
  }

  /// Adds the derivatives of a conductance.
  /// @param[in] A Jacobian, not scaled yet.
  /// @param[in] conductance What flows.
  /// @param[in] places Those of the displacements of all nodes, then of this
  /// rank's multipliers.
  void add(::Mat A, Conductance& conductance,
           std::span<const std::int64_t> places)
  {
    const int k = _bulk->number_of(*conductance.field());
    const std::vector<std::int8_t>& markers = _bulk->markers_of(k);
    const std::vector<std::int64_t> own = places_of(k);
    const std::vector<std::int64_t> dofs = conductance.at_nodes(own);
    const std::vector<std::int64_t> fixed
        = conductance.at_nodes(std::vector<std::int64_t>(
            markers.begin(), markers.begin() + std::ptrdiff_t(own.size())));
    std::size_t multiplier
        = std::size_t(_system->halo()->num_nodes()) * _system->halo()->gdim();
    for (const auto& c : _system->contacts())
    {
      if (c == conductance.contact()->shared_discrete())
        break;
      multiplier += c->nodes()->multiplier.size();
    }
    const contactx::results::Derivatives of = conductance.derivatives();
    const auto add_entries =
        [&](const contactx::Triplets& T, std::span<const std::int64_t> columns)
    {
      for (std::size_t e = 0; e < T.size(); ++e)
        if (const auto node = T.rows[e]; not fixed[node])
          petsc::check(MatSetValue(A, static_cast<PetscInt>(dofs[node]),
                                   static_cast<PetscInt>(columns[T.columns[e]]),
                                   T.values[e], ADD_VALUES),
                       "MatSetValue");
    };
    add_entries(of.by_field, dofs);
    add_entries(of.by_displacement, places);
    add_entries(of.by_multiplier, places.subspan(multiplier));
  }

  static void add(::Mat A, std::span<const std::int64_t> numbers,
                  const contactx::condense::Rows& rows)
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

  std::shared_ptr<contactx::solve::System> _system;
  std::shared_ptr<Bulk> _bulk;
  std::int64_t _start = 0; // place of this rank's first unknown
  contactx::condense::Rows _rows;
  std::vector<std::size_t> _order; // of the entries, as blocks have them
  int _assemblies = -1;
  Pattern _pattern;
};
} // namespace contactx_dolfinx
