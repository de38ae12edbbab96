// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#include "conductance.h"
#include "../check.h"
#include <algorithm>
#include <cmath>
#include <numeric>
#include <stdexcept>

using namespace contactx;
using namespace contactx::results;
using contact::Contact;
using law::NodeState;

namespace
{
/// Values of some slave nodes.
std::vector<double> some(const std::vector<double>& values,
                         const std::vector<std::int32_t>& nodes)
{
  std::vector<double> result;
  result.reserve(nodes.size());
  for (const std::int32_t i : nodes)
    result.push_back(values[i]);
  return result;
}

/// Values of all n slave nodes from those of some, zero elsewhere.
std::vector<double> spread(const std::vector<double>& values,
                           const std::vector<std::int32_t>& nodes,
                           std::size_t n)
{
  std::vector<double> result(n, 0);
  for (std::size_t k = 0; k < nodes.size(); ++k)
    result[nodes[k]] = values[k];
  return result;
}

std::vector<double> times(std::vector<double> a, const std::vector<double>& b)
{
  std::ranges::transform(a, b, a.begin(), std::multiplies<>());
  return a;
}

/// Columns of multipliers from those of pressures: p is the multiplier, or the
/// component of a vector along the normal.
Triplets chained(Triplets by_pressure, const Contact& contact)
{
  if (not contact.nodes()->is_vector())
    return by_pressure;
  const int g = contact.halo().gdim();
  const std::vector<double> normals = contact.master()->normals();
  Triplets result;
  result.reserve(g * by_pressure.size());
  for (std::size_t e = 0; e < by_pressure.size(); ++e)
    for (int k = 0; k < g; ++k)
    {
      const std::int32_t slave = by_pressure.columns[e];
      result.add(by_pressure.rows[e], g * slave + k,
                 by_pressure.values[e] * normals[3 * slave + k]);
    }
  return result;
}
} // namespace

void results::check_obstacle_value(std::optional<double> obstacle_value,
                                   bool is_rigid)
{
  if (is_rigid and not obstacle_value)
    throw std::invalid_argument("obstacle_value is missing: give the field's "
                                "value at the rigid obstacle");
  if (obstacle_value and not is_rigid)
    throw std::invalid_argument("obstacle_value is for rigid obstacles: a "
                                "master surface has the field itself");
}

Conductance::Conductance(std::shared_ptr<Contact> contact,
                         std::shared_ptr<const Results> results,
                         law::Coefficient coefficient,
                         std::optional<double> obstacle_value)
    : _contact(std::move(contact)), _results(std::move(results)),
      _coefficient(std::move(coefficient)), _obstacle_value(obstacle_value)
{
  check::require(_contact != nullptr, "contact must not be empty");
  check::require(_results != nullptr, "results must not be empty");
  check_obstacle_value(_obstacle_value, _contact->master()->is_rigid());
}

Conductance::Iterate Conductance::evaluate() const
{
  _contact->update_gap();
  const std::vector<double>& gap = _contact->nodes()->gap;
  Iterate result{Transfer(*_contact), {}, {}, {}, {}};
  const std::vector<std::int8_t>& is_paired = result.transfer.is_paired();
  // Without a gap there is no pair, or the contact is switched off
  for (std::size_t i = 0; i < gap.size(); ++i)
    if (is_paired[i] and not std::isnan(gap[i]))
      result.nodes.push_back(static_cast<std::int32_t>(i));
  result.pressure = some(_results->recovered_pressure(), result.nodes);
  result.gap = some(gap, result.nodes);
  _contact->halo().ranks().agree(
      [&]
      {
        result.h = spread(_coefficient.values(result.pressure, result.gap),
                          result.nodes, gap.size());
      });
  return result;
}

/// Field of the slave nodes less that of the master in front of them; of no
/// meaning where there is none, as the area is zero there (n).
std::vector<double>
Conductance::differences(const Iterate& iterate,
                         std::span<const double> field) const
{
  const mesh::Halo& halo = _contact->halo();
  halo.ranks().agree(
      [&] { check::rows(field.size(), halo.num_owned(), 1, "field"); });
  std::vector<double> every(field.begin(), field.end());
  every.resize(halo.num_nodes());
  halo.forward(every, 1);
  std::vector<double> result = iterate.transfer.differences(every);
  for (double& difference : result)
    difference -= _obstacle_value.value_or(0);
  return result;
}

/// Flow from each slave node to its master (n).
std::vector<double> Conductance::flows(const Iterate& iterate,
                                       std::span<const double> field) const
{
  return times(times(iterate.h, iterate.transfer.area()),
               differences(iterate, field));
}

double Conductance::flow(std::span<const double> field)
{
  const std::vector<double> parts = flows(evaluate(), field);
  return mesh::total(_contact->halo().ranks(),
                     std::accumulate(parts.begin(), parts.end(), 0.));
}

std::vector<double> Conductance::residual(std::span<const double> field)
{
  const mesh::Halo& halo = _contact->halo();
  const Iterate iterate = evaluate();
  std::vector<double> b(halo.num_nodes(), 0);
  iterate.transfer.add(flows(iterate, field), b);
  halo.reverse(b, 1);
  b.resize(halo.num_owned());
  return b;
}

Triplets Conductance::by_field()
{
  const Iterate iterate = evaluate();
  return iterate.transfer.by_field(iterate.h);
}

Derivatives Conductance::derivatives(std::span<const double> field)
{
  const Iterate iterate = evaluate();
  const Transfer& transfer = iterate.transfer;
  const std::vector<double> flow_by_h
      = times(transfer.area(), differences(iterate, field));
  const law::Gradient h = _coefficient.gradient(iterate.pressure, iterate.gap,
                                                _contact->halo().ranks());
  const auto of_flow = [&](const std::vector<double>& slope)
  { return times(spread(slope, iterate.nodes, flow_by_h.size()), flow_by_h); };
  return {transfer.by_field(iterate.h),
          transfer.by_displacement(of_flow(h.by_gap)),
          chained(transfer.by_slaves(of_flow(h.by_pressure)), *_contact)};
}
