// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#pragma once

#include "../geometry/facets.h"
#include "../mesh/ranks.h"
#include <memory>

namespace contactx::contact
{
/// @brief Slave nodes that a rank owns, and those of others that share a facet
/// with them.
///
/// State, pairs and laws are those of owned nodes alone, of which there are n;
/// the owned ones and the others are m. Arrays are row-major. Sizes that do
/// not fit throw std::invalid_argument, which names the argument.
class SlaveNodes
{
public:
  /// @brief Find the nodes.
  /// @param[in] nodes Nodes of this rank.
  /// @param[in] facets Slave facets around the slave nodes that this rank owns,
  /// their nodes among those of this rank.
  /// @param[in] own Slave facets of this rank's cells, each on one rank alone.
  SlaveNodes(std::shared_ptr<const mesh::NodeMap> nodes,
             const geometry::FacetList& facets, const geometry::FacetList& own);

  /// @brief Integrate with a weight: over all angles in axisymmetric models,
  /// over the thickness in plane ones. Before masters and contacts are made of
  /// the slave nodes; collective.
  /// @param[in] weight Values at the owned slave nodes, between which the
  /// shape functions interpolate (shape=(n)).
  /// @throws std::invalid_argument on all ranks if a value is negative or not
  /// finite, or those of a facet are all zero.
  void set_weight(std::span<const double> weight);

  /// @brief Take the facets as parts of quadratic ones, which share their
  /// nodes. Before masters and contacts are made of the slave nodes;
  /// collective.
  /// @param[in] level Where each owned slave node is on quadratic facets: 0 at
  /// vertices, 1 on edges, 2 inside (shape=(n)).
  /// @param[in] is_mortar Whether facets are integrated, in geometry::Basis.
  void set_level(std::span<const std::int8_t> level, bool is_mortar);

  /// @brief True if the facets are parts of quadratic ones.
  bool is_quadratic() const { return _is_quadratic; }

  /// @brief True if they are parts of quadratic facets that are integrated.
  bool is_mortar() const { return _is_mortar; }

  /// @brief kernel::Weights of the nodes in the areas of facets, at all slave
  /// nodes.
  geometry::Shares shares() const { return {_weight, _level}; }

  /// @brief These weights by the integrals of the shape functions, which are
  /// zero at the vertices of triangles of six nodes; those of geometry::Basis
  /// where facets are integrated.
  geometry::Shares pressure_shares() const
  {
    return {_weight, _level, _is_mortar};
  }

  /// @brief The weight at all slave nodes (shape=(m)); empty if there is none.
  const std::vector<double>& weight() const { return _weight; }

  /// @brief The weight at the corners of the facets, in the order of their
  /// nodes; empty if there is none.
  std::vector<double> corner_weight() const;

  /// @brief Nodes of this rank.
  const mesh::NodeMap& nodes() const { return *_nodes; }

  /// @brief Slave facets around the owned slave nodes.
  geometry::FacetList facets() const { return _facets.list(); }

  /// @brief Slave facets of this rank's cells, each on one rank alone.
  geometry::FacetList own() const { return _own.list(); }

  /// @brief Owned slave nodes in order (shape=(n)).
  std::span<const std::int32_t> owned() const
  {
    return std::span(_around).first(_num_owned);
  }

  /// @brief All slave nodes of the facets in order, the owned ones first
  /// (shape=(m)).
  const std::vector<std::int32_t>& around() const { return _around; }

  /// @brief Nodes of the facets by their places among those, in the order of
  /// the facets' nodes.
  const std::vector<std::int32_t>& corners() const { return _corners; }

  /// @brief The facets around the owned slave nodes, with these places for
  /// nodes.
  geometry::FacetList local() const { return {_facets.offsets, _corners}; }

  /// @brief Give all slave nodes the values that their owners have; collective.
  /// @param[in] values Values at owned slave nodes (shape=(n, width)).
  /// @param[in] width Values a node.
  /// @return Values (shape=(m, width)).
  std::vector<double> scatter_forward(std::span<const double> values,
                                      int width = 1) const;

  /// @copydoc scatter_forward
  std::vector<std::int64_t>
  scatter_forward(std::span<const std::int64_t> values, int width = 1) const;

  /// @copydoc scatter_forward
  std::vector<std::int8_t> scatter_forward(std::span<const std::int8_t> values,
                                           int width = 1) const;

  /// @brief Values of all nodes of this rank at the slave nodes.
  /// @param[in] values Values (shape=(num_nodes, width)).
  /// @param[in] width Values a node.
  /// @param[in] name Name of the values, for messages.
  /// @return Values (shape=(m, width)).
  std::vector<double> here(std::span<const double> values, int width,
                           const char* name) const;

  /// @brief Mark the owned slave nodes that face a master, see `facing_nodes`.
  /// @param[in] x Positions of all nodes (shape=(num_nodes, gdim)).
  /// @param[in] normal Unit normals of the master at the owned slave nodes
  /// (shape=(n, gdim)).
  /// @param[in] gdim Geometric dimension, 2 or 3.
  /// @return 1 at the nodes that do, else 0 (shape=(n)).
  std::vector<std::int8_t> facing(std::span<const double> x,
                                  std::span<const double> normal,
                                  int gdim) const;

  /// @brief Reference areas of the corners of the facets that face a master,
  /// else zero, see the function of this name.
  ///
  /// Those of nodes of other ranks count as if all faced it.
  /// @param[in] reference Reference positions of all nodes (shape=(num_nodes,
  /// gdim)).
  /// @param[in] x Positions of all nodes (shape=(num_nodes, gdim)).
  /// @param[in] normal Unit normals of the master at the owned slave nodes, or
  /// zero (shape=(n, gdim)).
  /// @param[in] gdim Geometric dimension, 2 or 3.
  /// @return Areas, in the order of the facets' nodes.
  std::vector<double> facing_areas(std::span<const double> reference,
                                   std::span<const double> x,
                                   std::span<const double> normal,
                                   int gdim) const;

  /// @brief Largest value of each facet's nodes, NaN if one is.
  /// @param[in] values Values at all slave nodes (shape=(m)).
  /// @return Values (shape=(num_facets)).
  std::vector<double> largest(std::span<const double> values) const;

  /// @brief Smallest value of each facet's nodes, NaN if one is.
  /// @param[in] values Values at all slave nodes (shape=(m)).
  /// @return Values (shape=(num_facets)).
  std::vector<double> smallest(std::span<const double> values) const;

  /// @brief Distance of the nearest facet to some nodes; collective.
  /// @param[in] which 1 at these among the owned slave nodes, else 0
  /// (shape=(n)).
  /// @return 2 where a node of the facet is among them, 1 where one of a
  /// neighbour is, else 0 (shape=(num_facets)).
  std::vector<std::int8_t> near(std::span<const std::int8_t> which) const;

  /// @brief Sums at the owned slave nodes of what is given at the corners of
  /// the facets.
  /// @param[in] corners Values, in the order of the facets' nodes.
  /// @return Sums (shape=(n)).
  std::vector<double> sums(std::span<const double> corners) const;

private:
  // Values at owned slave nodes with zero at those of other ranks
  std::vector<double> padded(std::span<const double> normal, int gdim) const;

  std::shared_ptr<const mesh::NodeMap> _nodes;
  geometry::Facets _facets, _own;
  std::vector<std::int32_t> _around, _corners;
  std::vector<double> _weight;
  std::vector<std::int8_t> _level;
  bool _is_quadratic = false, _is_mortar = false;
  std::size_t _num_owned;
};
} // namespace contactx::contact
