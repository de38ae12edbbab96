// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#pragma once

#include <array>
#include <cmath>
#include <cstddef>

/// @brief Contact from node or surface to surface, free of DOLFINx and PETSc.
///
/// Coordinates that are zero or from 1e-50 to 1e50 in magnitude give finite
/// results or none; beyond, products of them may be infinite or NaN, as may
/// what follows from a coordinate that is no number. Sizes and numbers of nodes
/// are taken for granted: the bindings check them.
namespace contactx
{
/// @brief Point or vector with `D` components.
template <int D>
using Vector = std::array<double, D>;

template <std::size_t D>
constexpr std::array<double, D> operator+(std::array<double, D> a,
                                          const std::array<double, D>& b)
{
  for (std::size_t k = 0; k < D; ++k)
    a[k] += b[k];
  return a;
}

template <std::size_t D>
constexpr std::array<double, D> operator-(std::array<double, D> a,
                                          const std::array<double, D>& b)
{
  for (std::size_t k = 0; k < D; ++k)
    a[k] -= b[k];
  return a;
}

template <std::size_t D>
constexpr std::array<double, D> operator*(double s, std::array<double, D> a)
{
  for (std::size_t k = 0; k < D; ++k)
    a[k] *= s;
  return a;
}

template <std::size_t D>
constexpr double dot(const std::array<double, D>& a,
                     const std::array<double, D>& b)
{
  double s = 0;
  for (std::size_t k = 0; k < D; ++k)
    s += a[k] * b[k];
  return s;
}

template <std::size_t D>
double norm(const std::array<double, D>& a)
{
  return std::sqrt(dot(a, a));
}

constexpr Vector<3> cross(const Vector<3>& a, const Vector<3>& b)
{
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2],
          a[0] * b[1] - a[1] * b[0]};
}
} // namespace contactx
