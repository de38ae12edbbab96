// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#include "obstacle_tie.h"
#include "../check.h"
#include "../kernel/layout.h"
#include <algorithm>
#include <stdexcept>

using namespace contactx;
using namespace contactx::contact;

ObstacleTie::ObstacleTie(std::shared_ptr<geometry::Obstacle> obstacle,
                         std::shared_ptr<const SlaveNodes> slaves,
                         std::span<const double> x, int gdim, double reach)
    : ObstacleMaster(std::move(obstacle), std::move(slaves), x, gdim, reach,
                     true),
      _offset(size(), 0)
{
}

std::int32_t ObstacleTie::search(std::span<const double> x,
                                 std::span<const std::int8_t> closed)
{
  if (_found)
    return 0;
  _place = at_slaves(x);
  _normal = _obstacle->evaluate(_place, _gdim).normal;
  const std::int32_t changed = ObstacleMaster::search(x, closed);
  _found = true;
  return changed;
}

std::optional<std::vector<kernel::Pairs>>
ObstacleTie::update(std::span<const double> x, bool frozen,
                    std::span<const double> offset)
{
  check::rows(offset.size(), size(), 1, "offset", "slave node");
  std::ranges::copy(offset, _offset.begin());
  return ObstacleMaster::update(x, frozen, offset);
}

void ObstacleTie::update_slip(std::span<const double> at,
                              std::span<const kernel::ObstaclePair>)
{
  std::vector<double> place = _place;
  for (std::size_t i = 0; i < place.size(); ++i)
    place[i] += _offset[i / _gdim] * _normal[i];
  const std::vector<double> carried
      = _obstacle->carry(place, _placed, _obstacle->placement(_gdim));
  for (std::size_t i = 0; i < size(); ++i)
  {
    _slip[i] = {};
    for (int k = 0; k < _gdim; ++k)
    {
      _slip[i].slip[k] = at[_gdim * i + k] - carried[_gdim * i + k];
      _slip[i].derivative[(_gdim + 1) * k] = 1;
    }
  }
}

void ObstacleTie::accept(std::span<const double> x)
{
  if (_found)
  {
    // Step by step: a velocity is that of the step alone
    std::vector<double> place
        = _obstacle->carry(_place, _placed, _obstacle->placement(_gdim));
    _normal = _obstacle->evaluate(place, _gdim).normal;
    _place = std::move(place);
  }
  ObstacleMaster::accept(x);
}

std::vector<Saved> ObstacleTie::save() const
{
  std::vector<Saved> saved = ObstacleMaster::save();
  if (_found)
  {
    saved.push_back({"place", RowKind::slave, _gdim, _place});
    saved.push_back({"normal", RowKind::slave, _gdim, _normal});
  }
  return saved;
}

void ObstacleTie::load(const std::vector<Saved>& saved)
{
  _found = false;
  if (has(saved, "place"))
  {
    std::vector<double> place = values_of_size(saved, "place", size(), _gdim);
    std::vector<double> normal = values_of_size(saved, "normal", size(), _gdim);
    ObstacleMaster::load(saved);
    _place = std::move(place);
    _normal = std::move(normal);
    _found = true;
  }
  else
    ObstacleMaster::load(saved);
}
