// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#include "obstacle.h"
#include <stdexcept>

using namespace contactx::obstacle;

void Geometry::resize(std::size_t n, int gdim)
{
  gap.resize(n);
  gradient.resize(n * gdim);
  normal.resize(n * gdim);
  curvature.resize(n * gdim * gdim);
}

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
  if (cosine <= -1 + 1e-12)
    throw std::invalid_argument(
        "an obstacle turns by 180 degrees within a step, which has no shortest "
        "way: take smaller steps");
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

std::vector<double> Placement::carry(std::span<const double> x,
                                     const Placement& to) const
{
  const std::size_t gdim = point.size();
  const std::vector<double> R = turn(to);
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
