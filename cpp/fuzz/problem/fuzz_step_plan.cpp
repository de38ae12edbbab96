// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#include "../input.h"
#include "../require.h"
#include <algorithm>
#include <contactx/problem/step_plan.h>
#include <optional>
#include <stdexcept>
#include <vector>

using namespace contactx::fuzz;
using contactx::problem::StepPlan;

/// Accepted and failed steps in any order: each given t is met, and a saved
/// place goes on where it was.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data,
                                      std::size_t size)
{
  Input in(data, size);
  std::vector<double> given(in.below(6));
  double t = 0;
  for (double& end : given)
    end = t += 0.25 * (in.below(12) - 1);
  std::optional<StepPlan> made;
  try
  {
    made.emplace(given, in.below(45) - 2, in.below(20) - 1);
  }
  catch (const std::invalid_argument&)
  {
    return 0;
  }
  StepPlan& plan = *made;
  std::vector<double> met;
  for (int k = 0; k < 200 and not plan.finished(); ++k)
  {
    const double from = plan.t(), to = plan.next();
    require(from < to and to <= given.back(),
            "steps go forward, to a given t at most");
    if (in.flag())
    {
      plan.accept(in.below(30));
      require(plan.t() == to, "an accepted step is where it was to end");
      met.push_back(to);
    }
    else if (plan.cut(in.below(60)))
      require(plan.t() == from and plan.next() < to,
              "a failed step is shorter next time");
    else
      require(plan.next() == to, "what cannot be cut stays");
    StepPlan other(given, plan.max_cuts(), plan.easy());
    other.load(plan.given(), plan.place());
    require(other.t() == plan.t(), "a saved place is the same");
    require(plan.finished() or other.next() == plan.next(),
            "a saved place goes on alike");
  }
  if (plan.finished())
    for (const double wanted : given)
      require(std::ranges::find(met, wanted) != met.end(),
              "each given t is met");
  return 0;
}
