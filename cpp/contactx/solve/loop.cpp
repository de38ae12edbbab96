// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#include "loop.h"
#include "../mesh/deformed_cells.h"
#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <utility>

using namespace contactx;
using namespace contactx::solve;

namespace
{
/// Rotation of a free body, radians: linear strains take it for a stretch by
/// 1e-4
constexpr double rotation_max = 0.014;

/// Penetration after bodies have moved, over that before, from which on rigid
/// ones go no farther
constexpr double room_ratio = 0.5;

std::vector<std::shared_ptr<FreeBodyContact>>
holdings(const System::Contacts& contacts)
{
  std::vector<std::shared_ptr<FreeBodyContact>> held;
  for (const auto& c : contacts)
    held.push_back(solve::free_body_contact(c));
  return held;
}
} // namespace

Loop::Loop(std::shared_ptr<System> system,
           std::shared_ptr<const mesh::Bodies> bodies)
    : _system(std::move(system)), _convergence(_system),
      _bodies(std::make_shared<FreeBodies>(
          std::move(bodies), _system->bulk(), holdings(_system->contacts()),
          _system->halo()->original().first(_system->halo()->num_owned()))),
      _active_set(_system->halo(), _system->contacts(), _bodies),
      _path(_system),
      _forces{[this] { return _system->forces(); },
              [this]
              {
                const auto b = _system->bulk_residual();
                return std::vector<double>(b.begin(), b.end());
              },
              [this] { return _convergence.scale_of_balance(); }}
{
}

bool Loop::begin_step(bool damped)
{
  _system->begin_step();
  _active_set.begin_step();
  _path.begin_step(damped);
  _stays = false;
  _length.begin_step(damped, _convergence.scales().length);
  const std::span<const double> u = _system->bulk()->displacements();
  _start.assign(u.begin(), u.end());
  _last.reset();
  _ahead.clear();
  _balance.begin_step();
  _has_stepped = false;
  _iterate = {};
  ++_version;
  if (not std::isfinite(_convergence.scale()))
    return false;
  std::vector<double> stiffness = this->stiffness();
  set_factors(stiffness);
  _convergence.begin_step(std::move(stiffness));
  _bodies->begin_step();
  return true;
}

/// Stiffness of each owned node: the mean of its free diagonal entries, zero
/// where all are prescribed.
std::vector<double> Loop::stiffness()
{
  Bulk& bulk = *_system->bulk();
  const int g = _system->halo()->gdim();
  const std::span<const double> diagonal = bulk.diagonal();
  const std::span<const std::int8_t> markers = bulk.markers();
  std::vector<double> stiffness(_system->halo()->num_owned());
  for (std::size_t i = 0; i < stiffness.size(); ++i)
  {
    int free = 0;
    for (int k = 0; k < g; ++k)
      if (markers[g * i + k] == 0)
      {
        stiffness[i] += std::abs(diagonal[g * i + k]);
        ++free;
      }
    if (free > 0)
      stiffness[i] /= free;
  }
  return stiffness;
}

/// Sets the factor c of each contact's complementarity.
void Loop::set_factors(std::span<const double> stiffness)
{
  std::vector<double> compliance(_system->halo()->num_nodes());
  for (std::size_t i = 0; i < stiffness.size(); ++i)
    if (stiffness[i] > 0)
      compliance[i] = 1 / stiffness[i];
  _system->halo()->forward(std::span(compliance), 1);
  for (const auto& c : _system->contacts())
    c->set_factor(compliance);
  _system->take_factors();
}

/// Moves free bodies that carry no force out of what penetrates them before the
/// first iterate, as far as rigid ones go: nothing resists them, so that no
/// linear system tells where.
void Loop::make_room()
{
  _has_made_room = false;
  if (not _bodies->any_free())
    return;
  double depth = std::numeric_limits<double>::infinity();
  std::vector<double> before;
  for (int moves = 0;; ++moves)
  {
    _active_set.pair();
    const auto found = _bodies->escape(_forces, moves == 0);
    if (not found)
    {
      _has_made_room = moves > 0;
      return;
    }
    const std::span<const double> now = _system->bulk()->displacements();
    if (not(found->depth < room_ratio * depth))
    {
      // What is packed deforms from where it is
      _system->bulk()->set_displacements(before);
      _has_made_room = moves > 1;
      return;
    }
    depth = found->depth;
    before.assign(now.begin(), now.end());
    std::vector<double> u = before;
    for (std::size_t i = 0; i < u.size(); ++i)
      u[i] += found->increment[i];
    _system->bulk()->set_displacements(u);
  }
}

