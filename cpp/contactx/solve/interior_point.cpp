// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#include "interior_point.h"
#include "../law/cone.h"
#include "../mesh/extent.h"
#include "step_length.h"
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

using namespace contactx;
using namespace contactx::solve;
using contactx::law::ConeVector;
using contactx::law::Interior;

namespace
{
using Map = Eigen::Map<const Eigen::VectorXd>;
using MutableMap = Eigen::Map<Eigen::VectorXd>;
using Tangent = Eigen::VectorXd;

/// Part of the way to the boundary of the cones that a step takes
constexpr double boundary_fraction = 0.99;
/// Gap scale from the movement of a step's first solves, over that; at most the
/// scene's extent
constexpr double movement_fraction = 0.3;
/// Gap of closed nodes, over the scale of gaps, from which on the work to close
/// them tells the scale of pressures
constexpr double told_gap = 1e-3;
/// Pressures and tractions at the start, over the scale and the bound
constexpr double traction_fraction = 0.5;
/// Power of the affine step's success that the corrector aims at: Mehrotra's
/// rule
constexpr double centring_power = 3;
/// Difference of a node's indicators, from -1 to 1 at a solution, below which
/// it is in doubt
constexpr double doubtful_difference = 0.6;
/// Nodes in doubt, or that open and close, over the closed ones, and number of
/// the latter, at which an active set may be that of the solution. Slender
/// bodies, spheres and slabs take the same iterations from 0.02 to 0.05
constexpr double few_fraction = 0.02, few_nodes = 4;
/// Iterates that a path takes, about. An active set is left for it where it has
/// more to go
constexpr int path_cost = 12;
/// Closed nodes, over these, that an active set tells apart as soon
constexpr int nodes_per_iterate = 3;
/// Residual over the forces, and gaps that are not the slacks, over their
/// scale, at which an exact active set may be tried
constexpr double trial_residual = 1e-2, trial_defect = 0.1;
/// Mean product of pairs, over the product of their means, at which one is
/// tried in any case, and then again
constexpr double trial_level = 1e-6, trial_level_ratio = 1e-3;
/// Way of the active set's iterate since the step's start over the shortest one
/// before it, and forces there that nothing holds over those at the start, from
/// which on the path begins elsewhere: bodies have run away
constexpr double escape_ratio = 1e2;
/// Iterates without progress, and iterates, after which the path is given up
constexpr int max_poor_iterates = 4, max_iterations = 40;

/// Turns a vector of the tangential plane of one normal into that of another
Tangent transported(const Tangent& t, const Tangent& from, const Tangent& to)
{
  const double c = 1 + from.dot(to);
  if (not(c > 0.1))
    return Tangent::Zero(t.size());
  return t - to.dot(t) / c * (from + to);
}

/// A scalar and the vector of a node.
ConeVector joined(double scalar, const std::vector<double>& vectors,
                  std::size_t i, int g)
{
  ConeVector v(1 + g);
  v << scalar, Map(&vectors[g * i], g);
  return v;
}

/// How far slave nodes move past their masters: along the normal where there is
/// no friction, else any way.
std::vector<double> passed(const contact::Contact& contact,
                           std::span<const double> u)
{
  const kernel::Weights weights = contact.master()->weights();
  const std::vector<double> normals = contact.master()->normals();
  const int g = contact.nodes()->gdim();
  std::vector<Eigen::Vector3d> sums(contact.nodes()->status.size(),
                                    Eigen::Vector3d::Zero());
  for (std::size_t e = 0; e < weights.values.size(); ++e)
    sums[weights.slaves[e]].head(g)
        += weights.values[e] * Map(&u[g * weights.nodes[e]], g);
  std::vector<double> lengths(sums.size());
  for (std::size_t i = 0; i < sums.size(); ++i)
    lengths[i] = contact.nodes()->is_vector()
                     ? sums[i].norm()
                     : std::abs(sums[i].dot(Map(&normals[3 * i], 3)));
  return lengths;
}

/// Changes of (b, t) and of (gamma, w) of a node by a step.
template <class Step>
std::pair<ConeVector, ConeVector> of_cones(const Interior& in, const Step& step,
                                           std::size_t i)
{
  return {
      joined(in.by_pressure[i] * step.pressure[i], step.traction, i, in.gdim),
      joined(step.slip_length[i], step.slip, i, in.gdim)};
}
} // namespace

