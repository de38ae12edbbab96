// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#include "check_facets.h"
#include "../geometry/middle.h"
#include "../math/scales.h"
#include "../mesh/extent.h"
#include "../mesh/found_nodes.h"
#include "../search/records.h"
#include "../text.h"
#include <algorithm>
#include <cmath>
#include <stdexcept>

using namespace contactx;
using namespace contactx::problem;

namespace
{
bool is_degenerate(std::span<const std::int32_t> nodes,
                   std::span<const double> x, int gdim, double smallest)
{
  Vector<3> low{}, high{};
  for (int k = 0; k < gdim; ++k)
  {
    low[k] = high[k] = x[std::size_t(nodes[0]) * gdim + k];
    for (const std::int32_t node : nodes.subspan(1))
    {
      low[k] = std::min(low[k], x[std::size_t(node) * gdim + k]);
      high[k] = std::max(high[k], x[std::size_t(node) * gdim + k]);
    }
  }
  const double size = norm(high - low);
  const geometry::CornerNormals normals = geometry::corner_normals(nodes, x);
  const Vector<3> mean = normals.mean();
  // Compared with size^(gdim - 1), what the normal of a well-shaped facet has
  const double wanted
      = math::equal_rel_tol * (gdim == 2 ? size : size * size) * norm(mean);
  bool is_turned = false;
  for (int i = 0; i < normals.size; ++i)
    is_turned = is_turned or dot(normals.normal[i], mean) <= wanted;
  return is_turned or size <= smallest;
}

/// A facet as all ranks know it.
struct Place
{
  search::FacetKey key;
  Vector<3> middle;
};
} // namespace

void contactx::problem::check_facets(const mesh::Halo& halo,
                                     const mesh::NamedSurface& surface,
                                     const std::string& role)
{
  mesh::Ranks& ranks = halo.ranks();
  const auto x = halo.reference();
  const int gdim = halo.gdim();
  const geometry::FacetList& facets = surface.facets;
  const double length = norm(mesh::extent(ranks, facets.nodes, x, gdim));
  std::int64_t count = 0;
  std::vector<Place> first;
  for (std::int32_t f = 0; f < facets.size(); ++f)
  {
    if (not is_degenerate(facets[f], x, gdim, math::equal_rel_tol * length))
      continue;
    ++count;
    search::FacetKey key;
    key.fill(search::FacetRecord::none);
    std::ranges::transform(facets[f], key.begin(), [&halo](std::int32_t node)
                           { return halo.original()[node]; });
    std::ranges::sort(key);
    if (first.empty() or key < first.front().key)
      first = {{key, geometry::middle(facets[f], x, gdim)}};
  }
  count = mesh::total(ranks, count);
  if (count == 0)
    return;
  first = mesh::gathered(ranks, std::span<const Place>(first));
  const Place& at = *std::ranges::min_element(first, {}, &Place::key);
  std::string nodes;
  for (const std::int64_t number : at.key)
    if (number != search::FacetRecord::none)
      nodes += (nodes.empty() ? "" : ", ") + std::to_string(number);
  throw std::invalid_argument(
      std::to_string(count) + " facets of the " + role + " surface "
      + surface.name
      + " are degenerate: they have no area, or are folded so that their "
        "Jacobian changes sign. The first is at "
      + point_text(std::span(at.middle).first(gdim), length)
      + " and has the nodes " + nodes
      + " of the mesh as it was made: repair the mesh there "
        "(manual: errors/refused-mesh)");
}

void contactx::problem::check_folds(const mesh::Halo& halo,
                                    const contact::SlaveNodes& slaves,
                                    const std::string& name)
{
  const auto x = halo.reference();
  const int gdim = halo.gdim();
  const geometry::FacetList facets = slaves.facets(), local = slaves.local();
  std::vector<Vector<3>> sums(slaves.around().size(), Vector<3>{});
  std::vector<double> sizes(slaves.around().size(), 0);
  for (std::int32_t f = 0; f < facets.size(); ++f)
  {
    const Vector<3> normal = geometry::corner_normals(facets[f], x).mean();
    for (const std::int32_t i : local[f])
    {
      sums[i] = sums[i] + normal;
      sizes[i] += norm(normal);
    }
  }
  std::vector<std::int32_t> bad;
  for (std::size_t i = 0; i < slaves.owned().size(); ++i)
    if (norm(sums[i]) <= math::negligible_part * sizes[i])
      bad.push_back(slaves.owned()[i]);
  const mesh::FoundNodes found = mesh::found_nodes(halo, bad, x);
  if (found.count == 0)
    return;
  const double size
      = std::ranges::max(mesh::extent(halo.ranks(), slaves.owned(), x, gdim));
  throw std::invalid_argument(
      "the slave surface " + name + " is folded at "
      + std::to_string(found.count)
      + " nodes, where the normals of its facets cancel, first at "
      + point_text(found.at, size) + ", node " + std::to_string(found.first)
      + " of the mesh as it was made: take the facets of one side out of the "
        "surface (manual: errors/refused-mesh)");
}
