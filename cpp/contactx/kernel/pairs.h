// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#pragma once

#include "layout.h"
#include <cstdint>
#include <vector>

namespace contactx::kernel
{
/// @brief Pairs of slave nodes, or of slave facets, with master facets of one
/// kind: what kernels are called for. Arrays are row-major.
struct Pairs
{
  int num_slaves = 1; ///< slave nodes of a pair: one, or those of a facet
  int num_nodes = 0;  ///< nodes of the master facet, 0 for a rigid obstacle
  int data_size = 0;  ///< values a pair
  int slip_size = 0;  ///< values of slip a pair, 0 where there are none
  bool is_movement = false; ///< whether they measure slip alone

  /// Slave nodes by their place among those of the contact, those of other
  /// ranks last (shape=(num_pairs, num_slaves))
  std::vector<std::int32_t> slaves;
  /// The slave nodes and those of the master facet among all nodes of this
  /// rank (shape=(num_pairs, num_slaves + num_nodes))
  std::vector<std::int32_t> nodes;
  /// Data of a pair that the kernels read, see kernel/layout.h
  /// (shape=(num_pairs, data_size))
  std::vector<double> data;
  /// Slip data that they read (shape=(num_pairs, slip_size))
  std::vector<double> slip;

  /// @brief Number of pairs.
  std::size_t size() const { return slaves.size() / num_slaves; }

  /// @brief Data of a pair of single slave nodes, a FacetPair or a
  /// ObstaclePair.
  template <class Row>
  Row row(std::size_t pair) const
  {
    return kernel::read<Row>(data.data() + data_size * pair);
  }

  /// @brief Slip data of such a pair, a FacetSlip or a
  /// ObstacleSlip.
  template <class Row>
  Row slip_row(std::size_t pair) const
  {
    return kernel::read<Row>(slip.data() + slip_size * pair);
  }

  /// @brief Add the data of a pair.
  template <class Row>
  void add(const Row& row)
  {
    const auto values = kernel::values_of(std::span(&row, 1));
    data.insert(data.end(), values.begin(), values.end());
  }

  /// @brief Add the slip data of a pair.
  template <class Row>
  void add_slip(const Row& row)
  {
    const auto values = kernel::values_of(std::span(&row, 1));
    slip.insert(slip.end(), values.begin(), values.end());
  }

  /// @brief True if other pairs have the same nodes, so that forms of these
  /// serve them, too.
  bool same(const Pairs& other) const
  {
    return is_movement == other.is_movement and slaves == other.slaves
           and nodes == other.nodes;
  }
};

/// @brief Relative movement of slave nodes and their masters as a matrix of
/// slave nodes and nodes, by its entries; those of one place add up.
struct Weights
{
  std::vector<std::int32_t> slaves; ///< by their place in the contact
  std::vector<std::int32_t> nodes;  ///< among all nodes of this rank
  std::vector<double> values; ///< 1 for the slave node, -N_l for its master's
};
} // namespace contactx::kernel
