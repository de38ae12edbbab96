// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#include "surfaces_audit.h"
#include "../check.h"
#include "../geometry/middle.h"
#include "../geometry/sizes.h"
#include "../math/vec.h"
#include "../mesh/extent.h"
#include "../mesh/spread.h"
#include "passed_nodes.h"
#include "penetration.h"
#include <algorithm>
#include <array>
#include <cmath>
#include <stdexcept>

using namespace contactx;
using namespace contactx::audit;

namespace
{
// Least overlap of a surface with the other's outer edge, over the facet: the
// larger one of the two bounds of surface-to-surface
constexpr double edge_overlap_min = 1. / 16;
// Largest depth of a node without a pair behind a facet, over the facet's size
constexpr double unpaired_depth_max = 1. / 32;
// Values of a slave facet for the master's nodes, see see_slave
constexpr int num_probe_values = 8;

double largest_of(std::span<const double> values)
{
  double most = 0;
  for (const double v : values)
    most = std::max(most, v);
  return most;
}

std::shared_ptr<contact::DeformableMaster>
deformable(const contact::Contact& contact)
{
  auto master
      = std::dynamic_pointer_cast<contact::DeformableMaster>(contact.master());
  if (not master)
    throw std::invalid_argument("the contact's master must be deformable");
  return master;
}

/// Largest displacement of a node of facets.
double largest_displacement_of(const geometry::FacetList& facets,
                               std::span<const double> from,
                               std::span<const double> to, int gdim)
{
  double longest = 0;
  for (const std::int32_t node : facets.nodes)
  {
    double square = 0;
    for (int k = 0; k < gdim; ++k)
    {
      const std::size_t at = std::size_t(node) * gdim + k;
      square += (to[at] - from[at]) * (to[at] - from[at]);
    }
    longest = std::max(longest, std::sqrt(square));
  }
  return longest;
}
} // namespace

SurfacesAudit::SurfacesAudit(std::shared_ptr<mesh::Halo> halo,
                             std::shared_ptr<contact::Contact> contact)
    : _halo(std::move(halo)), _contact(std::move(contact)),
      _master(deformable(*_contact)),
      _at_slave(_halo, _contact->slaves().facets().offsets,
                _contact->slaves().facets().nodes),
      _outside_slave(_halo, _contact->slaves().own().offsets,
                     _contact->slaves().own().nodes),
      _extent(std::ranges::max(
          mesh::extent(_halo->ranks(), _master->surface()->own().nodes,
                       _halo->reference(), _halo->gdim()))),
      _behind(_contact->slaves().owned().size(), 0)
{
  const auto n = std::size_t(_halo->num_nodes());
  std::vector<std::int64_t> shared(n, 0);
  std::ranges::copy(_contact->shared(), shared.begin());
  _halo->forward(std::span(shared), 1);
  std::vector<double> marks(n, 0);
  for (const std::int32_t node : _master->surface()->own().nodes)
    marks[node] = shared[node] == 0;
  for (std::size_t i = 0; i < n; ++i)
    if (marks[i] > 0)
      _points.push_back(static_cast<std::int32_t>(i));
  _halo->reverse(std::span(marks), 1);
  for (std::int32_t i = 0; i < _halo->num_owned(); ++i)
    if (marks[i] > 0)
      _owned_master.push_back(i);
}

void SurfacesAudit::accept()
{
  _behind = find_behind();
  accept_warning();
}

Findings SurfacesAudit::find(std::span<const double> start)
{
  Findings findings;
  const auto now = _halo->now();
  const std::vector<double>& x = now->x;
  check::rows(start.size(), x.size(), 1, "start");
  findings.facet_size = facet_size(_contact->slaves().own(), x);
  look_back(start, x, findings);
  if (findings.passed.count == 0)
    findings.inside = look_from_slave(x);
  look_from_master(x, findings);
  findings.apart = look_across(x, findings.facet_size);
  findings.chords = chords(*_halo, *_contact);
  warn(findings, findings.chords, findings.edges);
  findings.penetrates_too_deep = not findings.is_fault() and findings.deepest
                                 and findings.deepest->excess > 1;
  return findings;
}

bool SurfacesAudit::is_small() const
{
  return _contact->sliding() == contact::Sliding::small;
}

