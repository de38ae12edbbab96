// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#pragma once

#include "../contact/contact.h"
#include "../contact/method.h"
#include "../geometry/obstacle.h"
#include "../law/law.h"
#include "../mesh/mesh.h"
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <variant>
#include <vector>

namespace contactx::problem
{
/// @brief Options of a contact, as users of any host give them.
struct ContactOptions
{
  contact::Method method = contact::Method::node_to_surface;
  contact::Sliding sliding = contact::Sliding::finite;
  /// Whether slave nodes keep their place on the master; excludes friction
  bool tied = false;
  /// Whether friction may act: without it nothing along the surface is computed
  bool has_friction = false;
  /// Bound of friction in place of Coulomb's, if it is not empty
  law::BoundFunction bound = {};
  /// Largest distance of a pair; the diameter of the larger surface if not
  /// given, unlimited for an obstacle
  std::optional<double> search_distance = {};
  /// In self-contact the length along the surface up to which facets are no
  /// masters of a node, see search::SelfSight
  std::optional<double> excluded_distance = {};
  /// Gaps and overlaps of the reference configuration up to this length count
  /// as none, see contact::Contact::Options
  std::optional<double> adjust = {};
  /// Whether linear facets stand for smooth surfaces, see geometry::SmoothFacet
  bool smooth = false;
  /// Complementarity factor along the surface as a part of the normal one
  double tangential_factor = 1;
};

/// @brief Check that options are in their range and do not exclude each other.
/// @param[in] options The options.
/// @param[in] is_self Whether slave and master are the same surface.
/// @throws std::invalid_argument if not.
void check(const ContactOptions& options, bool is_self);

/// @brief Both sides of a contact.
struct Sides
{
  mesh::NamedSurface slave; ///< facets of this rank's cells
  /// Another surface, or an obstacle
  std::variant<mesh::NamedSurface, std::shared_ptr<geometry::Obstacle>> master;
  bool is_self = false; ///< whether the master is the slave surface itself
  /// Where the bulk's nodes are on quadratic facets, see geometry::Shares;
  /// empty where the displacement is linear
  std::vector<std::int8_t> level = {};
  /// Factor of contact's integrals at some nodes, at least 0: 2 pi r in
  /// axisymmetric models, a thickness; one if empty
  std::function<std::vector<double>(std::span<const std::int32_t> nodes)> weight
      = {};
};

/// @brief Name of a contact in messages.
/// @param[in] sides Its sides.
/// @param[in] sliding Its kinematics.
std::string name_of(const Sides& sides, contact::Sliding sliding);

/// @brief Make a contact, its slave nodes paired in the reference
/// configuration; all ranks must take part.
/// @param[in] mesh The mesh, whose halo may grow.
/// @param[in] sides Its sides.
/// @param[in] options How it is.
/// @param[in] prescribed 1 at displacements with a Dirichlet condition, those
/// of the bulk's nodes (shape=(num_bulk, gdim)).
/// @throws std::invalid_argument on all ranks if options exclude each other or
/// are out of their range, facets of any rank are degenerate, the surfaces
/// share nodes that are no crack's tip or face away from each other, a body
/// lies wholly inside its master, or an obstacle's parameters do not fit.
std::shared_ptr<contact::Contact>
make_contact(const mesh::Mesh& mesh, const Sides& sides,
             const ContactOptions& options,
             std::vector<std::int8_t> prescribed);
} // namespace contactx::problem
