// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#pragma once

#include "../condense/solver/factorised.h"
#include "../condense/solver/field_split.h"
#include "../condense/solver/multigrid_solver.h"
#include "../condense/solver/predictor.h"
#include "../condense/solver/soft_stiff.h"
#include "../solve/accuracy.h"
#include "problem.h"

namespace contactx::problem
{
/// @brief Solves the system of the Jacobian with the multipliers eliminated.
///
/// The displacements that are left are found by CG, or GMRES where friction
/// slips, with a multigrid hierarchy that is updated with the contact. Where
/// multigrid is slow, and where multipliers remain unknowns, a block
/// preconditioner of soft and stiff bodies takes its place. Other fields are
/// solved for together with the displacements, by field splitting. What cannot
/// be condensed goes to a direct solver whose factors serve several Jacobians.
/// Each solve is as accurate as the next residual will show.
///
/// It follows the problem by itself: where a step has started, or was taken
/// back, and which iterate was judged last. All ranks must take part in all of
/// it.
class CondensedSolver final : public LinearSolver
{
public:
  /// @brief What solves of a step have done.
  struct Statistics
  {
    int solves = 0;         ///< linear solves
    int iterations = 0;     ///< Krylov iterations, by any of the solvers
    int hierarchies = 0;    ///< hierarchies made
    int factorisations = 0; ///< factorisations, of blocks or of the whole
    int factorised = 0;     ///< those of the whole
    /// Why solves had the block preconditioner of bodies
    std::vector<std::string> by_bodies;
    std::vector<std::string> direct;       ///< why solves were not condensed
    std::map<std::string, double> seconds; ///< wall seconds of parts
  };

  /// @brief Create a solver.
  /// @param[in] problem The problem; it must outlive this.
  /// @param[in] algebra Operations of the host.
  CondensedSolver(Problem& problem, std::shared_ptr<condense::Algebra> algebra);

  /// Costs and limits, which may be changed
  condense::Tuning tuning;

  /// @brief Nothing needs to be assembled before.
  void update() override {}

  /// @brief Solve J x = b at the iterate that was judged last.
  /// @param[in] b Right-hand side (shape=(size)).
  /// @param[out] x Solution; not finite where there is none (shape=(size)).
  void solve(std::span<const double> b, std::span<double> x) override;

  /// @brief Multiply by the Jacobian, y = J x.
  void multiply(std::span<const double> x, std::span<double> y);

  /// @brief Drop the results of earlier solves: after a failed step they are of
  /// no use, or half done. What the failed step found of multigrid does not
  /// count either.
  void reset();

  /// @brief What the solves of this step have done.
  Statistics statistics();

private:
  using Spans = std::span<const double>;

  void follow();
  double target() const;
  const condense::Springs& springs() const;
  std::shared_ptr<condense::CondensedOperator> condensed(Spans b);
  bool solve_condensed(Spans b, std::span<double> x);
  bool iterate(std::shared_ptr<condense::CondensedOperator> K_c,
               bool is_retained, Spans rhs, std::span<double> v, double target);
  bool is_slow(std::shared_ptr<condense::CondensedOperator> K_c, Spans rhs,
               std::span<double> v);
  bool iterate_with_fields(Spans rhs, std::span<double> x, double target);
  void solve_directly(Spans b, std::span<double> x, std::string reason);

  Problem& _problem;
  std::shared_ptr<condense::Algebra> _algebra;
  solve::Accuracy _accuracy;
  condense::MultigridSolver _multigrid;
  condense::SoftStiffSolver _soft_stiff;
  condense::FieldSplitSolver _field_split;
  condense::FactorisedSolver _factorised;
  condense::Predictor _predictor;
  std::shared_ptr<const condense::Numbering> _numbering;
  std::shared_ptr<const condense::Condensation> _condensation;
  int _halo_version = -1;
  // What of the problem was followed
  int _starts = -1, _restores = 0, _number = -1;
  bool _is_predicted = false;
  // Whether multigrid has solved a system, so that its first digit is not asked
  // for apart
  bool _multigrid_serves = false;
  // Failures of multigrid, of multigrid where multipliers are left, and of the
  // block preconditioner: those of now, and at the start of the step
  struct Failures
  {
    int multigrid = 0, retained = 0, bodies = 0;
  } _failures, _failures_before;
  Statistics _statistics;
};
} // namespace contactx::problem