InteriorPoint::InteriorPoint(std::shared_ptr<System> system)
    : _system(std::move(system)),
      _extent(std::ranges::max(mesh::extent(
          ranks(),
          _system->halo()->reference().first(_system->num_displacements()),
          _system->halo()->gdim())))
{
}

void InteriorPoint::begin_step(bool is_barred)
{
  _most_closed = 0;
  _count = _iterations = _trial = _poor = 0;
  _passed = {};
  _is_barred = is_barred;
  _gap_scale = _pressure_scale = _last_way = 0;
  _shortest_way = std::numeric_limits<double>::max();
  _start.resize(_system->size());
  _system->unknowns(_start);
  drop();
}

void InteriorPoint::drop()
{
  _is_on = _is_trial = _is_predictor = false;
  for (const auto& c : _system->contacts())
    c->nodes()->interior.reset();
}

/// Means of pressures, of slacks and of their products over the area.
std::array<double, 3> InteriorPoint::means() const
{
  std::array<double, 4> sums{};
  for (const auto& c : _system->contacts())
  {
    const auto& in = c->nodes()->interior;
    if (not in)
      continue;
    for (std::size_t i = 0; i < in->is_on.size(); ++i)
    {
      if (not in->is_on[i])
        continue;
      const double area = c->nodes()->area[i];
      double product = in->pressure[i] * in->slack[i];
      if (in->has_friction[i])
        product = 0.5 * product
                  + 0.25
                        * law::bound_and_traction(*in, i).dot(
                            law::slip_slacks(*in, i));
      sums[0] += area * in->pressure[i];
      sums[1] += area * in->slack[i];
      sums[2] += area * product;
      sums[3] += area;
    }
  }
  ranks().reduce(std::span<double>(sums), mesh::Reduction::sum);
  return {sums[0] / sums[3], sums[1] / sums[3], sums[2] / sums[3]};
}

void InteriorPoint::note(std::span<const double> dx)
{
  if (_is_on or _is_trial or _is_barred or _count > 1)
    return;
  const std::vector<double> u = _system->movement(dx);
  std::array<double, 4> sums{};
  double farthest = 0;
  std::size_t at = _system->num_bulk();
  for (const auto& c : _system->contacts())
  {
    const law::NodeState& nodes = *c->nodes();
    const int size = nodes.size();
    const std::vector<double> change = passed(*c, u);
    for (std::size_t i = 0; i < nodes.status.size(); ++i, at += size)
    {
      farthest = std::max(farthest, change[i]);
      if (not nodes.closed(i) or c->law()->is_tied())
        continue;
      double dp = 0;
      for (int k = 0; k < size; ++k)
        dp -= dx[at + k] * _system->factors()[at + k - _system->num_bulk()]
              * (size > 1 ? nodes.normal[size * i + k] : 1);
      const double A = nodes.area[i], g = nodes.gap[i];
      sums[0] += A * dp * g;
      sums[1] += A * g * g;
      sums[2] += A;
      sums[3] += A * nodes.pressure(i);
    }
  }
  ranks().reduce(std::span<double>(sums), mesh::Reduction::sum);
  farthest = mesh::largest(ranks(), farthest);
  if (not(sums[2] > 0))
    return;
  const double g = std::sqrt(sums[1] / sums[2]),
               d = std::min(movement_fraction * farthest, _extent);
  _gap_scale = std::max({g, d, _gap_scale});
  // Nodes that have been closed tell nothing of what closing takes
  if (g > told_gap * _gap_scale)
    _pressure_scale = std::abs(sums[0]) / sums[2] / std::max(g, d);
  else if (not(_pressure_scale > 0))
    _pressure_scale = std::abs(sums[3]) / sums[2];
}

