// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#include "jacobian.h"
#include "bulk.h"
#include "conductance.h"
#include "contact.h"
#include <algorithm>
#include <contactx/mesh/spread.h>
#include <contactx/solve/system.h>

namespace contactx_dolfinx
{
namespace
{
/// Adds entries to a matrix, those of one row that follow one another
/// together.
void set(::Mat A, const contactx::condense::Entries& all)
{
  const std::vector<PetscInt> columns(all.columns.begin(), all.columns.end());
  for (std::size_t first = 0, end = 0; first < all.rows.size(); first = end)
  {
    while (end < all.rows.size() and all.rows[end] == all.rows[first])
      ++end;
    const auto row = static_cast<PetscInt>(all.rows[first]);
    petsc::check(MatSetValues(A, 1, &row, static_cast<PetscInt>(end - first),
                              &columns[first], &all.values[first], ADD_VALUES),
                 "MatSetValues");
  }
  petsc::check(MatAssemblyBegin(A, MAT_FINAL_ASSEMBLY), "MatAssemblyBegin");
  petsc::check(MatAssemblyEnd(A, MAT_FINAL_ASSEMBLY), "MatAssemblyEnd");
}

void add(contactx::condense::Entries& all,
         const contactx::condense::Entries& more)
{
  all.rows.insert(all.rows.end(), more.rows.begin(), more.rows.end());
  all.columns.insert(all.columns.end(), more.columns.begin(),
                     more.columns.end());
  all.values.insert(all.values.end(), more.values.begin(), more.values.end());
}
} // namespace

Jacobian::Jacobian(std::shared_ptr<contactx::solve::System> system,
                   std::shared_ptr<Bulk> bulk)
    : _system(std::move(system)), _bulk(std::move(bulk))
{
  _start = contactx::mesh::total_before(
      _system->halo()->ranks(), static_cast<std::int64_t>(_system->size()));
}

void Jacobian::assemble(::Mat A,
                        const std::optional<std::vector<double>>& springs)
{
  const contactx::condense::ContactBlock contact(_system->contacts(),
                                                 _system->markers(), true);
  const std::vector<std::int64_t> places = this->places();
  contactx::condense::Entries all = of_bulk();
  add(all, contact.entries(places));
  for (const auto& conductance : _bulk->conductances())
    add(all, of_conductance(*conductance, places));

  PetscObjectId id = 0;
  petsc::check(PetscObjectGetId(reinterpret_cast<PetscObject>(A), &id),
               "PetscObjectGetId");
  const bool same
      = id == _matrix and all.rows == _rows and all.columns == _columns;
  if (contactx::mesh::everywhere(_system->halo()->ranks(), same))
    petsc::check(MatZeroEntries(A), "MatZeroEntries");
  else
    petsc::check(MatResetHash(A), "MatResetHash");
  set(A, all);
  _matrix = id;
  _rows = std::move(all.rows);
  _columns = std::move(all.columns);

  finish(A, *_system, springs);
}

void Jacobian::finish(::Mat A, const contactx::solve::System& system,
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

std::vector<std::int64_t> Jacobian::places() const
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

const contactx::condense::Entries& Jacobian::of_bulk()
{
  _bulk->assemble();
  if (std::exchange(_assemblies, _bulk->assemblies()) == _bulk->assemblies())
    return _of_bulk;
  const bool is_known = not _of_bulk.rows.empty();
  _of_bulk.values.clear();
  const int n = static_cast<int>(_bulk->functions().size());
  for (int i = 0; i < n; ++i)
    for (int j = 0; j < n; ++j)
    {
      // The forms, and with them the pattern, stay the same
      std::vector<std::int64_t> columns;
      const std::vector<std::int64_t> mine = places_of(i);
      append(_bulk->block(i, j), is_known ? nullptr : &columns, mine);
      if (not is_known)
      {
        const std::vector<std::int64_t> places = places_of(j, columns);
        _of_bulk.columns.insert(_of_bulk.columns.end(), places.begin(),
                                places.end());
      }
    }
  return _of_bulk;
}

void Jacobian::append(::Mat K, std::vector<std::int64_t>* columns,
                      std::span<const std::int64_t> places)
{
  PetscInt row = 0;
  petsc::check(MatGetOwnershipRange(K, &row, nullptr), "MatGetOwnershipRange");
  for (const std::int64_t place : places)
  {
    PetscInt count = 0;
    const PetscInt* numbers = nullptr;
    const PetscScalar* values = nullptr;
    petsc::check(MatGetRow(K, row, &count, &numbers, &values), "MatGetRow");
    _of_bulk.values.insert(_of_bulk.values.end(), values, values + count);
    if (columns)
    {
      columns->insert(columns->end(), numbers, numbers + count);
      _of_bulk.rows.resize(_of_bulk.values.size(), place);
    }
    petsc::check(MatRestoreRow(K, row, &count, &numbers, &values),
                 "MatRestoreRow");
    ++row;
  }
}

std::vector<std::int64_t> Jacobian::places_of(int function) const
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

std::vector<std::int64_t>
Jacobian::places_of(int function, std::span<const std::int64_t> wanted)
{
  const std::vector<std::int64_t> own = places_of(function);
  petsc::OwnVec every, found;
  petsc::check(VecCreateMPI(_bulk->u()->function_space()->mesh()->comm(),
                            static_cast<PetscInt>(own.size()), PETSC_DETERMINE,
                            every.put()),
               "VecCreateMPI");
  // Numbers up to 2^53 are exact
  std::ranges::copy(own, petsc::Values(every.get()).span().begin());
  const std::vector<PetscInt> numbers(wanted.begin(), wanted.end());
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

contactx::condense::Entries
Jacobian::of_conductance(Conductance& conductance,
                         std::span<const std::int64_t> places) const
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
  contactx::condense::Entries entries;
  const auto append
      = [&](const contactx::Triplets& T, std::span<const std::int64_t> columns)
  {
    for (std::size_t e = 0; e < T.size(); ++e)
      if (const auto node = T.rows[e]; not fixed[node])
      {
        entries.rows.push_back(dofs[node]);
        entries.columns.push_back(columns[T.columns[e]]);
        entries.values.push_back(T.values[e]);
      }
  };
  const contactx::results::Derivatives of = conductance.derivatives();
  append(of.by_field, dofs);
  append(of.by_displacement, places);
  append(of.by_multiplier, places.subspan(multiplier));
  return entries;
}
} // namespace contactx_dolfinx
