// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#include "results.h"
#include "../check.h"
#include "../math/scales.h"
#include "transfer.h"
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <stdexcept>

using namespace contactx;
using namespace contactx::contact;
using namespace contactx::results;

namespace
{
constexpr double undefined = std::numeric_limits<double>::quiet_NaN();

/// Whether a weight is 2 pi r, or another multiple of a radius that varies.
bool is_circumference(const Contact& contact)
{
  const mesh::Halo& halo = contact.halo();
  const SlaveNodes& slaves = contact.slaves();
  const auto owned = slaves.owned();
  // On a rank without slave nodes there is no weight, either
  const auto& weight = slaves.weight();
  std::vector<double> radius, own;
  if (not weight.empty())
    for (std::size_t i = 0; i < owned.size(); ++i)
    {
      radius.push_back(halo.reference()[halo.gdim() * owned[i]]);
      own.push_back(weight[i]);
    }
  std::array<double, 3> most{-infinity, -infinity, -infinity};
  for (std::size_t i = 0; i < own.size(); ++i)
    most = {std::max(most[0], own[i]), std::max(most[1], radius[i]),
            std::max(most[2], -radius[i])};
  if (halo.ranks().size() > 1)
    halo.ranks().reduce(std::span<double>(most), mesh::Reduction::largest);
  const auto [largest, high, low] = most;
  if (not(largest > 0) or not(high > 0))
    return false;
  const double factor = largest / high;
  bool is_multiple = true;
  for (std::size_t i = 0; i < own.size(); ++i)
    if (std::abs(own[i] - factor * radius[i]) > math::equal_rel_tol * largest)
      is_multiple = false;
  const bool varies = high + low > math::equal_rel_tol * high;
  const double circle = 2 * std::numbers::pi;
  const bool is_full
      = std::abs(factor - circle) <= math::equal_rel_tol * factor;
  return mesh::everywhere(halo.ranks(), is_multiple) and (varies or is_full);
}

std::vector<std::int8_t> closed(const NodeState& nodes)
{
  std::vector<std::int8_t> result(nodes.num_nodes());
  for (std::size_t i = 0; i < result.size(); ++i)
    result[i] = nodes.closed(i);
  return result;
}

/// Rows of some nodes.
std::vector<double> rows(std::span<const double> values,
                         std::span<const std::int32_t> nodes, int width)
{
  std::vector<double> result;
  result.reserve(nodes.size() * width);
  for (const std::int32_t node : nodes)
    result.insert(result.end(), values.begin() + std::ptrdiff_t(width) * node,
                  values.begin() + std::ptrdiff_t(width) * (node + 1));
  return result;
}

/// Add rows up.
void add_rows(std::span<const double> values, int width, double* sum)
{
  for (std::size_t i = 0; i < values.size(); ++i)
    sum[i % width] += values[i];
}

/// Moment of forces of all ranks about a point.
Vector<3> sum_of_moments(mesh::Ranks& ranks, const Vector<3>& about,
                         std::span<const double> x,
                         std::span<const double> forces, int gdim)
{
  Vector<3> sum{};
  for (std::size_t i = 0; i < forces.size() / gdim; ++i)
    sum = sum
          + cross(vector_at(x, i, gdim) - about, vector_at(forces, i, gdim));
  if (ranks.size() > 1)
    ranks.reduce(std::span<double>(sum), mesh::Reduction::sum);
  return sum;
}
} // namespace

Results::Results(std::shared_ptr<const Contact> contact)
    : _contact(std::move(contact))
{
  if (not _contact)
    throw std::invalid_argument("contact must not be empty");
  const mesh::Halo& halo = _contact->halo();
  // The contact owns its slave nodes
  _recovery = std::make_shared<const Recovery>(
      std::shared_ptr<const SlaveNodes>(_contact, &_contact->slaves()),
      halo.reference(), gdim());
  _is_axisymmetric = gdim() == 2 and is_circumference(*_contact);
  const std::size_t n = _contact->slaves().owned().size();
  _pressure.assign(n, 0);
  _traction.assign(n * gdim(), 0);
  _master_pressure.assign(halo.num_owned(), 0);
  _gap.assign(n, undefined);
  _status.assign(n, law::open);
  _slip.assign(n * gdim(), 0);
  _slip_total.assign(n, 0);
  _on_slave = _at = _slip;
}