/// Norm of the bulk's forces that nothing holds.
double InteriorPoint::unbalanced() const
{
  const std::span<const double> force = _system->bulk()->residual();
  const std::span<const std::int8_t> markers = _system->bulk()->markers();
  double sum = 0;
  for (std::size_t i = 0; i < force.size(); ++i)
    if (markers[i] == 0)
      sum += force[i] * force[i];
  return std::sqrt(mesh::total(ranks(), sum));
}

/// Norm of the areas of the slave nodes.
double InteriorPoint::area() const
{
  double sum = 0;
  for (const auto& c : _system->contacts())
    for (const double A : c->nodes()->area)
      sum += A * A;
  return std::sqrt(mesh::total(ranks(), sum));
}

bool InteriorPoint::has_run_away() const
{
  return _last_way > escape_ratio * _shortest_way;
}

double InteriorPoint::reach() const
{
  return has_run_away() ? escape_ratio * _shortest_way : infinity;
}

bool InteriorPoint::begins(const Changes& changes, std::int64_t closed,
                           double way)
{
  ++_count;
  _most_closed = std::max(_most_closed, closed);
  const auto now = static_cast<double>(changes.contact);
  // The most nodes of three iterates before
  const auto most = std::ranges::max_element(_passed);
  const auto ago = static_cast<double>(*most),
             last = static_cast<double>(_passed[0]);
  const auto apart = 1 + std::distance(_passed.begin(), most);
  _passed = {changes.contact, _passed[0], _passed[1]};
  if (_is_barred)
    return false;
  _last_way = way;
  _shortest_way = std::min(_shortest_way, way);
  if (_count == 1)
    return false;
  if (_count > path_cost or has_run_away())
    return changes.status > 0;
  if (_most_closed <= nodes_per_iterate * path_cost)
    return false;
  // Where one iterate alone changes many, a few follow
  if (std::min(now, last)
      <= std::max(few_nodes, few_fraction * static_cast<double>(closed)))
    return false;
  // Iterates that are still to go, if fewer and fewer nodes pass as they do now
  const double rate = std::log(now / ago) / static_cast<double>(apart);
  return rate >= 0 or std::log(now) > -path_cost * rate;
}

void InteriorPoint::start()
{
  // Nothing is to be had from where bodies have run away to
  _before = _start;
  if (not has_run_away())
    _system->unknowns(_before);
  _status.clear();
  for (const auto& c : _system->contacts())
    _status.push_back(c->nodes()->status);
  _is_second = false;
  begin();
}

bool InteriorPoint::begins_again()
{
  if (_is_second)
    return false;
  _is_second = true;
  begin();
  return true;
}

/// Begins from the displacements of the active set's iterate, which have come
/// far, or where they are far off, and the second time, from those of the
/// step's start. Multipliers of a set that is far off may have any size.
void InteriorPoint::begin()
{
  _is_on = true;
  _is_trial = false;
  _iterations = _poor = 0;
  _tried = -1;
  _steps.clear();
  std::vector<double> from = _start;
  std::copy_n(_before.begin(), _system->num_bulk(), from.begin());
  _system->take(_start);
  const double here = unbalanced() + _pressure_scale * area();
  _system->take(from);
  if (_is_second or unbalanced() > escape_ratio * here)
    _system->take(_start);
  _shown.clear();
  _part = few_fraction;
  _level = trial_level;
}

