// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#include "whole_surface.h"
#include <algorithm>

using namespace contactx;
using namespace contactx::search;

WholeSurface::WholeSurface(std::shared_ptr<const mesh::Halo> halo,
                           const geometry::FacetList& own)
    : _halo(std::move(halo))
{
  const FacetRecords mine = search::records(own, *_halo);
  _records = joined(mesh::gathered<FacetRecord>(
      _halo->ranks(), std::span<const FacetRecord>(mine)));
  struct Node
  {
    std::int64_t original, number;
    std::int32_t owner;
  };
  std::vector<Node> nodes;
  for (const FacetRecord& facet : _records)
    for (int l = 0; l < facet.size(); ++l)
      nodes.push_back({facet.original[l], facet.numbers[l], facet.owners[l]});
  std::ranges::sort(nodes, {}, &Node::original);
  nodes.erase(std::unique(nodes.begin(), nodes.end(),
                          [](const Node& a, const Node& b)
                          { return a.original == b.original; }),
              nodes.end());
  std::vector<std::int64_t> here;
  for (const Node& node : nodes)
  {
    if (node.owner == _halo->ranks().rank())
    {
      _owned.push_back(static_cast<std::int32_t>(_original.size()));
      here.push_back(node.number);
    }
    _original.push_back(node.original);
  }
  _owned_here = _halo->find(here);
  const auto place = [this](std::int64_t original)
  {
    return static_cast<std::int32_t>(
        std::ranges::lower_bound(_original, original) - _original.begin());
  };
  for (const FacetRecord& facet : _records)
  {
    for (int l = 0; l < facet.size(); ++l)
      _facets.nodes.push_back(place(facet.original[l]));
    _facets.offsets.push_back(static_cast<std::int32_t>(_facets.nodes.size()));
  }
  const auto of_ranks = mesh::gathered<std::int32_t>(
      _halo->ranks(), std::span<const std::int32_t>(_owned));
  _of_ranks.assign(of_ranks.begin(), of_ranks.end());
}

std::int32_t WholeSurface::node(std::int32_t here) const
{
  const std::int64_t original = _halo->original()[here];
  const auto at = std::ranges::lower_bound(_original, original);
  if (at == _original.end() or *at != original)
    return -1;
  return static_cast<std::int32_t>(at - _original.begin());
}
