// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#pragma once

#include "../geometry/integrals.h"
#include "box_tree.h"
#include "surface.h"
#include <optional>

namespace contactx::search
{
/// @brief Finds the master facets in front of each slave facet.
///
/// Both are projected on the slave facet's plane, along its normal or another
/// direction. Where several layers of the
/// master lie over one another the nearest one counts. Facets without area or
/// position, and those whose projection is folded, are in no pair.
class FacetSearch
{
public:
  /// @brief Create the search.
  /// @param[in] slave_offsets First node of each slave facet and the end.
  /// @param[in] slave_nodes Nodes of the slave facets.
  /// @param[in] master_offsets First node of each master facet and the end.
  /// @param[in] master_nodes Nodes of the master facets.
  /// @param[in] gdim Geometric dimension, 2 or 3.
  /// @throws std::invalid_argument where facets are none of that dimension.
  FacetSearch(std::vector<std::int32_t> slave_offsets,
              std::vector<std::int32_t> slave_nodes,
              std::vector<std::int32_t> master_offsets,
              std::vector<std::int32_t> master_nodes, int gdim);

  /// @brief Find the pairs.
  /// @param[in] x Node coordinates (shape=(num_nodes, gdim)), row-major.
  /// @param[in] reach Largest distance of a pair.
  /// @param[in] margin By which part a slave facet is enlarged about its middle
  /// in the search: pairs that do not overlap yet.
  /// @param[in] all_layers Whether all layers count: for a part of the master.
  /// @param[in] along Unit normals of the master to project along, one a slave
  /// facet, zero for its own normal (shape=(num_slave_facets, 3)), or empty.
  geometry::FacetPairs find(std::span<const double> x, double reach,
                            double margin, bool all_layers = false,
                            std::span<const double> along = {});

  /// @brief Geometric dimension.
  int gdim() const { return _master.gdim(); }

  /// @brief Number of nodes that positions are needed of.
  std::int32_t num_nodes() const
  {
    return std::max(_slave.num_nodes(), _master.num_nodes());
  }

  /// @brief Slave facets.
  geometry::FacetList slave() const { return _slave.facets(); }

  /// @brief Master facets.
  geometry::FacetList master() const { return _master.facets(); }

private:
  Surface _slave, _master;
  std::optional<BoxTree> _tree;
};

/// @brief True if all pairs of a part are among others.
/// @param[in] all Pairs, ascending by slave and then by master facet.
/// @param[in] part Others, in the same order.
bool contains(const geometry::FacetPairs& all,
              const geometry::FacetPairs& part);
} // namespace contactx::search