/// Puts new nodes on the path, takes off those that have lost their master, and
/// turns tractions with their normals.
void InteriorPoint::place()
{
  const bool is_first = _iterations == 0;
  for (const auto& c : _system->contacts())
  {
    law::NodeState& nodes = *c->nodes();
    if (c->law()->is_tied())
      continue;
    if (not nodes.interior)
      nodes.interior.emplace(nodes);
    Interior& in = *nodes.interior;
    const int g = nodes.gdim(), size = nodes.size();
    std::ranges::fill(nodes.redundant, 0);
    std::ranges::fill(nodes.frictionless, 0);
    for (std::size_t i = 0; i < in.is_on.size(); ++i)
    {
      const bool is_on = not std::isnan(nodes.gap[i]) and not nodes.immobile[i];
      double* lambda = &nodes.multiplier[size * i];
      if (not is_on)
      {
        in.is_on[i] = 0;
        nodes.status[i] = law::open;
        std::fill_n(lambda, size, 0.0);
        continue;
      }
      const bool is_new = not in.is_on[i];
      if (is_new)
      {
        in.is_on[i] = 1;
        in.slack[i] = std::max(nodes.gap[i], _gap_scale);
        const double product
            = is_first ? _gap_scale * _pressure_scale : _product;
        in.pressure[i] = is_first and not _is_second ? _pressure_scale
                                                     : product / in.slack[i];
      }
      if (nodes.is_vector())
      {
        const Tangent n = Map(&nodes.normal[g * i], g);
        MutableMap t(&in.traction[g * i], g), w(&in.slip[g * i], g);
        if (is_new)
        {
          t = Map(lambda, g);
          t -= n.dot(t) * n;
          w.setZero();
          if (not is_first)
            t.setZero();
        }
        else
        {
          const Tangent from = Map(&in.normal[g * i], g);
          t = transported(t, from, n);
          w = transported(w, from, n);
        }
        MutableMap(&in.normal[g * i], g) = n;
      }
      nodes.status[i] = nodes.is_vector() ? law::stick : law::slip;
    }
    const auto bound = [&] { c->law()->bound_interior(nodes); };
    if (c->law()->may_throw())
      ranks().agree(bound);
    else
      bound();
    for (std::size_t i = 0; i < in.is_on.size(); ++i)
    {
      if (not in.is_on[i])
        continue;
      double* lambda = &nodes.multiplier[size * i];
      if (not nodes.is_vector())
      {
        lambda[0] = in.pressure[i];
        continue;
      }
      MutableMap t(&in.traction[g * i], g), w(&in.slip[g * i], g);
      const bool had_friction = in.has_friction[i];
      in.has_friction[i] = in.bound[i] > 0;
      if (in.has_friction[i])
      {
        const bool is_new = not had_friction;
        // A bound that is not linear in the pressure may have been passed
        const double most
            = (is_new ? traction_fraction : boundary_fraction) * in.bound[i];
        if (t.norm() >= (is_new ? most : in.bound[i]))
          t *= most / t.norm();
        if (is_new)
        {
          w.setZero();
          const double product
              = is_first ? _gap_scale * in.pressure[i] : _product;
          in.slip_length[i] = 2 * product / in.bound[i];
        }
        if (not(in.slip_length[i] > w.norm()))
          in.slip_length[i] = w.norm() / boundary_fraction;
      }
      else
        t.setZero();
      MutableMap(lambda, g)
          = in.pressure[i] * Tangent(Map(&nodes.normal[g * i], g)) + t;
    }
  }
}

void InteriorPoint::predict()
{
  place();
  const auto [pressure, slack, product] = means();
  _product = product;
  _scale = pressure * slack;
  _is_predictor = true;
  for (const auto& c : _system->contacts())
    if (auto& in = c->nodes()->interior)
    {
      in->target = 0;
      std::ranges::fill(in->product, 0);
      std::ranges::fill(in->correction, 0);
    }
}

