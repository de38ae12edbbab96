// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#include "springs.h"
#include "../math/scales.h"
#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

using namespace contactx;

namespace
{
double square(std::span<const double> row)
{
  double sum = 0;
  for (const double value : row)
    sum += value * value;
  return sum;
}
} // namespace

std::vector<double>
solve::independent_springs(mesh::Ranks& ranks, const dense::Matrix& field,
                           std::span<const std::int8_t> prescribed,
                           std::span<const double> diagonal,
                           std::span<const std::int64_t> original, int gdim)
{
  const std::size_t n = field.rows, k = field.cols;
  ranks.agree(
      [&]
      {
        if (gdim < 1 or prescribed.size() != n or diagonal.size() != n
            or original.size() * gdim < n)
          throw std::invalid_argument("field, prescribed, diagonal and "
                                      "original must be of the same owned "
                                      "nodes");
      });
  dense::Matrix left = field;
  for (std::size_t i = 0; i < n; ++i)
    if (prescribed[i] == 1)
      std::fill_n(&left.values[i * k], k, 0.0);
  std::vector<double> springs(n), direction(k), size(n);
  for (std::size_t spring = 0; spring < k; ++spring)
  {
    double most = 0;
    for (std::size_t i = 0; i < n; ++i)
    {
      size[i] = square(left.row(i));
      most = std::max(most, size[i]);
    }
    most = mesh::largest(ranks, most);
    // Modes that move nothing, or nothing that is free
    if (not(most > 0))
      break;
    // Of those that are equal the first one in the mesh as it was made
    std::int64_t mine = std::numeric_limits<std::int64_t>::max();
    std::size_t dof = n;
    for (std::size_t i = 0; i < n; ++i)
      if (math::is_largest(size[i], most))
      {
        const auto number
            = static_cast<std::int64_t>(original[i / gdim] * gdim + i % gdim);
        if (number < mine)
        {
          mine = number;
          dof = i;
        }
      }
    const bool is_mine = mesh::least(ranks, mine) == mine and dof < n;
    std::ranges::fill(direction, 0.0);
    if (is_mine)
    {
      std::ranges::copy(left.row(dof), direction.begin());
      springs[dof] = std::abs(diagonal[dof]);
    }
    if (ranks.size() > 1)
      ranks.reduce(std::span(direction), mesh::Reduction::sum);
    const double length = std::sqrt(square(direction));
    for (double& d : direction)
      d /= length;
    for (std::size_t i = 0; i < n; ++i)
    {
      if (size[i] == 0)
        continue;
      double along = 0;
      for (std::size_t j = 0; j < k; ++j)
        along += left(i, j) * direction[j];
      for (std::size_t j = 0; j < k; ++j)
        left(i, j) -= along * direction[j];
    }
  }
  return springs;
}
