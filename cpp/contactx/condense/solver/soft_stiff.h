// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#pragma once

#include "coarse_model.h"
#include "tuning.h"

namespace contactx::condense
{
/// @brief Factors of a block, kept while contact changes it little. All ranks
/// must take part in all of it.
class BlockFactors
{
public:
  /// @brief Take displacements.
  /// @param[in] algebra What factorises.
  /// @param[in] part The displacements.
  /// @param[in] name Name of the factors.
  BlockFactors(Algebra& algebra, DofBlock part, std::string_view name)
      : part(std::move(part)), _algebra(algebra), _name(name)
  {
  }

  /// @brief Factorise it where contact has changed it.
  /// @param[in] change What contact adds to the bulk's block.
  /// @param[in] make Makes the whole block; its first unknowns are those of the
  /// part.
  /// @param[in] is_symmetric Whether the block is symmetric.
  /// @param[in] group Number of successive unknowns that belong together.
  /// @param[in] max_change Relative difference to the change in the factors up
  /// to which they are kept.
  /// @return Whether it was factorised.
  bool update(MatrixPtr change, const std::function<MatrixPtr()>& make,
              bool is_symmetric, int group, double max_change);

  /// @brief Drop the factors.
  void drop();

  /// @brief Whether the factors are of another matrix.
  bool is_old() const { return _is_old; }

  /// @brief Solve for the values of all displacements at those of the block.
  /// @param[in] values Right-hand side (shape=(num_owned)).
  /// @param[out] found Solution, written at those of the block
  /// (shape=(num_owned)).
  void solve(std::span<const double> values, std::span<double> found);

  /// The displacements
  DofBlock part;

private:
  Algebra& _algebra;
  std::string_view _name;
  bool _is_old = false;
  MatrixPtr _change;
  std::unique_ptr<Factors> _factors;
  std::vector<double> _b, _x;
};

/// @brief FGMRES with a block preconditioner of soft and stiff bodies, with an
/// approximate Schur complement.
///
/// Once the multipliers are eliminated contact couples the unknowns c of soft
/// bodies and m of stiff ones, which are their masters. With factors of A_cc
/// the block triangular matrix
///
///     M = [A_cc A_cm; 0 S]
///
/// leaves A M^-1 with the eigenvalues of the Schur complement A_mm - A_mc
/// A_cc^-1 A_cm times S^-1 alone. S is A_mm with springs in the place of the
/// soft bodies. For each unit of area these are as stiff as 1 / u for the
/// longest waves, where a traction of one all over the contact moves a node by
/// u, and as sum d / sum a for the shortest ones, d being the bulk's diagonal
/// and a the contact area of closed nodes. A spring is a weighted geometric
/// mean of both, as the condition of an optimised Schwarz method is (Gander
/// 2006). The larger the contact the more long waves differ from short ones,
/// and the more iterations that takes: once these are too many, a coarse model
/// of the soft bodies takes the place of the ground. It takes fewer, but its
/// factors and each iteration cost more.
///
/// Multipliers that stay unknowns belong to m. Where no bodies differ all
/// unknowns are in c.
///
/// Factors serve until contact has changed their block much, and for as long as
/// that costs fewer iterations than new ones. All ranks must take part in all
/// of it.
class SoftStiffSolver
{
public:
  /// @brief Create a solver.
  /// @param[in] algebra What factorises; it must outlive this.
  /// @param[in] bodies The bodies.
  /// @param[in] tuning Costs and limits; it must outlive this.
  SoftStiffSolver(Algebra& algebra, std::shared_ptr<const mesh::Bodies> bodies,
                  const Tuning& tuning)
      : _algebra(algebra), _bodies(std::move(bodies)), _tuning(tuning)
  {
  }
  // Matrices call it
  SoftStiffSolver(const SoftStiffSolver&) = delete;
  SoftStiffSolver& operator=(const SoftStiffSolver&) = delete;

  /// @brief Whether there are stiff bodies and soft ones.
  bool tells_apart(CondensedOperator& K_c) const;

  /// @brief Solve K_c v = rhs.
  /// @param[in] K_c The condensed matrix.
  /// @param[in] rhs Right-hand side.
  /// @param[in,out] v Start of the iterations, then the solution.
  /// @param[in] target What the norm of the residual must fall below.
  /// @return Whether the iterations converged.
  bool solve(std::shared_ptr<CondensedOperator> K_c,
             std::span<const double> rhs, std::span<double> v, double target);

  /// @brief Drop all factors.
  void reset();

  /// @brief Start to count.
  void begin_step() { _iterations = _factorisations = 0; }

  /// @brief Krylov iterations since `begin_step`.
  int iterations() const { return _iterations; }

  /// @brief Factorisations of blocks since `begin_step`.
  int factorisations() const { return _factorisations; }

private:
  bool iterate(std::span<const double> rhs, std::span<double> v, double target,
               double reduction);
  void update(std::optional<double> reduction);
  void split();
  bool update_stiff(const Transforms& transforms, double max_change);
  std::vector<double> springs();
  std::vector<double> stiffness_per_area();
  void precondition(std::span<const double> r, std::span<double> z);
  int num_old() const;

  Algebra& _algebra;
  std::shared_ptr<const mesh::Bodies> _bodies;
  const Tuning& _tuning;
  std::shared_ptr<CondensedOperator> _K_c;
  std::shared_ptr<const CondensedOperator> _updated_for;
  // Displacements of this rank that the blocks are of
  std::shared_ptr<const Numbering> _numbering;
  std::unique_ptr<BlockFactors> _soft, _stiff;
  std::unique_ptr<CoarseModel> _model;
  std::unique_ptr<FlexibleGMRES> _gmres;
  std::optional<std::vector<double>> _per_area;
  bool _has_model = false;
  int _built_at = -1;
  // Iterations that new factors cost where those at hand are of another matrix,
  // else zero, and those lost since they were new
  int _renewal = 0;
  double _lost = 0;
  // Iterations for a reduction of the residual by e with new factors, the last
  // ones most
  double _rate = 0;
  int _iterations = 0, _factorisations = 0;
  std::vector<double> _work;
};
} // namespace contactx::condense