std::vector<InteriorPoint::Step>
InteriorPoint::increments(std::span<const double> dx) const
{
  const std::vector<double> u = _system->movement(dx);
  std::vector<Step> steps;
  std::size_t at = _system->num_bulk();
  for (const auto& c : _system->contacts())
  {
    const law::NodeState& nodes = *c->nodes();
    const int size = nodes.size();
    Step& step = steps.emplace_back();
    const std::size_t n = nodes.num_nodes();
    const auto& in = nodes.interior;
    if (not in)
    {
      at += n * size;
      continue;
    }
    step.pressure.assign(n, 0);
    step.slack.assign(n, 0);
    step.traction.assign(in->traction.size(), 0);
    step.slip.assign(in->traction.size(), 0);
    step.slip_length.assign(n, 0);
    contact::Contact::Change change;
    if (nodes.is_vector())
      change = c->change(u);
    for (std::size_t i = 0; i < n; ++i, at += size)
    {
      if (not in->is_on[i])
        continue;
      Tangent dl(size);
      for (int k = 0; k < size; ++k)
        dl[k] = -dx[at + k] * _system->factors()[at + k - _system->num_bulk()];
      const double p = in->pressure[i];
      double& dp = step.pressure[i];
      dp = dl[0];
      if (nodes.is_vector())
      {
        const Tangent normal = Map(&nodes.normal[size * i], size),
                      turn = Map(&change.normal[size * i], size),
                      t = Map(&in->traction[size * i], size);
        dp = normal.dot(dl) + t.dot(turn);
        Tangent dt = dl - p * turn;
        dt -= normal.dot(dt) * normal;
        if (in->has_friction[i])
        {
          MutableMap(&step.traction[size * i], size) = dt;
          const law::ConePair pair = law::pair_of(*in, i);
          ConeVector x(1 + size);
          x << in->by_pressure[i] * dp, dt;
          const ConeVector y
              = -law::slip_slacks(*in, i) + 2 * in->target * pair.inverse()
                + ConeVector(Map(&in->correction[(1 + size) * i], 1 + size))
                - pair.scaled(x);
          step.slip_length[i] = y[0];
          MutableMap(&step.slip[size * i], size) = y.tail(size);
        }
      }
      const double s = in->slack[i];
      step.slack[i] = -s + (in->target - in->product[i]) / p - s / p * dp;
    }
  }
  return steps;
}

void InteriorPoint::add(const std::vector<Step>& steps, double primal,
                        double dual)
{
  const auto plus
      = [](std::vector<double>& to, const std::vector<double>& by, double part)
  {
    for (std::size_t i = 0; i < by.size(); ++i)
      to[i] += part * by[i];
  };
  for (std::size_t k = 0; k < steps.size(); ++k)
    if (auto& in = _system->contacts()[k]->nodes()->interior)
    {
      plus(in->pressure, steps[k].pressure, dual);
      plus(in->traction, steps[k].traction, dual);
      plus(in->slack, steps[k].slack, primal);
      plus(in->slip_length, steps[k].slip_length, primal);
      plus(in->slip, steps[k].slip, primal);
      for (std::size_t i = 0; i < in->bound.size(); ++i)
        if (in->has_friction[i])
          in->bound[i] += dual * in->by_pressure[i] * steps[k].pressure[i];
    }
}

std::array<double, 2>
InteriorPoint::lengths(const std::vector<Step>& steps) const
{
  double primal = infinity, dual = infinity;
  for (std::size_t k = 0; k < steps.size(); ++k)
  {
    const auto& in = _system->contacts()[k]->nodes()->interior;
    if (not in)
      continue;
    const Step& step = steps[k];
    for (std::size_t i = 0; i < in->is_on.size(); ++i)
    {
      if (not in->is_on[i])
        continue;
      if (step.slack[i] < 0)
        primal = std::min(primal, -in->slack[i] / step.slack[i]);
      if (step.pressure[i] < 0)
        dual = std::min(dual, -in->pressure[i] / step.pressure[i]);
      if (not in->has_friction[i])
        continue;
      const auto [x, y] = of_cones(*in, step, i);
      dual = std::min(
          dual, law::step_to_boundary(law::bound_and_traction(*in, i), x));
      primal = std::min(primal,
                        law::step_to_boundary(law::slip_slacks(*in, i), y));
    }
  }
  return {mesh::least(ranks(), primal), mesh::least(ranks(), dual)};
}