void Results::update()
{
  measure();
  sum_forces();
  recover();
  if (_contact->master()->is_rigid())
    return;
  _master_pressure = Transfer(*_contact).at_master(_pressure);
  std::ranges::replace_if(
      _master_pressure, [](double p) { return std::isnan(p); }, 0.);
}

void Results::measure()
{
  const NodeState& nodes = *_contact->nodes();
  _gap = nodes.gap;
  _status = nodes.status;
  // Nodes that take no force have what their neighbours have: open if one of
  // these is, else sticking if one of them does
  const std::vector<double> gap = _recovery->filled(nodes.gap, 1);
  const auto beside = [&](std::int8_t status)
  {
    std::vector<double> has(nodes.status.size());
    std::ranges::transform(nodes.status, has.begin(), [&](std::int8_t s)
                           { return s == status ? 1. : 0.; });
    return _recovery->filled(has, 1);
  };
  const std::vector<double> is_open = beside(law::open),
                            sticks = beside(law::stick);
  for (std::size_t i = 0; i < _gap.size(); ++i)
    if (std::isnan(_gap[i]) and not std::isnan(gap[i]))
    {
      _gap[i] = gap[i];
      _status[i] = is_open[i] > 0  ? law::open
                   : sticks[i] > 0 ? law::stick
                                   : law::slip;
    }
  if (const auto& history = _contact->history())
  {
    _slip = history->slip();
    _slip_total = history->total();
  }
}

void Results::sum_forces()
{
  const mesh::Halo& halo = _contact->halo();
  const NodeState& nodes = *_contact->nodes();
  const int g = gdim();
  const std::vector<double> forces = nodal_forces(assembled());
  _on_slave = rows(forces, _contact->slaves().owned(), g);
  // In self-contact all nodes may be slaves: those in contact are
  if (_contact->is_self())
    for (std::size_t i = 0; i < nodes.status.size(); ++i)
      if (not nodes.closed(i))
        std::fill_n(_on_slave.begin() + g * i, g, 0.);
  _at = rows(halo.now()->x, _contact->slaves().owned(), g);
  std::array<double, 6> sums{};
  add_rows(_on_slave, g, sums.data());
  add_rows(forces, g, sums.data() + 3);
  if (halo.ranks().size() > 1)
    halo.ranks().reduce(std::span<double>(sums), mesh::Reduction::sum);
  std::copy_n(sums.begin(), 3, _force.begin());
  std::copy_n(sums.begin() + 3, 3, _imbalance.begin());
  // The force on a rigid obstacle goes to its support
  if (_contact->master()->is_rigid())
    _imbalance = _imbalance - _force;
}

/// What this rank's pairs add to the residual of all nodes (num_nodes, gdim).
std::vector<double> Results::assembled() const
{
  std::vector<double> b(std::size_t(_contact->halo().num_nodes()) * gdim(), 0);
  _contact->add_residual(b);
  return b;
}

/// Forces on the owned nodes (num_owned, gdim); collective.
std::vector<double> Results::nodal_forces(std::vector<double> forces) const
{
  const mesh::Halo& halo = _contact->halo();
  halo.reverse(forces, gdim());
  forces.resize(std::size_t(halo.num_owned()) * gdim());
  for (double& f : forces)
    f = -f;
  return forces;
}

/// Recovered tractions of the multipliers of now, without those of frictionless
/// contact; collective.
Recovered Results::tractions() const
{
  const NodeState& nodes = *_contact->nodes();
  if (nodes.is_vector())
    return _recovery->tractions(nodes.multiplier, nodes.normal, nodes.area,
                                closed(nodes));
  return {_recovery->pressure(nodes.multiplier, nodes.area, closed(nodes)), {}};
}

