// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#include "surface.h"
#include "cells.h"
#include "ranks.h"
#include <algorithm>
#include <contactx/mesh/straight.h>
#include <stdexcept>

namespace contactx_dolfinx
{
Surface::Surface(
    std::shared_ptr<const dolfinx::mesh::MeshTags<std::int32_t>> tags,
    std::vector<std::int32_t> values)
    : _tags(std::move(tags)), _values(std::move(values))
{
  const auto& topology = *_tags->topology();
  if (_tags->dim() != topology.dim() - 1)
    throw std::invalid_argument(
        "a Surface needs tags of facets: pass those of dimension tdim - 1");
  if (_values.empty())
    throw std::invalid_argument("a Surface needs at least one tag: pass one");
  const std::int32_t owned = topology.index_map(_tags->dim())->size_local();
  std::vector<std::int64_t> there;
  for (std::int32_t value : _values)
  {
    const std::vector<std::int32_t> facets = _tags->find(value);
    there.push_back(std::ranges::count_if(facets, [owned](std::int32_t f)
                                          { return f < owned; }));
    _facets.insert(_facets.end(), facets.begin(), facets.end());
  }
  std::ranges::sort(_facets);
  const auto repeated = std::ranges::unique(_facets);
  _facets.erase(repeated.begin(), repeated.end());
  Ranks ranks(topology.comm());
  ranks.reduce(std::span<std::int64_t>(there), contactx::mesh::Reduction::sum);
  std::int64_t count = 0;
  for (std::size_t i = 0; i < _values.size(); ++i)
  {
    if (there[i] == 0)
      throw std::invalid_argument("tag " + std::to_string(_values[i])
                                  + " is not in the facet tags: give tags that "
                                    "are there");
    _name += (i > 0 ? ", " : "") + std::to_string(_values[i]);
    count += there[i];
  }
  // As Python has it
  _name = "Surface(tags=(" + _name + (_values.size() == 1 ? ",), " : "), ")
          + std::to_string(count) + " facets)";
}

contactx::geometry::Facets Surface::facet_nodes(const FunctionSpace& V,
                                                contactx::mesh::Ranks& ranks,
                                                const std::string& role) const
{
  auto topology = V.mesh()->topology_mutable();
  const int tdim = topology->dim();
  topology->create_connectivity(tdim - 1, tdim);
  topology->create_connectivity(tdim, tdim - 1);
  const auto cells = topology->connectivity(tdim - 1, tdim);
  ranks.agree([&] { check(*topology, *cells); });

  const auto facets = topology->connectivity(tdim, tdim - 1);
  const std::int32_t num_owned = topology->index_map(tdim)->size_local();
  std::vector<std::int32_t> of, local;
  for (std::int32_t f : _facets)
  {
    const std::int32_t cell = cells->links(f)[0];
    if (cell >= num_owned)
      continue;
    const auto own = facets->links(cell);
    of.push_back(cell);
    local.push_back(
        static_cast<std::int32_t>(std::ranges::find(own, f) - own.begin()));
  }
  const contactx::mesh::Geometry geometry = geometry_of(*V.mesh());
  contactx::mesh::check_straight(ranks, role + " " + _name, cells_of(V),
                                 geometry, points_of_cell(*V.mesh()), of,
                                 local);
  return contactx::mesh::facets(cells_of(V), of, local, geometry);
}

void Surface::check(
    const dolfinx::mesh::Topology& topology,
    const dolfinx::graph::AdjacencyList<std::int32_t>& cells) const
{
  if (_tags->topology().get() != &topology)
    throw std::invalid_argument("the facet tags of " + _name
                                + " belong to another mesh than the "
                                  "displacement: make them on its mesh");
  std::vector<std::int32_t> between;
  // The cell on the other side may be on another rank
  if (dolfinx::MPI::size(topology.comm()) > 1)
    between = topology.interprocess_facets();
  std::ranges::sort(between);
  for (std::int32_t f : _facets)
    if (cells.num_links(f) != 1 or std::ranges::binary_search(between, f))
      throw std::invalid_argument(
          _name
          + " has facets inside a body, with a cell on either side: a "
            "contact surface must be part of the boundary");
}
} // namespace contactx_dolfinx