void Loop::settle_first()
{
  make_room();
  update_active_set(true);
  // For callers that ask for the Jacobian before the residual: freezing the
  // kinematics has changed the pairs
  _system->evaluate();
  _is_homogeneous = find_homogeneous();
}

bool Loop::find_homogeneous()
{
  const auto& contacts = _system->contacts();
  const auto scales = [](const auto& c)
  { return not c->updates_kinematics() and not c->law()->may_throw(); };
  if (not _system->bulk()->is_linear() or _system->bulk()->fields()
      or not std::ranges::all_of(contacts, scales))
    return false;
  const bool moved
      = std::ranges::any_of(_start, [](double u) { return u != 0; });
  if (mesh::anywhere(_system->halo()->ranks(), moved))
    return false;
  return std::ranges::all_of(contacts, [](const auto& c)
                             { return c->is_without_gaps(); });
}

bool Loop::is_curved() const
{
  return not _system->bulk()->is_linear()
         or std::ranges::any_of(_system->contacts(), [](const auto& contact)
                                { return contact->updates_kinematics(); });
}

/// Sets Dirichlet values among unknowns, takes them, and gives the norm of the
/// residual, infinite where it is not finite.
double Loop::residual_at(std::vector<double>& x)
{
  _system->take(x);
  const std::span<const double> defect = _system->bulk()->defect();
  for (std::size_t i = 0; i < defect.size(); ++i)
    x[i] -= defect[i];
  _system->take(x);
  std::vector<double> b(_system->size());
  _system->residual(b);
  double sum = 0;
  for (const double force : b)
    sum += force * force;
  sum = mesh::total(_system->halo()->ranks(), sum);
  return std::isfinite(sum) ? std::sqrt(sum)
                            : std::numeric_limits<double>::infinity();
}

void Loop::predict(std::span<const double> increment)
{
  // By surface-to-surface an extrapolation may pass a corner of the other body,
  // where that method has more than one answer
  const bool may_pass
      = std::ranges::any_of(_system->contacts(),
                            [](const auto& contact)
                            {
                              return contact->master()->integrates()
                                     and not contact->master()->is_rigid();
                            });
  if (not is_curved() or may_pass or _has_made_room)
    return;
  std::vector<double> start(_system->size());
  _system->unknowns(start);
  std::vector<double> held = start, way = start, there = start;
  const std::size_t n = _system->num_bulk();
  for (std::size_t i = 0; i < there.size(); ++i)
    there[i] += increment[i] / (i < n ? 1 : _system->factors()[i - n]);
  const double before = residual_at(held), after = residual_at(there);
  _system->take(start);
  for (std::size_t i = 0; i < way.size(); ++i)
    way[i] -= there[i];
  if (not(after < before) or within_cells(way) < 1)
    return;
  _system->take(there);
  _has_stepped = true;
  _path.take_start();
  update_active_set(false);
  // As in settle_first
  _system->evaluate();
}

void Loop::update_active_set(bool is_first)
{
  _active_set.update(_forces, is_first);
  ++_version;
}

