// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#include "transfer.h"
#include "../check.h"
#include <algorithm>
#include <cmath>
#include <limits>

using namespace contactx;
using namespace contactx::results;

Transfer::Transfer(const contact::Contact& contact)
    : _halo(contact.halo()), _weights(contact.master()->weights()),
      _normals(contact.master()->normals()), _area(contact.nodes()->area)
{
  const std::size_t n = _area.size();
  _of_slave = grouped(_weights.slaves, n);
  _is_paired.assign(n, 0);
  const std::vector<std::int8_t>& left_out = contact.is_left_out();
  for (std::size_t i = 0; i < n; ++i)
  {
    _is_paired[i]
        = not _of_slave[i].empty() and _area[i] > 0 and not left_out[i];
    if (not _is_paired[i])
      _area[i] = 0;
  }
  _is_slave.assign(_halo.num_nodes(), 0);
  if (not contact.is_self())
  {
    for (const std::int32_t node : contact.slaves().around())
      _is_slave[node] = 1;
    return;
  }
  // All nodes may be slaves: those that are now
  std::vector<std::int64_t> marks(_halo.num_nodes(), 0);
  const auto owned = contact.slaves().owned();
  for (std::size_t i = 0; i < n; ++i)
    marks[owned[i]] = _is_paired[i];
  _halo.forward(std::span(marks), 1);
  std::ranges::copy(marks, _is_slave.begin());
}

/// Calls f(slave, node, weight) for all entries of paired slave nodes.
template <class F>
void Transfer::for_each(F&& f) const
{
  for (std::size_t e = 0; e < _weights.values.size(); ++e)
    if (const std::int32_t i = _weights.slaves[e]; _is_paired[i])
      f(i, _weights.nodes[e], _weights.values[e]);
}

std::vector<double> Transfer::differences(std::span<const double> field) const
{
  check::rows(field.size(), _halo.num_nodes(), 1, "field");
  std::vector<double> differences(_area.size(), 0);
  for_each([&](std::int32_t i, std::int32_t node, double w)
           { differences[i] += w * field[node]; });
  return differences;
}

void Transfer::add(std::span<const double> flow, std::span<double> b) const
{
  check::rows(flow.size(), _area.size(), 1, "flow");
  check::rows(b.size(), _halo.num_nodes(), 1, "b");
  for_each([&](std::int32_t i, std::int32_t node, double w)
           { b[node] += w * flow[i]; });
}

Triplets Transfer::by_field(std::span<const double> h) const
{
  check::rows(h.size(), _area.size(), 1, "h");
  Triplets entries;
  for (std::size_t i = 0; i < _area.size(); ++i)
    if (_is_paired[i])
      for (const std::int32_t row : _of_slave[i])
        for (const std::int32_t column : _of_slave[i])
          entries.add(_weights.nodes[row], _weights.nodes[column],
                      h[i] * _area[i] * _weights.values[row]
                          * _weights.values[column]);
  return merged(entries, _halo.num_nodes(), _halo.num_nodes());
}

Triplets Transfer::by_displacement(std::span<const double> factor) const
{
  check::rows(factor.size(), _area.size(), 1, "factor");
  const int g = _halo.gdim();
  Triplets entries;
  for (std::size_t i = 0; i < _area.size(); ++i)
    if (_is_paired[i] and factor[i] != 0)
      for (const std::int32_t row : _of_slave[i])
        for (const std::int32_t column : _of_slave[i])
          for (int k = 0; k < g; ++k)
            entries.add(_weights.nodes[row], g * _weights.nodes[column] + k,
                        factor[i] * _weights.values[row] * _normals[3 * i + k]
                            * _weights.values[column]);
  return merged(entries, _halo.num_nodes(), std::size_t(g) * _halo.num_nodes());
}

Triplets Transfer::by_slaves(std::span<const double> factor) const
{
  check::rows(factor.size(), _area.size(), 1, "factor");
  Triplets entries;
  for_each([&](std::int32_t i, std::int32_t node, double w)
           { entries.add(node, i, w * factor[i]); });
  return merged(entries, _halo.num_nodes(), _area.size());
}

std::vector<double> Transfer::at_master(std::span<const double> values) const
{
  _halo.ranks().agree(
      [&] { check::rows(values.size(), _area.size(), 1, "values"); });
  std::vector<double> sums(2 * std::size_t(_halo.num_nodes()), 0);
  for_each(
      [&](std::int32_t i, std::int32_t node, double w)
      {
        if (_is_slave[node])
          return;
        // By their sizes: dual functions and quadratic shape functions change
        // sign, and some of these have no integral
        const double part = _area[i] * std::abs(w);
        sums[2 * node] += part * values[i];
        sums[2 * node + 1] += part;
      });
  _halo.reverse(sums, 2);
  std::vector<double> means(_halo.num_owned());
  for (std::size_t i = 0; i < means.size(); ++i)
    means[i] = sums[2 * i + 1] > 0 ? sums[2 * i] / sums[2 * i + 1]
                                   : std::numeric_limits<double>::quiet_NaN();
  return means;
}
