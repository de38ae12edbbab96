// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#pragma once

#include <array>

namespace contactx::mesh
{
/// @brief 27 numbers of a polynomial of degree two in each of three variables
/// on a unit cube, at [i + 3 * j + 9 * k], the first variable counting fastest:
/// its values at 0, 1/2 and 1, or its coefficients in Bernstein's basis.
///
/// The polynomial lies between the least and the largest of its coefficients,
/// and the coefficients of the corners are its values there.
using Triquadratic = std::array<double, 27>;

/// @brief Distance between neighbours along each variable.
constexpr std::array<int, 3> strides{1, 3, 9};

/// @brief Call f(first) for the first of each three numbers that lie along a
/// variable.
template <class Function>
constexpr void for_each_line(int variable, Function&& f)
{
  const int a = strides[(variable + 1) % 3], b = strides[(variable + 2) % 3];
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j)
      f(a * i + b * j);
}

/// @brief Coefficients of the polynomial that has given values.
constexpr Triquadratic coefficients(Triquadratic values)
{
  for (int variable = 0; variable < 3; ++variable)
    for_each_line(variable,
                  [&values, s = strides[variable]](int p)
                  {
                    values[p + s] = 2. * values[p + s]
                                    - 0.5 * (values[p] + values[p + 2 * s]);
                  });
  return values;
}

/// @brief Coefficients on one half of the cube, by de Casteljau's algorithm.
/// @param[in] b Coefficients on the cube.
/// @param[in] variable Which variable is halved.
/// @param[in] upper Whether it is the half with the larger values of it.
constexpr Triquadratic half(Triquadratic b, int variable, bool upper)
{
  for_each_line(variable,
                [&b, s = strides[variable], upper](int p)
                {
                  const double lower_middle = 0.5 * (b[p] + b[p + s]);
                  const double upper_middle = 0.5 * (b[p + s] + b[p + 2 * s]);
                  const double middle = 0.5 * (lower_middle + upper_middle);
                  b[p + s] = upper ? upper_middle : lower_middle;
                  b[upper ? p : p + 2 * s] = middle;
                });
  return b;
}
} // namespace contactx::mesh
