// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#include "obstacle_tie.h"
#include "../check.h"
#include "../kernel/layout.h"
#include <algorithm>
#include <stdexcept>

using namespace contactx;
using namespace contactx::contact;

ObstacleTie::ObstacleTie(std::shared_ptr<obstacle::Obstacle> obstacle,
                         std::shared_ptr<const SlaveNodes> slaves,
                         std::span<const double> x, int gdim, double reach)
    : ObstacleMaster(std::move(obstacle), std::move(slaves), x, gdim, reach,
                     true),
      _first(_placed), _offset(size(), 0)
{
}

std::int32_t ObstacleTie::search(std::span<const double> x,
                                 std::span<const std::int8_t> closed)
{
  if (_found)
    return 0;
  _reference = at_slaves(x);
  _normal = _obstacle->evaluate(_reference, _gdim).normal;
  const std::int32_t changed = ObstacleMaster::search(x, closed);
  _found = true;
  return changed;
}

std::optional<std::vector<Pairs>>
ObstacleTie::update(std::span<const double> x, bool frozen,
                    std::span<const double> offset)
{
  check::rows(offset.size(), size(), 1, "offset", "slave node");
  std::ranges::copy(offset, _offset.begin());
  return ObstacleMaster::update(x, frozen, offset);
}

void ObstacleTie::update_slip(std::span<const double> at,
                              std::span<const double>)
{
  std::vector<double> place(_reference.size());
  for (std::size_t i = 0; i < place.size(); ++i)
    place[i] = _reference[i] + _offset[i / _gdim] * _normal[i];
  const std::vector<double> carried
      = _first.carry(place, _obstacle->placement(_gdim));
  std::ranges::fill(_slip, 0.0);
  for (std::size_t i = 0; i < size(); ++i)
  {
    double* row = &_slip[i * kernel::rigid_slip_size];
    for (int k = 0; k < _gdim; ++k)
    {
      row[kernel::rigid_slip + k] = at[_gdim * i + k] - carried[_gdim * i + k];
      row[kernel::rigid_slip_derivative + (_gdim + 1) * k] = 1;
    }
  }
}
