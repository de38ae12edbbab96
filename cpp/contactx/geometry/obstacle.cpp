// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#include "obstacle.h"
#include "../math/scales.h"
#include <algorithm>
#include <cmath>
#include <stdexcept>

using namespace contactx::geometry;

void Geometry::resize(std::size_t n, int gdim)
{
  gap.resize(n);
  gradient.resize(n * gdim);
  normal.resize(n * gdim);
  curvature.resize(n * gdim * gdim);
}

/// Of the derivative of the normal that part which is along the surface is
/// symmetric, with two eigenvalues or one.
std::vector<double> Geometry::largest_curvatures(int gdim) const
{
  const std::size_t g = gdim;
  std::vector<double> largest(gap.size());
  for (std::size_t i = 0; i < largest.size(); ++i)
  {
    const double* n = &normal[g * i];
    double sum = 0, squares = 0;
    for (std::size_t j = 0; j < g; ++j)
    {
      const double* row = &curvature[g * (g * i + j)];
      double along = 0;
      for (std::size_t k = 0; k < g; ++k)
        along += row[k] * n[k];
      for (std::size_t k = 0; k < g; ++k)
      {
        const double turn = row[k] - along * n[k];
        squares += turn * turn;
        sum += j == k ? turn : 0;
      }
    }
    const double apart = std::max(2 * squares - sum * sum, 0.);
    largest[i] = (std::abs(sum) + std::sqrt(apart)) / 2;
  }
  return largest;
}

namespace
{
std::vector<double> product(const std::vector<double>& A,
                            const std::vector<double>& B, std::size_t n)
{
  std::vector<double> C(n * n);
  for (std::size_t i = 0; i < n; ++i)
    for (std::size_t k = 0; k < n; ++k)
      for (std::size_t j = 0; j < n; ++j)
        C[n * i + j] += A[n * i + k] * B[n * k + j];
  return C;
}

/// Rotation by a rotation vector: I + sin(a) K + (1 - cos(a)) K^2, with its
/// length a and the cross product K of its direction.
std::vector<double> rotation(std::span<const double> v)
{
  const double a = std::sqrt(v[0] * v[0] + v[1] * v[1] + v[2] * v[2]);
  std::vector<double> R{1, 0, 0, 0, 1, 0, 0, 0, 1};
  if (a == 0)
    return R;
  const double x = v[0] / a, y = v[1] / a, z = v[2] / a;
  const std::vector<double> K{0, -z, y, z, 0, -x, -y, x, 0};
  const std::vector<double> square = product(K, K, 3);
  for (int i = 0; i < 9; ++i)
    R[i] += std::sin(a) * K[i] + (1 - std::cos(a)) * square[i];
  return R;
}
} // namespace

std::vector<double> Placement::turn(const Placement& to) const
{
  const std::size_t gdim = point.size();
  std::vector<double> R(gdim * gdim, 0);
  for (std::size_t i = 0; i < gdim; ++i)
    R[gdim * i + i] = 1;
  if (direction.empty() or to.direction.empty())
    return R;
  // I + K + K^2 / (1 + a.b) with K = b a^T - a b^T
  const std::vector<double>&a = direction, &b = to.direction;
  std::vector<double> K(gdim * gdim);
  double cosine = 0;
  for (std::size_t i = 0; i < gdim; ++i)
  {
    cosine += a[i] * b[i];
    for (std::size_t j = 0; j < gdim; ++j)
      K[gdim * i + j] = b[i] * a[j] - a[i] * b[j];
  }
  if (cosine <= -1 + math::round_off)
    throw std::invalid_argument(
        "an obstacle turns by 180 degrees within a step, which has no shortest "
        "way: take smaller steps (manual: errors/obstacle-turns)");
  for (std::size_t i = 0; i < gdim; ++i)
    for (std::size_t j = 0; j < gdim; ++j)
    {
      double square = 0;
      for (std::size_t k = 0; k < gdim; ++k)
        square += K[gdim * i + k] * K[gdim * k + j];
      R[gdim * i + j]
          = R[gdim * i + j] + K[gdim * i + j] + square / (1 + cosine);
    }
  return R;
}

/// Rotation of the material about the direction of another placement, or by the
/// difference of rotation vectors.
std::vector<double> Placement::spin(const Placement& to) const
{
  const std::size_t gdim = point.size();
  if (gdim == 3 and angle.size() == 3)
  {
    std::vector<double> back = rotation(angle), R(9);
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j)
        R[3 * i + j] = back[3 * j + i];
    return product(rotation(to.angle), R, 3);
  }
  const double by = to.angle[0] - angle[0];
  if (gdim == 2)
    return {std::cos(by), -std::sin(by), std::sin(by), std::cos(by)};
  std::vector<double> vector = to.direction;
  for (double& component : vector)
    component *= by;
  return rotation(vector);
}

std::vector<double> Placement::carry(std::span<const double> x,
                                     const Placement& to) const
{
  const std::size_t gdim = point.size();
  std::vector<double> R = turn(to);
  if (not angle.empty() and angle.size() == to.angle.size())
    R = product(spin(to), R, gdim);
  std::vector<double> carried(x.size());
  for (std::size_t row = 0; row + gdim <= x.size(); row += gdim)
    for (std::size_t i = 0; i < gdim; ++i)
    {
      double y = 0;
      for (std::size_t k = 0; k < gdim; ++k)
        y += (x[row + k] - point[k]) * R[gdim * i + k];
      carried[row + i] = to.point[i] + y;
    }
  return carried;
}

std::vector<double> Obstacle::carry(std::span<const double> x,
                                    const Placement& from, const Placement& to)
{
  return from.carry(x, to);
}

std::vector<double> Obstacle::distance(std::span<const double> x, int gdim)
{
  return evaluate(x, gdim).gap;
}

std::vector<double> Obstacle::normals(std::span<const double> x, int gdim)
{
  return evaluate(x, gdim).normal;
}

std::vector<double> Obstacle::level(std::span<const double> x, int gdim)
{
  return distance(x, gdim);
}
