// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#include "obstacle_pairs.h"
#include "../check.h"
#include "../kernel/layout.h"
#include "../math/vec.h"
#include "touching.h"
#include <algorithm>
#include <cmath>
#include <functional>
#include <stdexcept>

using namespace contactx;
using namespace contactx::contact;

namespace
{
template <class Row>
std::vector<double> copied(const std::vector<Row>& rows)
{
  const auto values = kernel::values_of(std::span<const Row>(rows));
  return {values.begin(), values.end()};
}

std::vector<double> gathered_rows(std::span<const double> x,
                                  std::span<const std::int32_t> nodes, int gdim)
{
  check::positions(x.size(), check::num_nodes(nodes), gdim);
  std::vector<double> rows(nodes.size() * gdim);
  for (std::size_t i = 0; i < nodes.size(); ++i)
    for (int k = 0; k < gdim; ++k)
      rows[gdim * i + k] = x[std::size_t(gdim) * nodes[i] + k];
  return rows;
}
} // namespace

ObstacleMaster::ObstacleMaster(std::shared_ptr<geometry::Obstacle> obstacle,
                               std::shared_ptr<const SlaveNodes> slaves,
                               std::span<const double> x, int gdim,
                               double reach, bool measures_slip)
    : _obstacle(std::move(obstacle)), _slaves(std::move(slaves)), _gdim(gdim),
      _reach(reach), _measures_slip(measures_slip)
{
  if (not _slaves)
    throw std::invalid_argument("slaves must not be empty");
  const geometry::FacetList facets = _slaves->facets();
  check::facets(facets.offsets, facets.nodes, gdim);
  check::positions(x.size(), check::num_nodes(facets.nodes), gdim);
  _paired.assign(size(), 0);
  _slip.resize(size());
  _found.resize(size());
  _at = at_slaves(x);
  ObstacleMaster::accept(x);
  ObstacleMaster::begin_step();
}

std::vector<double> ObstacleMaster::at_slaves(std::span<const double> x) const
{
  return gathered_rows(x, _slaves->owned(), _gdim);
}

std::vector<kernel::ObstaclePair>
ObstacleMaster::pairs_of(const geometry::Geometry& seen) const
{
  const std::size_t g = _gdim;
  std::vector<kernel::ObstaclePair> pairs(size());
  for (std::size_t i = 0; i < size(); ++i)
  {
    pairs[i].gap = seen.gap[i];
    std::copy_n(&seen.gradient[g * i], g, pairs[i].gradient.begin());
    std::copy_n(&seen.normal[g * i], g, pairs[i].normal.begin());
    std::copy_n(&seen.curvature[g * g * i], g * g, pairs[i].curvature.begin());
  }
  return pairs;
}

std::int32_t ObstacleMaster::search(std::span<const double> x,
                                    std::span<const std::int8_t>)
{
  _at = at_slaves(x);
  _obstacle->evaluate(_at, _gdim, _seen);
  _found = pairs_of(_seen);
  update_slip(_at, _found);
  // The far side of an obstacle, too, has a closest point for a node
  _paired = _slaves->facing(x, _seen.normal, _gdim);
  for (std::size_t i = 0; i < size(); ++i)
    _paired[i] = _paired[i] and std::abs(_seen.gap[i]) <= _reach;
  return 0;
}

std::vector<kernel::Pairs> ObstacleMaster::pairs() const
{
  return group(_found);
}

std::optional<std::vector<kernel::Pairs>>
ObstacleMaster::update(std::span<const double> x, bool frozen,
                       std::span<const double>)
{
  const std::vector<double> now = at_slaves(x);
  std::vector<kernel::ObstaclePair> pairs;
  if (not frozen)
  {
    _obstacle->evaluate(now, _gdim, _seen);
    pairs = pairs_of(_seen);
  }
  else
  {
    pairs = _found;
    for (std::size_t i = 0; i < size(); ++i)
    {
      double more = 0;
      for (int k = 0; k < _gdim; ++k)
        more
            += pairs[i].gradient[k] * (now[_gdim * i + k] - _at[_gdim * i + k]);
      pairs[i].gap += more;
      pairs[i].curvature = {};
    }
  }
  update_slip(now, pairs);
  return group(pairs);
}

void ObstacleMaster::update_slip(std::span<const double> at,
                                 std::span<const kernel::ObstaclePair> pairs)
{
  if (not _measures_slip)
    return;
  const std::vector<double> from = carried();
  const int g = _gdim;
  for (std::size_t i = 0; i < size(); ++i)
  {
    const auto& normal = pairs[i].normal;
    const auto& turn = pairs[i].curvature;
    _slip[i] = {};
    auto& [slip, derivative] = _slip[i];
    Vector<3> movement{}, turned_back{};
    double height = 0;
    for (int k = 0; k < g; ++k)
    {
      movement[k] = at[g * i + k] - from[g * i + k];
      height += normal[k] * movement[k];
    }
    for (int k = 0; k < g; ++k)
      for (int j = 0; j < g; ++j)
        turned_back[k] += movement[j] * turn[g * j + k];
    for (int j = 0; j < g; ++j)
      for (int k = 0; k < g; ++k)
      {
        const double across = (j == k) - normal[j] * normal[k];
        slip[j] += across * movement[k];
        derivative[g * j + k]
            = across - height * turn[g * j + k] - normal[j] * turned_back[k];
      }
  }
}

