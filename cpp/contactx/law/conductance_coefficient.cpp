// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#include "conductance_coefficient.h"
#include "../check.h"
#include "../math/scales.h"
#include "../text.h"
#include <algorithm>
#include <array>
#include <cmath>
#include <stdexcept>
#include <string>

using namespace contactx;
using namespace contactx::law;

namespace
{
/// Values plus a number, at least zero; NaN stays.
std::vector<double> clipped(std::span<const double> values, double by = 0)
{
  std::vector<double> result(values.begin(), values.end());
  for (double& v : result)
    v = std::max(v + by, 0.);
  return result;
}

void check_count(std::size_t size, std::size_t n)
{
  if (size != n)
    throw std::invalid_argument("coefficient() of a conductance returned "
                                + std::to_string(size) + " values for "
                                + std::to_string(n)
                                + " nodes: return a value for each");
}

bool is_finite(const std::vector<double>& values)
{
  return std::ranges::all_of(values, [](double v) { return std::isfinite(v); });
}
} // namespace

Coefficient::Coefficient(double value) : _value(value)
{
  if (not std::isfinite(value) or value < 0)
    throw std::invalid_argument("coefficient is " + number_text(value, 6)
                                + ": give a finite number of at least 0");
}

Coefficient::Coefficient(Function function, GradientFunction gradient)
    : _function(std::move(function)), _gradient(std::move(gradient))
{
  check::require(bool(_function), "the coefficient of a conductance is empty: "
                                  "give a number or a function");
}

std::vector<double> Coefficient::values(std::span<const double> pressure,
                                        std::span<const double> gap) const
{
  check::rows(gap.size(), pressure.size(), 1, "gap");
  return evaluate(clipped(pressure), clipped(gap));
}

std::vector<double> Coefficient::evaluate(std::span<const double> pressure,
                                          std::span<const double> gap) const
{
  if (not _function or pressure.empty())
    return std::vector<double>(pressure.size(), _value);
  std::vector<double> h = _function(pressure, gap);
  check_count(h.size(), pressure.size());
  check::require(
      is_finite(h) and std::ranges::all_of(h, [](double v) { return v >= 0; }),
      "coefficient() of a conductance is negative or not finite: it must not "
      "be for any pressure and gap of at least zero");
  return h;
}

Gradient Coefficient::evaluate_gradient(std::span<const double> pressure,
                                        std::span<const double> gap) const
{
  if (pressure.empty())
    return {};
  Gradient found = _gradient(pressure, gap);
  for (const auto& part : {found.by_pressure, found.by_gap})
  {
    check_count(part.size(), pressure.size());
    check::require(is_finite(part), "a derivative of the coefficient of a "
                                    "conductance is not finite: it must be for "
                                    "any pressure and gap of at least zero");
  }
  return found;
}

Gradient Coefficient::gradient(std::span<const double> pressure,
                               std::span<const double> gap,
                               mesh::Ranks& ranks) const
{
  const std::size_t n = pressure.size();
  ranks.agree([&] { check::rows(gap.size(), n, 1, "gap"); });
  const std::array<std::vector<double>, 2> at{clipped(pressure), clipped(gap)};
  Gradient result{std::vector<double>(n, 0), std::vector<double>(n, 0)};
  if (not _function)
    return result;
  if (_gradient)
  {
    ranks.agree([&] { result = evaluate_gradient(at[0], at[1]); });
    return result;
  }
  for (const int k : {0, 1})
  {
    double most = 0;
    for (const double v : at[k])
      most = std::max(most, v);
    most = mesh::largest(ranks, most);
    if (most == 0)
      continue;
    const double step = math::negligible_part * most;
    auto high = at, low = at;
    high[k] = clipped(at[k], step);
    low[k] = clipped(at[k], -step);
    ranks.agree(
        [&]
        {
          const auto above = evaluate(high[0], high[1]);
          const auto below = evaluate(low[0], low[1]);
          auto& slope = k == 0 ? result.by_pressure : result.by_gap;
          for (std::size_t i = 0; i < n; ++i)
            slope[i] = (above[i] - below[i]) / (high[k][i] - low[k][i]);
        });
  }
  return result;
}