void Results::recover()
{
  NodeState& nodes = *_contact->nodes();
  const int g = gdim();
  auto [pressure, traction] = tractions();
  if (not nodes.is_vector())
  {
    // What pairs make of recovered pressures; views of the multipliers stay
    // valid
    const std::vector<double> raw = nodes.multiplier;
    std::ranges::copy(pressure, nodes.multiplier.begin());
    std::vector<double> b = assembled();
    std::ranges::copy(raw, nodes.multiplier.begin());
    traction = rows(nodal_forces(std::move(b)), _contact->slaves().owned(), g);
    for (std::size_t k = 0; k < traction.size(); ++k)
      traction[k] /= nodes.area[k / g];
  }
  const std::vector<double> ratio = _recovery->ratio();
  std::vector<double> recovered(traction.size());
  for (std::size_t k = 0; k < traction.size(); ++k)
    recovered[k] = nodes.area[k / g] * ratio[k / g] * traction[k];
  _pressure = between(std::move(pressure), 1);
  _traction = between(std::move(traction), g);
  _recovery_change = results::recovery_change(_contact->halo().ranks(),
                                              _on_slave, recovered, g);
}

std::vector<double> Results::recovered_pressure() const
{
  return between(tractions().pressure, 1);
}

/// Tractions with those of nodes without an area from their neighbours;
/// collective.
std::vector<double> Results::between(std::vector<double> values,
                                     int width) const
{
  const std::vector<double> filled = _recovery->filled(values, width);
  // One that is alone in contact keeps its own
  for (std::size_t k = 0; k < values.size(); ++k)
    if (filled[k] != 0)
      values[k] = filled[k];
  return values;
}

/// Check that there is a moment, about a point.
Vector<3> Results::check_moment(std::span<const double> point) const
{
  if (_is_axisymmetric)
    throw std::logic_error(
        "the weight of the contact is in proportion to the radius, as in an "
        "axisymmetric model, where the forces around the axis have no moment: "
        "leave it out");
  const int g = gdim();
  if (point.size() != std::size_t(g)
      or not std::ranges::all_of(point,
                                 [](double p) { return std::isfinite(p); }))
    throw std::invalid_argument("the point of a moment must have "
                                + std::to_string(g) + " finite coordinates");
  return vector_at(point, 0, g);
}

Vector<3> Results::moment(std::span<const double> point) const
{
  return sum_of_moments(_contact->halo().ranks(), check_moment(point), _at,
                        _on_slave, gdim());
}

Vector<3> Results::moment(std::span<const double> point,
                          std::span<const double> shares) const
{
  const Vector<3> about = check_moment(point);
  return sum_of_moments(_contact->halo().ranks(), about,
                        _contact->halo().now()->x, forces_of(shares), gdim());
}

Vector<3> Results::force(std::span<const double> shares) const
{
  Vector<3> sum{};
  add_rows(forces_of(shares), gdim(), sum.data());
  mesh::Ranks& ranks = _contact->halo().ranks();
  if (ranks.size() > 1)
    ranks.reduce(std::span<double>(sum), mesh::Reduction::sum);
  return sum;
}

/// Shares of the forces on the owned nodes (num_owned, gdim); collective.
std::vector<double> Results::forces_of(std::span<const double> shares) const
{
  const mesh::Halo& halo = _contact->halo();
  halo.ranks().agree(
      [&] { check::rows(shares.size(), halo.num_owned(), 1, "shares"); });
  std::vector<double> forces = nodal_forces(assembled());
  for (std::size_t k = 0; k < forces.size(); ++k)
    forces[k] *= shares[k / gdim()];
  return forces;
}

std::vector<double> Results::shares(const geometry::FacetList& part,
                                    const geometry::FacetList& whole) const
{
  const mesh::Halo& halo = _contact->halo();
  const auto areas = [&](const geometry::FacetList& facets)
  {
    std::vector<double> result
        = geometry::nodal_areas(facets, halo.reference(), gdim());
    halo.reverse(result, 1);
    result.resize(halo.num_owned());
    return result;
  };
  std::vector<double> shares = areas(part);
  const std::vector<double> all = areas(whole);
  for (std::size_t i = 0; i < shares.size(); ++i)
    if (shares[i] > 0)
      shares[i] /= all[i];
  return shares;
}

