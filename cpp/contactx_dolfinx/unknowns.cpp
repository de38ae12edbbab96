// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#include "unknowns.h"
#include <algorithm>
#include <basix/cell.h>
#include <basix/finite-element.h>
#include <dolfinx/fem/utils.h>
#include <numeric>
#include <set>
#include <stdexcept>

namespace contactx_dolfinx
{
namespace
{
bool is_mixed_space(const FunctionSpace& V) { return V.element()->is_mixed(); }

std::shared_ptr<const dolfinx::fem::FiniteElement<double>>
vectors(basix::cell::type cell, int degree, int gdim)
{
  return std::make_shared<const dolfinx::fem::FiniteElement<double>>(
      basix::create_element<double>(
          basix::element::family::P, cell, degree,
          basix::element::lagrange_variant::gll_warped,
          basix::element::dpc_variant::unset, false),
      std::vector{std::size_t(gdim)});
}

/// Owned dofs of a part of a space, in order, but for some.
std::vector<std::int32_t> dofs_of(const FunctionSpace& part, std::size_t owned,
                                  std::span<const std::int32_t> without)
{
  const int bs = part.dofmap()->bs();
  const auto blocks = part.dofmap()->map();
  std::vector<std::int8_t> is_there(owned, 0);
  for (std::size_t i = 0; i < blocks.size(); ++i)
    for (int k = 0; k < bs; ++k)
      if (const std::size_t dof = bs * blocks.data_handle()[i] + k; dof < owned)
        is_there[dof] = 1;
  for (const std::int32_t dof : without)
    is_there[dof] = 0;
  std::vector<std::int32_t> dofs;
  for (std::size_t i = 0; i < owned; ++i)
    if (is_there[i])
      dofs.push_back(static_cast<std::int32_t>(i));
  return dofs;
}
} // namespace

namespace input
{
void check_blocks(const Blocks& blocks)
{
  const std::size_t n = blocks.functions.size();
  const bool has_rows = std::ranges::all_of(blocks.J, [n](const auto& row)
                                            { return row.size() == n; });
  if (blocks.F.size() != n or blocks.J.size() != n or not has_rows)
    throw std::invalid_argument("F must have a form for each function, and J "
                                "one for each pair of them, "
                                "null where there is none: "
                                + std::to_string(n) + " and "
                                + std::to_string(n) + " times "
                                + std::to_string(n));
  const auto number = [n](std::size_t k)
  { return n == 1 ? "" : "[" + std::to_string(k) + "]"; };
  const auto argument = [&](std::size_t k)
  {
    return std::pair<const Function*, std::string>{
        blocks.functions[k].get(), n == 1 ? "u" : "functions" + number(k)};
  };
  bool depends = false, is_of_others = true;
  for (std::size_t i = 0; i < n; ++i)
  {
    check_form(blocks.F[i].get(), "F" + number(i), {argument(i)},
               "give the residual, linear in a test function");
    for (std::size_t j = 0; j < n; ++j)
      if (blocks.J[i][j] or n == 1)
        check_form(blocks.J[i][j].get(), "J" + number(i) + number(j),
                   {argument(i), argument(j)},
                   "give the derivative of F, derivative(F, u)");
    const auto& in = blocks.F[i]->coefficients();
    for (const auto& w : blocks.functions)
      for (const auto& c : in)
      {
        depends = depends or c == w;
        is_of_others
            = is_of_others and not is_space_of(*w, *c->function_space());
      }
    is_of_others = is_of_others and not in.empty();
  }
  if (not depends and not is_of_others)
    throw std::invalid_argument(
        "F does not depend on u: create the form with the very Function that "
        "is passed as u");
}
} // namespace input

Unknowns::Unknowns(std::vector<std::shared_ptr<Function>> functions,
                   int displacement)
    : _functions(std::move(functions))
{
  check_functions();
  const bool is_mixed = _functions.size() == 1
                        and is_mixed_space(*_functions[0]->function_space());
  const int count
      = is_mixed
            ? _functions[0]->function_space()->element()->num_sub_elements()
            : static_cast<int>(_functions.size());
  if (displacement < 0 or displacement >= count)
    throw std::invalid_argument(
        "displacement is " + std::to_string(displacement)
        + ": give a number from 0 to " + std::to_string(count - 1));
  _index = is_mixed ? 0 : displacement;
  const auto& w = _functions[_index];
  const FunctionSpace& V = *w->function_space();
  if (is_mixed)
    copy_from(V.sub({displacement}));
  else if (is_lagrange(V))
    _u = w;
  else
    copy_from(V);
  input::check_displacement(_u.get());
  find_fields();
  read();
}

void Unknowns::read()
{
  if (is_copy())
    _u->x()->array() = displacements_of(
        std::span<const double>(_functions[_index]->x()->array()));
}

void Unknowns::write()
{
  if (not is_copy())
    return;
  auto& values = _functions[_index]->x()->array();
  for (std::size_t i = 0; i < _dofs.size(); ++i)
    values[_dofs[i]] = _u->x()->array()[i];
}

std::size_t Unknowns::num_owned(const Function& w)
{
  const auto& dofs = *w.function_space()->dofmap();
  return std::size_t(dofs.index_map_bs()) * dofs.index_map->size_local();
}

void Unknowns::check_functions() const
{
  if (_functions.empty())
    throw std::invalid_argument("there are no functions to solve for: give "
                                "the displacement and the other fields");
  std::set<const Function*> once;
  for (std::size_t k = 0; k < _functions.size(); ++k)
  {
    const std::string name = "functions[" + std::to_string(k) + "]";
    const Function* w = _functions[k].get();
    if (w == nullptr)
      throw std::invalid_argument(name + " is null: give a Function");
    if (not once.insert(w).second)
      throw std::invalid_argument(name
                                  + " is there twice: list each function once");
    const FunctionSpace& V = *w->function_space();
    if (not V.component().empty())
      throw std::invalid_argument(
          name
          + " is in a part of a mixed space: give the function of the "
            "whole");
    if (V.mesh() != _functions[0]->function_space()->mesh())
      throw std::invalid_argument(
          name
          + " is on another mesh than functions[0]: contact needs one that "
            "holds all, make one mesh");
  }
}

void Unknowns::copy_from(const FunctionSpace& part)
{
  const auto mesh = part.mesh();
  const int gdim = mesh->geometry().dim(), tdim = mesh->topology()->dim();
  const auto cell
      = dolfinx::mesh::cell_type_to_basix_type(mesh->topology()->cell_type());
  const dolfinx::fem::ElementDofLayout& layout
      = part.dofmap()->element_dof_layout();
  const auto entities = basix::cell::topology(cell);
  const auto fits = [&](const dolfinx::fem::ElementDofLayout& wanted)
  {
    for (int d = 0; d < tdim; ++d)
      for (int i = 0; i < static_cast<int>(entities[d].size()); ++i)
        if (layout.entity_dofs(d, i).size() != wanted.entity_dofs(d, i).size())
          return false;
    return layout.entity_dofs(tdim, 0).size()
           >= wanted.entity_dofs(tdim, 0).size();
  };
  const bool has_vectors
      = not is_mixed_space(part) and part.element()->block_size() == gdim;
  for (const int degree : {1, 2})
  {
    if (not has_vectors)
      break;
    const auto element = vectors(cell, degree, gdim);
    if (not fits(dolfinx::fem::create_element_dof_layout(*element)))
      continue;
    _u = std::make_shared<Function>(create_space(mesh, element));
    find_nodes(part);
    return;
  }
  throw std::invalid_argument(
      "the displacement must be of a continuous Lagrange space of vectors on "
      "the surface: take degree 1 or 2, which may be enriched by bubbles "
      "inside of cells, and as many components as the mesh has dimensions");
}

void Unknowns::find_nodes(const FunctionSpace& part)
{
  const FunctionSpace& V = *_u->function_space();
  const std::size_t gdim = V.mesh()->geometry().dim();
  const auto& layout = part.dofmap()->element_dof_layout();
  const auto& own = V.dofmap()->element_dof_layout();
  const auto nodes = V.dofmap()->map(), blocks = part.dofmap()->map();
  // Local dof of the part at each node of a cell
  std::vector<int> local(nodes.extent(1));
  const auto& every = own.entity_dofs_all();
  for (std::size_t d = 0; d < every.size(); ++d)
    for (std::size_t i = 0; i < every[d].size(); ++i)
      for (std::size_t k = 0; k < every[d][i].size(); ++k)
        local[every[d][i][k]]
            = layout.entity_dofs(static_cast<int>(d), static_cast<int>(i))[k];
  // In a mixed space the components of a block have dofs of their own
  const bool is_blocked = part.dofmap()->bs() == static_cast<int>(gdim);
  _dofs.resize(_u->x()->array().size());
  for (std::size_t c = 0; c < nodes.extent(0); ++c)
    for (std::size_t i = 0; i < nodes.extent(1); ++i)
      for (std::size_t k = 0; k < gdim; ++k)
        _dofs[gdim * nodes(c, i) + k] = static_cast<std::int32_t>(
            is_blocked ? gdim * blocks(c, local[i]) + k
                       : blocks(c, gdim * local[i] + k));
}

void Unknowns::find_fields()
{
  const std::size_t owned = num_owned(*_u);
  _owned.resize(owned);
  if (is_copy())
    std::copy_n(_dofs.begin(), owned, _owned.begin());
  else
    std::iota(_owned.begin(), _owned.end(), 0);
  for (int f = 0; f < static_cast<int>(_functions.size()); ++f)
  {
    const FunctionSpace& V = *_functions[f]->function_space();
    const auto add = [&](const FunctionSpace& part)
    {
      std::span<const std::int32_t> mine;
      if (f == _index)
        mine = _owned;
      _fields.push_back({f, dofs_of(part, num_owned(*_functions[f]), mine)});
    };
    // The same on all ranks: each takes part in what is done to a field
    if (is_mixed_space(V))
      for (int i = 0; i < V.element()->num_sub_elements(); ++i)
        add(V.sub({i}));
    else if (f != _index or is_copy())
      add(V);
  }
}
} // namespace contactx_dolfinx
