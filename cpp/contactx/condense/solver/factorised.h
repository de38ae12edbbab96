// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#pragma once

#include "algebra.h"
#include "tuning.h"

namespace contactx::condense
{
/// @brief GMRES on the system of all unknowns with the factors of an older
/// Jacobian, for as long as that pays.
///
/// Between two Jacobians little differs: rows of nodes that have changed their
/// status, normals that have turned. So iterations are few, and a new
/// factorisation is made once those since the last one have cost as much. All
/// ranks must take part in all of it.
class FactorisedSolver
{
public:
  /// @brief Create a solver.
  /// @param[in] algebra What factorises; it must outlive this.
  /// @param[in] tuning Costs; it must outlive this.
  FactorisedSolver(Algebra& algebra, const Tuning& tuning)
      : _algebra(algebra), _tuning(tuning), _solver(algebra.direct_solver())
  {
  }

  /// @brief Solve J x = b with the Jacobian of now.
  /// @param[in] b Right-hand side.
  /// @param[out] x Solution; not finite where the Jacobian is singular.
  /// @param[in] target What the norm of the residual must fall below.
  /// @param[in] springs What holds free bodies.
  /// @param[in] is_last Whether it is to be the last solve of a step. Where
  /// nodes are on the edge of stick and slip the next step starts from them as
  /// they are, so what is left of an older Jacobian must not move them.
  void solve(std::span<const double> b, std::span<double> x, double target,
             const Springs& springs, bool is_last);

  /// @brief Drop the factors: an error of the host may have left them half
  /// done.
  void reset();

  /// @brief Start to count.
  void begin_step() { _iterations = _factorisations = 0; }

  /// @brief Iterations since `begin_step`.
  int iterations() const { return _iterations; }

  /// @brief Factorisations since `begin_step`.
  int factorisations() const { return _factorisations; }

private:
  bool iterate(std::span<const double> b, std::span<double> x, double target,
               int most);

  Algebra& _algebra;
  const Tuning& _tuning;
  std::unique_ptr<DirectSolver> _solver;
  bool _has_factors = false;
  int _lost = 0; // iterations since the last factorisation
  int _iterations = 0, _factorisations = 0;
};
} // namespace contactx::condense
