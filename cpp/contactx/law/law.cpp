// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#include "law.h"
#include "../math/scales.h"
#include "../math/vec.h"
#include "../text.h"
#include "coulomb.h"
#include "slip_history.h"
#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <string>

using namespace contactx;
using namespace contactx::law;
using contactx::law::NodeState;

namespace
{
// Trial friction over its bound up to which a node whose slip reverses sticks
// first. From 3 to 100 iterations differ by little, without a limit they are
// twice as many
constexpr double reversal_reach = 10;

/// What is thrown for other multipliers than those of a law.
void check_multipliers(const Law& law, const NodeState& nodes)
{
  if (law.is_vector() != nodes.is_vector())
    throw std::invalid_argument(
        "nodes must have " + std::string(law.is_vector() ? "vector" : "scalar")
        + " multipliers for the law \"" + std::string(law.name()) + "\"");
}

/// Gaps, NaN where a node cannot close
std::vector<double> closable_gaps(const NodeState& nodes)
{
  std::vector<double> gap(nodes.gap.size());
  for (std::size_t i = 0; i < gap.size(); ++i)
    gap[i] = nodes.closable_gap(i);
  return gap;
}

/// Part of the bound on friction that a node which slips may fall short of.
double edge(double pressure, double highest)
{
  // What Newton's method leaves at the end of a step, which starts the next one
  return pressure > 0
             ? std::min(math::negligible_part * highest / pressure, 0.5)
             : 0.5;
}

/// Whether the trial friction of a node exceeds a bound.
bool exceeds(const NodeState& nodes, std::size_t i, double bound)
{
  const std::size_t gdim = nodes.gdim();
  const double p = nodes.pressure(i), c = nodes.tangential_ratio * nodes.c[i];
  double size = 0;
  for (std::size_t k = gdim * i; k < gdim * (i + 1); ++k)
  {
    const double trial
        = nodes.multiplier[k] - p * nodes.normal[k] - c * nodes.slip[k];
    size += trial * trial;
  }
  return std::sqrt(size) > bound;
}

std::vector<double> pressures(const NodeState& nodes)
{
  std::vector<double> p(nodes.status.size());
  for (std::size_t i = 0; i < p.size(); ++i)
    p[i] = nodes.pressure(i);
  return p;
}

/// Pressures that the status goes by, see `pressure_hat`.
std::vector<double> pressures_hat(const NodeState& nodes)
{
  std::vector<double> p(nodes.status.size());
  for (std::size_t i = 0; i < p.size(); ++i)
    p[i] = pressure_hat(nodes.pressure(i), nodes.c[i], nodes.gap[i],
                        nodes.closed(i));
  return p;
}

double length_of_slip(const NodeState& nodes, std::size_t i)
{
  double sum = 0;
  for (std::size_t k = nodes.gdim() * i; k < nodes.gdim() * (i + 1); ++k)
    sum += nodes.slip[k] * nodes.slip[k];
  return std::sqrt(sum);
}
} // namespace

std::int32_t Frictionless::set_status(NodeState& nodes, mesh::Ranks&) const
{
  check_multipliers(*this, nodes);
  const auto gap = closable_gaps(nodes);
  return normal_status({nodes.multiplier, gap, nodes.c}, nodes.status);
}

void Frictionless::evaluate(NodeState& nodes) const
{
  check_multipliers(*this, nodes);
  if (nodes.interior)
    interior_complementarity(nodes);
  else
    normal_complementarity({nodes.multiplier, nodes.gap, nodes.c}, nodes.area,
                           nodes.status, nodes.value, nodes.by_multiplier,
                           nodes.by_gap);
}

