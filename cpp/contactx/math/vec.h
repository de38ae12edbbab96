// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>

/// @brief Contact from node or surface to surface, free of DOLFINx and PETSc.
///
/// Coordinates that are zero or from 1e-50 to 1e50 in magnitude give finite
/// results or none; beyond, products of them may be infinite or NaN, as may
/// what follows from a coordinate that is no number. Sizes and numbers of nodes
/// are taken for granted: the bindings check them.
namespace contactx
{
/// @brief Point or vector with `D` components: a plain array, as kernels read
/// and write rows of them, and programs include it without Eigen.
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

/// @brief Product of `gdim` components.
inline double dot(const double* a, const double* b, int gdim)
{
  double s = 0;
  for (int k = 0; k < gdim; ++k)
    s += a[k] * b[k];
  return s;
}

/// @brief Row of an array, zero behind its `gdim` components.
/// @param[in] values Rows (shape=(n, gdim)).
/// @param[in] i The row.
/// @param[in] gdim Its components.
inline Vector<3> vector_at(std::span<const double> values, std::size_t i,
                           int gdim)
{
  Vector<3> v{};
  for (int k = 0; k < gdim; ++k)
    v[k] = values[i * gdim + k];
  return v;
}

inline constexpr double infinity = std::numeric_limits<double>::infinity();

constexpr Vector<3> cross(const Vector<3>& a, const Vector<3>& b)
{
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2],
          a[0] * b[1] - a[1] * b[0]};
}
} // namespace contactx
