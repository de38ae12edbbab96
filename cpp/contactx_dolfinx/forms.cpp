// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#include "forms.h"
#include "jacobian.h"
#include <algorithm>
#include <dolfinx/fem/assembler.h>
#include <dolfinx/fem/utils.h>
#include <dolfinx/la/SparsityPattern.h>
#include <dolfinx/la/petsc.h>
#include <stdexcept>

namespace contactx_dolfinx
{
namespace
{
void assemble(::Mat A, MatAssemblyType type)
{
  petsc::check(MatAssemblyBegin(A, type), "MatAssemblyBegin");
  petsc::check(MatAssemblyEnd(A, type), "MatAssemblyEnd");
}

auto references(const std::vector<std::pair<ContactForms::IndexMap, int>>& maps)
{
  std::vector<
      std::pair<std::reference_wrapper<const dolfinx::common::IndexMap>, int>>
      all;
  for (const auto& [map, width] : maps)
    all.emplace_back(*map, width);
  return all;
}
} // namespace

Forms::Forms(Assembler& assembler, std::shared_ptr<const Form> J)
    : _assembler(&assembler), _J(std::move(J))
{
  if (assembler.bulk()->fields())
    throw std::invalid_argument(
        "Forms is for a displacement alone, but the assembler solves for "
        "other fields, too: take the forms of each contact, "
        "contact->forms()");
  const auto V = assembler.bulk()->u()->function_space();
  if (not _J or _J->rank() != 2 or _J->function_spaces()[0] != V
      or _J->function_spaces()[1] != V)
    throw std::invalid_argument(
        "J must be a bilinear form of the displacement's space");
  refresh();
}

::Mat Forms::matrix()
{
  if (_made_for == _versions)
    petsc::check(MatZeroEntries(_A.get()), "MatZeroEntries");
  else
  {
    // KSP notices that the pattern is another one
    if (_A.get())
      petsc::check(MatResetHash(_A.get()), "MatResetHash");
    else
      create();
    set_numbers();
    _made_for = _versions;
  }
  return _A.get();
}

const Settled& Forms::settle(::Vec x, double rtol, double atol, int max_it)
{
  take(x);
  if (not _assembler->report().history.empty())
    _assembler->problem().moved();
  const Settled& found = _assembler->settle(rtol, atol, max_it);
  // Iterates may have been taken back
  const ::Vec now = _assembler->x();
  if (now != x)
    petsc::check(VecCopy(now, x), "VecCopy");
  evaluate();
  return found;
}

void Forms::update(::Vec x)
{
  take(x);
  evaluate();
}

void Forms::assemble_vector(::Vec b)
{
  _assembler->problem().enter("residual");
  const petsc::Values values(b);
  auto at = values.span().begin();
  dolfinx::la::Vector<double> force(_forms.front()->displacement_map, gdim());
  std::ranges::fill(force.array(), 0);
  for (const ContactForms* forms : _forms)
    for (const auto& form : forms->F_u)
      dolfinx::fem::assemble_vector(force.array(), *form);
  force.scatter_rev(std::plus<double>());
  for (std::size_t i = 0; i < system().num_displacements(); ++i, ++at)
    if (not _assembler->bulk()->markers()[i])
      *at += force.array()[i];
  for (const ContactForms* forms : _forms)
  {
    dolfinx::la::Vector<double> values(forms->multiplier_map,
                                       forms->multiplier_size);
    std::ranges::fill(values.array(), 0);
    for (const auto& form : forms->F_lambda)
      dolfinx::fem::assemble_vector(values.array(), *form);
    const int own
        = forms->multiplier_map->size_local() * forms->multiplier_size;
    for (int i = 0; i < own; ++i, ++at)
      *at += values.array()[i];
  }
}

void Forms::assemble_matrix(::Mat A)
{
  _assembler->problem().enter("jacobian");
  if (A != _A.get() or _made_for != _versions)
    throw std::invalid_argument(
        "A is not the matrix of the pairs of now: call matrix() again");
  assemble(A, MAT_FLUSH_ASSEMBLY);
  const std::vector<std::int8_t> markers = system().markers(), none;
  const auto maps = this->maps();
  std::vector<PetscInt> first{0};
  for (const auto& [map, width] : maps)
    first.push_back(first.back()
                    + width * (map->size_local() + map->num_ghosts()));
  for_each_block(
      [&](const Form& form, std::size_t i, std::size_t j)
      {
        const auto numbers
            = [&](std::size_t k, std::span<const std::int32_t> blocks)
        {
          std::vector<PetscInt> all;
          for (const std::int32_t block : blocks)
            for (int c = 0; c < maps[k].second; ++c)
              all.push_back(first[k] + maps[k].second * block + c);
          return all;
        };
        const auto add = [&](std::span<const std::int32_t> rows,
                             std::span<const std::int32_t> columns,
                             std::span<const double> values)
        {
          const auto r = numbers(i, rows), c = numbers(j, columns);
          petsc::check(MatSetValuesLocal(A, static_cast<PetscInt>(r.size()),
                                         r.data(),
                                         static_cast<PetscInt>(c.size()),
                                         c.data(), values.data(), ADD_VALUES),
                       "MatSetValuesLocal");
          return 0;
        };
        dolfinx::fem::assemble_matrix(
            add, form, std::span(i == 0 ? markers : none), std::span(none));
      });
  assemble(A, MAT_FINAL_ASSEMBLY);
  Jacobian::finish(A, system(), _assembler->loop().free_bodies().springs());
}

std::array<::Mat, 4> Forms::blocks(::Mat A) const
{
  PetscInt start = 0, end = 0;
  petsc::check(MatGetOwnershipRange(A, &start, &end), "MatGetOwnershipRange");
  const auto middle = start + static_cast<PetscInt>(system().num_bulk());
  petsc::Owner<IS, ISDestroy> u, w;
  petsc::check(ISCreateStride(comm(), middle - start, start, 1, u.put()),
               "ISCreateStride");
  petsc::check(ISCreateStride(comm(), end - middle, middle, 1, w.put()),
               "ISCreateStride");
  std::array<::Mat, 4> all{};
  for (int k = 0; k < 4; ++k)
    petsc::check(MatCreateSubMatrix(A, (k < 2 ? u : w).get(),
                                    (k % 2 == 0 ? u : w).get(),
                                    MAT_INITIAL_MATRIX, &all[k]),
                 "MatCreateSubMatrix");
  return all;
}

void Forms::take(::Vec x)
{
  const petsc::ConstValues values(x);
  system().take(values.span());
}

void Forms::evaluate()
{
  system().evaluate();
  refresh();
}

void Forms::refresh()
{
  _forms.clear();
  _versions.clear();
  for (const auto& contact : _assembler->contacts())
  {
    _forms.push_back(&contact->forms());
    _versions.push_back(_forms.back()->version());
  }
}

template <class Use>
void Forms::for_each_block(Use&& use) const
{
  for (std::size_t k = 1; k <= _forms.size(); ++k)
  {
    const ContactForms& of = *_forms[k - 1];
    const std::array<const ContactForms::List*, 4> parts{&of.K, &of.B, &of.C,
                                                         &of.D};
    for (int p = 0; p < 4; ++p)
      for (const auto& form : *parts[p])
        use(*form, p < 2 ? 0 : k, p % 2 == 0 ? 0 : k);
  }
}

Forms::Maps Forms::maps() const
{
  Maps maps{{_forms.front()->displacement_map, gdim()}};
  for (const ContactForms* forms : _forms)
    maps.emplace_back(forms->multiplier_map, forms->multiplier_size);
  return maps;
}

void Forms::create()
{
  using dolfinx::la::SparsityPattern;
  const Maps maps = this->maps();
  std::vector<SparsityPattern> patterns;
  std::vector<int> widths;
  patterns.reserve(maps.size() * maps.size());
  for (const auto& row : maps)
  {
    widths.push_back(row.second);
    for (const auto& column : maps)
      patterns.emplace_back(comm(), std::array{row.first, column.first},
                            std::array{row.second, column.second});
  }
  dolfinx::fem::build_sparsity_pattern(patterns.front(), *_J);
  for_each_block(
      [&](const Form& form, std::size_t i, std::size_t j)
      {
        dolfinx::fem::build_sparsity_pattern(patterns[maps.size() * i + j],
                                             form);
      });
  std::vector<std::vector<const SparsityPattern*>> all(maps.size());
  for (std::size_t k = 0; k < patterns.size(); ++k)
    all[k / maps.size()].push_back(&patterns[k]);
  SparsityPattern pattern(comm(), all, {references(maps), references(maps)},
                          {widths, widths});
  pattern.finalize();
  *_A.put() = dolfinx::la::petsc::create_matrix(comm(), pattern);
}

void Forms::set_numbers()
{
  const Maps maps = this->maps();
  const auto [start, first, ghosts, owners]
      = dolfinx::common::stack_index_maps(references(maps));
  std::vector<PetscInt> numbers;
  for (std::size_t k = 0; k < maps.size(); ++k)
  {
    const auto& [map, width] = maps[k];
    for (std::int32_t i = 0; i < width * map->size_local(); ++i)
      numbers.push_back(static_cast<PetscInt>(start + first[k] + i));
    numbers.insert(numbers.end(), ghosts[k].begin(), ghosts[k].end());
  }
  petsc::Owner<ISLocalToGlobalMapping, ISLocalToGlobalMappingDestroy> local;
  petsc::check(ISLocalToGlobalMappingCreate(
                   MPI_COMM_SELF, 1, static_cast<PetscInt>(numbers.size()),
                   numbers.data(), PETSC_COPY_VALUES, local.put()),
               "ISLocalToGlobalMappingCreate");
  petsc::check(MatSetLocalToGlobalMapping(_A.get(), local.get(), local.get()),
               "MatSetLocalToGlobalMapping");
}
} // namespace contactx_dolfinx