void Coulomb::set_friction(std::span<const double> friction)
{
  const auto is_bad
      = [](double mu) { return not(mu >= 0) or not std::isfinite(mu); };
  auto bad = std::ranges::find_if(friction, is_bad);
  if (bad != friction.end())
  {
    // The least tells most
    if (const auto least = std::ranges::min_element(friction); *least < 0)
      bad = least;
    throw std::invalid_argument("friction is " + exact_text(*bad)
                                + ": give numbers of at least 0 (manual: "
                                  "errors/friction-values)");
  }
  _friction.assign(friction.begin(), friction.end());
}

/// Bounds of friction at some pressures: none where friction is left out, and
/// on nodes that are pulled off those of no pressure.
Bounds Coulomb::bounds(const NodeState& nodes,
                       std::span<const double> pressure) const
{
  const std::size_t n = nodes.frictionless.size();
  Bounds found;
  if (_bound)
  {
    std::vector<double> pressed(n), slipped(n);
    for (std::size_t i = 0; i < n; ++i)
    {
      // False for NaN, too
      pressed[i] = pressure[i] > 0 ? pressure[i] : 0;
      slipped[i]
          = length_of_slip(nodes, i) + (_history ? _history->total()[i] : 0);
    }
    found = _bound(pressed, slipped);
    for (const auto* values :
         {&found.bound, &found.by_pressure, &found.by_slip})
      if (values->size() != n)
        throw std::invalid_argument("the law of friction must give values for "
                                    "each of "
                                    + std::to_string(n) + " slave nodes, not "
                                    + std::to_string(values->size()));
    for (std::size_t i = 0; i < n; ++i)
    {
      if (not(found.bound[i] >= 0) or not std::isfinite(found.bound[i])
          or not std::isfinite(found.by_pressure[i])
          or not std::isfinite(found.by_slip[i]))
        throw std::invalid_argument(
            "the law of friction gives the bound "
            + std::to_string(found.bound[i]) + " at the pressure "
            + std::to_string(pressed[i]) + ", with the derivatives "
            + std::to_string(found.by_pressure[i]) + " and "
            + std::to_string(found.by_slip[i])
            + ": it must be at least 0, and all of them finite (manual: "
              "errors/friction-values)");
      if (pressure[i] < 0)
        found.by_pressure[i] = 0;
    }
  }
  else
  {
    if (_friction.size() != n)
      throw std::invalid_argument(
          "friction must have a coefficient for each of " + std::to_string(n)
          + " slave nodes, not " + std::to_string(_friction.size()));
    found = {std::vector<double>(n), _friction, std::vector<double>(n)};
    for (std::size_t i = 0; i < n; ++i)
      found.bound[i] = _friction[i] * pressure[i];
  }
  for (std::size_t i = 0; i < n; ++i)
    if (nodes.frictionless[i])
      found.bound[i] = found.by_pressure[i] = found.by_slip[i] = 0;
  return found;
}

void Coulomb::bound_interior(NodeState& nodes) const
{
  Interior& interior = *nodes.interior;
  Bounds found = bounds(nodes, interior.pressure);
  interior.bound = std::move(found.bound);
  interior.by_pressure = std::move(found.by_pressure);
}

std::vector<double> Coulomb::friction(const NodeState& nodes) const
{
  return bounds(nodes, pressures(nodes)).by_pressure;
}

double Coulomb::friction_max() const
{
  if (_bound)
    return infinity;
  return _friction.empty() ? 0 : *std::ranges::max_element(_friction);
}

std::vector<std::int8_t> Coulomb::has_friction(const NodeState& nodes) const
{
  const std::vector<double> p = pressures(nodes);
  const Bounds found = bounds(nodes, p);
  std::vector<std::int8_t> result(p.size());
  for (std::size_t i = 0; i < result.size(); ++i)
    result[i] = p[i] > 0 and found.bound[i] > 0;
  return result;
}

