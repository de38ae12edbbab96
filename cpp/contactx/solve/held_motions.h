// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#pragma once

#include "motion_fields.h"
#include <Eigen/LU>
#include <span>
#include <vector>

namespace contactx::solve
{
/// @brief Rigid motions of bodies that supports hold, as many as there are
/// motions: these are statically determinate, so that they strain nothing.
class HeldMotions
{
public:
  /// @brief Hold motions.
  /// @param[in] ranks The ranks.
  /// @param[in] fields Displacements by each motion, zero at prescribed dofs.
  /// @param[in] supports Stiffness at the dofs that are held, zero at others
  /// (shape=(num_owned * gdim)).
  HeldMotions(mesh::Ranks& ranks, MotionFields fields,
              std::span<const double> supports);

  /// @brief Take the forces of the supports off a residual: what is left does
  /// no work on the motions. Collective.
  /// @param[in,out] force Residual, of which the first entries are those of the
  /// displacements of owned nodes (shape=(>= num_owned * gdim)).
  void take_off(std::span<double> force);

  /// @brief Norm of the forces that were taken off last.
  double force() const { return _force; }

private:
  mesh::Ranks& _ranks;
  MotionFields _fields;
  /// Supports of each part, by their number among its dofs
  std::vector<std::vector<Eigen::Index>> _supports;
  /// Of unit motions at these
  std::vector<Eigen::FullPivLU<Eigen::MatrixXd>> _work;
  double _force = 0;
};
} // namespace contactx::solve
