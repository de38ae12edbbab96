// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#include "shared_nodes.h"
#include <algorithm>
#include <array>
#include <stdexcept>

using namespace contactx;
using namespace contactx::mesh;

std::vector<std::int8_t>
contactx::mesh::shared_nodes(const NodeMap& nodes,
                             const geometry::FacetList& slave,
                             const geometry::FacetList& master)
{
  const auto n = static_cast<std::size_t>(nodes.num_nodes());
  std::vector<double> has(2 * n, 0);
  for (const std::int32_t node : slave.nodes)
    has[2 * std::size_t(node)] = 1;
  for (const std::int32_t node : master.nodes)
    has[2 * std::size_t(node) + 1] = 1;
  nodes.reverse(std::span(has), 2);
  std::vector<std::int64_t> both(n);
  for (std::size_t i = 0; i < n; ++i)
    both[i] = has[2 * i] > 0 and has[2 * i + 1] > 0;
  nodes.forward(std::span(both), 1);
  return {both.begin(), both.end()};
}

std::vector<std::int8_t>
contactx::mesh::edge_nodes(const Halo& halo, const geometry::FacetList& facets)
{
  // Around a node within the surface each facet begins where another one ends,
  // so that any numbers of the neighbours at which they do cancel
  const auto number = [original = halo.original()](std::int32_t node)
  {
    return static_cast<double>(static_cast<std::uint64_t>(original[node])
                               * 2654435761 % (std::uint64_t(1) << 31));
  };
  std::vector<double> turns(halo.num_nodes(), 0);
  for (std::int32_t f = 0; f < facets.size(); ++f)
  {
    const auto nodes = facets[f];
    if (nodes.size() == 2)
    {
      turns[nodes[0]] += 1;
      turns[nodes[1]] -= 1;
      continue;
    }
    std::array<std::int32_t, 4> ring{nodes[0], nodes[1], nodes[2]};
    if (nodes.size() == 4)
      ring = {nodes[0], nodes[1], nodes[3], nodes[2]};
    const std::size_t n = nodes.size();
    for (std::size_t i = 0; i < n; ++i)
      turns[ring[i]]
          += number(ring[(i + 1) % n]) - number(ring[(i + n - 1) % n]);
  }
  halo.reverse(std::span(turns), 1);
  std::vector<std::int8_t> is_edge(halo.num_owned());
  std::transform(turns.begin(), turns.begin() + halo.num_owned(),
                 is_edge.begin(), [](double turn) { return turn != 0; });
  return is_edge;
}

void contactx::mesh::check_shared(const Halo& halo, const NamedSurface& slave,
                                  const NamedSurface& master)
{
  const std::vector<std::int8_t> shared
      = shared_nodes(halo, slave.facets, master.facets);
  bool is_bad = false;
  for (const geometry::FacetList& facets : {slave.facets, master.facets})
  {
    const std::vector<std::int8_t> is_edge = edge_nodes(halo, facets);
    for (std::size_t i = 0; i < is_edge.size(); ++i)
      is_bad = is_bad or (shared[i] and not is_edge[i]);
    for (std::int32_t f = 0; f < facets.size(); ++f)
      is_bad = is_bad
               or std::ranges::all_of(facets[f], [&shared](std::int32_t node)
                                      { return shared[node] != 0; });
  }
  if (not mesh::anywhere(halo.ranks(), is_bad))
    return;
  const std::int64_t count = mesh::total(
      halo.ranks(), std::int64_t(std::count(
                        shared.begin(), shared.begin() + halo.num_owned(), 1)));
  throw std::invalid_argument(
      "slave and master overlap: " + slave.name + " and " + master.name
      + " share " + std::to_string(count)
      + " nodes. Give each body its own nodes and each surface its own facets: "
        "in gmsh do not fragment the bodies. Faces of a crack may share the "
        "nodes of its tip, at the edge of both, and no others (manual: "
        "errors/refused-mesh)");
}
