// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#include "recovery.h"
#include "../check.h"
#include "../math/vec.h"
#include <algorithm>
#include <cmath>
#include <numeric>
#include <stdexcept>
#include <string>
#include <utility>

using namespace contactx;
using namespace contactx::results;

Recovery::Recovery(std::shared_ptr<const contact::SlaveNodes> slaves,
                   std::span<const double> x, int gdim)
    : _slaves(std::move(slaves)), _gdim(gdim)
{
  if (not _slaves)
    throw std::invalid_argument("slaves must not be empty");
  check::dimension(gdim);
  _passes = _slaves->is_quadratic() and _slaves->is_mortar() ? 1 : 2;
  const geometry::FacetList facets = _slaves->local();
  std::vector<double> here = _slaves->here(x, gdim, "x");
  std::vector<double> parts
      = geometry::corner_areas(facets, here, gdim, _slaves->pressure_shares());
  _area = _slaves->sums(parts);
  if (_slaves->is_quadratic())
  {
    _ratio = _slaves->sums(
        geometry::corner_areas(facets, here, gdim, _slaves->shares()));
    for (std::size_t i = 0; i < _ratio.size(); ++i)
      _ratio[i] = _ratio[i] > 0 ? _area[i] / _ratio[i] : 0;
  }
  const auto n = static_cast<std::int32_t>(_area.size());
  for (std::int32_t f = 0; f < facets.size(); ++f)
  {
    const auto nodes = facets[f];
    const std::span part(parts.data() + facets.offsets[f], nodes.size());
    const double whole = std::accumulate(part.begin(), part.end(), 0.0);
    for (std::size_t i = 0; i < nodes.size(); ++i)
      for (std::size_t j = 0; j < nodes.size(); ++j)
        if (i != j and nodes[i] < n)
        {
          if (part[i] > 0 and part[j] > 0)
            _pairs.push_back({nodes[i], nodes[j], part[i] * part[j] / whole,
                              static_cast<int>(nodes.size())});
          else if (_area[nodes[i]] == 0 and part[j] > 0)
            _beside.push_back({nodes[i], nodes[j]});
          else if (part[j] == 0)
            _given.push_back({nodes[i], nodes[j]});
        }
  }
  _most.assign(_area.size(), 0);
  for (const Pair& pair : _pairs)
    _most[pair.to] += pair.weight / _area[pair.to];
  _trend.emplace(_slaves, std::move(here), std::move(parts), gdim);
}

std::vector<Flow> Recovery::flows(std::span<const double> area,
                                  std::span<const std::int8_t> is_closed) const
{
  const std::size_t n = _area.size();
  std::vector<double> inside(n, 0), covered(n), own(n);
  for (const Pair& pair : _pairs)
    if (not is_closed[pair.from])
      inside[pair.to] += pair.weight;
  for (std::size_t i = 0; i < n; ++i)
  {
    own[i] = area[i] * (_ratio.empty() ? 1 : _ratio[i]);
    // Less than one where the master covers a node's facets in part
    covered[i] = _area[i] > 0 ? own[i] / _area[i] : 0;
    inside[i] = _area[i] > 0 ? 1 - inside[i] / _area[i] : 0;
  }
  inside = _slaves->scatter_forward(inside);
  covered = _slaves->scatter_forward(covered);

  std::vector<Flow> flows;
  flows.reserve(_pairs.size());
  for (const auto& [to, from, weight, corners] : _pairs)
  {
    if (not is_closed[to] or not is_closed[from])
      continue;
    const auto [less, more] = std::minmax(inside[to], inside[from]);
    const double r = less / more;
    const double rate = weight * std::min(covered[to], covered[from]) / own[to];
    // As the centre of a shape function is nearer to its node than the middle
    // of the facet is
    const double moment
        = _slaves->is_quadratic() ? 0 : (corners == 3 ? 3. / 4 : 2. / 3) * rate;
    flows.push_back({to, from, weight, corners, rate * (r * r), moment});
  }
  return flows;
}

