// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#pragma once

#include "galerkin.h"
#include "tuning.h"

namespace contactx::condense
{
/// @brief CG or GMRES with algebraic multigrid, kept from one condensed matrix
/// to the next.
///
/// Aggregates and prolongations are those of the bulk without contact, made
/// once. What contact changes in the condensed matrix is few rows, and its
/// projections are added to the matrices of the coarser levels wherever more
/// than a few displacements are constrained that were not, or no longer, and
/// where the iterations do not converge without. On the finest level the
/// condensed matrix is applied as it is.
///
/// Where the bulk's own matrix changes the hierarchy is made anew once it has
/// cost as many iterations too many as a new one costs, or where the iterations
/// do not converge with it. All ranks must take part in all of it.
class MultigridSolver
{
public:
  /// @brief Create a solver.
  /// @param[in] algebra What multigrid is of; it must outlive this.
  /// @param[in] tuning Costs; it must outlive this.
  MultigridSolver(Algebra& algebra, const Tuning& tuning)
      : _algebra(algebra), _tuning(tuning)
  {
  }
  // Matrices call it
  MultigridSolver(const MultigridSolver&) = delete;
  MultigridSolver& operator=(const MultigridSolver&) = delete;

  /// @brief Solve K_c v = rhs.
  /// @param[in] K_c The condensed matrix.
  /// @param[in] rhs Right-hand side.
  /// @param[in,out] v Start of the iterations, then the solution.
  /// @param[in] target What the norm of the residual must fall below.
  /// @return Whether the iterations converged.
  bool solve(std::shared_ptr<CondensedOperator> K_c,
             std::span<const double> rhs, std::span<double> v, double target);

  /// @brief Make what preconditions a condensed matrix.
  /// @param[in] K_c The condensed matrix.
  void prepare(std::shared_ptr<CondensedOperator> K_c);

  /// @brief Apply one cycle, v = M r, of the matrix prepared for.
  void cycle(std::span<const double> r, std::span<double> v)
  {
    _hierarchy->cycle(r, v);
  }

  /// @brief Solve with the matrix prepared for, to a tenth of the right-hand
  /// side.
  /// @param[in] rhs Right-hand side.
  /// @param[in,out] v Start of the iterations, then what they have found.
  /// @return False where multigrid is slow.
  bool solve_roughly(std::span<const double> rhs, std::span<double> v);

  /// @brief Iterate with `cycle`: again with coarser levels, and then with a
  /// hierarchy, of now if these were older and it did not converge.
  /// @param[in] K_c The condensed matrix.
  /// @param[in] iterate Iterates, and says whether that converged.
  /// @return Whether it did at last.
  bool solve_with(std::shared_ptr<CondensedOperator> K_c,
                  const std::function<bool()>& iterate);

  /// @brief Count iterations that `cycle` has preconditioned.
  /// @param[in] iterations Their number.
  /// @param[in] reduction Logarithm of what they were to reduce the residual
  /// by.
  void count(int iterations, double reduction);

  /// @brief Drop the hierarchy: two at once would be the largest part of the
  /// memory.
  void reset();

  /// @brief Start to count.
  void begin_step() { _iterations = _hierarchies = 0; }

  /// @brief Krylov iterations since `begin_step`.
  int iterations() const { return _iterations; }

  /// @brief Hierarchies made since `begin_step`.
  int hierarchies() const { return _hierarchies; }

private:
  bool iterate(std::span<const double> rhs, std::span<double> v, double target);
  Iterations run(std::span<const double> rhs, std::span<double> v,
                 bool is_symmetric, double target, int most);
  void build();
  void update(const ContactUpdate& change, bool coarse);

  Algebra& _algebra;
  const Tuning& _tuning;
  std::shared_ptr<CondensedOperator> _K_c;
  std::unique_ptr<Hierarchy> _hierarchy;
  std::unique_ptr<Galerkin> _galerkin;
  // What the hierarchy was brought up to, and whether without its coarser
  // levels
  std::shared_ptr<const CondensedOperator> _updated_for;
  bool _serves = false;
  // Iterations for a reduction by e while the hierarchy was new, and those lost
  // since
  double _rate = 0, _lost = 0;
  int _built_at = 0; // assemblies of the bulk
  int _iterations = 0, _hierarchies = 0;
};

/// @brief Rigid modes of all nodes, zero where displacements are prescribed.
///
/// Hertz takes up to 15 % more iterations where they are not zero there.
/// @param[in] ranks The ranks, all of which take part.
/// @param[in] x Positions of owned nodes (shape=(n, gdim)).
/// @param[in] prescribed Whether a displacement is prescribed
/// (shape=(n, gdim)).
/// @param[in] gdim Geometric dimension.
/// @return Three modes in 2D, six in 3D (shape=(n, gdim)) each.
std::vector<std::vector<double>>
rigid_modes(mesh::Ranks& ranks, std::span<const double> x,
            std::span<const std::int8_t> prescribed, int gdim);
} // namespace contactx::condense
