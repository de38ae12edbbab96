// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#pragma once

#include "../finder.h"
#include "../whole_surface.h"
#include "self_order.h"

namespace contactx::search
{
/// @brief Visibility of a surface from its own nodes.
///
/// Of the facets that face a node, and whose normals oppose its own, it does
/// not see
/// - its neighbours: facets within a distance along the surface, in the
///   reference configuration;
/// - what is in front of it through its own body: whose closest point is not
///   on the outer side of the node;
/// - what it is behind of through its own body. Behind a facet it has come
///   through that one if it saw it at the step's start; or if it is behind it
///   by less than half of what its body measures there, in the reference
///   configuration, from the node to the far side.
///
/// All ranks have all of the surface, and find the same for each node. Nodes
/// are numbered as WholeSurface does.
class SelfSight
{
public:
  /// @brief Take the surface; all ranks must take part.
  /// @param[in] halo Nodes of this rank.
  /// @param[in] own Facets of this rank's cells, each on one rank alone.
  /// @param[in] body Body of each of this rank's nodes (shape=(at least
  /// num_owned)).
  /// @param[in] excluded Distance along the surface up to which facets are
  /// neighbours; without it they are facets that share a node with one that
  /// has the node.
  SelfSight(std::shared_ptr<const mesh::Halo> halo,
            const geometry::FacetList& own, std::span<const std::int64_t> body,
            std::optional<double> excluded);

  /// @brief The surface.
  const WholeSurface& surface() const { return _surface; }

  /// @brief Order that decides which of two places is the slave.
  SelfOrder& order() { return _order; }

  /// @copydoc order
  const SelfOrder& order() const { return _order; }

  /// @brief Take the positions of the next searches; all ranks must take part.
  /// @param[in] x0 Positions of this rank's nodes at the step's start
  /// (shape=(at least num_owned, gdim)), row-major.
  /// @param[in] x The same of now.
  void refit(std::span<const double> x0, std::span<const double> x);

  /// @brief Positions of all nodes at the step's start (shape=(n, gdim)).
  const std::vector<double>& start() const { return _x0; }

  /// @brief Positions of all nodes now (shape=(n, gdim)).
  const std::vector<double>& positions() const { return _x; }

  /// @brief Outward unit normals at the step's start (shape=(n, gdim)).
  const std::vector<double>& start_normals() const { return _normal0; }

  /// @brief Outward unit normals now (shape=(n, gdim)).
  const std::vector<double>& normals() const { return _normal; }

  /// @brief Facet that a node sees, with which contact is measured.
  /// @param[in] node A node that this rank owns.
  /// @param[in] reach Largest distance.
  /// @param[in] hint A facet that may be near, -1 for none.
  FoundPlace find(std::int32_t node, double reach,
                  std::int32_t hint = -1) const;

  /// @brief True if the node is the slave where it faces a place of a facet.
  bool is_slave(std::int32_t node, const Projection& at) const;

  /// @brief Distance from a node that this rank owns through its body to the
  /// far side, in the reference configuration; infinite without one on the
  /// surface.
  double thickness(std::int32_t node) const { return _thickness[node]; }

private:
  bool sees(std::int32_t node, const Vector<3>& normal,
            const Projection& q) const;
  void find_neighbours(std::optional<double> excluded);
  void find_thickness();

  WholeSurface _surface;
  int _gdim;
  std::vector<double> _reference, _x0, _x, _normal0, _normal, _thickness;
  double _moved = 0; // largest movement of a node in the step
  std::vector<std::int64_t> _body;
  Finder _finder;
  SelfOrder _order;
  // Neighbours of the nodes that this rank owns, ascending
  std::vector<std::vector<std::int32_t>> _neighbours;
};
} // namespace contactx::search
