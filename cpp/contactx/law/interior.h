// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#pragma once

#include <cstdint>
#include <vector>

namespace contactx::law
{
class NodeState;

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