Verdict Loop::judge(bool is_start, double rtol, double atol,
                    std::span<double> b)
{
  const bool is_same = std::exchange(_stays, false);
  if (is_same and (not compare(rtol, atol, b) or _path.is_on()))
    return Verdict::goes_on;
  if (_path.is_on())
  {
    if (const Verdict verdict = judge_path(rtol, atol, b);
        verdict != Verdict::solution)
      return verdict;
  }
  else if (not is_start and not is_same)
  {
    if (not _has_stepped)
      look_ahead();
    _has_stepped = true;
    take_back();
    take_off_drift();
    update_active_set(false);
    const std::int64_t changes = _active_set.changes().status,
                       closed = _active_set.num_closed();
    if (_path.is_trial() and _path.is_refused(changes, closed))
    {
      _path.resume();
      return judge_path(rtol, atol, b);
    }
    if (not _path.is_trial() and not _bodies->held()
        and _path.begins(_active_set.changes(), closed, max_increment()))
    {
      _path.start();
      return judge_path(rtol, atol, b);
    }
  }
  bool is_small = compare(rtol, atol, b);
  while (is_small)
  {
    const auto end = _active_set.may_end(_forces);
    if (end == ActiveSet::End::solution and _bodies->let_go())
      update_active_set(false);
    else if (end == ActiveSet::End::solution)
      break;
    if (end == ActiveSet::End::frozen_pair_penetrates)
      return Verdict::frozen_pair_penetrates;
    ++_version;
    is_small = compare(rtol, atol, b);
  }
  _active_set.note(_iterate.residual);
  _length.note(_iterate.changes.status > 0 or _iterate.changes.pairs > 0);
  _last.emplace(_system->size());
  _system->unknowns(*_last);
  const bool is_unbalanced
      = _balance.note(_bodies->is_unbalanced(), _iterate.changes.status);
  if (not std::isfinite(_iterate.residual))
    return Verdict::not_finite;
  if (is_small)
  {
    if (_bodies->free_modes() == 0)
      return Verdict::solution;
    if (max_increment() > _convergence.farthest())
      return Verdict::unbounded_motion;
    return _bodies->turned() > rotation_max ? Verdict::large_rotation
                                            : Verdict::solution;
  }
  if (_length.is_stuck())
    return Verdict::stuck;
  return is_unbalanced ? Verdict::unbalanced : Verdict::goes_on;
}

/// Brings an interior point up to the iterate, and decides whether it ends.
Verdict Loop::judge_path(double rtol, double atol, std::span<double> b)
{
  _path.take();
  bool leads_on = not _path.is_stuck();
  double residual = 0;
  do
  {
    if (not leads_on)
    {
      _path.give_up();
      ++_version;
      update_active_set(false);
      if (compare(rtol, atol, b))
        return Verdict::solution;
      // Where nothing can balance a body neither will, unless iterates have
      // thrown it off
      const bool is_held = _bodies->may_balance(_forces, _path.reach());
      if (not _path.begins_again())
        return Verdict::goes_on;
      if (not is_held)
      {
        _active_set.pair();
        compare(rtol, atol, b);
        if (not _bodies->may_balance(_forces, _path.reach()))
          return Verdict::unbalanced;
      }
    }
    _active_set.pair();
    _path.predict();
    ++_version;
    compare(rtol, atol, b);
    double sum = 0;
    const auto markers = _system->bulk()->markers();
    for (std::size_t i = 0; i < _system->num_displacements(); ++i)
      if (markers[i] != 1)
        sum += b[i] * b[i];
    residual = std::sqrt(mesh::total(_system->halo()->ranks(), sum));
    leads_on = std::isfinite(residual);
  } while (not leads_on);
  if (not _path.may_end(residual / _convergence.scale()))
    return Verdict::goes_on;
  _path.leave();
  ++_version;
  return compare(rtol, atol, b) ? Verdict::solution : Verdict::goes_on;
}

bool Loop::corrects(std::span<const double> dx)
{
  if (not _path.is_predictor())
    return false;
  _path.correct(dx);
  return true;
}

double Loop::limit(std::span<const double> dx, const Correction& correction)
{
  if (corrects(dx))
  {
    _stays = true;
    return 0;
  }
  if (_path.is_on())
  {
    const double part = _path.limit(dx);
    std::vector<double> step(dx.begin(), dx.end());
    for (double& d : step)
      d *= part;
    const double within = within_cells(step);
    _path.shorten(within);
    return part * within;
  }
  if (_bodies->runs_along(dx))
  {
    _bodies->hold();
    ++_version;
    _stays = true;
    return 0;
  }
  _path.note(dx);
  foresee(dx);
  const double size = size_of(dx);
  _length.begin(size, std::isfinite(size) ? within_cells(dx) : 1);
  while (correction and _length.has_trial())
    _length.judge(correction(_length.part()));
  return _length.part();
}