SurfacesAudit::Configuration SurfacesAudit::configuration() const
{
  if (not is_small())
    return {_halo->now()->x, {}};
  const auto x = _halo->reference();
  Configuration now{{x.begin(), x.end()}, _halo->now()->x};
  for (std::size_t i = 0; i < x.size(); ++i)
    now.displacement[i] -= x[i];
  return now;
}

/// Size of the largest facet on any rank.
double SurfacesAudit::facet_size(const geometry::FacetList& facets,
                                 std::span<const double> x) const
{
  return mesh::largest(_halo->ranks(), largest_of(geometry::facet_sizes(
                                           facets, x, _halo->gdim())));
}

/// Nodes that are out of contact must not have gone through the other surface.
void SurfacesAudit::look_back(std::span<const double> start,
                              std::span<const double> x,
                              Findings& findings) const
{
  if (is_small())
    return;
  struct Side
  {
    geometry::FacetList own, other;
    std::span<const std::int32_t> nodes;
  };
  const int g = _halo->gdim();
  const auto slave = _contact->slaves().own(),
             master = _master->surface()->own();
  // A slave node with a pair faces its facet, a master node has no pair: what
  // the other searches find of them is within a facet's size
  std::array moved{largest_displacement_of(slave, start, x, g),
                   largest_displacement_of(master, start, x, g)};
  _halo->ranks().reduce(std::span<double>(moved), mesh::Reduction::largest);
  const bool is_far = moved[0] + moved[1] > findings.facet_size;
  const auto slaves = _contact->slaves().owned();
  const auto paired = _master->paired();
  std::vector<std::int32_t> candidates;
  for (std::size_t i = 0; i < slaves.size(); ++i)
    if ((is_far or not paired[i]) and not _contact->is_left_out()[i])
      candidates.push_back(slaves[i]);
  std::vector<Side> sides{{slave, master, candidates}};
  if (is_far)
    sides.push_back({master, slave, _owned_master});
  double overlap = 0;
  for (const double offset : _contact->offset())
    overlap = std::max(overlap, -offset);
  overlap = mesh::largest(_halo->ranks(), overlap);
  for (const auto& [own, other, nodes] : sides)
  {
    // Facets that have become long are no reason to allow more
    const double size
        = std::min(facet_size(other, start), facet_size(other, x));
    const double tolerance = contact_depth_max * size + overlap;
    FoundNodes found
        = passed_nodes(*_halo, own, other, start, x, nodes, tolerance);
    found.count += findings.passed.count;
    if (findings.passed.count == 0)
      findings.passed = std::move(found);
    else
      findings.passed.count = found.count;
  }
}

/// Which slave nodes without a pair lie behind the nearest facet, of any
/// normal.
std::vector<std::int8_t> SurfacesAudit::find_behind()
{
  const int g = _halo->gdim();
  mesh::Ranks& ranks = _halo->ranks();
  const auto slaves = _contact->slaves().owned();
  const auto paired = _master->paired();
  const law::NodeState& state = *_contact->nodes();
  std::vector<std::int32_t> nodes;
  std::vector<std::size_t> which;
  for (std::size_t i = 0; i < slaves.size(); ++i)
    if (not paired[i] and not state.immobile[i]
        and not _contact->is_left_out()[i])
    {
      which.push_back(i);
      nodes.push_back(slaves[i]);
    }
  std::vector<std::int8_t> behind(slaves.size(), 0);
  if (not mesh::anywhere(ranks, not which.empty()))
    return behind;
  const Configuration now = configuration();
  const auto size = geometry::facet_sizes(_master->surface()->own(), now.x, g);
  // RankBoxes of the search, but in small sliding nodes may have gone farther
  // since
  double reach = mesh::largest(ranks, largest_of(size));
  if (not is_small())
    reach = std::min(reach, _master->reach());
  const auto points = rows_of(now.x, nodes, g);
  std::vector<double> displacement;
  std::optional<search::Displacements> displacements;
  if (is_small())
  {
    displacement = rows_of(now.displacement, nodes, g);
    displacements = search::Displacements{now.displacement, displacement};
  }
  const search::ProbeResult seen = _master->outside()->probe().query(
      now.x, points, std::vector<double>(points.size(), 0), reach, size, 1,
      displacements);
  for (std::size_t k = 0; k < which.size(); ++k)
  {
    const double offset = std::min(_contact->offset()[which[k]], 0.);
    behind[which[k]]
        = seen.inside[k] and seen.margin[k] > edge_overlap_min
          and seen.gap[k] < offset - unpaired_depth_max * seen.values[k];
  }
  return behind;
}

