// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#include "time_step.h"
#include "../check.h"
#include "../text.h"
#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>

using namespace contactx;
using namespace contactx::problem;

namespace
{
/// The system, which must be there.
std::shared_ptr<solve::System> given(std::shared_ptr<solve::System> system)
{
  check::require(system != nullptr, "system must not be empty");
  return system;
}
} // namespace

TimeStep::TimeStep(std::shared_ptr<solve::System> system,
                   std::vector<std::shared_ptr<results::Results>> results,
                   std::shared_ptr<Inertia> inertia,
                   std::optional<double> impact_travel)
    : _system(given(std::move(system))), _halo(_system->halo()),
      _results(std::move(results)), _inertia(std::move(inertia)),
      _impact_travel(impact_travel), _impact(_halo, _system->contacts())
{
  check::require(_inertia != nullptr, "inertia must not be empty");
  check::require(_results.size() == _system->contacts().size()
                     and std::ranges::all_of(_results, [](const auto& r)
                                             { return r != nullptr; }),
                 "there must be results of each contact");
  if (_impact_travel and not(*_impact_travel > 0))
    throw std::invalid_argument("impact_travel is "
                                + number_text(*_impact_travel, 6)
                                + ": give a number above 0, or none");
  const std::size_t size = _inertia->diagonal().size();
  _halo->ranks().agree(
      [&]
      {
        check::rows(size, _halo->num_owned(), _halo->gdim(), "masses",
                    "owned node");
      });
  check_masses(*_inertia, _halo->ranks());
}

void TimeStep::begin(double dt, std::span<const double> velocity)
{
  _dt = 0;
  if (not(std::isfinite(dt) and dt > 0))
    throw std::invalid_argument("dt is " + number_text(dt, 6)
                                + ": give a finite time above 0");
  check(velocity);
  _halo->ranks().agree(
      [&]
      {
        check::require(std::ranges::all_of(velocity, [](double v)
                                           { return std::isfinite(v); }),
                       "velocity is not finite: set it to finite values");
      });
  const std::span<const double> u = _system->bulk()->displacements();
  _start.assign(u.begin(), u.end());
  _before.assign(velocity.begin(), velocity.end());
  _impact.begin_step();
  _dt = dt;
}

std::string TimeStep::end()
{
  if (_dt == 0)
    throw std::logic_error("end of a time step that has not begun: call begin "
                           "before the problem is solved");
  solve::Bulk& bulk = *_system->bulk();
  const std::span<const double> u = bulk.displacements();
  const std::size_t n = _start.size();
  std::vector<double> increment(n);
  for (std::size_t i = 0; i < n; ++i)
    increment[i] = u[i] - _start[i];
  if (std::string reason = refusal(increment); not reason.empty())
    return reason;
  constrain();

  std::vector<double> v(n);
  for (std::size_t i = 0; i < n; ++i)
    v[i] = 2 * increment[i] / _dt - _before[i];
  const double free = kinetic_energy(v);
  // Twice the mean of a step less its start oscillates where motion is
  // prescribed
  for (std::size_t i = 0; i < n; ++i)
    if ((*_markers)[i])
      v[i] = increment[i] / _dt;
  const double moved = kinetic_energy(v);
  _impact.correct(_dt, v,
                  [this](std::span<double> values) { solve_mass(values); });
  const double kinetic = kinetic_energy(v);

  const std::vector<double> contact = contact_forces();
  const std::span<const double> inner = _system->bulk_residual();
  double supports = 0;
  for (std::size_t i = 0; i < n; ++i)
    if ((*_markers)[i])
      supports += (inner[i] + contact[i]) * increment[i];
  supports = mesh::total(_halo->ranks(), supports);
  const std::span<const double> loads = _inertia->loads();

  _balance = {.dt = _dt,
              .kinetic = kinetic,
              .strain = strain_energy(),
              .momentum = momentum(v),
              .angular_momentum = angular_momentum(v),
              .work_of_loads = loads.empty() ? 0 : product(loads, increment),
              .work_of_supports = supports + moved - free,
              .contact_loss = moved - kinetic + product(contact, increment),
              .impulse = {}};
  const std::size_t g = _halo->gdim();
  for (const std::vector<double>& nodal : _impact.corrections())
  {
    std::vector<double> impulse(g, 0);
    for (std::size_t i = 0; i < nodal.size(); ++i)
      impulse[i % g] += nodal[i];
    _balance.impulse.push_back(sum(std::move(impulse)));
  }
  _velocity = std::move(v);
  _dt = 0;
  return {};
}

