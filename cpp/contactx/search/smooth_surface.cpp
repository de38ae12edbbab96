// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#include "smooth_surface.h"
#include <algorithm>

using namespace contactx;
using namespace contactx::search;

namespace
{
/// Name of a facet, as `key_of` takes it.
std::array<std::int64_t, most_nodes>
name_of(const mesh::Halo& halo, std::span<const std::int32_t> nodes)
{
  std::array<std::int64_t, most_nodes> name;
  name.fill(-1);
  for (std::size_t l = 0; l < nodes.size(); ++l)
    name[l] = halo.original()[nodes[l]];
  return name;
}
} // namespace

SmoothSurface::SmoothSurface(const mesh::Halo& halo,
                             const geometry::FacetList& own)
{
  const int g = halo.gdim();
  std::vector<std::int64_t> names;
  std::vector<double> corners;
  for (std::int32_t f = 0; f < own.size(); ++f)
  {
    const auto name = name_of(halo, own[f]);
    names.insert(names.end(), name.begin(), name.end());
    for (int l = 0; l < most_nodes; ++l)
      for (int k = 0; k < g; ++k)
        corners.push_back(l < std::ssize(own[f])
                              ? halo.reference()[std::size_t(own[f][l]) * g + k]
                              : 0);
  }
  names = mesh::gathered<std::int64_t>(halo.ranks(), names);
  corners = mesh::gathered<double>(halo.ranks(), corners);
  // In an order that does not depend on the ranks
  std::map<FacetKey, std::size_t> order;
  std::map<std::int64_t, std::int32_t> nodes;
  for (std::size_t i = 0; i < names.size() / most_nodes; ++i)
  {
    order.emplace(key_of(std::span(names).subspan(most_nodes * i, most_nodes)),
                  i);
    for (int l = 0; l < most_nodes; ++l)
      if (names[most_nodes * i + l] >= 0)
        nodes.emplace(names[most_nodes * i + l], 0);
  }
  std::int32_t count = 0;
  for (auto& [name, number] : nodes)
    number = count++;
  geometry::Facets facets;
  std::vector<double> x(std::size_t(count) * g);
  for (const auto& [key, i] : order)
  {
    for (int l = 0; l < most_nodes; ++l)
    {
      const std::size_t corner = most_nodes * i + l;
      if (names[corner] < 0)
        continue;
      facets.nodes.push_back(nodes.at(names[corner]));
      std::copy_n(corners.begin() + corner * g, g,
                  x.begin() + std::size_t(facets.nodes.back()) * g);
    }
    facets.offsets.push_back(static_cast<std::int32_t>(facets.nodes.size()));
  }
  const auto smooth = geometry::smooth_facets(facets.list(), x, g);
  std::size_t f = 0;
  for (const auto& [key, i] : order)
    _facets.emplace(key, smooth[f++]);
}

const geometry::SmoothFacet&
SmoothSurface::of(const mesh::Halo& halo,
                  std::span<const std::int32_t> nodes) const
{
  return _facets.at(key_of(name_of(halo, nodes)));
}

std::vector<geometry::SmoothFacet>
SmoothSurface::of(const mesh::Halo& halo,
                  const geometry::FacetList& facets) const
{
  std::vector<geometry::SmoothFacet> all;
  for (std::int32_t f = 0; f < facets.size(); ++f)
    all.push_back(of(halo, facets[f]));
  return all;
}
