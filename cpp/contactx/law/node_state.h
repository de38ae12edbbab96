// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#pragma once

#include "../mesh/ranks.h"
#include "interior.h"
#include "mean_normal.h"
#include "normal.h"
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <span>
#include <vector>

namespace contactx::law
{
/// @brief State of the slave nodes of one contact that this rank owns: what a
/// law reads and writes.
///
/// Arrays are row-major, n is the number of nodes, and size that of components
/// of a multiplier. What only vectors have is empty for scalar multipliers.
/// The arrays keep their sizes, so that views of them stay valid.
class NodeState
{
public:
  /// @brief Create the state: every node open.
  /// @param[in] num_nodes Number of slave nodes.
  /// @param[in] gdim Geometric dimension.
  /// @param[in] is_vector Whether multipliers are vectors.
  /// @param[in] has_means Whether normals are means over facets.
  /// @throws std::invalid_argument if a number is out of its range.
  NodeState(std::int32_t num_nodes, int gdim, bool is_vector,
            bool has_means = false);

  // Views of the arrays stay valid
  NodeState(const NodeState&) = delete;
  NodeState& operator=(const NodeState&) = delete;

  /// @brief Number of slave nodes.
  std::int32_t num_nodes() const { return _num_nodes; }

  /// @brief Geometric dimension.
  int gdim() const { return _gdim; }

  /// @brief Components of the multiplier: 1, or the geometric dimension.
  int size() const { return _size; }

  /// @brief True if multipliers are vectors.
  bool is_vector() const { return _is_vector; }

  /// Multiplier, force/area: pressure or traction (shape=(n, size))
  std::vector<double> multiplier;
  /// Multiplier that the last accepted step has started from (shape=(n, size))
  std::vector<double> before;
  /// Reference area (shape=(n))
  std::vector<double> area;
  /// Status, see Status (shape=(n))
  std::vector<std::int8_t> status;
  /// Gap, NaN where there is no pair (shape=(n))
  std::vector<double> gap;
  /// Unit normal of the master (shape=(n, gdim)), of vectors
  std::vector<double> normal;
  /// Slip increment of the step (shape=(n, gdim)), of vectors
  std::vector<double> slip;
  /// Factor of the gap in the complementarity, traction/length (shape=(n))
  std::vector<double> c;
  /// 1 where Dirichlet conditions keep slave node and master from moving along
  /// the normal: such a node stays open (shape=(n))
  std::vector<std::int8_t> immobile;
  /// 1 in directions in which slave node or master can move, else 0 (shape=(n,
  /// gdim)), of vectors
  std::vector<double> mobile;
  /// 1 where a node leaves this contact to another one that it closes
  /// (shape=(n))
  std::vector<std::int8_t> redundant;
  /// 1 where friction is left out because a node closes several contacts
  /// (shape=(n))
  std::vector<std::int8_t> frictionless;
  /// How often slip has turned back in this step (shape=(n))
  std::vector<std::int32_t> slip_reversals;
  /// How often nodes have closed with slip in this step (shape=(n))
  std::vector<std::int32_t> slip_closings;
  /// Complementarity factor along the surface, as a part of c
  double tangential_ratio = 1;
  /// Where the nodes are while an interior-point method solves
  std::optional<Interior> interior;

  /// Complementarity function, a force (shape=(n, size))
  std::vector<double> value;
  /// Its derivative by the multiplier (shape=(n, size, size))
  std::vector<double> by_multiplier;
  /// ... by the gap (shape=(n, size))
  std::vector<double> by_gap;
  /// ... by the slip (shape=(n, gdim, gdim)), of vectors
  std::vector<double> by_slip;
  /// ... by the normal (shape=(n, gdim, gdim)), of vectors
  std::vector<double> by_normal;

  /// Normals that are means over facets; nothing where a node has one of its
  /// own
  std::optional<MeanNormal> mean;

  /// @brief True if a node is in contact.
  bool closed(std::size_t i) const { return status[i] != law::open; }

  /// @brief True if a node is in contact, or would be if another condition let
  /// it.
  bool is_constrained(std::size_t i) const
  {
    return closed(i) or immobile[i] or redundant[i];
  }

  /// @brief Gap of a node, NaN where it cannot close.
  double closable_gap(std::size_t i) const
  {
    return immobile[i] or redundant[i]
               ? std::numeric_limits<double>::quiet_NaN()
               : gap[i];
  }

  /// @brief Pressure of a node, force/area.
  double pressure(std::size_t i) const
  {
    if (not is_vector())
      return multiplier[i];
    double p = 0;
    for (std::size_t k = _gdim * i; k < _gdim * (i + 1); ++k)
      p += normal[k] * multiplier[k];
    return p;
  }

  /// @brief True if the complementarity closes a node, or its gap is at most a
  /// tie; see `law::pressure_hat`.
  /// @param[in] i The node.
  /// @param[in] tie Gap, of either sign, up to which nodes touch; none if
  /// negative.
  bool closing(std::size_t i, double gap_tol = -1) const
  {
    // False for the gap NaN, too
    const double g = closable_gap(i);
    return law::pressure_hat(pressure(i), c[i], g, closed(i)) > 0
           or std::abs(g) <= gap_tol;
  }

  /// @brief Set the factor c to the stiffness of a pair over the slave node's
  /// area; any c > 0 has the same solution.
  /// @param[in] ranks The ranks, all of which take part.
  /// @param[in] compliance Compliance of each node's pair, length/force, zero
  /// where it is unknown (shape=(n)).
  /// @throws std::invalid_argument if there are not as many.
  void set_factor(mesh::Ranks& ranks, std::span<const double> compliance);

  /// @brief Close nodes, whatever their pressures: they stick where there is
  /// friction.
  /// @param[in] nodes Nodes by their number in the contact.
  /// @throws std::invalid_argument if there is no such node.
  void close(std::span<const std::int32_t> nodes);

  /// @brief Take the multiplier off open nodes.
  ///
  /// Those of an iterate whose active set is far too large are wild, and the
  /// stiffness that they would give to nodes that have just opened throws the
  /// next iterate off.
  void drop_open();

  /// @brief Scale normals that are means to unit length.
  void normalise();

  /// @brief Make slip of movements over several facets, which stand in its
  /// place: their part along the surface. Nothing where a node has a normal of
  /// its own.
  /// @param[in] origin Vectors that are taken off them (shape=(n, gdim)); empty
  /// for nothing.
  /// @throws std::invalid_argument if it is of another size.
  void project(std::span<const double> origin = {});

private:
  std::int32_t _num_nodes;
  int _gdim, _size;
  bool _is_vector;
};

/// @brief Gap up to which nodes touch but for round-off, a length.
/// @param[in] ranks The ranks, all of which take part.
/// @param[in] x Positions of the nodes on this rank (shape=(n, gdim)).
/// @param[in] gdim Geometric dimension.
/// @throws std::invalid_argument if there is no such dimension, or positions
/// have others.
double touching_gap(mesh::Ranks& ranks, std::span<const double> x, int gdim);
} // namespace contactx::law