Balance TimeStep::balance() const
{
  Balance balance = _balance;
  for (std::size_t c = 0; c < balance.impulse.size(); ++c)
    for (std::size_t k = 0; k < balance.impulse[c].size(); ++k)
      balance.impulse[c][k] += balance.dt * _results[c]->force()[k];
  return balance;
}

double TimeStep::kinetic_energy(std::span<const double> velocity)
{
  check(velocity);
  return 0.5 * product(velocity, _inertia->product(velocity));
}

std::vector<double> TimeStep::momentum(std::span<const double> velocity)
{
  check(velocity);
  const std::span<const double> p = _inertia->product(velocity);
  const std::size_t g = _halo->gdim();
  std::vector<double> total(g, 0);
  for (std::size_t i = 0; i < p.size(); ++i)
    total[i % g] += p[i];
  return sum(std::move(total));
}

std::vector<double> TimeStep::angular_momentum(std::span<const double> velocity)
{
  check(velocity);
  const std::span<const double> p = _inertia->product(velocity);
  const std::span<const double> X = _halo->reference(),
                                u = _system->bulk()->displacements();
  const std::size_t g = _halo->gdim();
  std::vector<double> total(g == 2 ? 1 : 3, 0);
  for (std::size_t i = 0; i < p.size(); i += g)
  {
    Vector<3> x{}, q{};
    for (std::size_t k = 0; k < g; ++k)
    {
      x[k] = X[i + k] + u[i + k];
      q[k] = p[i + k];
    }
    const Vector<3> moment = cross(x, q);
    if (g == 2)
      total[0] += moment[2];
    else
      for (int k = 0; k < 3; ++k)
        total[k] += moment[k];
  }
  return sum(std::move(total));
}

std::optional<double> TimeStep::strain_energy()
{
  const std::optional<double> mine = _inertia->strain_energy();
  if (not mine)
    return std::nullopt;
  return mesh::total(_halo->ranks(), *mine);
}

/// Why a step is refused in which a node has come too far before it touched.
std::string TimeStep::refusal(std::span<const double> increment) const
{
  if (not _impact_travel)
    return {};
  const double travel
      = _impact.arrival(increment, _system->bulk()->cell_sizes());
  if (not(travel > *_impact_travel))
    return {};
  return "a node moved by " + number_text(travel, 2)
         + " of a cell to what it hits, further than impact_travel = "
         + number_text(*_impact_travel, 6)
         + ": take shorter steps (manual: errors/impact-travel)";
}

/// Takes which dofs are prescribed, as supports may have changed.
void TimeStep::constrain()
{
  const std::span<const std::int8_t> now = _system->bulk()->markers();
  const bool same = _markers and std::ranges::equal(*_markers, now);
  if (mesh::everywhere(_halo->ranks(), same))
    return;
  _markers.emplace(now.begin(), now.end());
  if (not _inertia->is_lumped())
    _inertia->constrain(now);
}

void TimeStep::solve_mass(std::span<double> values)
{
  if (not _inertia->is_lumped())
  {
    _inertia->solve(values);
    return;
  }
  const std::span<const double> mass = _inertia->diagonal();
  for (std::size_t i = 0; i < values.size(); ++i)
    values[i] *= (*_markers)[i] ? 0 : 1 / mass[i];
}

/// What contacts add to the residual of the owned nodes.
std::vector<double> TimeStep::contact_forces() const
{
  std::vector<double> forces(std::size_t(_halo->num_nodes()) * _halo->gdim());
  for (const auto& contact : _system->contacts())
    contact->add_residual(forces);
  _halo->reverse(forces, _halo->gdim());
  forces.resize(_system->num_displacements());
  return forces;
}

/// Product of two vectors of all ranks.
double TimeStep::product(std::span<const double> a,
                         std::span<const double> b) const
{
  double value = 0;
  for (std::size_t i = 0; i < a.size(); ++i)
    value += a[i] * b[i];
  return mesh::total(_halo->ranks(), value);
}

void TimeStep::check(std::span<const double> velocity) const
{
  _halo->ranks().agree(
      [&]
      {
        check::rows(velocity.size(), _halo->num_owned(), _halo->gdim(),
                    "velocity", "owned node");
      });
}

/// Sums over the ranks.
std::vector<double> TimeStep::sum(std::vector<double> values) const
{
  if (_halo->ranks().size() > 1)
    _halo->ranks().reduce(std::span(values), mesh::Reduction::sum);
  return values;
}

void problem::attach(Problem& problem, std::shared_ptr<TimeStep> step)
{
  problem.allow_flight();
  problem.before_accept([step = std::move(step)] { return step->end(); });
}
