// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#include "factorised.h"
#include <algorithm>
#include <limits>

using namespace contactx;
using namespace contactx::condense;

namespace
{
// Iterations with the factors of the same Jacobian, but for rounding
constexpr int rounding_iterations = 4;
} // namespace

void FactorisedSolver::solve(std::span<const double> b, std::span<double> x,
                             double target, const Springs& springs,
                             bool is_last)
{
  {
    const Timing timing(_algebra, "Jacobian");
    _solver->assemble(springs);
  }
  if (_has_factors and _lost <= _tuning.renewal_cost)
  {
    const Timing timing(_algebra, "old factors");
    if (iterate(b, x, target,
                is_last ? rounding_iterations : _tuning.renewal_cost))
      return;
  }
  const Timing timing(_algebra, "factorisation");
  _has_factors = _solver->factorise();
  ++_factorisations;
  if (_has_factors)
  {
    _lost = 0;
    iterate(b, x, target, _tuning.renewal_cost);
  }
  else
    std::ranges::fill(x, std::numeric_limits<double>::infinity());
}

void FactorisedSolver::reset()
{
  _solver->reset();
  _has_factors = false;
  _lost = 0;
}

bool FactorisedSolver::iterate(std::span<const double> b, std::span<double> x,
                               double target, int most)
{
  const Iterations done = _solver->solve(b, x, target, most);
  _lost += done.count;
  _iterations += done.count;
  return done.converged();
}
