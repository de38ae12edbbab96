// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#include "parameters.h"
#include "../text.h"
#include <algorithm>
#include <stdexcept>

using namespace contactx;

std::string geometry::text(std::span<const double> values)
{
  std::string all;
  for (double value : values)
    all += (all.empty() ? "" : ", ") + exact_text(value);
  return "[" + all + "]";
}

Vector<3> geometry::vector(std::span<const double> value, int gdim,
                           const char* name)
{
  if (std::ssize(value) != gdim
      or not std::ranges::all_of(value,
                                 [](double v) { return std::isfinite(v); }))
    throw std::invalid_argument(std::string(name) + " is " + text(value)
                                + ": give " + std::to_string(gdim)
                                + " finite numbers, as the mesh has");
  Vector<3> v{};
  std::ranges::copy(value, v.begin());
  return v;
}

std::vector<double> geometry::spun(std::span<const double> value, int size,
                                   const char* name)
{
  const bool is_finite
      = std::ranges::all_of(value, [](double v) { return std::isfinite(v); });
  if (not is_finite or (not value.empty() and std::ssize(value) != size))
    throw std::invalid_argument(
        std::string(name) + " is " + text(value) + ": give "
        + (size == 1 ? "a finite number"
                     : std::to_string(size)
                           + " finite numbers, a rotation "
                             "vector")
        + ", in radians");
  return {value.begin(), value.end()};
}

Vector<3> geometry::direction(std::span<const double> value, int gdim,
                              const char* name)
{
  Vector<3> v = vector(value, gdim, name);
  double largest = 0;
  for (double c : v)
    largest = std::max(largest, std::abs(c));
  if (largest == 0)
    throw std::invalid_argument(std::string(name)
                                + " is a zero vector: give a direction");
  // Squares of very small and very large components are none
  if (not(1e-100 < largest and largest < 1e100))
    for (double& c : v)
      c /= largest;
  const double length = norm(v);
  for (double& c : v)
    c /= length;
  return v;
}

double geometry::positive(double value, const char* name)
{
  if (not(std::isfinite(value) and value > 0))
    throw std::invalid_argument(std::string(name) + " is " + exact_text(value)
                                + ": give a positive number");
  return value;
}
