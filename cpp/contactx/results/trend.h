// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#pragma once

#include "../contact/slave_nodes.h"

namespace contactx::results
{
/// @brief Two slave nodes that share a facet.
struct Pair
{
  std::int32_t to, from;
  double weight; ///< product of the nodes' parts of the facet's area over it
  int corners;   ///< of the facet
};

/// @brief How the force that goes from one closed node to another one follows
/// from their pressures: averages, and the first moments of shape functions.
struct Flow
{
  std::int32_t to, from;
  double weight; ///< that of the pair
  int corners;   ///< that of the pair
  double rate;   ///< of an average, over the area of `to`
  /// Integral of the product of both shape functions over the area of `to`;
  /// zero on quadratic facets, where multipliers are those of the nodes' places
  double moment;
};

/// @brief Slope of the pressure that an edge of the contact and what is inside
/// have in common.
struct Slope
{
  /// Pressure over length, zero where there is none, at all slave nodes
  /// (shape=(m, gdim))
  std::vector<double> values;
  /// How far the pressure rises towards the edge that a node is at, from 0, not
  /// at all or no more than it scatters, to 1, as a line (shape=(m))
  std::vector<double> share;
};

/// @brief Finds where the pressure rises towards an edge of the contact.
///
/// The contact is that of the facets of which all nodes are closed; its edge is
/// one of the surface, or where neighbours are open. All is fitted by least
/// squares to a node and its neighbours, and exact where the pressure is linear
/// in the coordinates. The slope at the edge is the least of three: zero, that
/// of the fit, and what follows at the edge from its change towards the inside,
/// which is nothing where the edge is a plane of symmetry. It counts by how
/// much more it explains than scatters, there and in the rows behind. From
/// there it goes inside, row by row, no steeper than the fits.
class Trend
{
public:
  /// @brief Find the edges of the facets.
  /// @param[in] slaves Slave nodes.
  /// @param[in] x Reference positions of all slave nodes (shape=(m, gdim)).
  /// @param[in] parts Parts of the facets' areas, in the order of their nodes.
  /// @param[in] gdim Geometric dimension, 2 or 3.
  Trend(std::shared_ptr<const contact::SlaveNodes> slaves,
        std::vector<double> x, std::vector<double> parts, int gdim);

  /// @brief Find the slope; collective.
  /// @param[in] flows Pairs of closed nodes.
  /// @param[in] p Pressures (shape=(n)).
  /// @param[in] closed 1 at nodes in contact, else 0 (shape=(m)).
  Slope find(std::span<const Flow> flows, std::span<const double> p,
             std::span<const std::int8_t> closed) const;

  /// @brief Reference positions of all slave nodes (shape=(m, gdim)).
  const std::vector<double>& x() const { return _x; }

private:
  // Pressures, where they are, and slopes, of all slave nodes
  struct Fit;
  struct Rim;

  Rim rim(std::span<const std::int8_t> closed) const;
  std::vector<double> scatter_behind(std::span<const Flow> flows,
                                     std::span<const double> points,
                                     const Rim& rim) const;
  Fit fit(std::span<const Flow> flows, std::span<const double> points) const;

  // Edge of a facet, in 2D its end, and the unit vector that leads out of it
  struct Edge
  {
    std::int32_t a, b, facet;
    std::array<double, 3> out;
  };

  std::shared_ptr<const contact::SlaveNodes> _slaves;
  std::vector<double> _x, _parts, _normal;
  std::vector<Edge> _edges; // the same ones of neighbours follow each other
  int _gdim;
};
} // namespace contactx::results