/// Finds from the affine step which nodes close and stick, by the ratios of new
/// to old values (Tapia's indicators).
void InteriorPoint::judge(const std::vector<Step>& steps)
{
  std::vector<std::vector<std::int8_t>> shown;
  std::array<std::int64_t, 3> sums{};
  for (std::size_t k = 0; k < steps.size(); ++k)
  {
    const law::NodeState& nodes = *_system->contacts()[k]->nodes();
    auto& status = shown.emplace_back(nodes.status);
    const auto& in = nodes.interior;
    if (not in)
      continue;
    const int g = in->gdim;
    const Step& step = steps[k];
    for (std::size_t i = 0; i < in->is_on.size(); ++i)
    {
      status[i] = law::open;
      if (not in->is_on[i])
        continue;
      const double p = 1 + step.pressure[i] / in->pressure[i];
      const double s = 1 + step.slack[i] / in->slack[i];
      const bool closes = p > s;
      bool is_sure = std::abs(p - s) > doubtful_difference;
      if (closes)
        status[i] = law::slip;
      if (closes and in->has_friction[i])
      {
        const auto tangent = [g, i](const std::vector<double>& v)
        { return Map(&v[g * i], g); };
        const Tangent t = tangent(in->traction),
                      t_new = t + tangent(step.traction), w = tangent(in->slip),
                      w_new = w + tangent(step.slip);
        const double inside
            = (in->bound[i] + in->by_pressure[i] * step.pressure[i]
               - t_new.norm())
              / std::max(in->bound[i] - t.norm(),
                         std::numeric_limits<double>::min());
        const double slides
            = (in->slip_length[i] + step.slip_length[i] + w_new.norm())
              / (in->slip_length[i] + w.norm());
        if (inside > slides)
          status[i] = law::stick;
        is_sure = is_sure and std::abs(inside - slides) > doubtful_difference;
      }
      sums[0] += not is_sure;
      sums[1] += closes;
    }
    if (k < _shown.size())
      for (std::size_t i = 0; i < status.size(); ++i)
        sums[2] += status[i] != _shown[k][i];
  }
  ranks().reduce(std::span<std::int64_t>(sums), mesh::Reduction::sum);
  _doubtful = sums[0];
  _closed = sums[1];
  _differ = sums[2];
  _shown = std::move(shown);
}

void InteriorPoint::correct(std::span<const double> dx)
{
  _is_predictor = false;
  const std::vector<Step> steps = increments(dx);
  auto [primal, dual] = lengths(steps);
  primal = std::min(1.0, primal);
  dual = std::min(1.0, dual);
  judge(steps);
  if (_is_curved)
    primal = dual = std::min(primal, dual);
  std::vector<std::optional<Interior>> before;
  for (const auto& c : _system->contacts())
    before.push_back(c->nodes()->interior);
  add(steps, primal, dual);
  const double after = means()[2];
  for (std::size_t k = 0; k < before.size(); ++k)
    _system->contacts()[k]->nodes()->interior = std::move(before[k]);
  const double centring = std::min(
      1.0, std::pow(std::max(after / _product, 0.0), centring_power));
  for (std::size_t k = 0; k < steps.size(); ++k)
  {
    auto& in = _system->contacts()[k]->nodes()->interior;
    if (not in)
      continue;
    const int g = in->gdim;
    const Step& step = steps[k];
    in->target = centring * _product;
    for (std::size_t i = 0; i < in->is_on.size(); ++i)
    {
      if (not in->is_on[i])
        continue;
      in->product[i] = step.pressure[i] * step.slack[i];
      if (not in->has_friction[i])
        continue;
      const auto [x, y] = of_cones(*in, step, i);
      MutableMap(&in->correction[(1 + g) * i], 1 + g)
          = law::pair_of(*in, i).correction(x, y);
    }
  }
}

