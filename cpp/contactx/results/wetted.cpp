// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#include "wetted.h"
#include "../check.h"
#include "../contact/deformable_master.h"
#include "../math/scales.h"
#include "../search/surface_probe.h"
#include "transfer.h"
#include <algorithm>
#include <cmath>
#include <numeric>
#include <optional>

using namespace contactx;
using namespace contactx::results;

namespace
{
/// Part of what is in front of a master's node that must be wetted: not one
/// half, which round-off would decide where meshes match
constexpr double wetted_part_min = 0.45;

/// A fluid on the nodes of this rank.
class Fluid
{
public:
  explicit Fluid(const mesh::Halo& halo)
      : _halo(halo), _neighbours(halo.num_nodes()), _on_facets(halo.num_nodes())
  {
    is_wetted.assign(halo.num_nodes(), 0);
    is_barred = is_wetted;
  }

  /// Let it go along the edges of facets.
  void add(const geometry::FacetList& facets)
  {
    for (std::int32_t f = 0; f < facets.size(); ++f)
    {
      const auto nodes = facets[f];
      for (const std::int32_t node : nodes)
        _on_facets[node] = 1;
      geometry::visit(static_cast<int>(nodes.size()),
                      [&]<class F>(F)
                      {
                        for (const auto& [i, j] : F::edges)
                        {
                          _neighbours[nodes[i]].push_back(nodes[j]);
                          _neighbours[nodes[j]].push_back(nodes[i]);
                        }
                      });
    }
  }

  /// Nodes that any rank's facets have, once all were added; collective.
  std::vector<double> on_facets() const
  {
    std::vector<double> counts = _on_facets;
    _halo.reverse(counts, 1);
    return counts;
  }

  /// Spread from what is wetted to what is not barred, values of owned nodes
  /// being right before and those of all after it; collective.
  void spread()
  {
    const auto owned = _halo.num_owned();
    bool has_grown = true;
    while (has_grown)
    {
      _halo.forward(std::span(is_wetted), 1);
      const std::vector<std::int64_t> before = is_wetted;
      std::vector<std::int32_t> front;
      for (std::int32_t i = 0; i < _halo.num_nodes(); ++i)
        if (is_wetted[i])
          front.push_back(i);
      while (not front.empty())
      {
        const std::int32_t at = front.back();
        front.pop_back();
        for (const std::int32_t next : _neighbours[at])
          if (not is_wetted[next] and not is_barred[next])
          {
            is_wetted[next] = 1;
            front.push_back(next);
          }
      }
      // Ghosts that were reached here
      std::vector<double> reached(is_wetted.begin(), is_wetted.end());
      _halo.reverse(reached, 1);
      for (std::int32_t i = 0; i < owned; ++i)
        is_wetted[i] = reached[i] > 0;
      has_grown = mesh::anywhere(_halo.ranks(),
                                 _halo.ranks().size() > 1
                                     and not std::equal(before.begin(),
                                                        before.begin() + owned,
                                                        is_wetted.begin()));
    }
  }

  std::vector<std::int64_t> is_wetted, is_barred; // (num_nodes)

private:
  const mesh::Halo& _halo;
  std::vector<std::vector<std::int32_t>> _neighbours;
  std::vector<double> _on_facets;
};

/// What is in front of the nodes of a master.
class Gap
{
public:
  /// Take the surfaces as they are now; collective.
  explicit Gap(std::shared_ptr<const contact::Contact> contact,
               std::shared_ptr<mesh::Halo> halo)
      : _contact(std::move(contact)), _halo(std::move(halo))
  {
    // In self-contact nodes are on both sides, which the pairs tell
    if (_contact->is_self())
      return;
    const auto* master = dynamic_cast<const contact::DeformableMaster*>(
        _contact->master().get());
    const int g = _halo->gdim();
    const geometry::FacetList facets = master->surface()->own();
    std::vector<double> vectors = geometry::nodal_area_vectors(facets, x(), g);
    std::vector<double> marks(_halo->num_nodes(), 0);
    for (const std::int32_t node : facets.nodes)
      marks[node] = 1;
    _halo->reverse(vectors, g);
    _halo->reverse(marks, 1);
    for (std::int32_t i = 0; i < _halo->num_owned(); ++i)
      if (marks[i] > 0)
      {
        _nodes.push_back(i);
        _points.insert(_points.end(), &x()[g * i], &x()[g * i] + g);
        const double* v = &vectors[g * i];
        const double length = std::sqrt(std::inner_product(v, v + g, v, 0.));
        for (int k = 0; k < g; ++k)
          _normals.push_back(length > 0 ? v[k] / length : 0);
      }
    const geometry::FacetList slave = _contact->slaves().facets();
    _probe.emplace(_halo, slave.offsets, slave.nodes);
  }

