// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#pragma once

#include "interior.h"
#include <Eigen/Core>
#include <cstddef>

namespace contactx::law
{
/// @brief Vector of a second-order cone: a scalar, then a vector.
using ConeVector = Eigen::VectorXd;

/// @brief Pair x, y of vectors inside the second-order cone { v : v0 > |v1| },
/// with the scaling of Nesterov and Todd (SIAM J. Optim. 8, 1998): the matrix F
/// for which F x = y.
class ConePair
{
public:
  /// @brief Take a pair.
  /// @param[in] x Inside the cone.
  /// @param[in] y Inside the cone.
  ConePair(const ConeVector& x, const ConeVector& y);

  /// @brief F v.
  ConeVector scaled(const ConeVector& v) const;

  /// @brief Column of F by the scalar, and the block of the vectors.
  ConeVector first_column() const;
  Eigen::MatrixXd block() const;

  /// @brief Inverse of x by Jordan's product: J x / det x.
  ConeVector inverse() const;

  /// @brief Mehrotra's correction of dy + F dx = .. for an affine step:
  /// -W L(v)^-1 [(W dx) o (W^-1 dy)], with W W = F and v = W x.
  ConeVector correction(const ConeVector& dx, const ConeVector& dy) const;

private:
  ConeVector mirrored(const ConeVector& v, const ConeVector& q) const;

  ConeVector _x, _u, _q;
  double _factor; // sqrt(det y / det x)
};

/// @brief Largest t with x + t dx inside the second-order cone; infinite if
/// there is none.
double step_to_boundary(const ConeVector& x, const ConeVector& dx);

/// @brief (b, t) of a node.
ConeVector bound_and_traction(const Interior& in, std::size_t i);

/// @brief (gamma, w) of a node.
ConeVector slip_slacks(const Interior& in, std::size_t i);

/// @brief The pair of both.
ConePair pair_of(const Interior& in, std::size_t i);
} // namespace contactx::law
