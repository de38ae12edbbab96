// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#pragma once

#include "../../geometry/facets.h"
#include "../../math/vec.h"

namespace contactx::search
{
/// @brief Says for two places of one surface which of them is the slave, where
/// they face each other.
///
/// Constraints of both sides at once would be singular. So all places of the
/// surface are put in an order that does not depend on how it deforms, and
/// contact closes the later one of two:
/// - of two connected parts that of the smaller and softer facets is later; of
///   parts that are alike within a factor of 2 the one whose first node has the
///   larger number;
/// - within a curve it is the place farther along it. A closed one begins at
///   the node that is farthest from its middle. What folds does so about
///   points between the two sides, so that one side is all before the other;
/// - within a surface in 3D it is the place farther from the node that is
///   farthest from the middle, along edges. Half the distance from a second
///   node, far from the first and from what is farthest from that, is added:
///   for sides that lie as a mirror has them.
class SelfOrder
{
public:
  /// @brief Put a surface in order.
  /// @param[in] facets All facets, in an order that no rank depends on.
  /// @param[in] x Reference positions of their nodes (shape=(n, gdim)).
  /// @param[in] gdim Geometric dimension, 2 or 3.
  SelfOrder(const geometry::FacetList& facets, std::span<const double> x,
            int gdim);

  /// @brief Put softer parts behind stiffer ones of facets as large.
  /// @param[in] compliance Compliance of the nodes, length/force (shape=(n)).
  void take_compliance(std::span<const double> compliance);

  /// @brief True if a node comes after a place of a facet.
  /// @param[in] node The node.
  /// @param[in] facet The facet's nodes.
  /// @param[in] weights Values of its shape functions at the place.
  bool is_after(std::int32_t node, std::span<const std::int32_t> facet,
                std::span<const double> weights) const;

  /// @brief Connected part of each node (shape=(n)).
  const std::vector<std::int32_t>& part() const { return _part; }

  /// @brief Place of each node within its part, a length (shape=(n)).
  const std::vector<double>& along() const { return _along; }

  /// @brief Place of each part among the parts (shape=(num_parts)).
  const std::vector<std::int32_t>& rank() const { return _rank; }

private:
  void set_ranks(std::span<const double> score);

  int _gdim;
  std::vector<std::int32_t> _part, _rank;
  std::vector<double> _along;
  std::vector<double> _size; // mean size of the facets of each part
};

/// @brief Displacements along the edges of facets.
class EdgePaths
{
public:
  /// @brief Take the edges.
  /// @param[in] facets Facets.
  /// @param[in] x Positions (shape=(n, gdim)), row-major.
  /// @param[in] gdim Geometric dimension, 2 or 3.
  EdgePaths(const geometry::FacetList& facets, std::span<const double> x,
            int gdim);

  /// @brief Nodes within a distance along edges of a node, with the distances,
  /// in their order.
  /// @param[in] from The node.
  /// @param[in] within Longest length; may be infinite.
  std::vector<std::pair<double, std::int32_t>> from(std::int32_t from,
                                                    double within) const;

private:
  std::vector<std::vector<std::pair<double, std::int32_t>>> _edges;
};
} // namespace contactx::search
