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

namespace
{
/// Linear solves after which a step is cut: this many times those of the step
/// before it, and no fewer than these. Sheets that are bent and drawn take the
/// same, within a tenth, for 2 to 5 times and 10 to 32 solves
constexpr int budget_ratio = 4, least_budget = 32;
/// Linear solves that an accepted step counts for at least towards a longer
/// one: extrapolated steps, and those of bodies that nothing presses, take none
constexpr int least_cost = 4;
/// Failures in a row from which on a step is not extrapolated: the way turns
constexpr int plain_failures = 2;
} // namespace

StepPlan::StepPlan(std::vector<double> given, int max_cuts,
                   std::optional<int> easy)
    : _given(std::move(given)), _max_cuts(max_cuts), _easy(easy)
{
  check::require(not _given.empty(), "steps must have at least one t");
  check::require(0 <= max_cuts and max_cuts <= 40,
                 "max_cuts must be from 0 to 40");
  check::require(not easy or *easy >= 0, "easy must be at least 0");
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

Attempt StepPlan::attempt() const
{
  Attempt attempt{t(), next(), 0, {}};
  if (_length > 0 and _failures < plain_failures)
    attempt.ratio = (attempt.end - attempt.start) / _length;
  // The first step has nothing to be measured against
  if (shorter() and _cost > 0)
    attempt.budget = std::max(least_budget, budget_ratio * _cost);
  return attempt;
}

void StepPlan::accept(int iterations)
{
  const double end = next(), part = share();
  _length = end - t();
  _cost = iterations;
  _debt = std::max(_debt - std::max(iterations, least_cost), 0);
  const bool grows
      = _easy ? iterations <= *_easy and _failures == 0 : _debt == 0;
  if (grows)
    _cuts = std::max(_cuts - 1, 0);
  _failures = 0;
  _done = part;
  if (part < 1)
    return;
  ++_number;
  _start = end;
  _done = 0;
}

/// How often the step that has failed is to be halved; nothing if it may not
/// be.
std::optional<int> StepPlan::shorter() const
{
  int cuts = _cuts + 1;
  // The rest of a given step may be shorter than what was to be attempted
  while (_done + std::ldexp(1.0, -cuts) >= 1)
    ++cuts;
  return cuts > _max_cuts ? std::nullopt : std::optional(cuts);
}

bool StepPlan::cut(int iterations)
{
  const std::optional<int> cuts = shorter();
  if (not cuts)
    return false;
  _cuts = *cuts;
  ++_failures;
  _debt = iterations;
  return true;
}

std::vector<double> StepPlan::place() const
{
  return {static_cast<double>(_number),
          _start,
          _done,
          static_cast<double>(_cuts),
          static_cast<double>(_debt),
          static_cast<double>(_cost),
          _length};
}

void StepPlan::load(std::span<const double> given,
                    std::span<const double> place)
{
  check::require(place.size() == 7, "place must have seven numbers");
  StepPlan saved({given.begin(), given.end()}, _max_cuts, _easy);
  saved._number = static_cast<std::size_t>(place[0]);
  check::require(saved._number <= saved._given.size(),
                 "place must be on the way of its steps");
  saved._start = place[1];
  saved._done = place[2];
  saved._cuts = static_cast<int>(place[3]);
  saved._debt = static_cast<int>(place[4]);
  saved._cost = static_cast<int>(place[5]);
  saved._length = place[6];
  if (saved._given != _given)
  {
    const double t = saved.t();
    if (t > _given.back())
      throw std::invalid_argument("it is at t = " + number_text(t, 6)
                                  + ", beyond the last given t = "
                                  + number_text(_given.back(), 6));
    const auto after = std::ranges::upper_bound(_given, t);
    const double length = saved._length;
    saved = StepPlan(_given, _max_cuts, _easy);
    saved._number = after - _given.begin();
    saved._start = t;
    saved._length = length;
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
