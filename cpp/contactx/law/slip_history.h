// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#pragma once

#include "node_state.h"
#include <vector>

namespace contactx::law
{
/// @brief Slip and work of friction of the accepted steps. n is the number of
/// owned slave nodes; arrays are row-major.
class SlipHistory
{
public:
  /// @brief Start without slip.
  /// @param[in] num_nodes Number of slave nodes.
  /// @param[in] gdim Geometric dimension.
  SlipHistory(std::int32_t num_nodes, int gdim);

  /// @brief Add a converged step.
  /// @param[in] nodes State of the same slave nodes, with vector multipliers.
  /// @throws std::invalid_argument if they are others.
  void add(const NodeState& nodes);

  /// @brief Go on from other values.
  /// @param[in] slip As `slip` gave it.
  /// @param[in] total As `total` gave it.
  /// @param[in] dissipation As `dissipation` gave it.
  /// @throws std::invalid_argument if they are of other sizes; nothing has
  /// changed.
  void restore(std::vector<double> slip, std::vector<double> total,
               std::vector<double> dissipation);

  /// @brief Geometric dimension.
  int gdim() const { return _gdim; }

  /// @brief Increment of the last step, zero on open nodes (shape=(n, gdim)).
  const std::vector<double>& slip() const { return _slip; }

  /// @brief Accumulated length (shape=(n)).
  const std::vector<double>& total() const { return _total; }

  /// @brief Work of friction of each node in all steps, at least 0: energy
  /// (shape=(n)).
  const std::vector<double>& dissipation() const { return _dissipation; }

private:
  int _gdim;
  std::vector<double> _slip, _total, _dissipation;
};
} // namespace contactx::law
