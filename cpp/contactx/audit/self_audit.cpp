// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#include "self_audit.h"
#include "../check.h"
#include "../contact/deformable_master.h"
#include "../geometry/sizes.h"
#include "passage.h"
#include "penetration.h"
#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

using namespace contactx;
using namespace contactx::audit;

namespace
{
/// Depth of a node behind a facet, over the body's thickness there, up to which
/// it is in contact
constexpr double thickness_fraction_max = 1. / 4;
} // namespace

SelfAudit::SelfAudit(std::shared_ptr<mesh::Halo> halo,
                     std::shared_ptr<contact::Contact> contact)
    : _halo(std::move(halo)), _contact(std::move(contact))
{
  if (const auto master = std::dynamic_pointer_cast<contact::DeformableMaster>(
          _contact->master()))
    _surface
        = std::dynamic_pointer_cast<search::SelfSurface>(master->surface());
  if (not _surface)
    throw std::invalid_argument("the contact's surface must be on itself");
}

Findings SelfAudit::find(std::span<const double> start)
{
  const auto now = _halo->now();
  const std::vector<double>& x = now->x;
  check::rows(start.size(), x.size(), 1, "start");
  search::SelfSight& sight = _surface->sight();
  sight.refit(start, x);
  const std::vector<double> sizes = geometry::facet_sizes(
      sight.surface().facets(), sight.positions(), _halo->gdim());
  Findings findings;
  findings.facet_size = sizes.empty() ? 0 : std::ranges::max(sizes);
  findings.passed = look_back(findings.facet_size);
  findings.deepest = look_around(sizes);
  findings.penetrates_too_deep = not findings.is_fault() and findings.deepest
                                 and findings.deepest->excess > 1;
  return findings;
}

/// Values of slave nodes at all nodes of the surface; collective.
std::vector<double> SelfAudit::nodal(std::span<const double> of_slaves) const
{
  std::vector<double> values(_halo->num_owned(), 0);
  const auto slaves = _contact->slaves().owned();
  for (std::size_t i = 0; i < slaves.size(); ++i)
    values[slaves[i]] = of_slaves[i];
  return _surface->sight().surface().gathered(std::span<const double>(values),
                                              1);
}

/// Nodes must not have gone through the surface.
FoundNodes SelfAudit::look_back(double size) const
{
  const search::SelfSight& sight = _surface->sight();
  const search::WholeSurface& surface = sight.surface();
  const auto &x0 = sight.start(), &x1 = sight.positions();
  const int g = _halo->gdim();
  double moved = 0;
  for (std::int32_t i = 0; i < surface.num_nodes(); ++i)
  {
    double square = 0;
    for (int k = 0; k < g; ++k)
    {
      const double d = x1[std::size_t(i) * g + k] - x0[std::size_t(i) * g + k];
      square += d * d;
    }
    moved = std::max(moved, std::sqrt(square));
  }
  double overlap = 0;
  for (const double offset : _contact->offset())
    overlap = std::max(overlap, -offset);
  overlap = mesh::largest(_halo->ranks(), overlap);
  std::vector<double> tolerance;
  double least = contact_depth_max * size;
  for (const std::int32_t node : surface.owned())
  {
    tolerance.push_back(std::min(contact_depth_max * size,
                                 thickness_fraction_max * sight.thickness(node))
                        + overlap);
    least = std::min(least, tolerance.back());
  }
  // Nodes that have not come that far are seen from where they are
  if (not(2 * moved > mesh::least(_halo->ranks(), least)))
    return {};
  const auto& owned = surface.owned();
  const auto from = rows_of(x0, owned, g), to = rows_of(x1, owned, g);
  const auto normal0 = rows_of(sight.start_normals(), owned, g),
             normal1 = rows_of(sight.normals(), owned, g);
  const Passages found
      = passages(surface.facets(), x0, x1, g,
                 {from, to, normal0, normal1, tolerance, owned});
  std::vector<std::int32_t> bad;
  for (std::size_t i = 0; i < owned.size(); ++i)
    if (found.facet[i] >= 0)
      bad.push_back(surface.owned_here()[i]);
  return found_nodes(*_halo, bad, _halo->now()->x);
}

/// How deep nodes are behind facets that they see.
std::optional<Depth> SelfAudit::look_around(std::span<const double> sizes) const
{
  const search::SelfSight& sight = _surface->sight();
  const search::WholeSurface& surface = sight.surface();
  const geometry::FacetList facets = surface.facets();
  const int g = _halo->gdim();
  const auto& x = sight.positions();
  const law::NodeState& state = *_contact->nodes();
  std::vector<double> held(_contact->slaves().owned().size());
  for (std::size_t i = 0; i < held.size(); ++i)
    held[i] = state.is_constrained(i);
  const std::vector<double> is_held = nodal(held),
                            offset = nodal(_contact->offset());
  // Nodes of facets around those that are in contact
  std::vector<std::int8_t> beside(surface.num_nodes(), 0);
  const auto holds = [&](std::int32_t f)
  {
    return std::ranges::any_of(facets[f], [&](std::int32_t node)
                               { return is_held[node] > 0; });
  };
  for (std::int32_t f = 0; f < facets.size(); ++f)
    if (holds(f))
      for (const std::int32_t node : facets[f])
        beside[node] = 1;
  const std::vector<double> curvature
      = geometry::nodal_curvatures(facets, x, sight.normals(), g);
  const double reach = sizes.empty() ? 0 : std::ranges::max(sizes);
  std::vector<std::size_t> there;
  std::vector<double> size, turn, depth;
  std::vector<std::int8_t> near;
  for (std::size_t i = 0; i < surface.owned().size(); ++i)
  {
    const std::int32_t node = surface.owned()[i];
    const search::FoundPlace found = sight.find(node, reach);
    if (not found.selected)
      continue;
    const std::int32_t f = found.selected->facet;
    const auto nodes = facets[f];
    const bool is_beside
        = beside[node]
          or std::ranges::any_of(nodes, [&](std::int32_t other)
                                 { return beside[other] != 0; });
    double taken_off = offset[node], bent = curvature[node];
    for (const std::int32_t other : nodes)
    {
      taken_off = std::min(taken_off, offset[other]);
      bent = std::max(bent, curvature[other]);
    }
    there.push_back(i);
    size.push_back(sizes[f]);
    turn.push_back(bent);
    near.push_back(is_held[node] > 0 or holds(f) ? 2 : is_beside);
    depth.push_back(taken_off - found.selected->gap);
  }
  const auto explained = allowed_penetration(
      size, turn, near,
      std::vector<double>(there.size(),
                          std::numeric_limits<double>::infinity()));
  std::vector<double> excess(there.size());
  for (std::size_t k = 0; k < there.size(); ++k)
    excess[k] = depth[k] / explained[k];
  std::optional<Depth> mine;
  if (const auto k = worst_of(excess); k >= 0)
    mine = Depth{excess[k], depth[k], size[k], near[k] > 1,
                 rows_of(x, std::span(&surface.owned()[there[k]], 1), g)};
  return deepest(_halo->ranks(), mine, g);
}