Totals Results::totals(std::span<const double> shares) const
{
  const NodeState& nodes = *_contact->nodes();
  const mesh::Halo& halo = _contact->halo();
  halo.ranks().agree(
      [&]
      {
        if (not shares.empty())
          check::rows(shares.size(), halo.num_owned(), 1, "shares");
      });
  const auto owned = _contact->slaves().owned();
  std::vector<double> share(owned.size(), 1);
  if (not shares.empty())
    std::ranges::transform(owned, share.begin(),
                           [&](std::int32_t node) { return shares[node]; });
  // Numbers of nodes in contact and slipping, area, work of friction
  std::array<double, 4> sums{};
  for (std::size_t i = 0; i < nodes.status.size(); ++i)
    if (share[i] > 0 and nodes.closed(i))
    {
      sums[0] += 1;
      sums[1] += nodes.status[i] == law::slip;
      sums[2] += share[i] * nodes.area[i];
    }
  if (const auto& history = _contact->history())
    for (std::size_t i = 0; i < share.size(); ++i)
      sums[3] += share[i] * history->dissipation()[i];
  std::array<double, 2> most{0, -infinity};
  for (std::size_t i = 0; i < share.size(); ++i)
    if (share[i] > 0)
    {
      most[0] = std::max(most[0], _pressure[i]);
      if (std::isfinite(nodes.gap[i]))
        most[1] = std::max(most[1], -nodes.gap[i]);
    }
  mesh::Ranks& ranks = _contact->halo().ranks();
  if (ranks.size() > 1)
  {
    ranks.reduce(std::span<double>(sums), mesh::Reduction::sum);
    ranks.reduce(std::span<double>(most), mesh::Reduction::largest);
  }
  return {static_cast<std::int64_t>(sums[0]),
          static_cast<std::int64_t>(sums[1]),
          sums[2],
          most[0],
          std::isfinite(most[1]) ? -most[1] : undefined,
          sums[3]};
}

void Results::check_deformable() const
{
  if (_contact->master()->is_rigid())
    throw std::invalid_argument(
        "the master is a rigid obstacle, which has no nodes: take the result "
        "itself, on the slave");
}

std::vector<double> Results::on_both(std::span<const double> values,
                                     double missing) const
{
  check_deformable();
  const std::size_t n = _pressure.size();
  _contact->halo().ranks().agree(
      [&] { check::rows(values.size(), n, 1, "values"); });
  std::vector<double> known(values.begin(), values.end()), is_known(n, 1);
  for (std::size_t i = 0; i < n; ++i)
    if (std::isnan(known[i]))
      known[i] = is_known[i] = 0;
  const Transfer transfer(*_contact);
  const std::vector<double> shares = transfer.at_master(is_known);
  // Means of those that are known
  std::vector<double> result = transfer.at_master(known);
  for (std::size_t k = 0; k < result.size(); ++k)
  {
    const double mean = result[k] / shares[k];
    result[k] = std::isnan(mean) ? missing : mean;
  }
  const auto owned = _contact->slaves().owned();
  for (std::size_t i = 0; i < n; ++i)
    result[owned[i]] = is_known[i] != 0 ? values[i] : missing;
  return result;
}

std::vector<double> Results::across(std::span<const double> field) const
{
  check_deformable();
  const mesh::Halo& halo = _contact->halo();
  halo.ranks().agree(
      [&] { check::rows(field.size(), halo.num_owned(), 1, "field"); });
  const auto owned = _contact->slaves().owned();
  const Transfer transfer(*_contact);
  std::vector<double> result = transfer.at_master(rows(field, owned, 1));
  for (std::size_t k = 0; k < result.size(); ++k)
    if (std::isnan(result[k]))
      result[k] = field[k];
  std::vector<double> every(field.begin(), field.end());
  every.resize(halo.num_nodes());
  halo.forward(every, 1);
  const std::vector<double> differences = transfer.differences(every);
  for (std::size_t i = 0; i < owned.size(); ++i)
    result[owned[i]] = field[owned[i]] - differences[i];
  return result;
}
