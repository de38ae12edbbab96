// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#include "mortar_slip.h"
#include "touching.h"
#include <stdexcept>

using namespace contactx::contact;

void MortarSlip::begin_step(Mortar now, std::vector<double> origin)
{
  _origin = std::move(origin);
  _gap = _sides->total(now.gap, now.slave);
  _start = std::move(now);
}

void MortarSlip::touch(std::span<const std::int8_t> which, const Mortar& now,
                       std::span<const double> offset,
                       std::span<const double> origin)
{
  const std::size_t n = _sides->size();
  if (not _start)
    throw std::logic_error("slip is measured before a step has begun");
  const std::vector<double> gaps = _sides->total(now.gap, now.slave);
  std::vector<std::int8_t> known(_sides->around().size(), 0);
  for (std::size_t p = 0; p < _start->size(); ++p)
    for (int s = 0; s < _start->width; ++s)
    {
      const auto row = _start->row(p, s);
      if (std::ranges::any_of(row, [](double w) { return w != 0; }))
        known[_sides->numbers(_start->slave[p])[s]] = 1;
    }
  std::vector<double> part(n, 0), rest(n);
  for (std::size_t i = 0; i < n; ++i)
  {
    // Nodes without a master at the start are measured from here
    if (which[i])
      part[i]
          = known[i] ? touching(_gap[i] - offset[i], gaps[i] - offset[i]) : 1.0;
    rest[i] = 1 - part[i];
  }
  const std::size_t g = n > 0 ? _origin.size() / n : 0;
  for (std::size_t k = 0; k < _origin.size(); ++k)
    _origin[k] = rest[k / g] * _origin[k] + part[k / g] * origin[k];
  _start = _start->scaled(_sides->at_corners(rest, _start->slave))
               .joined(now.scaled(_sides->at_corners(part, now.slave)));
}

Mortar MortarSlip::pairs(std::span<const double> area) const
{
  if (not _start)
    throw std::logic_error("slip is measured before a step has begun");
  return _start->scaled(_sides->at_corners(area, _start->slave));
}

std::span<const std::int32_t> MortarSlip::masters() const
{
  return _start ? std::span<const std::int32_t>(_start->master)
                : std::span<const std::int32_t>();
}

void MortarSlip::rename(std::span<const std::int32_t> numbers)
{
  if (_start)
    for (std::int32_t& f : _start->master)
      f = numbers[f];
}