/// Slave nodes must not come behind the master without a pair.
FoundNodes SurfacesAudit::look_from_slave(std::span<const double> x)
{
  const auto behind = find_behind();
  const auto slaves = _contact->slaves().owned();
  std::vector<std::int32_t> bad;
  for (std::size_t i = 0; i < slaves.size(); ++i)
    if (behind[i] and not _behind[i])
      bad.push_back(slaves[i]);
  return found_nodes(*_halo, bad, x);
}

/// Curvature of each slave facet, which matters to linear kinematics alone.
std::vector<double> SurfacesAudit::bent(const Configuration& now) const
{
  const contact::SlaveNodes& slaves = _contact->slaves();
  const geometry::FacetList local = slaves.local();
  if (not is_small())
    return std::vector<double>(local.size(), 0);
  const int g = _halo->gdim();
  const auto x = rows_of(now.x, slaves.around(), g);
  // Their owners have all facets around the others
  const std::size_t n = slaves.owned().size();
  auto normals = geometry::nodal_normals(local, x, g);
  normals = slaves.scatter_forward(
      std::span<const double>(normals).first(n * g), g);
  const auto curvature = geometry::nodal_curvatures(local, x, normals, g);
  return slaves.largest(
      slaves.scatter_forward(std::span<const double>(curvature).first(n)));
}

/// What the master's nodes see of the slave facets: the facet's size, how near
/// it is to contact, what is taken off the gap, how it is bent, the largest
/// stiffness of its nodes, its normal.
search::ProbeResult SurfacesAudit::see_slave(const Configuration& now,
                                             std::span<const double> normals)
{
  const int g = _halo->gdim();
  const contact::SlaveNodes& slaves = _contact->slaves();
  const law::NodeState& state = *_contact->nodes();
  const auto size = geometry::unstretched_sizes(slaves.facets(), now.x,
                                                _halo->reference(), g);
  const double reach = facet_size(slaves.facets(), now.x);
  std::vector<std::int8_t> held(slaves.owned().size());
  std::vector<double> stiffness(held.size());
  for (std::size_t i = 0; i < held.size(); ++i)
  {
    held[i] = state.is_constrained(i);
    stiffness[i] = state.c[i] * state.area[i];
  }
  const auto offset
      = slaves.smallest(slaves.scatter_forward(_contact->offset()));
  const auto near = slaves.near(held);
  const auto curvature = bent(now);
  const auto stiff = slaves.largest(slaves.scatter_forward(stiffness));
  std::vector<double> values;
  values.reserve(num_probe_values * size.size());
  const auto normal = geometry::middles(slaves.facets(), now.x, g).normals;
  for (std::size_t f = 0; f < size.size(); ++f)
  {
    const Vector<3> n = vector_at(normal, f, g);
    values.insert(values.end(), {size[f], double(near[f]), offset[f],
                                 curvature[f], stiff[f], n[0], n[1], n[2]});
  }
  const auto points = rows_of(now.x, _points, g);
  std::vector<double> displacement;
  std::optional<search::Displacements> displacements;
  if (is_small())
  {
    displacement = rows_of(now.displacement, _points, g);
    displacements = search::Displacements{now.displacement, displacement};
  }
  return _at_slave.query(now.x, points, rows_of(normals, _points, g), reach,
                         values, num_probe_values, displacements);
}

