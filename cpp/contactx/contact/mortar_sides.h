// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#pragma once

#include "../facet/nodal.h"
#include "../mortar/integrals.h"
#include "pairs.h"
#include "slave_nodes.h"
#include <array>

namespace contactx::contact
{
/// @brief Pairs of facets with their integrals; facets have four places for
/// nodes, of which triangles and segments leave some at zero.
struct Mortar
{
  std::vector<std::int32_t> slave, master; ///< facets of each pair
  /// Integrals of the dual functions with the master's shape functions
  /// (shape=(num_pairs, 4, 4))
  std::vector<double> weight;
  /// Integrals with the gap along the slave facet's normal
  /// (shape=(num_pairs, 4))
  std::vector<double> gap;

  /// @brief Number of pairs.
  std::size_t size() const { return slave.size(); }

  /// @brief Whether a pair has any weight.
  bool has_weight(std::size_t p) const;

  /// @brief With rows multiplied by factors (shape=(num_pairs, 4)).
  Mortar scaled(std::span<const double> factor) const;

  /// @brief With the pairs of another one, of both those that have any weight.
  Mortar joined(const Mortar& other) const;
};

/// @brief Facets of a slave and a master surface as rows of four nodes, of
/// which triangles and segments repeat their last one.
class MortarSides
{
public:
  /// @brief Take the slave's side.
  /// @param[in] slaves Slave nodes, which must outlive this.
  /// @param[in] reference Reference positions (shape=(num_nodes, gdim)).
  /// @param[in] gdim Geometric dimension.
  MortarSides(const SlaveNodes& slaves, std::span<const double> reference,
              int gdim);

  /// @brief Take the master's side.
  void meet(const facet::FacetList& master);

  /// @brief Number of owned slave nodes.
  std::size_t size() const { return _slaves->owned().size(); }

  /// @brief Owned slave nodes in order.
  std::span<const std::int32_t> slaves() const { return _slaves->owned(); }

  /// @brief All slave nodes in order, those of other ranks last.
  std::span<const std::int32_t> around() const { return _slaves->around(); }

  /// @brief Nodes of a slave facet by their places in `around`.
  std::span<const std::int32_t, 4> numbers(std::int32_t facet) const
  {
    return std::span<const std::int32_t, 4>(_numbers.data() + 4 * facet, 4);
  }

  /// @brief Nodes of a slave facet.
  std::span<const std::int32_t, 4> slave_nodes(std::int32_t facet) const
  {
    return std::span<const std::int32_t, 4>(_slave.data() + 4 * facet, 4);
  }

  /// @brief Nodes of a master facet.
  std::span<const std::int32_t, 4> master_nodes(std::int32_t facet) const
  {
    return std::span<const std::int32_t, 4>(_master.data() + 4 * facet, 4);
  }

  /// @brief Number of slave facets.
  std::int32_t num_slave_facets() const
  {
    return static_cast<std::int32_t>(_slave_sizes.size());
  }

  /// @brief Radius of the smallest slave facet's circle inside, about; infinite
  /// without facets.
  double inradius() const { return _inradius; }

  /// @brief Value of an owned slave node, zero for those of other ranks.
  /// @param[in] values Values of owned slave nodes (shape=(n)).
  /// @param[in] number Place of the node in `around`.
  double at(std::span<const double> values, std::int32_t number) const
  {
    return number < std::int32_t(size()) ? values[number] : 0.0;
  }

  /// @brief Values at the corners of the slave facets of pairs, zero at nodes
  /// of other ranks (shape=(num_pairs, 4)).
  /// @param[in] values Values of owned slave nodes (shape=(n)).
  /// @param[in] facets Slave facets.
  std::vector<double> at_corners(std::span<const double> values,
                                 std::span<const std::int32_t> facets) const;

  /// @brief Sums over all facets of each owned slave node (shape=(n)).
  /// @param[in] values Values at corners (shape=(num_facets, 4)).
  std::vector<double> total(std::span<const double> values) const;

  /// @brief Sums over some facets of each owned slave node (shape=(n)).
  /// @param[in] values Values at corners (shape=(m, 4)).
  /// @param[in] facets Their slave facets (shape=(m)).
  std::vector<double> total(std::span<const double> values,
                            std::span<const std::int32_t> facets) const;

  /// @brief Pairs with what the kernels read, by the kinds of both facets.
  /// @param[in] mortar Pairs with their integrals.
  /// @param[in] dual Coefficients of the dual functions (shape=(num_facets, 4,
  /// 4)).
  /// @param[in] normal Normals of the slave facets, those of the master
  /// (shape=(num_facets, 3)).
  /// @param[in] is_movement Whether they measure slip alone.
  std::vector<Pairs> pairs(const Mortar& mortar, std::span<const double> dual,
                           std::span<const double> normal,
                           bool is_movement = false) const;

  /// @brief Unit normal and directions along one facet of each owned slave
  /// node, in columns (shape=(n, gdim, gdim)).
  std::vector<double> frames(std::span<const double> x) const;

  /// @brief Normals midway between those of each slave facet and its master
  /// (shape=(num_facets, 3)): small sliding keeps those of the reference, and
  /// two surfaces that are pressed together meet midway.
  /// @param[in] x Positions.
  /// @param[in] pairs Pairs of facets.
  /// @param[in] weight Integrals of the pairs (shape=(num_pairs, 4, 4)).
  /// @param[in] normal Normals of the slave facets (shape=(num_facets, 3)).
  std::vector<double> between(std::span<const double> x,
                              const mortar::FacetPairs& pairs,
                              std::span<const double> weight,
                              std::span<const double> normal) const;

private:
  const SlaveNodes* _slaves;
  std::array<double, 3> master_normal(std::span<const double> x,
                                      std::int32_t facet) const;

  int _gdim;
  std::vector<std::int32_t> _slave, _numbers, _master;
  std::vector<int> _slave_sizes, _master_sizes;
  double _inradius;
};

/// @brief Vectors of unit length; zero stays zero (shape=(n, 3)).
void normalise(std::span<double> vectors);
} // namespace contactx::contact
