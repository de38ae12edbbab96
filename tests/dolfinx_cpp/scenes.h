// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#pragma once

#include <basix/finite-element.h>
#include <cmath>
#include <cstdio>
#include <dolfinx.h>
#include <dolfinx/io/XDMFFile.h>
#include <string>

/// What the test programs share: meshes of files, spaces, and figures as
/// scripts of Python print them.
namespace scenes
{
using T = PetscScalar;
using U = double;
using Element = std::shared_ptr<const dolfinx::fem::FiniteElement<U>>;

/// A mesh with tags of its facets.
struct Domain
{
  std::shared_ptr<dolfinx::mesh::Mesh<U>> mesh;
  std::shared_ptr<const dolfinx::mesh::MeshTags<std::int32_t>> tags;
};

/// Mesh and tags of a file.
inline Domain read(const char* name, dolfinx::mesh::CellType cell,
                   int order = 1)
{
  dolfinx::io::XDMFFile file(MPI_COMM_WORLD, name, "r");
  const int dim = dolfinx::mesh::cell_dim(cell);
  Domain found;
  found.mesh = std::make_shared<dolfinx::mesh::Mesh<U>>(
      file.read_mesh(dolfinx::fem::CoordinateElement<U>(cell, order),
                     dolfinx::mesh::GhostMode::shared_facet, "mesh"));
  const auto topology = found.mesh->topology_mutable();
  topology->create_entities(dim - 1);
  topology->create_connectivity(dim - 1, dim);
  topology->create_connectivity(dim, dim - 1);
  found.tags = std::make_shared<const dolfinx::mesh::MeshTags<std::int32_t>>(
      file.read_meshtags(*found.mesh, "facet_tags", std::nullopt));
  return found;
}

/// A Lagrange element of numbers, or of vectors of so many components.
inline Element lagrange(dolfinx::mesh::CellType cell, int degree,
                        std::optional<std::size_t> components = std::nullopt)
{
  std::optional<std::vector<std::size_t>> shape;
  if (components)
    shape.emplace(1, *components);
  return std::make_shared<const dolfinx::fem::FiniteElement<U>>(
      basix::create_element<U>(basix::element::family::P,
                               dolfinx::mesh::cell_type_to_basix_type(cell),
                               degree,
                               basix::element::lagrange_variant::gll_warped,
                               basix::element::dpc_variant::unset, false),
      shape);
}

inline std::shared_ptr<dolfinx::fem::FunctionSpace<U>>
space(const Domain& domain, const Element& element)
{
  return std::make_shared<dolfinx::fem::FunctionSpace<U>>(
      dolfinx::fem::create_functionspace<U>(domain.mesh, element));
}

/// Norm over all ranks, of the values that are numbers.
inline double norm(std::span<const double> values)
{
  double s = 0;
  for (const double v : values)
    s += std::isnan(v) ? 0 : v * v;
  MPI_Allreduce(MPI_IN_PLACE, &s, 1, MPI_DOUBLE, MPI_SUM, MPI_COMM_WORLD);
  return std::sqrt(s);
}

/// Norm of a function, of what this rank owns; zero if there is none.
inline double norm(const std::shared_ptr<dolfinx::fem::Function<T>>& f)
{
  if (not f)
    return 0;
  const auto& dofs = *f->function_space()->dofmap();
  return norm(std::span<const double>(f->x()->array())
                  .first(dofs.bs() * dofs.index_map->size_local()));
}

/// Figures as they are printed, with blanks between them.
inline std::string text_of(const std::vector<double>& figures)
{
  std::string line;
  for (const double figure : figures)
  {
    char text[64];
    // Rounding has a sign
    std::snprintf(text, sizeof(text), "%.13f",
                  std::abs(figure) < 5e-14 ? 0.0 : figure);
    line += (line.empty() ? "" : " ") + std::string(text);
  }
  return line;
}

/// Print a line on the first rank.
inline void print(const std::string& line)
{
  if (dolfinx::MPI::rank(MPI_COMM_WORLD) == 0)
    std::printf("%s\n", line.c_str());
}
} // namespace scenes
