// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#include "springs.h"
#include "../math/scales.h"
#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

using namespace contactx;

std::vector<double>
solve::independent_springs(mesh::Ranks& ranks, const Eigen::MatrixXd& field,
                           std::span<const std::int8_t> prescribed,
                           std::span<const double> diagonal,
                           std::span<const std::int64_t> original, int gdim)
{
  const std::size_t n = field.cols(), k = field.rows();
  ranks.agree(
      [&]
      {
        if (gdim < 1 or prescribed.size() != n or diagonal.size() != n
            or original.size() * gdim < n)
          throw std::invalid_argument("field, prescribed, diagonal and "
                                      "original must be of the same owned "
                                      "nodes");
      });
  Eigen::MatrixXd left = field;
  for (std::size_t i = 0; i < n; ++i)
    if (prescribed[i] == 1)
      left.col(i).setZero();
  std::vector<double> springs(n), size(n);
  Eigen::VectorXd direction(k);
  for (std::size_t spring = 0; spring < k; ++spring)
  {
    double most = 0;
    for (std::size_t i = 0; i < n; ++i)
    {
      size[i] = left.col(i).squaredNorm();
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
    direction.setZero();
    if (is_mine)
    {
      direction = left.col(dof);
      springs[dof] = std::abs(diagonal[dof]);
    }
    if (ranks.size() > 1)
      ranks.reduce(std::span(direction.data(), k), mesh::Reduction::sum);
    direction /= direction.norm();
    for (std::size_t i = 0; i < n; ++i)
      if (size[i] != 0)
        left.col(i) -= left.col(i).dot(direction) * direction;
  }
  return springs;
}
