// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#pragma once

#include "../geometry/integrals.h"
#include "../geometry/quadratic.h"
#include "../geometry/quadratic_facets.h"
#include "../kernel/layout.h"
#include "../kernel/pairs.h"
#include "slave_nodes.h"
#include <array>

namespace contactx::contact
{
/// @brief kernel::Pairs of facets with their integrals; facets have so many
/// places for nodes, of which smaller ones leave some at zero.
struct Mortar
{
  int width = 4;                           ///< places for the nodes of a facet
  std::vector<std::int32_t> slave, master; ///< facets of each pair
  /// Integrals of the dual functions with the master's shape functions
  /// (shape=(num_pairs, width, width))
  std::vector<double> weight;
  /// Integrals with the gap along the slave facet's normal
  /// (shape=(num_pairs, width))
  std::vector<double> gap;

  /// @brief Number of pairs.
  std::size_t size() const { return slave.size(); }

  /// @brief True if a pair has any weight.
  bool has_weight(std::size_t p) const;

  /// @brief Integrals of a slave node of a pair with the master's nodes.
  std::span<const double> row(std::size_t p, int s) const
  {
    return std::span(weight).subspan((p * width + s) * width, width);
  }

  /// @brief With rows multiplied by factors (shape=(num_pairs, width)).
  Mortar scaled(std::span<const double> factor) const;

  /// @brief With the pairs of another one, of both those that have any weight.
  Mortar joined(const Mortar& other) const;
};

/// @brief Facets of a slave and a master surface as rows of nodes: their own,
/// or those of the quadratic facets that they are parts of. Smaller facets
/// repeat their last one.
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
  /// @param[in] master Master facets.
  /// @param[in] level Where their nodes are on quadratic facets, see
  /// geometry::Shares; empty where facets are linear.
  void set_master_facets(const geometry::FacetList& master,
                         std::span<const std::int8_t> level);

  /// @brief Places for the nodes of a facet.
  int width() const { return _slave.width; }

  /// @brief Quadratic facets that the slave facets are parts of.
  const geometry::QuadraticFacets& slave_wholes() const { return _slave; }

  /// @brief Quadratic facets that the master facets are parts of.
  const geometry::QuadraticFacets& master_wholes() const { return _master; }

  /// @brief Number of owned slave nodes.
  std::size_t size() const { return _slaves->owned().size(); }

  /// @brief Owned slave nodes in order.
  std::span<const std::int32_t> slaves() const { return _slaves->owned(); }

  /// @brief All slave nodes in order, those of other ranks last.
  std::span<const std::int32_t> around() const { return _slaves->around(); }

  /// @brief Nodes of a slave facet by their places in `around`.
  std::span<const std::int32_t> numbers(std::int32_t facet) const
  {
    return std::span(_numbers).subspan(std::size_t(facet) * width(), width());
  }

  /// @brief Nodes of a slave facet.
  std::span<const std::int32_t> slave_nodes(std::int32_t facet) const
  {
    return _slave.row(facet);
  }

  /// @brief Nodes of a master facet.
  std::span<const std::int32_t> master_nodes(std::int32_t facet) const
  {
    return _master.row(facet);
  }

  /// @brief Call f(node, part) for the nodes that a slave node's basis takes
  /// parts of, see geometry::Basis.
  /// @param[in] facet Slave facet.
  /// @param[in] s Number of the slave node in it.
  /// @param[in] f Function.
  template <class Function>
  void for_each_part(std::int32_t facet, int s, Function&& f) const
  {
    const auto nodes = slave_nodes(facet);
    geometry::visit_whole(_gdim, _slave.sizes[facet],
                          [&]<class F>(F)
                          {
                            geometry::Basis<F>::for_each_part(
                                s,
                                [&](int j, double part) { f(nodes[j], part); });
                          });
  }

  /// @brief Number of slave facets.
  std::int32_t num_slave_facets() const
  {
    return static_cast<std::int32_t>(_slave.sizes.size());
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
  /// of other ranks (shape=(num_pairs, width)).
  /// @param[in] values Values of owned slave nodes (shape=(n)).
  /// @param[in] facets Slave facets.
  std::vector<double> at_corners(std::span<const double> values,
                                 std::span<const std::int32_t> facets) const;

  /// @brief Sums over all facets of each owned slave node (shape=(n)).
  /// @param[in] values Values at corners (shape=(num_facets, width)).
  std::vector<double> total(std::span<const double> values) const;

  /// @brief Sums over some facets of each owned slave node (shape=(n)).
  /// @param[in] values Values at corners (shape=(m, width)).
  /// @param[in] facets Their slave facets (shape=(m)).
  std::vector<double> total(std::span<const double> values,
                            std::span<const std::int32_t> facets) const;

  /// @brief kernel::Pairs with the data that the kernels read, by the kinds of
  /// both facets.
  /// @param[in] mortar kernel::Pairs with their integrals.
  /// @param[in] dual Coefficients of the dual functions (shape=(num_facets,
  /// width, width)).
  /// @param[in] normal Normals of the slave facets, those of the master
  /// (shape=(num_facets, 3)).
  /// @param[in] keeps What finite sliding keeps of each slave facet's pairs
  /// (shape=(num_facets)).
  /// @param[in] corner Normals of the master at the nodes of the slave facets
  /// that keep all (shape=(num_facets, 4, 3)); empty if none does.
  /// @param[in] is_movement Whether they measure slip alone.
  std::vector<kernel::Pairs>
  pairs(const Mortar& mortar, std::span<const double> dual,
        std::span<const double> normal, std::span<const kernel::Keeps> keeps,
        std::span<const double> corner, bool is_movement = false) const;

  /// @brief Unit normal and directions along one facet of each owned slave
  /// node, in columns (shape=(n, gdim, gdim)).
  std::vector<double> frames(std::span<const double> x) const;

  /// @brief Mean unit normal of the master facets in front of each slave facet,
  /// zero where there are none (shape=(num_facets, 3)).
  /// @param[in] x Positions.
  /// @param[in] pairs kernel::Pairs of facets.
  /// @param[in] weight Integrals of the pairs (shape=(num_pairs, width,
  /// width)).
  std::vector<double> master_normals(std::span<const double> x,
                                     const geometry::FacetPairs& pairs,
                                     std::span<const double> weight) const;

  /// @brief 1 at slave facets that have a node on an edge of the surface, where
  /// facets meet at an angle that no mesh of a smooth surface has, else 0;
  /// collective.
  /// @param[in] x Positions.
  std::vector<std::int8_t> at_edges(std::span<const double> x) const;

  /// @brief Normals midway between those of each slave facet and its master
  /// (shape=(num_facets, 3)): small sliding keeps those of the reference, and
  /// two surfaces that are pressed together meet midway.
  /// @param[in] x Positions.
  /// @param[in] pairs kernel::Pairs of facets.
  /// @param[in] weight Integrals of the pairs (shape=(num_pairs, width,
  /// width)).
  /// @param[in] normal Normals of the slave facets (shape=(num_facets, 3)).
  std::vector<double> between(std::span<const double> x,
                              const geometry::FacetPairs& pairs,
                              std::span<const double> weight,
                              std::span<const double> normal) const;

private:
  const SlaveNodes* _slaves;
  std::array<double, 3> master_normal(std::span<const double> x,
                                      std::int32_t facet) const;

  int _gdim;
  geometry::QuadraticFacets _slave, _master;
  std::vector<std::int32_t> _numbers;
  double _inradius;
};

/// @brief Vectors of unit length; zero stays zero (shape=(n, 3)).
void normalise(std::span<double> vectors);
} // namespace contactx::contact