  /// Part of what is in front of each node that is wetted, NaN where nothing is
  /// (shape=(num_owned)); collective.
  std::vector<double> wetted(std::span<const std::int64_t> is_wetted)
  {
    if (not _probe)
    {
      std::vector<double> values;
      for (const std::int32_t node : _contact->slaves().owned())
        values.push_back(static_cast<double>(is_wetted[node]));
      return Transfer(*_contact).at_master(values);
    }
    // The probe interpolates displacements: those along one axis are values
    const int g = _halo->gdim();
    std::vector<double> along(std::size_t(_halo->num_nodes()) * g, 0);
    for (std::int32_t i = 0; i < _halo->num_nodes(); ++i)
      along[g * i] = static_cast<double>(is_wetted[i]);
    const std::vector<double> none(_points.size(), 0);
    const search::ProbeResult seen
        = _probe->query(x(), _points, _normals, _contact->master()->reach(), {},
                        0, search::Displacements{along, none});
    std::vector<double> parts(_halo->num_owned(), NAN);
    for (std::size_t i = 0; i < _nodes.size(); ++i)
      if (not std::isnan(seen.gap[i])
          and seen.margin[i] > -math::negligible_part)
        parts[_nodes[i]] = seen.displacement[i];
    return parts;
  }

private:
  const std::vector<double>& x() const { return _halo->now()->x; }

  std::shared_ptr<const contact::Contact> _contact;
  std::shared_ptr<mesh::Halo> _halo;
  std::optional<search::SurfaceProbe> _probe;
  std::vector<std::int32_t> _nodes; // of the master that this rank owns
  std::vector<double> _points, _normals;
};
} // namespace

std::vector<std::int8_t> results::wetted_nodes(
    const std::shared_ptr<mesh::Halo>& halo, const geometry::FacetList& facets,
    std::span<const std::int8_t> is_entry,
    std::span<const std::shared_ptr<const contact::Contact>> contacts)
{
  const std::int32_t owned = halo->num_owned();
  mesh::Ranks& ranks = halo->ranks();
  ranks.agree(
      [&]
      {
        check::facets(facets.offsets, facets.nodes, halo->gdim());
        check::numbers(facets.nodes, halo->num_bulk(), "facets", "nodes");
        check::rows(std::ssize(is_entry), owned, 1, "is_entry", "owned node");
        for (const auto& contact : contacts)
          if (not contact or &contact->halo() != halo.get())
            throw std::invalid_argument(
                "contacts must be those of one problem: "
                "one is null or of another halo");
      });
  Fluid fluid(*halo);
  fluid.add(facets);
  std::vector<std::int8_t> is_closed(owned, 0), is_slave(owned, 0);
  std::vector<Gap> gaps;
  for (const auto& contact : contacts)
  {
    fluid.add(contact->slaves().own());
    if (not contact->is_active())
      continue;
    const bool is_deformable = not contact->master()->is_rigid();
    const std::vector<std::int8_t> paired = contact->master()->paired();
    const auto slaves = contact->slaves().owned();
    for (std::size_t i = 0; i < slaves.size(); ++i)
    {
      is_closed[slaves[i]] |= contact->nodes()->closed(i);
      is_slave[slaves[i]] |= is_deformable and paired[i];
    }
    if (is_deformable)
      gaps.emplace_back(contact, halo);
  }
  const std::vector<double> on_facets = fluid.on_facets();
  for (std::int32_t i = 0; i < owned; ++i)
    fluid.is_wetted[i] = is_entry[i] and on_facets[i] > 0 and not is_closed[i];

  bool has_grown = true;
  while (has_grown)
  {
    halo->forward(std::span(fluid.is_wetted), 1);
    std::vector<double> parts(owned, NAN);
    for (Gap& gap : gaps)
    {
      const std::vector<double> wetted = gap.wetted(fluid.is_wetted);
      for (std::int32_t i = 0; i < owned; ++i)
        parts[i] = std::fmin(parts[i], wetted[i]);
    }
    const std::vector<std::int64_t> before = fluid.is_wetted;
    for (std::int32_t i = 0; i < owned; ++i)
    {
      // A slave node has its status, and a master's is entered across the gap
      const bool is_behind = not std::isnan(parts[i]) and not is_slave[i];
      fluid.is_barred[i] = is_closed[i] or is_behind;
      if (is_behind and on_facets[i] > 0 and not is_closed[i]
          and parts[i] > wetted_part_min)
        fluid.is_wetted[i] = 1;
    }
    halo->forward(std::span(fluid.is_barred), 1);
    fluid.spread();
    has_grown = mesh::anywhere(ranks, not std::equal(before.begin(),
                                                     before.begin() + owned,
                                                     fluid.is_wetted.begin()));
  }
  return {fluid.is_wetted.begin(), fluid.is_wetted.begin() + owned};
}
