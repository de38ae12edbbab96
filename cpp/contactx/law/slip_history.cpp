// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#include "slip_history.h"
#include <stdexcept>
#include <string>
#include <utility>

using namespace contactx::law;

SlipHistory::SlipHistory(std::int32_t num_nodes, int gdim)
    : _gdim(gdim), _slip(std::size_t(num_nodes) * gdim),
      _total(std::size_t(num_nodes)), _dissipation(std::size_t(num_nodes))
{
}

void SlipHistory::add(const NodeState& nodes)
{
  if (nodes.slip.size() != _slip.size())
    throw std::invalid_argument(
        "nodes must be the " + std::to_string(_total.size())
        + " slave nodes of the history, with vector multipliers");
  for (std::size_t i = 0; i < _total.size(); ++i)
  {
    double length = 0, work = 0;
    for (std::size_t k = _gdim * i; k < _gdim * (i + 1); ++k)
    {
      _slip[k] = nodes.closed(i) ? nodes.slip[k] : 0.0;
      length += _slip[k] * _slip[k];
      work += nodes.multiplier[k] * _slip[k];
    }
    _total[i] += std::sqrt(length);
    _dissipation[i] -= nodes.area[i] * work;
  }
}

void SlipHistory::restore(std::vector<double> slip, std::vector<double> total,
                          std::vector<double> dissipation)
{
  if (slip.size() != _slip.size() or total.size() != _total.size()
      or dissipation.size() != _dissipation.size())
    throw std::invalid_argument("slip, total and dissipation must be those of "
                                + std::to_string(_total.size())
                                + " slave nodes");
  _slip = std::move(slip);
  _total = std::move(total);
  _dissipation = std::move(dissipation);
}
