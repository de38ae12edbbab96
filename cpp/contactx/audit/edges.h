// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#pragma once

#include "../contact/contact.h"
#include "../math/vec.h"
#include <optional>
#include <string>

namespace contactx::audit
{
/// @brief A node of the master that is below a slave facet.
struct MasterBelow
{
  std::int32_t node; ///< the node
  double depth;      ///< its depth
  double size;       ///< size of the facet
  double stiffness;  ///< the largest one of the facet's nodes, force/length
  Vector<3> normal;  ///< outward unit normal of the facet
};

/// @brief What node-to-surface contact makes of the master's edges.
///
/// An edge is pressed along the normal of the smooth surface that it touches.
/// Slave nodes beside it are pressed along the normals of its faces, and
/// between them it is not seen.
struct EdgeForce
{
  double share; ///< part of the normal force at nodes of edges
  double off;   ///< difference from the force along the slave's normals there,
                ///< node by node, over the normal force
  std::vector<double> at; ///< where that is largest (shape=(gdim))

  /// Force that an edge between slave nodes would need to come out of their
  /// facet, the largest one, over the normal force; infinite where that is zero
  double unseen;
  double depth;               ///< depth of that edge
  double size;                ///< size of the facet
  std::vector<double> hidden; ///< where it is (shape=(gdim))

  /// @brief What is off in the force; infinite where more of it is unseen than
  /// seen.
  double ratio() const;

  /// @brief True if the force has another direction than at an edge.
  bool is_coarse() const;

  /// @brief What that means and what to do: one sentence, which the name of the
  /// contact goes before.
  std::string words() const;
};

/// @brief Look at the edges of the master in a contact of two deformable
/// bodies; collective.
///
/// The normal force of each slave node along the master's normal, and along the
/// slave's own, are shared out to the nodes of the master's facet, and compared
/// where facets of the master make an edge. A slave node at an edge of its own
/// surface may have any normal.
/// @param[in] halo Nodes of this rank.
/// @param[in] contact A contact of two deformable bodies, with the pairs and
/// multipliers of now.
/// @param[in] x Positions that give the normals (shape=(num_nodes, gdim)),
/// row-major.
/// @param[in] below Nodes of the master below slave facets.
/// @return Nothing where facets are integrated, or there is no force and no
/// edge that needs one.
std::optional<EdgeForce> edge_force(mesh::Halo& halo,
                                    const contact::Contact& contact,
                                    std::span<const double> x,
                                    std::span<const MasterBelow> below);
} // namespace contactx::audit
