// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#pragma once

#include <Eigen/LU>
#include <contactx/math/matrix.h>
#include <vector>

namespace contactx::tests
{
/// @brief A x.
inline std::vector<double> product(const Eigen::MatrixXd& A,
                                   std::span<const double> x)
{
  std::vector<double> y(A.rows());
  Eigen::VectorXd::Map(y.data(), A.rows()) = A * math::column(x);
  return y;
}

/// @brief The x of A x = b.
inline std::vector<double> solution(const Eigen::MatrixXd& A,
                                    std::span<const double> b)
{
  std::vector<double> x(A.rows());
  Eigen::VectorXd::Map(x.data(), A.rows())
      = A.partialPivLu().solve(math::column(b));
  return x;
}
} // namespace contactx::tests
