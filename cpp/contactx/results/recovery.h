// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#pragma once

#include "trend.h"
#include <optional>

namespace contactx::results
{
/// @brief Recovered tractions of slave nodes, force/area.
struct Recovered
{
  std::vector<double> pressure; ///< (shape=(n))
  std::vector<double> traction; ///< (shape=(n, gdim))
};

/// @brief Nodal tractions that scatter less than the multipliers.
///
/// A multiplier is the force of a slave node over its area. It scatters from
/// node to node where the meshes do not match (by 20 % on Hertz's problem, node
/// to surface), and at the edge of the contact. Recovery moves force between
/// closed nodes i and j that share a facet, in two passes (one where quadratic
/// multipliers are integrated, which scatter less) of
///
///     p_i <- p_i + 1/A_i sum_j m_ij (p_j - p_i - s_ij (x_j - x_i)),
///     m_ij = (A_fi A_fj / A_f) r_ij^2
///
/// with the parts A_fi of a facet's area A_f. Inside the contact, where r = 1,
/// a pass takes the means of the facets, and of them those of the nodes. Where
/// the pressure falls towards the edge of the contact it does so like a root,
/// and says little of what is inside: r_ij < 1 is the ratio of the closed parts
/// of the two nodes' surroundings. Where the master covers a node's facets in
/// part m_ij is that part of it, the smaller one of the two nodes. This was
/// chosen by measurement on Hertz's point and line contacts, the same for both
/// methods.
///
/// s_ij is the mean of the two nodes' Slope, which is zero but where the
/// pressure rises towards an edge of the contact: what is averaged is the
/// pressure without it, as an average from one side would lower it, and nothing
/// is taken from the edge. Before the passes
///
///     p_i <- p_i - 1/A_i sum_j M_ij s_ij (x_j - x_i),
///
/// M_ij the integrals of the products of the shape functions: a multiplier at
/// an edge is the pressure at the centre of its shape function, a third of a
/// facet inside. These properties are exact but for round-off:
///
/// - the sum of the pressures' forces stays, as what one node loses another one
///   gains;
/// - a uniform traction stays, on any mesh and next to any edge;
/// - at an edge that it rises to, a linear pressure is what is recovered, if
///   facets are affine and the rows that the slope goes inside closed;
/// - at such an edge the pressure is not below the multiplier where half of the
///   slope, or more, counts;
/// - signs and the friction cone stay: each step is one of forces that nodes
///   give to others, no more than they have, the same parts of p and t;
/// - open nodes stay at zero, and no rigid motion changes anything.
///
/// Peaks inside the contact that are not much wider than a facet get lower:
/// with 3, 6 and 12 nodes in the half-width of a line contact by 3, 0.9 and 0.3
/// %.
///
/// Arrays are those of the owned slave nodes, of which there are n, row-major.
/// All ranks must take part in what is not static but the constructor;
/// neighbours may belong to others. Sizes that do not fit throw
/// std::invalid_argument.
class Recovery
{
public:
  /// @brief Find the neighbours.
  /// @param[in] slaves Slave nodes.
  /// @param[in] x Reference positions of all nodes (shape=(num_nodes, gdim)).
  /// @param[in] gdim Geometric dimension, 2 or 3.
  Recovery(std::shared_ptr<const contact::SlaveNodes> slaves,
           std::span<const double> x, int gdim);

  /// @brief Average pressures.
  /// @param[in] p Pressures, zero on open nodes (shape=(n)).
  /// @param[in] area Areas of the slave nodes (shape=(n)).
  /// @param[in] closed 1 at nodes in contact, else 0 (shape=(n)).
  /// @return Averages (shape=(n)).
  std::vector<double> pressure(std::span<const double> p,
                               std::span<const double> area,
                               std::span<const std::int8_t> closed) const;

  /// @brief Average vector multipliers: pressures, and what is along the
  /// surface as they are.
  ///
  /// From node to node it turns with the normal, so that it keeps its size on a
  /// curved surface.
  /// @param[in] multiplier Tractions that the master exerts, zero on open nodes
  /// (shape=(n, gdim)).
  /// @param[in] normal Unit normals (shape=(n, gdim)).
  /// @param[in] area Areas of the slave nodes (shape=(n)).
  /// @param[in] closed 1 at nodes in contact, else 0 (shape=(n)).
  Recovered tractions(std::span<const double> multiplier,
                      std::span<const double> normal,
                      std::span<const double> area,
                      std::span<const std::int8_t> closed) const;

  /// @brief Factor of the areas of slave nodes in the forces of
  /// recovered tractions: one but on triangles of six nodes (shape=(n)).
  std::vector<double> ratio() const
  {
    return _ratio.empty() ? std::vector<double>(_area.size(), 1) : _ratio;
  }

  /// @brief Values with those of nodes at which the shape functions have no
  /// integral, as the vertices of quadratic triangles, from their neighbours;
  /// collective.
  /// @param[in] values Values of the slave nodes (shape=(n, width)).
  /// @param[in] width Values a node.
  /// @return Values, at nodes without an area the mean of their neighbours'.
  std::vector<double> filled(std::span<const double> values, int width) const;

private:
  // What multipliers are by the integrals of the shape functions, vertices of
  // quadratic triangles giving their forces to closed neighbours
  std::vector<double> consistent(std::span<const double> values, int width,
                                 std::span<const double> area,
                                 std::span<const std::int8_t> closed) const;

  // Force that goes from one node to another one and back over the tractions
  // there, and over the area of `to`
  struct Exchange
  {
    std::int32_t to, from;
    double gets, gives;
  };

  // Pairs of closed nodes, of which all slave nodes are given
  std::vector<Flow> flows(std::span<const double> area,
                          std::span<const std::int8_t> is_closed) const;

  // One step, for pressures at all slave nodes: a pass of averages, or the one
  // from the centres of shape functions to the nodes
  std::vector<Exchange> exchange(std::span<const Flow> flows,
                                 const Slope& slope, std::span<const double> p,
                                 bool averages) const;

  // Take all steps for pressures
  std::vector<std::vector<Exchange>>
  exchanges(std::vector<double>& p, std::span<const double> area,
            std::span<const std::int8_t> closed) const;

  // Take one for tractions along the surface, with the normals of all nodes
  void carry(std::vector<double>& t, std::span<const double> normals,
             std::span<const Exchange> exchange) const;

  std::shared_ptr<const contact::SlaveNodes> _slaves;
  int _gdim, _passes;
  std::vector<Pair> _pairs; // neighbours
  std::optional<Trend> _trend;
  std::vector<double> _area; // of all of a node's facets
  // Part of its force that a node gives in a pass if neighbours have none
  std::vector<double> _most;
  // Areas that multipliers are of over those above
  std::vector<double> _ratio;
  // Nodes without such an area, and their neighbours; these, and such nodes
  std::vector<std::pair<std::int32_t, std::int32_t>> _beside, _given;
};

/// @brief By how much recovered tractions change the force of a contact, over
/// the sum of its nodes' forces; collective.
/// @param[in] ranks The ranks.
/// @param[in] forces Forces of the multipliers on this rank's slave nodes
/// (shape=(n, gdim)).
/// @param[in] recovered Forces of the recovered tractions (shape=(n, gdim)).
/// @param[in] gdim Geometric dimension, 2 or 3.
/// @return The change, zero where there are no forces.
double recovery_change(mesh::Ranks& ranks, std::span<const double> forces,
                       std::span<const double> recovered, int gdim);
} // namespace contactx::results
