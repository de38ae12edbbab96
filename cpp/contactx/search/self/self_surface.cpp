// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#include "self_surface.h"
#include "../../check.h"
#include <algorithm>
#include <tuple>

using namespace contactx;
using namespace contactx::search;

namespace
{
/// A node with a pair, as all ranks know it. It is sent as it lies in memory.
struct Paired
{
  std::int32_t node, is_closed;
  FacetKey facet;
};
static_assert(sizeof(Paired) == 2 * sizeof(std::int32_t) + sizeof(FacetKey));
} // namespace

SelfSurface::SelfSurface(std::shared_ptr<mesh::Halo> halo, geometry::Facets own,
                         const std::vector<std::int64_t>& body,
                         std::optional<double> excluded,
                         std::span<const std::int8_t> level)
    : DistributedSurface(halo, own, level),
      _sight(halo, own.list(), body, excluded)
{
}

void SelfSurface::take_compliance(std::span<const double> nodal)
{
  // Once, so that sides stay what they are
  if (_is_ordered)
    return;
  _is_ordered = true;
  _sight.order().take_compliance(_sight.surface().gathered(nodal, 1));
}

/// What nodes see, by the numbers of facets of the whole surface.
std::vector<std::optional<Projection>>
SelfSurface::candidates(std::span<const std::int32_t> nodes, double reach) const
{
  std::vector<std::optional<Projection>> places(nodes.size());
  std::int32_t hint = -1;
  for (std::size_t i = 0; i < nodes.size(); ++i)
  {
    const std::int32_t node = _sight.surface().node(nodes[i]);
    const FoundPlace found = _sight.find(node, reach, hint);
    if (found.nearest)
      hint = found.nearest->facet;
    places[i] = found.selected;
  }
  return places;
}

/// Learns the facets of places, and gives them their numbers among `facets`;
/// collective.
std::vector<std::optional<Projection>>
SelfSurface::here(std::vector<std::optional<Projection>> places)
{
  FacetRecords wanted;
  for (const auto& place : places)
    if (place)
      wanted.push_back(_sight.surface().records()[place->facet]);
  const std::vector<std::int32_t> numbers = learn(wanted);
  auto number = numbers.begin();
  for (auto& place : places)
    if (place)
      place->facet = *number++;
  return places;
}

Found SelfSurface::find_of_nodes(std::span<const double> x,
                                 std::span<const std::int32_t> nodes,
                                 std::span<const double>, double reach)
{
  _sight.refit(_halo->start()->x, x);
  const auto places = here(candidates(nodes, reach));
  Found found(nodes.size());
  for (std::size_t i = 0; i < nodes.size(); ++i)
    if (places[i])
    {
      found.take(i, *places[i]);
      found.distance[i] = std::abs(places[i]->gap);
    }
  return found;
}

std::int32_t SelfSurface::pair(Pairing& pairing, const geometry::FacetList&,
                               std::span<const double> x, double reach,
                               std::span<const std::int8_t> closed)
{
  check::positions(x.size(), pairing.num_nodes(), _halo->gdim());
  check::rows(closed.size(), pairing.slaves().size(), 1, "closed",
              "slave node");
  const int version = _halo->version();
  const std::vector<std::int32_t> left = pairing.seek(x, reach);
  // Other nodes may take over where nothing moves
  _sight.refit(_halo->start()->x, x);
  std::vector<std::int32_t> nodes;
  for (const std::int32_t i : left)
    nodes.push_back(pairing.slaves()[i]);
  std::vector<std::optional<Projection>> places = candidates(nodes, reach);
  for (std::size_t k = 0; k < left.size(); ++k)
    if (places[k]
        and not _sight.is_slave(_sight.surface().node(nodes[k]), *places[k]))
      places[k] = std::nullopt;
  std::int32_t changed = accept_projections(pairing, left, here(places), x,
                                            version, reach, closed);
  const std::vector<double> grown
      = _halo->updated({x.begin(), x.end()}, _halo->gdim(), version);
  changed += drop_doubles(pairing, grown, reach, closed);
  return changed;
}

/// Drops the pair of one of two nodes that are each paired with a facet of the
/// other, and open pairs of nodes that are the master now; collective.
std::int32_t SelfSurface::drop_doubles(Pairing& pairing,
                                       std::span<const double> x, double reach,
                                       std::span<const std::int8_t> closed)
{
  const WholeSurface& surface = _sight.surface();
  std::vector<Paired> mine;
  const std::vector<std::int64_t> names = this->names(pairing.facet());
  for (std::size_t i = 0; i < pairing.slaves().size(); ++i)
    if (pairing.facet()[i] >= 0)
      mine.push_back({surface.node(pairing.slaves()[i]), closed[i],
                      key_of(std::span(names).subspan(most_nodes * i))});
  const auto every
      = mesh::gathered<Paired>(_halo->ranks(), std::span<const Paired>(mine));
  std::vector<const Paired*> of_node(surface.num_nodes(), nullptr);
  for (const Paired& p : every)
    of_node[p.node] = &p;
  const auto has = [&surface](const FacetKey& key, std::int32_t node)
  { return std::ranges::find(key, surface.original()[node]) != key.end(); };
  const SelfOrder& order = _sight.order();
  const auto is_first = [&order](const Paired& a, const Paired& b)
  {
    const auto value = [&order](const Paired& p)
    {
      return std::tuple(p.is_closed, order.rank()[order.part()[p.node]],
                        order.along()[p.node], p.node);
    };
    return value(a) > value(b);
  };
  const auto is_master = [&](std::size_t i, const Paired& me)
  {
    const auto at = std::ranges::lower_bound(surface.records(), me.facet, {},
                                             &FacetRecord::key);
    Projection place{};
    place.facet = static_cast<std::int32_t>(at - surface.records().begin());
    std::copy_n(pairing.xi().begin() + std::ptrdiff_t(2 * i), 2,
                place.xi.begin());
    return not _sight.is_slave(me.node, place);
  };
  std::int32_t changed = 0;
  for (std::size_t i = 0; i < pairing.slaves().size(); ++i)
  {
    if (pairing.facet()[i] < 0)
      continue;
    const Paired& me = *of_node[surface.node(pairing.slaves()[i])];
    bool drops = not closed[i] and is_master(i, me);
    for (const std::int64_t original : me.facet)
    {
      const auto at = std::ranges::lower_bound(surface.original(), original);
      if (at == surface.original().end())
        continue;
      const Paired* other = of_node[at - surface.original().begin()];
      drops
          = drops
            or (other and has(other->facet, me.node) and is_first(*other, me));
    }
    if (drops)
      changed += pairing.accept_projection(
          static_cast<std::int32_t>(i), std::nullopt, x, reach, closed[i] != 0);
  }
  return changed;
}