std::vector<double>
Recovery::consistent(std::span<const double> values, int width,
                     std::span<const double> area,
                     std::span<const std::int8_t> closed) const
{
  std::vector<double> result(values.begin(), values.end());
  // The same on all ranks, unlike the number of nodes
  if (not _slaves->is_quadratic())
    return result;
  const std::size_t n = _area.size();
  const std::vector<std::int8_t> is_closed = _slaves->scatter_forward(closed);
  std::vector<int> count(n, 0);
  for (const auto& [vertex, to] : _beside)
    count[vertex] += is_closed[to];
  // Force that each of its neighbours gets
  std::vector<double> share(n * width, 0);
  for (std::size_t i = 0; i < n; ++i)
    for (int k = 0; k < width; ++k)
    {
      double& value = result[width * i + k];
      if (_ratio[i] > 0)
        value /= _ratio[i];
      else if (count[i] > 0)
        share[width * i + k] = value * area[i] / count[i];
    }
  share = _slaves->scatter_forward(share, width);
  for (const auto& [to, vertex] : _given)
    if (is_closed[to] and _ratio[to] > 0)
      for (int k = 0; k < width; ++k)
        result[width * to + k]
            += share[width * vertex + k] / (area[to] * _ratio[to]);
  return result;
}

std::vector<double> Recovery::filled(std::span<const double> values,
                                     int width) const
{
  std::vector<double> result(values.begin(), values.end());
  if (not _slaves->is_quadratic())
    return result;
  const std::vector<double> every = _slaves->scatter_forward(values, width);
  std::vector<int> count(_area.size(), 0);
  for (const auto& [to, from] : _beside)
    if (count[to]++ == 0)
      std::fill_n(result.begin() + width * to, width, 0.0);
  for (const auto& [to, from] : _beside)
    for (int k = 0; k < width; ++k)
      result[width * to + k] += every[width * from + k] / count[to];
  return result;
}

std::vector<Recovery::Exchange> Recovery::exchange(std::span<const Flow> flows,
                                                   const Slope& slope,
                                                   std::span<const double> p,
                                                   bool averages) const
{
  const std::vector<double>& x = _trend->x();
  std::vector<Exchange> result;
  result.reserve(flows.size());
  // What nodes give beyond averages, of their own and to others
  std::vector<double> beyond(flows.size(), 0), room(_most), asked(_most.size());
  for (std::size_t f = 0; f < flows.size(); ++f)
  {
    const auto [to, from, weight, corners, rate, moment] = flows[f];
    const double average = averages ? rate : 0;
    double gets = average, gives = average;
    // Forces in tension, those of ties, are averaged alone
    if (p[to] > 0 and p[from] > 0)
    {
      const double mean = average * (p[from] - p[to]);
      double trend = 0;
      for (int k = 0; k < _gdim; ++k)
        trend
            += 0.5
               * (slope.values[to * _gdim + k] + slope.values[from * _gdim + k])
               * (x[from * _gdim + k] - x[to * _gdim + k]);
      double flow = mean - (averages ? rate : moment) * trend;
      // Averages take nothing from an edge of which half of the slope counts
      if (averages)
        flow *= std::max(1 - 2 * slope.share[flow < 0 ? to : from], 0.);
      // First, less is given the other way
      const double more = flow - mean, back = more > 0 ? p[to] : p[from];
      const double less = std::min(std::abs(more), average * back);
      (more > 0 ? gives : gets) -= less / back;
      beyond[f] = std::copysign(std::abs(more) - less, more);
    }
    room[to] -= gives;
    if (beyond[f] < 0)
      asked[to] -= beyond[f] / p[to];
    result.push_back({to, from, gets, gives});
  }
  // No node gives more than if its neighbours had no pressure
  for (std::size_t i = 0; i < room.size(); ++i)
    room[i] = asked[i] > room[i] ? std::max(room[i], 0.) / asked[i] : 1;
  const std::vector<double> part = _slaves->scatter_forward(room);
  for (std::size_t f = 0; f < flows.size(); ++f)
  {
    auto& [to, from, gets, gives] = result[f];
    if (beyond[f] > 0)
      gets += part[from] * beyond[f] / p[from];
    else if (beyond[f] < 0)
      gives -= part[to] * beyond[f] / p[to];
  }
  return result;
}