double InteriorPoint::limit(std::span<const double> dx)
{
  _steps = increments(dx);
  _lengths = lengths(_steps);
  for (double& length : _lengths)
    length = std::min(1.0, boundary_fraction * length);
  if (_is_curved)
    _lengths.fill(std::min(_lengths[0], _lengths[1]));
  return _lengths[0];
}

void InteriorPoint::shorten(double part)
{
  for (double& length : _lengths)
    length *= part;
}

void InteriorPoint::take()
{
  _has_stepped = not _steps.empty();
  if (not _has_stepped)
    return;
  add(_steps, _lengths[0], _lengths[1]);
  _steps.clear();
  ++_iterations;
}

bool InteriorPoint::may_end(double residual)
{
  if (_has_stepped and _iterations > 1 and not(_product < _before_product)
      and not(residual < _residual))
    ++_poor;
  if (_has_stepped and std::max(_lengths[0], _lengths[1]) < negligible_step)
    ++_poor;
  _before_product = _product;
  _residual = residual;
  _is_curved
      = not _system->bulk()->is_linear() and not(residual < trial_residual);
  double defect = 0;
  for (const auto& c : _system->contacts())
    if (const auto& in = c->nodes()->interior)
      for (std::size_t i = 0; i < in->is_on.size(); ++i)
        if (in->is_on[i])
          defect
              = std::max(defect, std::abs(c->nodes()->gap[i] - in->slack[i]));
  defect = mesh::largest(ranks(), defect);
  if (_iterations == 0 or not(residual < trial_residual)
      or not(defect < trial_defect * _gap_scale))
    return false;
  const double few
      = _part * static_cast<double>(std::max<std::int64_t>(1, _closed));
  if (_iterations == _tried)
    return false;
  bool ends = static_cast<double>(_doubtful) <= few
              and static_cast<double>(_differ) <= few and _iterations > 1;
  while (_product < _level * _scale)
  {
    _level *= trial_level_ratio;
    ends = true;
  }
  return ends;
}

bool InteriorPoint::is_stuck() const
{
  return _poor >= max_poor_iterates or _iterations >= max_iterations;
}

void InteriorPoint::give_up()
{
  _system->take(_before);
  _is_on = _is_trial = _is_predictor = false;
  _is_barred = true;
  for (std::size_t k = 0; k < _status.size(); ++k)
  {
    law::NodeState& nodes = *_system->contacts()[k]->nodes();
    nodes.interior.reset();
    std::ranges::copy(_status[k], nodes.status.begin());
  }
}

void InteriorPoint::leave()
{
  _kept.resize(_system->size());
  _system->unknowns(_kept);
  _saved.clear();
  _is_on = false;
  _is_trial = true;
  _trial = 0;
  _tried = _iterations;
  for (std::size_t k = 0; k < _system->contacts().size(); ++k)
  {
    law::NodeState& nodes = *_system->contacts()[k]->nodes();
    _saved.push_back(nodes.interior);
    if (not nodes.interior)
      continue;
    nodes.interior.reset();
    std::ranges::copy(_shown[k], nodes.status.begin());
    nodes.drop_open();
  }
}

bool InteriorPoint::is_refused(std::int64_t changes, std::int64_t closed)
{
  // The first update finds what the affine step had left in doubt
  const double part = (++_trial == 1 ? 3 : 1) * few_fraction;
  return static_cast<double>(changes)
             > std::max(1.0, part * static_cast<double>(closed))
         or _trial > path_cost;
}

void InteriorPoint::resume()
{
  _system->take(_kept);
  _is_on = true;
  _is_trial = false;
  _part = _doubtful == 0 ? 0 : _part / 4;
  for (std::size_t k = 0; k < _saved.size(); ++k)
    if (_saved[k])
      _system->contacts()[k]->nodes()->interior.emplace(*_saved[k]);
}
