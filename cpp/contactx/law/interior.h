// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

namespace contactx::law
{
class NodeState;

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

  /// @brief Mehrotra's correction of dy + F dx = .. for an affine step: -W
  /// L(v)^-1
  /// [(W dx) o (W^-1 dy)], with W W = F and v = W x.
  ConeVector correction(const ConeVector& dx, const ConeVector& dy) const;

private:
  ConeVector mirrored(const ConeVector& v, const ConeVector& q) const;

  ConeVector _x, _u, _q;
  double _factor; // sqrt(det y / det x)
};

/// @brief Largest t with x + t dx inside the second-order cone; infinite if
/// there is none.
double step_to_boundary(const ConeVector& x, const ConeVector& dx);

/// @brief Slave nodes of a contact on the central path of a primal-dual
/// interior-point method.
///
/// A node has a pressure p and a slack s of its gap, both positive, and with
/// friction a traction t inside its bound b(p) and slacks w of its slip and
/// gamma of its length inside the cone gamma > |w|. On the path
///
///     p s = tau,  (b, t) o (gamma, w) = (2 tau, 0)
///
/// with Jordan's product o, which for tau -> 0 is Signorini's law and
/// Coulomb's. Linearised, a node is a layer of compliance s / p along the
/// normal and F_tt along the surface. n is the number of nodes, vectors are
/// row-major.
struct Interior
{
  /// @brief No node is on the path.
  /// @param[in] nodes Nodes of the contact.
  explicit Interior(const NodeState& nodes);

  /// The pair ((b, t), (gamma, w)) of a node
  ConePair pair(std::size_t i) const;
  ConeVector x(std::size_t i) const;
  ConeVector y(std::size_t i) const;

  int gdim;
  std::vector<std::int8_t> is_on;        ///< 1 at nodes on it (shape=(n))
  std::vector<std::int8_t> has_friction; ///< 1 with a second pair (shape=(n))
  std::vector<double> pressure, slack;   ///< p and s (shape=(n))
  /// b, and its derivative by p (shape=(n))
  std::vector<double> bound, by_pressure;
  std::vector<double> traction, slip; ///< t and w (shape=(n, gdim))
  std::vector<double> slip_length;    ///< gamma (shape=(n))
  std::vector<double> normal; ///< that p and t belong to (shape=(n, gdim))
  double target = 0;          ///< tau, energy/area
  /// Second-order terms of the corrector: dp ds (shape=(n)) and
  /// ConePair::correction (shape=(n, 1 + gdim))
  std::vector<double> product, correction;
};

/// @brief Complementarity function of nodes on the path and its derivatives,
/// times area and factor c; other nodes are open.
/// @param[in,out] nodes Nodes that have an interior state.
void interior_complementarity(NodeState& nodes);
} // namespace contactx::law
