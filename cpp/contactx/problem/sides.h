// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#pragma once

#include "../contact/contact.h"
#include "../contact/deformable_master.h"
#include "../contact/method.h"
#include "../contact/obstacle_pairs.h"
#include "../law/law.h"
#include "../mesh/mesh.h"
#include <optional>

namespace contactx::problem
{
using contact::Method;

/// @brief Options of the master side of a contact.
struct MasterOptions
{
  Method method = Method::node_to_surface; ///< that was asked for
  contact::Sliding sliding = contact::Sliding::finite;
  /// Largest distance of a pair. If there is none it is the diameter of the
  /// larger surface, and unlimited for an obstacle
  std::optional<double> search_distance;
  /// Where each node of this rank is on quadratic facets, see geometry::Shares;
  /// empty where the displacement is linear
  std::vector<std::int8_t> level = {};
  /// Whether slave and master are the same surface, see search::SelfSurface
  bool is_self = false;
  /// Distance along that surface up to which facets are no masters of a node,
  /// see search::SelfSight
  std::optional<double> excluded_distance = {};
  /// Whether linear facets stand for smooth surfaces through their nodes, see
  /// geometry::SmoothFacet
  bool is_smooth = false;
};

/// @brief Slave nodes of a surface; all ranks must take part.
/// @param[in,out] halo Nodes of this rank, to which those of facets around its
/// own are added for good.
/// @param[in] facets Facets of this rank's cells, each on one rank alone.
/// @param[in] level Where all nodes are on quadratic facets that these are
/// parts of, see geometry::Shares; empty where the displacement is linear.
/// @param[in] method Method of the contact.
/// @param[in] is_rigid Whether the master is an obstacle.
/// @throws std::invalid_argument on all ranks if the facets of one are none of
/// its nodes.
std::shared_ptr<contact::SlaveNodes> make_slave_nodes(
    const std::shared_ptr<mesh::Halo>& halo, const geometry::FacetList& facets,
    std::span<const std::int8_t> level = {},
    Method method = Method::node_to_surface, bool is_rigid = false);

/// @brief Make the master side of a contact with a deformable body, without
/// pairs yet; all ranks must take part.
/// @param[in] mesh The mesh, whose halo may grow.
/// @param[in] slaves Slave nodes, as `make_slave_nodes` makes them.
/// @param[in] slave_name What messages call the slave surface.
/// @param[in] master Master surface.
/// @param[in] law Contact law.
/// @param[in] options How it is made.
/// @throws std::invalid_argument on all ranks if facets of any rank are
/// degenerate or the slave surface is folded, if the surfaces share nodes that
/// are no crack's tip, or a body lies wholly inside the other one; of smooth
/// surfaces if it is one on itself, the law is a tie, or facets are
/// quadratic.
std::shared_ptr<contact::DeformableMaster>
make_master(const mesh::Mesh& mesh,
            std::shared_ptr<const contact::SlaveNodes> slaves,
            const std::string& slave_name, const mesh::NamedSurface& master,
            const law::Law& law, const MasterOptions& options);

/// @brief Make the master side of a contact with an obstacle, without pairs
/// yet; all ranks must take part.
/// @param[in] mesh The mesh.
/// @param[in] slaves Slave nodes, as `make_slave_nodes` makes them.
/// @param[in] slave_name What messages call the slave surface.
/// @param[in] obstacle The obstacle, which gets to know the size of the slave
/// surface. What it throws on any rank is thrown on all of them.
/// @param[in] law Contact law.
/// @param[in] options How it is made; sliding does not count here.
/// @throws std::invalid_argument on all ranks if slave facets of any rank are
/// degenerate, the obstacle's parameters do not fit, or a body lies wholly
/// inside the obstacle.
std::shared_ptr<contact::ObstacleMaster> make_master(
    const mesh::Mesh& mesh, std::shared_ptr<const contact::SlaveNodes> slaves,
    const std::string& slave_name, std::shared_ptr<geometry::Obstacle> obstacle,
    const law::Law& law, const MasterOptions& options);

/// @brief Diameter of the larger of two surfaces: twice the largest distance
/// of its nodes from their mean. All ranks must take part.
///
/// A body that has moved into another within one iteration must still be found.
/// @param[in] halo Nodes of this rank.
/// @param[in] slave Slave facets on this rank.
/// @param[in] master Master facets on this rank.
double default_reach(const mesh::Halo& halo, const geometry::FacetList& slave,
                     const geometry::FacetList& master);
} // namespace contactx::problem