std::vector<double> ObstacleMaster::carried() const
{
  return _obstacle->carry(_start, _placed, _obstacle->placement(_gdim));
}

std::vector<double> ObstacleMaster::movement() const
{
  const std::size_t g = _gdim;
  const std::vector<double> gap = _obstacle->evaluate(_x0, _gdim).gap;
  const std::vector<double> to
      = _measures_slip
            ? _obstacle->carry(_x0, _placed, _obstacle->placement(_gdim))
            : _x0;
  std::vector<double> movement(size() * g);
  for (std::size_t i = 0; i < size(); ++i)
  {
    const auto& normal = _found[i].normal;
    double height = 0;
    for (std::size_t k = 0; k < g; ++k)
      height += normal[k] * (to[g * i + k] - _x0[g * i + k]);
    // The obstacle comes nearer by what the gap of a place falls
    for (std::size_t k = 0; k < g; ++k)
      movement[g * i + k] = to[g * i + k] - _x0[g * i + k]
                            + (_gap0[i] - gap[i] - height) * normal[k];
  }
  return movement;
}

void ObstacleMaster::accept(std::span<const double> x)
{
  std::vector<double> x0 = at_slaves(x);
  std::vector<double> gap0 = _obstacle->evaluate(x0, _gdim).gap;
  if (_measures_slip)
  {
    geometry::Placement placed = _obstacle->placement(_gdim);
    _parameters = _obstacle->parameters(_gdim);
    _placed = std::move(placed);
  }
  _x0 = std::move(x0);
  _gap0 = std::move(gap0);
}

void ObstacleMaster::begin_step()
{
  if (_measures_slip)
    _start = _x0;
}

bool ObstacleMaster::has_unknown_motion(double tolerance) const
{
  if (not _measures_slip or _obstacle->knows_its_motion())
    return false;
  const std::vector<double> gap = _obstacle->evaluate(_x0, _gdim).gap;
  for (std::size_t i = 0; i < size(); ++i)
    if (std::abs(gap[i] - _gap0[i]) > tolerance)
      return true;
  return _obstacle->parameters(_gdim) != _parameters;
}

std::optional<std::vector<double>>
ObstacleMaster::turn(std::span<const double>) const
{
  if (not _measures_slip)
    return std::nullopt;
  const std::vector<double> one = _placed.turn(_obstacle->placement(_gdim));
  std::vector<double> all;
  all.reserve(size() * one.size());
  for (std::size_t i = 0; i < size(); ++i)
    all.insert(all.end(), one.begin(), one.end());
  return all;
}

void ObstacleMaster::touch(std::span<const std::int8_t> which,
                           std::span<const double> x, std::span<const double>,
                           std::span<const double> offset)
{
  if (not _measures_slip)
    return;
  check::rows(which.size(), size(), 1, "which", "slave node");
  check::rows(offset.size(), size(), 1, "offset", "slave node");
  const std::vector<double> now = at_slaves(x);
  const std::vector<double> gap = _obstacle->evaluate(now, _gdim).gap;
  const std::vector<double> seen
      = _obstacle->carry(now, _obstacle->placement(_gdim), _placed);
  for (std::size_t i = 0; i < size(); ++i)
  {
    if (not which[i])
      continue;
    const double part = touching(_gap0[i] - offset[i], gap[i] - offset[i]);
    for (std::size_t k = _gdim * i; k < _gdim * (i + 1); ++k)
      _start[k] = _x0[k] + part * (seen[k] - _x0[k]);
  }
}

std::vector<kernel::Pairs>
ObstacleMaster::group(std::span<const kernel::ObstaclePair> pairs) const
{
  kernel::Pairs p;
  p.data_size = kernel::num_values<kernel::ObstaclePair>;
  p.slip_size = _measures_slip ? kernel::num_values<kernel::ObstacleSlip> : 0;
  for (std::size_t i = 0; i < size(); ++i)
  {
    if (not _paired[i])
      continue;
    p.slaves.push_back(static_cast<std::int32_t>(i));
    p.nodes.push_back(_slaves->owned()[i]);
    p.add(pairs[i]);
    if (_measures_slip)
      p.add_slip(_slip[i]);
  }
  if (p.slaves.empty())
    return {};
  std::vector<kernel::Pairs> groups;
  groups.push_back(std::move(p));
  return groups;
}

