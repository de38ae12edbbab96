// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#include "predictor.h"
#include "../../math/scales.h"
#include <algorithm>
#include <cmath>
#include <utility>

using namespace contactx;
using namespace contactx::condense;

namespace
{
using Values = std::vector<double>;

// Number of last steps that are kept, and of those whose increments are
// combined
constexpr std::size_t num_steps_kept = 4, num_steps_combined = 2;
// Relative distance of a step's load from the multiples of this one's, up to
// which loads are proportional
constexpr double max_load_deviation = 0.1;

/// Adds, y += factor x
void add(std::span<double> y, double factor, std::span<const double> x)
{
  for (std::size_t i = 0; i < y.size(); ++i)
    y[i] += factor * x[i];
}

void scale(std::span<double> x, double factor)
{
  for (double& value : x)
    value *= factor;
}

/// Value after some of a polynomial, the last one first
Values next(std::span<const Values> values)
{
  Values sum(values.front().size(), 0);
  const auto n = static_cast<double>(values.size());
  double binomial = 1;
  for (std::size_t k = 0; k < values.size(); ++k)
  {
    const auto at = static_cast<double>(k);
    binomial *= (n - at) / (at + 1);
    add(sum, k % 2 == 0 ? binomial : -binomial, values[k]);
  }
  return sum;
}
} // namespace

void Predictor::reset()
{
  _steps.clear();
  _start.reset();
  _load.reset();
  _is_first = false;
}

void Predictor::begin_step(std::vector<double> unknowns)
{
  if (_start and _load)
  {
    // Newton's method subtracts what it solves for
    add(*_start, -1, unknowns);
    _steps.push_front({std::move(*_start), std::move(*_load)});
    if (_steps.size() > num_steps_kept)
      _steps.pop_back();
  }
  _start = std::move(unknowns);
  _load.reset();
  _is_first = true;
}

std::optional<std::vector<double>>
Predictor::start(CondensedOperator& K_c, std::span<const double> factors,
                 std::span<const double> b, std::span<const double> rhs,
                 std::span<double> v, double tolerance)
{
  if (not std::exchange(_is_first, false))
    return std::nullopt;
  _load.emplace(b.begin(), b.end());
  if (_steps.empty())
    return std::nullopt;
  if (auto increment = extrapolated(K_c, b))
  {
    const Values start = K_c.unknowns(*increment, factors);
    Values product(start.size());
    K_c.multiply(start, product);
    add(product, -1, rhs);
    if (norm(K_c.numbering().ranks(), product) <= tolerance)
      return increment;
  }
  combine(K_c, factors, rhs, v);
  return std::nullopt;
}

std::optional<std::vector<double>>
Predictor::extrapolated(CondensedOperator& K_c, std::span<const double> b) const
{
  mesh::Ranks& ranks = K_c.numbering().ranks();
  const double size = norm(ranks, b);
  std::vector<Values> increments;
  for (const Step& step : _steps)
  {
    // Increment of a load that grows as before
    const double part = size > 0 ? dot(ranks, step.load, b) / (size * size) : 0;
    Values rest = step.load;
    add(rest, -part, b);
    if (part == 0
        or norm(ranks, rest) > max_load_deviation * std::abs(part) * size)
      break;
    increments.push_back(step.increment);
    scale(increments.back(), 1 / part);
  }
  if (increments.size() < 2)
    return std::nullopt;
  // What would have served best for the last step
  std::size_t order = 1;
  double least = INFINITY;
  for (std::size_t k = 1; k < increments.size(); ++k)
  {
    Values error = next(std::span(increments).subspan(1, k));
    add(error, -1, increments.front());
    if (const double size = norm(ranks, error); size < least)
    {
      least = size;
      order = k;
    }
  }
  // One more comes nearer where the polynomial has done so
  Values x = next(std::span(increments).first(order + 1));
  const auto prescribed = K_c.numbering().algebra().prescribed();
  for (std::size_t i = 0; i < prescribed.size(); ++i)
    if (prescribed[i])
      x[i] = b[i];
  return x;
}

void Predictor::combine(CondensedOperator& K_c, std::span<const double> factors,
                        std::span<const double> rhs, std::span<double> v) const
{
  mesh::Ranks& ranks = K_c.numbering().ranks();
  Values start(v.size(), 0), left(rhs.begin(), rhs.end());
  // Orthonormal products of the matrix, each with its vector
  std::vector<std::pair<Values, Values>> basis;
  for (std::size_t k = 0; k < std::min(_steps.size(), num_steps_combined); ++k)
  {
    Values vector = K_c.unknowns(_steps[k].increment, factors);
    Values product(vector.size());
    K_c.multiply(vector, product);
    const double size = norm(ranks, product);
    for (const auto& [other, of_other] : basis)
    {
      const double factor = dot(ranks, of_other, product);
      add(product, -factor, of_other);
      add(vector, -factor, other);
    }
    const double added = norm(ranks, product);
    if (added <= math::equal_rel_tol * size)
      continue;
    scale(vector, 1 / added);
    scale(product, 1 / added);
    const double factor = dot(ranks, product, left);
    add(start, factor, vector);
    add(left, -factor, product);
    basis.emplace_back(std::move(vector), std::move(product));
  }
  std::ranges::copy(start, v.begin());
}
