// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#include "penetration.h"
#include "cells.h"
#include <algorithm>
#include <contactx/results/wetted.h>
#include <stdexcept>

namespace contactx_dolfinx
{
bool penetrate(const Assembler& assembler, const Surface& surface,
               const std::function<bool(const contactx::Vector<3>&)>& enters,
               Function& wet)
{
  const FunctionSpace& V = *assembler.bulk()->u()->function_space();
  const FunctionSpace& Q = *wet.function_space();
  if (Q.mesh() != V.mesh() or not is_scalar_lagrange(Q, {1}))
    throw std::invalid_argument(
        "what a fluid wets is a function of another space: take one of the "
        "scalar linear Lagrange space on the displacement's mesh");
  const auto& halo = assembler.halo();
  const contactx::geometry::Facets facets
      = surface.facet_nodes(V, halo->ranks(), "wetted");

  // Nodes of a cell begin with its vertices
  std::vector<std::int32_t> vertex(num_nodes(V), -1);
  const auto nodes = V.dofmap()->map(), vertices = Q.dofmap()->map();
  for (std::size_t c = 0; c < vertices.extent(0); ++c)
    for (std::size_t i = 0; i < vertices.extent(1); ++i)
      vertex[nodes(c, i)] = vertices(c, i);

  const std::int32_t owned = halo->num_owned();
  std::vector<std::int8_t> is_entry(owned, 0);
  halo->ranks().agree(
      [&]
      {
        for (std::int32_t i = 0; i < owned; ++i)
        {
          contactx::Vector<3> x{};
          std::copy_n(halo->reference().begin() + halo->gdim() * i,
                      halo->gdim(), x.begin());
          is_entry[i] = vertex[i] >= 0 and enters(x);
        }
      });
  std::vector<std::shared_ptr<const contactx::contact::Contact>> contacts;
  for (const auto& contact : assembler.contacts())
    contacts.push_back(contact->shared_discrete());
  const std::vector<std::int8_t> wetted = contactx::results::wetted_nodes(
      halo, facets.list(), is_entry, contacts);

  bool has_changed = false;
  for (std::int32_t i = 0; i < owned; ++i)
    if (vertex[i] >= 0)
    {
      double& value = wet.x()->array()[vertex[i]];
      has_changed = has_changed or value != wetted[i];
      value = wetted[i];
    }
  wet.x()->scatter_fwd();
  return contactx::mesh::anywhere(halo->ranks(), has_changed);
}
} // namespace contactx_dolfinx