std::vector<std::vector<Recovery::Exchange>>
Recovery::exchanges(std::vector<double>& p, std::span<const double> area,
                    std::span<const std::int8_t> closed) const
{
  const std::vector<std::int8_t> is_closed = _slaves->scatter_forward(closed);
  const std::vector<Flow> flows = this->flows(area, is_closed);
  const Slope slope = _trend->find(flows, p, is_closed);
  std::vector<std::vector<Exchange>> result;
  // First from the centres of the shape functions to the nodes
  for (int step = 0; step <= _passes; ++step)
  {
    const std::vector<double> every = _slaves->scatter_forward(p);
    result.push_back(exchange(flows, slope, every, step > 0));
    for (const auto& [to, from, gets, gives] : result.back())
      p[to] += gets * every[from] - gives * every[to];
  }
  return result;
}

std::vector<double>
Recovery::pressure(std::span<const double> p, std::span<const double> area,
                   std::span<const std::int8_t> closed) const
{
  const std::size_t n = _area.size();
  check::rows(p.size(), n, 1, "p");
  check::rows(area.size(), n, 1, "area");
  check::rows(closed.size(), n, 1, "closed");
  std::vector<double> result = consistent(p, 1, area, closed);
  exchanges(result, area, closed);
  return result;
}

void Recovery::carry(std::vector<double>& t, std::span<const double> normals,
                     std::span<const Exchange> exchange) const
{
  const std::vector<double> every = _slaves->scatter_forward(t, _gdim);
  for (const auto& [to, from, gets, gives] : exchange)
  {
    const std::size_t i = static_cast<std::size_t>(to) * _gdim;
    const std::size_t j = static_cast<std::size_t>(from) * _gdim;
    const double *a = &normals[j], *b = &normals[i];
    // Turned by the smallest rotation from a to b. Opposite vectors have none;
    // t is normal to both of them
    const double cosine = dot(a, b, _gdim);
    const double factor
        = 1 + cosine > 0 ? dot(b, &every[j], _gdim) / (1 + cosine) : 0;
    for (int k = 0; k < _gdim; ++k)
      t[i + k] += gets * (every[j + k] - factor * (a[k] + b[k]))
                  - gives * every[i + k];
  }
}

Recovered Recovery::tractions(std::span<const double> multiplier,
                              std::span<const double> normal,
                              std::span<const double> area,
                              std::span<const std::int8_t> closed) const
{
  const std::size_t n = _area.size();
  check::rows(multiplier.size(), n, _gdim, "multiplier");
  check::rows(normal.size(), n, _gdim, "normal");
  check::rows(area.size(), n, 1, "area");
  check::rows(closed.size(), n, 1, "closed");
  std::vector<double> p(n), t(multiplier.begin(), multiplier.end());
  for (std::size_t i = 0; i < n; ++i)
  {
    const double* at = &normal[i * _gdim];
    p[i] = dot(at, &t[i * _gdim], _gdim);
    for (int k = 0; k < _gdim; ++k)
      t[i * _gdim + k] -= p[i] * at[k];
  }
  Recovered result{consistent(p, 1, area, closed),
                   consistent(t, _gdim, area, closed)};
  const std::vector<double> normals = _slaves->scatter_forward(normal, _gdim);
  for (const auto& exchange : exchanges(result.pressure, area, closed))
    carry(result.traction, normals, exchange);
  for (std::size_t i = 0; i < n; ++i)
    for (int k = 0; k < _gdim; ++k)
      result.traction[i * _gdim + k]
          += result.pressure[i] * normal[i * _gdim + k];
  return result;
}

double contactx::results::recovery_change(mesh::Ranks& ranks,
                                          std::span<const double> forces,
                                          std::span<const double> recovered,
                                          int gdim)
{
  if (gdim < 1 or forces.size() % gdim != 0)
    throw std::invalid_argument("forces must have gdim values a node");
  check::rows(recovered.size(), forces.size(), 1, "recovered");
  // The size of the forces comes last
  std::vector<double> sums(gdim + 1, 0);
  for (std::size_t i = 0; i < forces.size(); i += gdim)
  {
    for (int k = 0; k < gdim; ++k)
      sums[k] += recovered[i + k] - forces[i + k];
    sums.back() += std::sqrt(dot(&forces[i], &forces[i], gdim));
  }
  if (ranks.size() > 1)
    ranks.reduce(std::span(sums), mesh::Reduction::sum);
  const double size = sums.back();
  return size > 0 ? std::sqrt(dot(sums.data(), sums.data(), gdim)) / size : 0;
}
