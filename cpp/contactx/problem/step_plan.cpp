// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#include "step_plan.h"
#include "../check.h"
#include "../text.h"
#include <algorithm>
#include <cmath>
#include <stdexcept>

using namespace contactx;
using namespace contactx::problem;

StepPlan::StepPlan(std::vector<double> given, int max_cuts, int easy)
    : _given(std::move(given)), _max_cuts(max_cuts), _easy(easy)
{
  check::require(not _given.empty(), "steps must have at least one t");
  check::require(0 <= max_cuts and max_cuts <= 40,
                 "max_cuts must be from 0 to 40");
  check::require(easy >= 0, "easy must be at least 0");
  double before = 0;
  for (const double t : _given)
  {
    if (not(t > before) or not std::isfinite(t))
      throw std::invalid_argument("steps holds " + number_text(t, 6) + " after "
                                  + number_text(before, 6)
                                  + ": each t must be larger than the last");
    before = t;
  }
}

std::vector<double> StepPlan::equal(int count, double t_end)
{
  check::require(count >= 1, "the number of steps must be at least 1");
  std::vector<double> given(count);
  for (int k = 0; k < count; ++k)
    given[k] = t_end * (double(k + 1) / count);
  return given;
}

void StepPlan::accept(int iterations)
{
  const double end = next(), part = share();
  if (iterations <= _easy and not _has_failed)
    _cuts = std::max(_cuts - 1, 0);
  _has_failed = false;
  _done = part;
  if (part < 1)
    return;
  ++_number;
  _start = end;
  _done = 0;
}

bool StepPlan::cut()
{
  int cuts = _cuts + 1;
  // The rest of a given step may be shorter than what was to be attempted
  while (_done + std::ldexp(1.0, -cuts) >= 1)
    ++cuts;
  if (cuts > _max_cuts)
    return false;
  _cuts = cuts;
  _has_failed = true;
  return true;
}

std::vector<double> StepPlan::place() const
{
  return {static_cast<double>(_number), _start, _done,
          static_cast<double>(_cuts)};
}

void StepPlan::load(std::span<const double> given,
                    std::span<const double> place)
{
  check::require(place.size() == 4, "place must have four numbers");
  StepPlan saved({given.begin(), given.end()}, _max_cuts, _easy);
  saved._number = static_cast<std::size_t>(place[0]);
  check::require(saved._number <= saved._given.size(),
                 "place must be on the way of its steps");
  saved._start = place[1];
  saved._done = place[2];
  saved._cuts = static_cast<int>(place[3]);
  if (saved._given != _given)
  {
    const double t = saved.t();
    if (t > _given.back())
      throw std::invalid_argument("it is at t = " + number_text(t, 6)
                                  + ", beyond the last given t = "
                                  + number_text(_given.back(), 6));
    const auto after = std::ranges::upper_bound(_given, t);
    saved = StepPlan(_given, _max_cuts, _easy);
    saved._number = after - _given.begin();
    saved._start = t;
  }
  *this = std::move(saved);
}

double StepPlan::share() const
{
  return std::min(_done + std::ldexp(1.0, -_cuts), 1.0);
}

double StepPlan::at(double share) const
{
  const double end = _given[_number];
  return share == 1 ? end : _start + share * (end - _start);
}