void SurfacesAudit::look_from_master(std::span<const double> positions,
                                     Findings& findings)
{
  const int g = _halo->gdim();
  const Configuration now = configuration();
  const geometry::FacetList around = _master->surface()->around();
  // Of the facets around a node some may be on other ranks alone
  const auto normals = mesh::spread(
      *_halo, normals_of_all(*_halo, _master->surface()->own(), now.x), g);
  const auto curvature = geometry::nodal_curvatures(around, now.x, normals, g);
  const search::ProbeResult seen = see_slave(now, normals);
  const std::size_t n = _points.size();
  std::vector<double> below(n), sizes(n);
  for (std::size_t i = 0; i < n; ++i)
  {
    below[i] = std::isnan(seen.height[i]) ? 0 : -seen.height[i];
    sizes[i] = seen.values[num_probe_values * i];
  }
  const auto outside
      = _outside_slave.find(now.x, rows_of(now.x, _points, g), below, sizes);
  std::vector<std::size_t> there;
  std::vector<double> size, turn;
  std::vector<std::int8_t> near;
  for (std::size_t i = 0; i < n; ++i)
  {
    // Facets that overlap the outer edge by less are not in contact
    if (std::isnan(seen.gap[i]) or not(seen.margin[i] > edge_overlap_min)
        or outside[i])
      continue;
    there.push_back(i);
    size.push_back(sizes[i]);
    near.push_back(
        _master->is_smooth()
            ? 2
            : static_cast<std::int8_t>(seen.values[num_probe_values * i + 1]));
    turn.push_back(curvature[_points[i]]);
  }
  auto explained = allowed_penetration(
      size, turn, near, std::vector<double>(there.size(), _extent));
  std::vector<double> depth(there.size()), excess(there.size());
  for (std::size_t k = 0; k < there.size(); ++k)
  {
    const std::size_t i = there[k];
    // Linear kinematics take a curved surface for flat along the displacement
    explained[k] += (turn[k] + seen.values[num_probe_values * i + 3])
                    * (seen.displacement[i] * seen.displacement[i]);
    depth[k] = seen.values[num_probe_values * i + 2] - seen.gap[i];
    excess[k] = depth[k] / explained[k];
  }
  std::vector<MasterBelow> nodes;
  for (std::size_t k = 0; k < there.size() and not _master->is_smooth(); ++k)
    if (const double* its = &seen.values[num_probe_values * there[k]];
        depth[k] > 0)
      nodes.push_back({_points[there[k]],
                       depth[k],
                       size[k],
                       its[4],
                       {its[5], its[6], its[7]}});
  findings.edges = edge_force(*_halo, *_contact, now.x, nodes);
  std::optional<Depth> mine;
  if (const auto k = worst_of(excess); k >= 0)
    mine = Depth{excess[k], depth[k], size[k], near[k] > 1,
                 rows_of(positions, std::span(&_points[there[k]], 1), g)};
  findings.deepest = deepest(_halo->ranks(), mine, g);
}

/// Distance between the surfaces if they press though nothing touches, else
/// zero.
///
/// Dual functions have both signs: on facets that are covered in part a mean
/// gap may be zero though there is a gap everywhere.
double SurfacesAudit::look_across(std::span<const double> x, double facet_size)
{
  if (not _contact->master()->integrates() or is_small())
    return 0;
  const int g = _halo->gdim();
  mesh::Ranks& ranks = _halo->ranks();
  const auto slaves = _contact->slaves().owned();
  const law::NodeState& state = *_contact->nodes();
  std::vector<std::int32_t> nodes;
  double allowed = 0;
  for (std::size_t i = 0; i < slaves.size(); ++i)
    if (state.closed(i) and state.pressure(i) > 0)
    {
      nodes.push_back(slaves[i]);
      allowed = std::max(allowed, std::abs(_contact->offset()[i]));
    }
  if (not mesh::anywhere(ranks, not nodes.empty()))
    return 0;
  allowed = harmful_depth * facet_size + mesh::largest(ranks, allowed);
  const auto least
      = [&](search::SurfaceProbe& probe, std::span<const std::int32_t> points)
  {
    const search::ProbeResult seen
        = probe.query(x, rows_of(x, points, g),
                      std::vector<double>(points.size() * g, 0), 2 * allowed);
    return mesh::least(ranks, seen.distance.empty()
                                  ? infinity
                                  : std::ranges::min(seen.distance));
  };
  double distance = least(_master->outside()->probe(), nodes);
  if (distance > allowed)
    distance = std::min(distance, least(_at_slave, _points));
  return distance > allowed ? std::min(distance, 2 * allowed) : 0;
}
