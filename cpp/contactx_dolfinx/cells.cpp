// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#include "cells.h"
#include <algorithm>
#include <basix/finite-element.h>
#include <contactx/mesh/ranks.h>

namespace contactx_dolfinx
{
std::int32_t num_nodes(const FunctionSpace& V)
{
  const auto& map = *V.dofmap()->index_map;
  return map.size_local() + map.num_ghosts();
}

contactx::mesh::Cells cells_of(const FunctionSpace& V)
{
  const auto dofs = V.dofmap()->map();
  return {contactx::mesh::cell_type(
              dolfinx::mesh::to_string(V.mesh()->topology()->cell_type())),
          V.element()->basix_element().degree(),
          {dofs.data_handle(), dofs.size()}};
}

std::vector<std::int32_t> matching_nodes(const FunctionSpace& V,
                                         const FunctionSpace& Q)
{
  const auto of_vectors = V.dofmap()->map(), of_numbers = Q.dofmap()->map();
  std::vector<std::int32_t> match(num_nodes(V));
  for (std::size_t c = 0; c < of_vectors.extent(0); ++c)
    for (std::size_t i = 0; i < of_vectors.extent(1); ++i)
      match[of_vectors(c, i)] = of_numbers(c, i);
  return match;
}

bool is_scalar_lagrange(const FunctionSpace& Q,
                        std::initializer_list<int> degrees)
{
  if (not is_lagrange(Q) or Q.dofmap()->bs() != 1)
    return false;
  const int degree = Q.element()->basix_element().degree();
  return std::ranges::find(degrees, degree) != degrees.end();
}

contactx::mesh::Geometry geometry_of(const dolfinx::mesh::Mesh<double>& mesh)
{
  const auto& geometry = mesh.geometry();
  const auto points = geometry.dofmaps().front();
  return {geometry.dim(),
          geometry.cmaps().front().degree(),
          {points.data_handle(), points.size()},
          static_cast<int>(points.extent(1)),
          geometry.x()};
}

std::span<const std::int64_t>
original_cells(const dolfinx::mesh::Mesh<double>& mesh)
{
  const auto& numbers = mesh.topology()->original_cell_index;
  if (numbers.empty())
    return {};
  return numbers.front();
}

std::vector<double> points_of_cell(const dolfinx::mesh::Mesh<double>& mesh)
{
  const auto& map = mesh.geometry().cmaps().front();
  return basix::create_element<double>(
             basix::element::family::P,
             dolfinx::mesh::cell_type_to_basix_type(map.cell_shape()),
             map.degree(), map.variant(), basix::element::dpc_variant::unset,
             false)
      .points()
      .first;
}

std::vector<double> reference_positions(const FunctionSpace& V)
{
  return contactx::mesh::reference_positions(cells_of(V), num_nodes(V),
                                             geometry_of(*V.mesh()));
}

std::vector<std::int64_t> original_nodes(const FunctionSpace& V,
                                         contactx::mesh::Ranks& ranks)
{
  const auto& numbers = V.mesh()->geometry().input_global_indices();
  std::int64_t most = -1;
  for (const std::int64_t number : numbers)
    most = std::max(most, number);
  return contactx::mesh::original_nodes(
      cells_of(V), num_nodes(V), geometry_of(*V.mesh()), numbers,
      contactx::mesh::largest(ranks, most) + 1);
}
} // namespace contactx_dolfinx
