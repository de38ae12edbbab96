// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#include "quadrature.h"
#include <numbers>

using namespace contactx::geometry;

namespace
{
// Of fixed size: kernels must not allocate, not even at their first call
using Rule = std::array<GaussPoint, max_points>;

Rule make(int n)
{
  Rule rule{};
  for (int i = 0; i < n; ++i)
  {
    // Newton's method for the roots of the Legendre polynomial
    double x = std::cos(std::numbers::pi * (i + 0.75) / (n + 0.5));
    double slope = 1;
    for (int it = 0; it < 50; ++it)
    {
      double p = x, q = 1;
      for (int k = 2; k <= n; ++k)
      {
        const double next = ((2 * k - 1) * x * p - (k - 1) * q) / k;
        q = p;
        p = next;
      }
      slope = n * (x * p - q) / (x * x - 1);
      const double step = p / slope;
      x -= step;
      if (std::abs(step) < 1e-16)
        break;
    }
    rule[i] = {0.5 * (1 - x), 1 / ((1 - x * x) * slope * slope)};
  }
  return rule;
}
} // namespace

std::span<const GaussPoint> contactx::geometry::gauss(int n)
{
  static const auto rules = []
  {
    std::array<Rule, max_points + 1> all{};
    for (int i = 1; i <= max_points; ++i)
      all[i] = make(i);
    return all;
  }();
  return {rules[n].data(), static_cast<std::size_t>(n)};
}
