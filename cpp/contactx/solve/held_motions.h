// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#pragma once

#include "../mesh/ranks.h"
#include <Eigen/Core>
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
  /// @param[in] field Displacements by each motion at owned dofs, zero at
  /// prescribed ones (shape=(k, num_owned * gdim)).
  /// @param[in] supports Stiffness at the dofs that are held, zero at others
  /// (shape=(num_owned * gdim)).
  HeldMotions(mesh::Ranks& ranks, Eigen::MatrixXd field,
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
  Eigen::MatrixXd _field;
  std::vector<Eigen::Index> _dofs;
  /// Of unit motions at the supports
  Eigen::FullPivLU<Eigen::MatrixXd> _work;
  double _force = 0;
};
} // namespace contactx::solve
