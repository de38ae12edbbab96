// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#include "node_state.h"
#include "../check.h"
#include "../mesh/extent.h"
#include <algorithm>
#include <array>
#include <stdexcept>
#include <string>

using namespace contactx;
using namespace contactx::law;

namespace
{
std::size_t checked(std::int32_t num_nodes, int gdim)
{
  if (num_nodes < 0)
    throw std::invalid_argument("num_nodes must not be negative, as "
                                + std::to_string(num_nodes) + " is");
  check::dimension(gdim);
  return num_nodes;
}
} // namespace

NodeState::NodeState(std::int32_t num_nodes, int gdim, bool is_vector,
                     bool has_means)
    : _num_nodes(num_nodes), _gdim(gdim), _size(is_vector ? gdim : 1),
      _is_vector(is_vector)
{
  const std::size_t n = checked(num_nodes, gdim);
  const std::size_t rows = is_vector ? n : 0;
  multiplier.assign(n * _size, 0.0);
  before.assign(n * _size, 0.0);
  area.assign(n, 0.0);
  status.assign(n, law::open);
  gap.assign(n, std::numeric_limits<double>::quiet_NaN());
  normal.assign(rows * gdim, 0.0);
  slip.assign(rows * gdim, 0.0);
  c.assign(n, 1.0);
  immobile.assign(n, 0);
  mobile.assign(rows * gdim, 1.0);
  redundant.assign(n, 0);
  frictionless.assign(n, 0);
  slip_reversals.assign(n, 0);
  slip_closings.assign(n, 0);
  value.assign(n * _size, 0.0);
  by_multiplier.assign(n * _size * _size, 0.0);
  by_gap.assign(n * _size, 0.0);
  by_slip.assign(rows * gdim * gdim, 0.0);
  by_normal.assign(rows * gdim * gdim, 0.0);
  if (is_vector and has_means)
    mean.emplace(num_nodes, gdim);
}

void NodeState::set_factor(mesh::Ranks& ranks,
                           std::span<const double> compliance)
{
  ranks.agree(
      [&]
      {
        if (compliance.size() != area.size())
          throw std::invalid_argument(
              "compliance must have a value for each of "
              + std::to_string(area.size()) + " slave nodes, not "
              + std::to_string(compliance.size()));
      });
  std::array<double, 2> sums{};
  for (std::size_t i = 0; i < area.size(); ++i)
  {
    // Not yet the factor
    c[i] = compliance[i] * area[i];
    if (c[i] > 0)
    {
      sums[0] += std::log(c[i]);
      sums[1] += 1;
    }
  }
  if (ranks.size() > 1)
    ranks.reduce(std::span<double>(sums), mesh::Reduction::sum);
  // Where nothing can move: the geometric mean of the others
  const double usual = sums[1] > 0 ? std::exp(sums[0] / sums[1]) : 1.0;
  for (double& factor : c)
    factor = 1 / (factor > 0 ? factor : usual);
}

void NodeState::close(std::span<const std::int32_t> nodes)
{
  check::numbers(nodes, _num_nodes, "nodes", "slave nodes");
  for (std::int32_t i : nodes)
    status[i] = is_vector() and not frictionless[i] ? law::stick : law::slip;
}

void NodeState::drop_open()
{
  for (std::size_t i = 0; i < status.size(); ++i)
    if (not closed(i))
      std::fill_n(multiplier.begin() + _size * i, _size, 0.0);
}

void NodeState::normalise()
{
  if (mean)
    mean->normalise(normal, mobile);
}

void NodeState::project(std::span<const double> origin)
{
  if (not origin.empty() and origin.size() != slip.size())
    throw std::invalid_argument(
        "origin must have " + std::to_string(slip.size()) + " values, "
        + std::to_string(_gdim) + " for each slave node, not "
        + std::to_string(origin.size()));
  if (not mean)
    return;
  for (std::size_t k = 0; k < origin.size(); ++k)
    slip[k] -= origin[k];
  mean->project(normal, slip, mobile);
}

double contactx::law::touching_gap(mesh::Ranks& ranks,
                                   std::span<const double> x, int gdim)
{
  ranks.agree(
      [&]
      {
        checked(0, gdim);
        if (x.size() % gdim != 0)
          throw std::invalid_argument("x must have " + std::to_string(gdim)
                                      + " coordinates a node, not "
                                      + std::to_string(x.size()) + " in all");
      });
  return mesh::scales(ranks, x, gdim).gap_round_off();
}