std::vector<double> ObstacleMaster::normals() const
{
  std::vector<double> normals(3 * size(), 0);
  for (std::size_t i = 0; i < size(); ++i)
    if (_paired[i])
      std::copy_n(_found[i].normal.begin(), _gdim, &normals[3 * i]);
  return normals;
}

kernel::Weights ObstacleMaster::weights() const
{
  kernel::Weights w;
  for (std::size_t i = 0; i < size(); ++i)
    if (_paired[i])
    {
      w.slaves.push_back(static_cast<std::int32_t>(i));
      w.nodes.push_back(_slaves->owned()[i]);
      w.values.push_back(1);
    }
  return w;
}

std::vector<double> ObstacleMaster::compliance(std::span<const double>) const
{
  return std::vector<double>(size(), 0.0);
}

Mobility ObstacleMaster::mobility(std::span<const std::int8_t> free) const
{
  const std::size_t count
      = size() == 0 ? 0 : std::size_t(_slaves->owned().back()) + 1;
  if (free.size() < count * _gdim)
    throw std::invalid_argument("free must hold each component of all nodes");
  Mobility m{std::vector<double>(size(), 0),
             std::vector<double>(size() * _gdim)};
  for (std::size_t i = 0; i < size(); ++i)
  {
    const auto& normal = _found[i].normal;
    double square = 0;
    for (int k = 0; k < _gdim; ++k)
    {
      const double moves
          = free[std::size_t(_gdim) * _slaves->owned()[i] + k] ? 1 : 0;
      m.each[_gdim * i + k] = moves;
      square += normal[k] * moves * normal[k] * moves;
    }
    m.normal[i] = std::sqrt(square);
  }
  return m;
}

std::vector<double> ObstacleMaster::inside(std::span<const double> x) const
{
  return _obstacle->evaluate(at_slaves(x), _gdim).gap;
}

double ObstacleMaster::distance(std::span<const double> x) const
{
  double least = std::numeric_limits<double>::infinity();
  for (double gap : inside(x))
    least = std::min(least, std::abs(gap));
  return least;
}

std::vector<Saved> ObstacleMaster::save() const
{
  using enum RowKind;
  std::vector<Saved> saved{
      {"paired", slave, 0, _paired},
      {"data", slave, kernel::num_values<kernel::ObstaclePair>, copied(_found)},
      {"at", slave, _gdim, _at},
      {"x0", slave, _gdim, _x0},
      {"gap0", slave, 0, _gap0}};
  if (not _measures_slip)
    return saved;
  saved.push_back({"slip_data", slave, kernel::num_values<kernel::ObstacleSlip>,
                   copied(_slip)});
  saved.push_back({"start", slave, _gdim, _start});
  saved.push_back({"point", global, 0, _placed.point});
  if (not _placed.direction.empty())
    saved.push_back({"direction", global, 0, _placed.direction});
  if (not _placed.angle.empty())
    saved.push_back({"angle", global, 0, _placed.angle});
  if (_placed.time != 0)
    saved.push_back({"time", global, 0, std::vector<double>{_placed.time}});
  if (not _parameters.empty())
    saved.push_back({"parameters", global, 0, _parameters});
  return saved;
}

void ObstacleMaster::load(const std::vector<Saved>& saved)
{
  const std::size_t n = size();
  const auto& paired = values_of<std::int8_t>(saved, "paired");
  check::rows(paired.size(), n, 1, "paired", "slave node");
  auto found = kernel::rows_of<kernel::ObstaclePair>(values_of_size(
      saved, "data", n, kernel::num_values<kernel::ObstaclePair>));
  auto at = values_of_size(saved, "at", n, _gdim);
  auto x0 = values_of_size(saved, "x0", n, _gdim);
  auto gap0 = values_of_size(saved, "gap0", n, 1);
  if (_measures_slip)
  {
    auto slip = kernel::rows_of<kernel::ObstacleSlip>(values_of_size(
        saved, "slip_data", n, kernel::num_values<kernel::ObstacleSlip>));
    auto start = values_of_size(saved, "start", n, _gdim);
    geometry::Placement placed{values_of_size(saved, "point", 1, _gdim)};
    if (has(saved, "direction"))
      placed.direction = values_of_size(saved, "direction", 1, _gdim);
    if (has(saved, "angle"))
      placed.angle = values_of<double>(saved, "angle");
    if (has(saved, "time"))
      placed.time = values_of_size(saved, "time", 1, 1).front();
    _parameters = has(saved, "parameters")
                      ? values_of<double>(saved, "parameters")
                      : std::vector<double>{};
    _slip = std::move(slip);
    _start = std::move(start);
    _placed = std::move(placed);
  }
  _x0 = std::move(x0);
  _gap0 = std::move(gap0);
  _paired = paired;
  _found = std::move(found);
  _at = std::move(at);
}
