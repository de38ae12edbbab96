// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#include "slave_facets.h"
#include <algorithm>
#include <numeric>

using namespace contactx;
using namespace contactx::search;

geometry::Facets contactx::search::slave_facets(
    mesh::Halo& halo, std::span<const std::int32_t> offsets,
    std::span<const std::int32_t> nodes, std::span<const std::int8_t> level)
{
  if (halo.ranks().size() == 1)
    return {{offsets.begin(), offsets.end()}, {nodes.begin(), nodes.end()}};
  FacetRecords every;
  const geometry::QuadraticFacets parents
      = geometry::quadratic_facets({offsets, nodes}, level);
  for (const auto& [rank, theirs] :
       around_nodes(halo.ranks(), records({offsets, nodes}, halo), &parents))
    every.insert(every.end(), theirs.begin(), theirs.end());
  every = joined(std::move(every));
  add_to(halo, every, true);
  return here(every, halo);
}

geometry::Facets
contactx::search::in_order(const mesh::Halo& halo,
                           std::span<const std::int32_t> offsets,
                           std::span<const std::int32_t> nodes)
{
  const geometry::FacetList facets{offsets, nodes};
  const FacetRecords found = records(facets, halo);
  std::vector<std::int32_t> order(found.size());
  std::iota(order.begin(), order.end(), 0);
  std::ranges::stable_sort(order, {},
                           [&found](std::int32_t f) { return found[f].key(); });
  geometry::Facets result;
  for (const std::int32_t f : order)
  {
    result.nodes.insert(result.nodes.end(), facets[f].begin(), facets[f].end());
    result.offsets.push_back(static_cast<std::int32_t>(result.nodes.size()));
  }
  return result;
}
