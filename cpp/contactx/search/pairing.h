// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#pragma once

#include "finder.h"
#include <limits>

namespace contactx::search
{
/// @brief Pairs of slave nodes and master facets, kept from one search to the
/// next so that they reach a fixed point.
///
/// A slave node keeps its facet while its projection stays inside the facet
/// extended by the margin; where it is farther away than the facet is long, as
/// long as no other one is nearer by more than that margin. A pair that still
/// returns twice to the facet it has left is frozen until the step's end.
class Pairing
{
public:
  /// @brief Create the pairing with no node paired.
  /// @param[in] slave_offsets First node of each slave facet and the end.
  /// @param[in] slave_nodes Nodes of the slave facets.
  /// @param[in] master_offsets First node of each master facet and the end.
  /// @param[in] master_nodes Nodes of the master facets.
  /// @param[in] gdim Geometric dimension, 2 or 3.
  /// @param[in] num_owned Nodes of this number and above are paired elsewhere:
  /// their facets only serve the others' normals.
  Pairing(std::vector<std::int32_t> slave_offsets,
          std::vector<std::int32_t> slave_nodes,
          std::vector<std::int32_t> master_offsets,
          std::vector<std::int32_t> master_nodes, int gdim,
          std::int32_t num_owned = std::numeric_limits<std::int32_t>::max());

  /// @brief Slave nodes in ascending order (shape=(num_slaves)).
  const std::vector<std::int32_t>& slaves() const { return _slaves; }

  /// @brief Number of nodes that positions are needed of.
  std::int32_t num_nodes() const
  {
    return std::max(_num_slave_nodes, master().num_nodes());
  }

  /// @brief Master surface.
  const Surface& master() const { return _finder.surface(); }

  /// @brief Take another list of master facets; those that have a pair must
  /// keep their numbers, or pairs be restored.
  /// @param[in] offsets First node of each master facet and the end.
  /// @param[in] nodes Nodes of the master facets.
  void set_master(std::vector<std::int32_t> offsets,
                  std::vector<std::int32_t> nodes);

  /// @brief Forget the returns of the last step: nothing is frozen.
  void begin_step();

  /// @brief Search.
  /// @param[in] x Node coordinates (shape=(num_nodes, gdim)), row-major.
  /// @param[in] reach Largest distance of a pair.
  /// @param[in] closed Whether a slave node is in contact
  /// (shape=(num_slaves)).
  /// @return Number of slave nodes in contact that changed their facet.
  std::int32_t update(std::span<const double> x, double reach,
                      std::span<const std::int8_t> closed);

  /// @brief First half of `update`: what keeps its facet is projected on it.
  /// @param[in] x Node coordinates (shape=(num_nodes, gdim)), row-major.
  /// @param[in] reach Largest distance of a pair.
  /// @return Slave nodes that must be searched for, by their place in
  /// `slaves`, near ones in turn.
  std::vector<std::int32_t> seek(std::span<const double> x, double reach);

  /// @brief Second half of `update` for one slave node that `seek` has named.
  /// @param[in] i Slave node by its place in `slaves`.
  /// @param[in] found Result of the search for it.
  /// @param[in] x Node coordinates (shape=(num_nodes, gdim)), row-major.
  /// @param[in] reach Largest distance of a pair.
  /// @param[in] closed Whether the slave node is in contact.
  /// @return Whether it is in contact and has changed its facet.
  bool accept_projection(std::int32_t i, const std::optional<Projection>& found,
                         std::span<const double> x, double reach, bool closed);

  /// @brief Take over the pairs of another pairing of the same surfaces, as
  /// the functions of these names give them. Nothing is frozen then.
  /// @throws std::invalid_argument if they do not fit; nothing has changed.
  void restore(std::span<const std::int32_t> facet,
               std::span<const std::int32_t> feature,
               std::span<const double> xi, std::span<const double> cone,
               std::span<const double> normal);

  /// @brief Facet of each slave node, -1 where it has none
  /// (shape=(num_slaves)).
  const std::vector<std::int32_t>& facet() const { return _facet; }

  /// @brief Feature of the facet that each pair is on (shape=(num_slaves)).
  const std::vector<std::int32_t>& feature() const { return _feature; }

  /// @brief Local coordinates of each pair (shape=(num_slaves, 2)).
  const std::vector<double>& xi() const { return _xi; }

  /// @brief Components of the ridge normals (shape=(num_slaves, 3)).
  const std::vector<double>& cone() const { return _cone; }

  /// @brief Unit normals at the last search (shape=(num_slaves, 3)).
  const std::vector<double>& normal() const { return _normal; }

  /// @brief Slave nodes whose pair is frozen, by their place in `slaves`.
  std::vector<std::int32_t> frozen() const;

private:
  std::optional<Projection> in_margin(std::span<const double> x, std::size_t i,
                                      double reach) const;
  std::optional<Projection> keep(std::span<const double> x, std::size_t i,
                                 double reach) const;
  std::optional<Projection> as_near(std::span<const double> x, std::size_t i,
                                    std::int32_t other, double reach) const;
  void set(std::size_t i, const std::optional<Projection>& q,
           std::span<const double> x);
  bool is_on_ridge(std::size_t i, const Projection& q,
                   std::span<const double> x) const;

  std::vector<std::int32_t> _slave_offsets, _slave_nodes, _slaves;
  std::int32_t _num_slave_nodes; // with those that are paired elsewhere
  Finder _finder;
  std::vector<std::int32_t> _facet, _feature;
  std::vector<double> _xi, _cone, _normal;
  std::vector<std::int32_t> _order; // of the searches, near ones in turn
  std::vector<std::int32_t> _left;  // facet that a node left last
  std::vector<std::int8_t> _returns;
};
} // namespace contactx::search
