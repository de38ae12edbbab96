// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#pragma once

#include "../contact/contact.h"
#include "../math/triplets.h"

namespace contactx::results
{
/// @brief Scalar fields on both sides of a contact, by its pairs of now.
///
/// With the weights w_ij of the relative movement of slave node i and its
/// master the difference of a field T is d_i = sum_j w_ij T_j: its value at the
/// slave node less that of the master in front of it. What flows there from the
/// slave to the master is h_i A_i d_i with a coefficient h and the area A_i:
/// node j gives w_ij of it, so that nothing is lost on the way, on any mesh. By
/// surface to surface d is a mean with the dual functions, and uniform flows
/// are exact (as the contact patch test, Popp et al., 2010).
///
/// Arrays are of the owned slave nodes (n) or of all nodes of this rank
/// (num_nodes). Sizes that do not fit throw std::invalid_argument.
class Transfer
{
public:
  /// @brief Take the pairs as they are now.
  /// @param[in] contact The contact.
  explicit Transfer(const contact::Contact& contact);

  /// @brief 1 at slave nodes that have a master in front of them, and an area
  /// (shape=(n)).
  const std::vector<std::int8_t>& is_paired() const { return _is_paired; }

  /// @brief Differences of a field, zero where there is no pair.
  ///
  /// A rigid obstacle has no field: differences are the values themselves.
  /// @param[in] field Values (shape=(num_nodes)).
  /// @return Differences (shape=(n)).
  std::vector<double> differences(std::span<const double> field) const;

  /// @brief Add up flows that leave the nodes.
  /// @param[in] flow Flow from each slave node to its master (shape=(n)).
  /// @param[in,out] b Sums, of which those of nodes of other ranks belong there
  /// (shape=(num_nodes)).
  void add(std::span<const double> flow, std::span<double> b) const;

  /// @brief Derivative of what leaves the nodes by the field.
  /// @param[in] h Coefficient (shape=(n)).
  /// @return Entries w_ik h_i A_i w_ij, nodes by nodes: symmetric.
  Triplets by_field(std::span<const double> h) const;

  /// @brief Derivative of what leaves the nodes by the displacement, where
  /// flows depend on gaps; pairs and normals stay.
  /// @param[in] factor Derivative of each slave node's flow by its gap
  /// (shape=(n)).
  /// @return Entries w_ik factor_i n_i w_ij, nodes by displacements.
  Triplets by_displacement(std::span<const double> factor) const;

  /// @brief Derivative of what leaves the nodes by something of the slave
  /// nodes.
  /// @param[in] factor Derivative of each slave node's flow (shape=(n)).
  /// @return Entries w_ij factor_i, nodes by slave nodes.
  Triplets by_slaves(std::span<const double> factor) const;

  /// @brief Areas that flows go through, zero where there is no pair
  /// (shape=(n)).
  const std::vector<double>& area() const { return _area; }

  /// @brief Means of a field of the slave nodes at the master's nodes, by the
  /// areas in which they overlap; collective.
  /// @param[in] values Values, of which those without a pair do not count
  /// (shape=(n)).
  /// @return Means, NaN at nodes without a slave node (shape=(num_owned)).
  std::vector<double> at_master(std::span<const double> values) const;

private:
  template <class F>
  void for_each(F&& f) const;

  const mesh::Halo& _halo;
  kernel::Weights _weights;
  std::vector<double> _normals; // (n, 3)
  Groups _of_slave;             // entries of each slave node
  std::vector<double> _area;
  std::vector<std::int8_t> _is_paired, _is_slave;
};
} // namespace contactx::results