/// Remembers a Newton step in full, before a part of it is taken.
///
/// Slip of nodes that touch within a load step is measured from where they do
/// along its first Newton step, however much of that is taken: else the
/// solution would depend on what shortens it. Only that one counts.
void Loop::foresee(std::span<const double> dx)
{
  if (_has_stepped or not _bodies->has_friction())
    return;
  _ahead.resize(_system->size());
  _system->unknowns(_ahead);
  for (std::size_t i = 0; i < _ahead.size(); ++i)
    _ahead[i] -= dx[i];
}

/// Measures slip from where nodes touch along the first Newton step, if
/// only a part of it was taken.
void Loop::look_ahead()
{
  std::vector<double> x(_system->size());
  _system->unknowns(x);
  mesh::Ranks& ranks = _system->halo()->ranks();
  const bool is_known = std::ranges::all_of(_ahead, [](double value)
                                            { return std::isfinite(value); });
  if (not mesh::anywhere(ranks, not _ahead.empty() and x != _ahead)
      or mesh::anywhere(ranks, not is_known))
    return;
  _system->take(_ahead);
  _active_set.foresee();
  _system->take(x);
}

/// Takes back a part of the last step, if the active set cycles.
void Loop::take_back()
{
  if (not _last or not _active_set.shortens())
    return;
  std::vector<double> x(_system->size());
  _system->unknowns(x);
  for (std::size_t i = 0; i < x.size(); ++i)
    x[i] = std::lerp((*_last)[i], x[i], CycleGuard::step_fraction);
  _system->take(x);
}

/// Takes off what free bodies have drifted in a step of linear contact
/// conditions: with current kinematics pressures resist such motions by a
/// little, and steps seek the place where they balance.
void Loop::take_off_drift()
{
  if (not _active_set.is_linear())
    return;
  const auto drift = _bodies->drift();
  if (not drift)
    return;
  const std::span<const double> now = _system->bulk()->displacements();
  std::vector<double> u(now.begin(), now.end());
  for (std::size_t i = 0; i < u.size(); ++i)
    u[i] -= (*drift)[i];
  _system->bulk()->set_displacements(u);
}

/// Evaluates the residual of an iterate, and whether it is small enough.
bool Loop::compare(double rtol, double atol, std::span<double> b)
{
  _system->hold(_bodies->held());
  _system->residual(b);
  const auto found = _convergence.compare(b, rtol, atol);
  _iterate = {
      found.residual,         found.tolerance,          found.forces,
      found.defect,           _active_set.num_closed(), _active_set.changes(),
      _active_set.is_frozen()};
  double size = 0;
  for (const double u : _system->bulk()->displacements())
    size = std::max(size, std::abs(u));
  size = mesh::largest(_system->halo()->ranks(), size);
  return found.residual <= found.tolerance
         and found.defect <= math::solved_length_tol * size;
}

double Loop::within_cells(std::span<const double> dx) const
{
  Bulk& bulk = *_system->bulk();
  if (bulk.is_linear())
    return 1;
  const mesh::Halo& halo = *_system->halo();
  const std::vector<double> way = _system->movement(dx);
  const double part = mesh::max_step_without_inversion(
      bulk.cells(), bulk.nodes_per_cell(), halo.reference(), halo.now()->u, way,
      halo.gdim(), StepLength::det_fraction_min);
  return mesh::least(halo.ranks(), part);
}

double Loop::size_of(std::span<const double> dx) const
{
  double sum = 0;
  for (std::size_t i = 0; i < _system->num_displacements(); ++i)
    sum += dx[i] * dx[i];
  return std::sqrt(mesh::total(_system->halo()->ranks(), sum));
}

double Loop::max_increment()
{
  const std::span<const double> u = _system->bulk()->displacements();
  double most = 0;
  for (std::size_t i = 0; i < u.size(); ++i)
    most = std::max(most, std::abs(u[i] - _start[i]));
  return mesh::largest(_system->halo()->ranks(), most);
}

double Loop::changing() const
{
  const auto changes = _iterate.changes.status + _iterate.changes.pairs;
  return static_cast<double>(changes)
         / static_cast<double>(std::max<std::int64_t>(1, _iterate.closed));
}
