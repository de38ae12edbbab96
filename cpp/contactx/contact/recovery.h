// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#pragma once

#include "slave_nodes.h"

namespace contactx::contact
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
///     p_i <- p_i + 1/A_i sum_j m_ij (p_j - p_i),
///     m_ij = (A_fi A_fj / A_f) r_ij^2
///
/// with the parts A_fi of a facet's area A_f. Inside the contact, where r = 1,
/// a pass takes the means of the facets, and of them those of the nodes. At its
/// edge the pressure falls like a root and says little of what is inside:
/// r_ij < 1 is the ratio of the closed parts of the two nodes' surroundings.
/// Where the master covers a node's facets in part m_ij is that part of it, the
/// smaller one of the two nodes. All of this was chosen by measurement on
/// Hertz's point and line contacts, the same for both methods; these properties
/// are exact but for rounding:
///
/// - the sum of the pressures' forces stays, as what one node loses another one
///   gains;
/// - a uniform traction stays, on any mesh and next to any edge;
/// - signs and the friction cone stay: averages have positive weights, the same
///   for p and t;
/// - open nodes stay at zero, and no rigid motion changes anything.
///
/// Peaks that are not much wider than a facet get lower: with 3, 6 and 12 nodes
/// in the half-width of a line contact by 3, 0.9 and 0.3 %, at the corner of a
/// flat punch by a fifth.
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
  Recovery(std::shared_ptr<const SlaveNodes> slaves, std::span<const double> x,
           int gdim);

  /// @brief Average pressures.
  /// @param[in] p Pressures, zero on open nodes (shape=(n)).
  /// @param[in] area Areas of the slave nodes (shape=(n)).
  /// @param[in] closed 1 at nodes in contact, else 0 (shape=(n)).
  /// @return Averages (shape=(n)).
  std::vector<double> pressure(std::span<const double> p,
                               std::span<const double> area,
                               std::span<const std::int8_t> closed) const;

  /// @brief Average tractions along the surface.
  ///
  /// From node to node they turn with the normal, so that they keep their sizes
  /// on a curved surface.
  /// @param[in] t Tractions normal to the normals, zero on open nodes
  /// (shape=(n, gdim)).
  /// @param[in] normal Unit normals (shape=(n, gdim)).
  /// @param[in] area Areas of the slave nodes (shape=(n)).
  /// @param[in] closed 1 at nodes in contact, else 0 (shape=(n)).
  /// @return Averages, normal to the normals (shape=(n, gdim)).
  std::vector<double> shear(std::span<const double> t,
                            std::span<const double> normal,
                            std::span<const double> area,
                            std::span<const std::int8_t> closed) const;

  /// @brief Average vector multipliers: pressures and what is along the
  /// surface, each for itself.
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

  // Force that goes from one node to another one over the difference of their
  // tractions, and over the area of the one that it goes to
  struct Flow
  {
    std::int32_t to, from;
    double rate;
  };

  std::vector<Flow> flows(std::span<const double> area,
                          std::span<const std::int8_t> closed) const;

  std::shared_ptr<const SlaveNodes> _slaves;
  int _gdim, _passes;
  // Of all pairs of neighbours, with m_ij of nodes inside the contact
  std::vector<Flow> _flows;
  std::vector<double> _area; // of all of a node's facets
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
double recovery_change(parallel::Ranks& ranks, std::span<const double> forces,
                       std::span<const double> recovered, int gdim);
} // namespace contactx::contact
