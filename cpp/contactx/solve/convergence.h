// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#pragma once

#include "../math/scales.h"
#include "system.h"
#include <optional>

namespace contactx::solve
{
/// @brief Compares a residual with the forces of the problem.
///
/// The residual is relative to the forces of the bulk: in equilibrium the
/// bulk's residual is what supports and contacts carry. Multipliers are no
/// measure of the forces: far from the solution they may be huge, and where a
/// constraint is redundant they are arbitrary.
///
/// The tolerance is not below the rounding errors of the forces of stiff
/// bodies. These errors must not hide a residual elsewhere: once the whole
/// residual is below the tolerance, what exceeds the rounding error at each
/// node must be below a tolerance without rounding errors.
///
/// Where all forces cancel, as in a stress-free thermal strain, nothing but
/// rounding errors is left to measure the residual by. It is small then if it
/// is no larger than the rounding error at each node.
///
/// Rows of Dirichlet conditions are differences of displacements. They are
/// compared apart from the forces, so that nothing depends on the units.
///
/// Rows of other fields have units of their own. Those of each field are
/// relative to the largest residual that the field has had in the step, and not
/// below the rounding errors of their terms. All ranks must call
/// its functions without const.
class Convergence
{
public:
  /// @brief Residual and tolerance of an iterate.
  struct Result
  {
    double residual;  ///< its norm
    double tolerance; ///< bound of the residual
    double forces;    ///< forces of the problem
    double defect;    ///< the largest difference from a Dirichlet value
  };

  /// @brief Take the system.
  explicit Convergence(std::shared_ptr<System> system);

  /// @brief Start a step.
  /// @param[in] stiffness Stiffness of each owned node, zero where it cannot
  /// move, force/length (shape=(num_owned)).
  void begin_step(std::vector<double> stiffness);

  /// @brief Compare a residual.
  /// @param[in] b What `System::residual` gave.
  /// @param[in] rtol Tolerance relative to the forces.
  /// @param[in] atol Absolute tolerance.
  Result compare(std::span<const double> b, double rtol, double atol);

  /// @brief Take the converged state as the start of the next step.
  void accept();

  /// @brief Forces of the problem: norm of the bulk's residual.
  double scale();

  /// @brief Forces that those on a free body are balanced relative to:
  /// round-off errors of forces that cancel push no body anywhere.
  double scale_of_balance();

  /// @brief Length, stiffness and forces of the scene in this step.
  const math::Scales& scales() const { return _scales; }

  /// @brief Largest distance that bodies may have to move: the size of the
  /// scene, or the largest Dirichlet value, which may take a body anywhere.
  double farthest();

  /// @brief Factors by which residuals of other fields compare with forces.
  /// @param[in] sizes What the displacements' change alone would leave in the
  /// rows of each field, which counts as a residual that the field has had.
  /// @param[in] residual Residual of now: forces are that large at least.
  std::vector<double> weights_of_fields(std::span<const double> sizes,
                                        double residual);

  /// @brief True if a residual would deform bodies by less than anyone asks
  /// for.
  bool may_be_rounding(double residual) const;

private:
  mesh::Ranks& ranks() const { return _system->halo()->ranks(); }
  double norm(std::span<const double> values) const;
  std::vector<double> sizes() const;
  std::vector<double> sizes_of_terms() const;
  std::vector<double> around(std::vector<double> sizes) const;
  std::vector<double> errors() const;
  double largest_error() const;
  std::optional<std::vector<double>> rounding_of_cancelling(double residual);
  void look_into_cells(double force);
  bool has_run_away();
  double scale_of_accepted();
  Result compare_forces(std::span<const double> b, double rtol, double atol);
  std::vector<double> gap_lengths() const;
  double excess_of_fields(std::span<const double> b, double rtol);

  std::shared_ptr<System> _system;
  math::Scales _scales;
  std::vector<double> _stiffness;
  // Size of the cells: where strains are differences of 1 and the deformation
  // gradient, they have its round-off
  std::vector<double> _cell_size;
  // Sizes of the forces that cancel, and the residual before
  std::optional<std::vector<double>> _cancelling;
  std::optional<double> _before;
  // Largest residual of each other field in the step
  std::vector<double> _field_scales;
  // Forces of the bulk at the last solution, and what its residual was
  // relative to
  std::optional<std::pair<std::vector<double>, double>> _accepted;
};
} // namespace contactx::solve
