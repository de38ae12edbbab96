// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#pragma once

#include "multigrid_solver.h"

namespace contactx::condense
{
/// @brief Displacements and other fields together: FGMRES with a preconditioner
/// by field splitting.
///
/// With the condensed matrix K_c of the displacements, z = (I + right) v, and
/// the bulk's blocks K_uf, K_fu and K_ff,
///
///     K_c v + (I + left) K_uf f = rhs,    K_fu z + K_ff f = rows.
///
/// The preconditioner is the upper block triangle, with a cycle of multigrid
/// for K_c, and for the Schur complement K_ff - K_fu K^-1 K_uf the factors of
/// K_ff - c diag(K_fu diag(K)^-1 K_uf). That diagonal is near the mass of
/// pressures over the shear modulus, which is what the Schur complement of
/// incompressible bodies is (M. Benzi, G. H. Golub and J. Liesen, Numerical
/// solution of saddle point problems, Acta Numerica 14, 2005, section 10); c
/// gives it the mean of the eigenvalues. It is left out in rows where it would
/// cancel with K_ff, as for bubbles, whose own stiffness counts. All ranks must
/// take part in all of it.
class FieldSplitSolver
{
public:
  /// @brief Create a solver.
  /// @param[in] algebra Operations of the host; it must outlive this.
  /// @param[in] multigrid That of the displacements; it must outlive this.
  /// @param[in] tuning Costs; it must outlive this.
  FieldSplitSolver(Algebra& algebra, MultigridSolver& multigrid,
                   const Tuning& tuning)
      : _algebra(algebra), _multigrid(multigrid), _tuning(tuning)
  {
  }
  // Matrices call it
  FieldSplitSolver(const FieldSplitSolver&) = delete;
  FieldSplitSolver& operator=(const FieldSplitSolver&) = delete;

  /// @brief Take the condensed matrix, and the blocks of the bulk as it is now.
  /// @param[in] K_c The condensed matrix.
  /// @param[in] offsets Where each field begins among this rank's values of all
  /// of them, and the end of the last one.
  void update(std::shared_ptr<CondensedOperator> K_c,
              std::vector<std::size_t> offsets);

  /// @brief Norms of the fields' rows that displacements alone would leave.
  /// @param[in] rhs Right-hand side of the displacements (shape=(num_owned)).
  /// @return One a field.
  std::vector<double> sizes(std::span<const double> rhs);

  /// @brief Solve.
  /// @param[in] rhs Right-hand side, of displacements, then fields.
  /// @param[in] weights Factor of each field's rows, by which their residuals
  /// compare with forces.
  /// @param[in,out] x Start of the iterations, then the solution.
  /// @param[in] target What the norm of the residual must fall below.
  /// @return Whether the iterations converged.
  bool solve(std::span<const double> rhs, std::span<const double> weights,
             std::span<double> x, double target);

  /// @brief Add forces by fields, w += K_uf f.
  void add_forces(std::span<const double> f, double factor,
                  std::span<double> w);

  /// @brief Give the fields' rows, K_fu u + K_ff f.
  std::vector<double> rows(std::span<const double> u,
                           std::span<const double> f);

  /// @brief Drop factors and vectors.
  void reset();

  /// @brief Start to count.
  void begin_step() { _iterations = _factorisations = 0; }

  /// @brief Krylov iterations since `begin_step`.
  int iterations() const { return _iterations; }

  /// @brief Factorisations of the fields' block since `begin_step`.
  int factorisations() const { return _factorisations; }

private:
  using Span = std::span<const double>;

  void multiply(Span x, std::span<double> y);
  void precondition(Span r, std::span<double> z);
  void factorise();
  double mean_eigenvalue(Span diagonal);

  Algebra& _algebra;
  MultigridSolver& _multigrid;
  const Tuning& _tuning;
  std::shared_ptr<CondensedOperator> _K_c;
  FieldBlocks _blocks;
  std::vector<std::size_t> _offsets;
  std::unique_ptr<Factors> _schur;
  std::unique_ptr<FlexibleGMRES> _gmres;
  std::vector<double> _weights; // of each row
  std::vector<double> _z, _forces, _rows;
  int _updated_at = -1; // assemblies of the bulk
  int _iterations = 0, _factorisations = 0;
};
} // namespace contactx::condense