std::int32_t Coulomb::set_status(NodeState& nodes, mesh::Ranks& ranks) const
{
  double highest = 0;
  for (std::size_t i = 0; i < nodes.status.size(); ++i)
    highest = std::max(highest, nodes.pressure(i));
  highest = mesh::largest(ranks, highest);
  // Only now: no rank may leave the others waiting
  check_multipliers(*this, nodes);
  Bounds found;
  const auto look = [&] { found = bounds(nodes, pressures_hat(nodes)); };
  if (may_throw())
    ranks.agree(look);
  else
    look();
  for (std::size_t i = 0; i < found.bound.size(); ++i)
    if (nodes.status[i] == slip)
      found.bound[i] *= 1 - edge(nodes.pressure(i), highest);

  const auto before = nodes.status;
  const auto gap = closable_gaps(nodes);
  frictional_status({nodes.gdim(),
                     nodes.multiplier,
                     gap,
                     nodes.normal,
                     nodes.slip,
                     nodes.c,
                     found.by_pressure,
                     found.bound,
                     {},
                     nodes.tangential_ratio},
                    _has_cycled ? infinity : reversal_reach, nodes.status);
  std::int32_t changed = 0;
  for (std::size_t i = 0; i < before.size(); ++i)
  {
    std::int8_t& now = nodes.status[i];
    if (before[i] == open and now == slip and found.bound[i] > 0)
    {
      if (nodes.slip_closings[i] % 4 == 3)
        now = stick;
      ++nodes.slip_closings[i];
    }
    else if (before[i] == slip and now == stick
             and exceeds(nodes, i, found.bound[i]))
    {
      if (nodes.slip_reversals[i] % 2 == 1)
        now = slip;
      ++nodes.slip_reversals[i];
    }
    changed += now != before[i];
  }
  return changed;
}

void Coulomb::evaluate(NodeState& nodes) const
{
  check_multipliers(*this, nodes);
  if (nodes.interior)
    interior_complementarity(nodes);
  else
  {
    const Bounds found = bounds(nodes, pressures_hat(nodes));
    frictional_complementarity({nodes.gdim(), nodes.multiplier, nodes.gap,
                                nodes.normal, nodes.slip, nodes.c,
                                found.by_pressure, found.bound, found.by_slip,
                                nodes.tangential_ratio},
                               nodes.area, nodes.status, nodes.mobile,
                               {nodes.value, nodes.by_multiplier, nodes.by_gap,
                                nodes.by_slip, nodes.by_normal});
  }
  if (nodes.mean)
    nodes.mean->chain(nodes.normal, nodes.by_slip, nodes.by_normal);
}

std::int32_t Tied::set_status(NodeState& nodes, mesh::Ranks&) const
{
  check_multipliers(*this, nodes);
  std::int32_t changed = 0;
  for (std::size_t i = 0; i < nodes.status.size(); ++i)
  {
    const std::int8_t now
        = std::isnan(nodes.gap[i]) or nodes.redundant[i] ? open : stick;
    changed += now != nodes.status[i];
    nodes.status[i] = now;
  }
  return changed;
}

void Tied::evaluate(NodeState& nodes) const
{
  check_multipliers(*this, nodes);
  const std::size_t gdim = nodes.gdim();
  for (auto* derivative :
       {&nodes.by_multiplier, &nodes.by_gap, &nodes.by_slip, &nodes.by_normal})
    std::ranges::fill(*derivative, 0.0);
  for (std::size_t i = 0; i < nodes.status.size(); ++i)
    for (std::size_t k = 0; k < gdim; ++k)
    {
      const std::size_t at = gdim * i + k, diagonal = gdim * at + k;
      if (nodes.closed(i) and nodes.mobile[at] > 0)
      {
        nodes.by_slip[diagonal] = nodes.area[i] * nodes.c[i];
        nodes.value[at] = nodes.by_slip[diagonal] * nodes.slip[at];
      }
      else
      {
        nodes.by_multiplier[diagonal] = nodes.area[i];
        nodes.value[at] = nodes.area[i] * nodes.multiplier[at];
      }
    }
}
