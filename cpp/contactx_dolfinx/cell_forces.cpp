// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#include "cell_forces.h"
#include <basix/finite-element.h>
#include <cmath>
#include <contactx/mesh/halo.h>
#include <dolfinx/fem/assembler.h>
#include <dolfinx/fem/utils.h>
#include <functional>
#include <tuple>

namespace contactx_dolfinx
{
CellForces::CellForces(std::shared_ptr<const Form> F,
                       std::shared_ptr<const FunctionSpace> V)
    : _F(std::move(F)), _V(std::move(V))
{
}

std::vector<double> CellForces::magnitudes(const contactx::mesh::Halo& halo)
{
  if (not _broken)
    make();
  const auto constants = dolfinx::fem::pack_constants(*_F);
  auto packed = dolfinx::fem::allocate_coefficient_storage(*_F);
  dolfinx::fem::pack_coefficients(*_F, packed);
  const auto nodes = _V->dofmap()->map(), rows = _broken->dofmap()->map();
  const std::size_t gdim = halo.gdim();
  const auto& topology = *_V->mesh()->topology();
  const std::size_t num_cells
      = topology.index_map(topology.dim())->size_local();
  dolfinx::la::Vector<double> b(_broken->dofmap()->index_map,
                                static_cast<int>(gdim));
  std::vector<double> sums(halo.num_nodes(), 0);
  for (const auto& [integral, term] : _terms)
  {
    const auto& [values, stride] = packed.at(integral);
    std::ranges::fill(b.array(), 0);
    dolfinx::fem::assemble_vector(
        b.array(), term, std::span(constants),
        {{{integral.first, 0}, {std::span<const double>(values), stride}}});
    b.scatter_rev(std::plus<double>());
    for (std::size_t c = 0; c < num_cells; ++c)
      for (std::size_t i = 0; i < nodes.extent(1); ++i)
      {
        double size = 0;
        for (std::size_t k = 0; k < gdim; ++k)
          size = std::hypot(size, b.array()[gdim * rows(c, i) + k]);
        sums[nodes(c, i)] += size;
      }
  }
  halo.reverse(std::span(sums), 1);
  sums.resize(halo.num_owned());
  return sums;
}

void CellForces::make()
{
  const auto mesh = _V->mesh();
  const auto& element = _V->element()->basix_element();
  const auto broken
      = std::make_shared<const dolfinx::fem::FiniteElement<double>>(
          basix::create_element<double>(
              element.family(), element.cell_type(), element.degree(),
              element.lagrange_variant(), element.dpc_variant(), true),
          std::vector{std::size_t(_V->dofmap()->bs())});
  _broken = create_space(mesh, broken);
  // Cells of another mesh are none of the displacement's
  if (_F->mesh() != mesh)
    return;
  using Key = std::tuple<dolfinx::fem::IntegralType, int, int>;
  using Integral = dolfinx::fem::integral_data<double, double>;
  for (const auto type : _F->integral_types())
    for (int i = 0; i < _F->num_integrals(type, 0); ++i)
    {
      const auto where = _F->domain(type, i, 0);
      std::map<Key, Integral> integral;
      integral.emplace(
          Key{type, 0, 0},
          Integral(_F->kernel(type, i, 0),
                   std::vector<std::int32_t>(where.begin(), where.end()),
                   std::vector<int>()));
      _terms.emplace(std::pair{type, i},
                     Form({_broken}, std::move(integral), mesh, {}, {},
                          _F->needs_facet_permutations(), {}));
    }
}
} // namespace contactx_dolfinx
