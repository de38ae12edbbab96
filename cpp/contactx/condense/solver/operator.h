// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#pragma once

#include "../../mesh/bodies.h"
#include "../condensation.h"
#include "../dependent_constraints.h"
#include "chains.h"
#include <array>
#include <functional>
#include <optional>

namespace contactx::condense
{
/// @brief What turns the bulk's matrix into the condensed one, as matrices over
/// all displacements. Of what eliminations need of one another the first terms
/// of the series are in right and left.
struct Transforms
{
  MatrixPtr right;     ///< eliminated displacements by the others
  MatrixPtr left;      ///< rows that take over others
  MatrixPtr law;       ///< rows of the law
  MatrixPtr stiffness; ///< contact's part of the stiffness
  MatrixPtr springs;   ///< springs of soft nodes
};

/// @brief What contact changes in the bulk's matrix K, by the constrained
/// displacements e in order, without what friction adds.
struct ContactUpdate
{
  /// Their places among the displacements of this rank's slave nodes
  /// (shape=(k))
  std::vector<std::int32_t> places;
  MatrixPtr right; ///< their rows of `right`, (k, num_dofs)
  /// What they need of one another, (k, k); null where they do not
  const Matrix* chains = nullptr;
  MatrixPtr block;   ///< block K_ee, (k, k)
  MatrixPtr springs; ///< springs, (num_dofs, num_dofs), or null
  /// Diagonal with which the eigenvalues stay those of the bulk
  /// (shape=(num_owned))
  std::vector<double> bound;
};

/// @brief Unknowns of soft bodies and of stiff ones.
struct SoftAndStiff
{
  std::vector<std::int32_t> soft;  ///< owned displacements of soft bodies
  std::vector<std::int32_t> stiff; ///< those of stiff ones
};

/// @brief K_c = (I + left) (K + S) (I + right) + law (I + right) + springs,
/// with little on the diagonal for what is eliminated.
///
/// Where eliminations need one another (I - C_r)^-1 right and left (I -
/// C_l)^-1 take the place of right and left, see Elimination. It is applied as
/// it stands: the bulk's matrix is neither copied nor changed, and the others
/// have entries in contact rows alone. All ranks must take part in all of it.
class CondensedOperator
{
public:
  /// @brief Make the operator of the bulk as it is now.
  /// @param[in] numbering Displacements of this rank.
  /// @param[in] condensation How the multipliers are eliminated.
  /// @param[in] springs What is added to the diagonal.
  /// @throws NotCondensable on all ranks where eliminations hold one another.
  CondensedOperator(std::shared_ptr<const Numbering> numbering,
                    std::shared_ptr<const Condensation> condensation,
                    Springs springs);

  /// @brief Displacements of this rank.
  const Numbering& numbering() const { return *_numbering; }

  /// @brief The same, to be kept.
  std::shared_ptr<const Numbering> shared_numbering() const
  {
    return _numbering;
  }

  /// @brief The eliminated displacements, in order.
  const std::vector<std::int32_t>& eliminated() const
  {
    return _condensation->elimination().eliminated();
  }

  /// @brief The same and those of soft nodes, in order.
  const std::vector<std::int32_t>& constrained() const
  {
    return _condensation->elimination().constrained();
  }

  /// @brief Displacements of all slave nodes, in order.
  const std::vector<std::int32_t>& slave_dofs() const
  {
    return _condensation->elimination().slave_dofs();
  }

  /// @brief Multipliers that remain unknowns, in the places of prescribed
  /// displacements.
  const RetainedMultipliers& retained() const
  {
    return _condensation->retained();
  }

  /// @brief Whether the condensed matrix is symmetric.
  bool is_symmetric() const { return _is_symmetric; }

  /// @brief Adds the forces of other fields at displacements z to those of the
  /// bulk.
  using Coupling
      = std::function<void(std::span<const double> z, std::span<double> w)>;

  /// @brief Multiply, y = K_c v.
  /// @param[in] v Displacements, without what is eliminated.
  /// @param[out] y Product.
  /// @param[in] couple Called with all displacements and their forces.
  void multiply(std::span<const double> v, std::span<double> y,
                const Coupling& couple = {});

  /// @brief Multiply by the bulk, w = (K + S) z.
  void multiply_bulk(std::span<const double> z, std::span<double> w);

  /// @brief Give all displacements, z = (I + right) v, whatever v has for
  /// eliminated ones.
  void expand(std::span<const double> v, std::span<double> z);

  /// @brief Combine rows, y = (I + left) w, zero in the eliminated ones.
  void combine(std::span<const double> w, std::span<double> y);

  /// @brief Add the law's rows, y += sign law z.
  void add_law(std::span<const double> z, std::span<double> y, double sign);

  /// @brief What of constrained displacements the constraints' right-hand side
  /// gives.
  /// @param[in,out] values The same where none needs another one
  /// (shape=(num_owned)).
  void place(std::span<double> values);

  /// @brief Make rows that give multipliers have one multiplier each.
  /// @param[in,out] values Rows (shape=(num_owned)).
  void release(std::span<double> values);

  /// @brief Unknowns of the condensed matrix.
  /// @param[in] x Unknowns of the whole system
  /// (shape=(num_owned + num_multipliers)).
  /// @param[in] factors Multipliers over their unknowns
  /// (shape=(num_multipliers)).
  /// @return Displacements, zero where eliminated, and multipliers in the
  /// places of prescribed ones (shape=(num_owned)).
  std::vector<double> unknowns(std::span<const double> x,
                               std::span<const double> factors) const;

  /// @brief Owned unknowns of soft bodies and of stiff ones, the same bodies on
  /// all ranks.
  SoftAndStiff parts(const mesh::Bodies& bodies);

  /// @brief Part of a residual that counts for the softest body.
  /// @param[in] bodies The bodies.
  /// @param[in] residual Residual of owned displacements (shape=(num_owned)).
  double residual_weight(const mesh::Bodies& bodies,
                         std::span<const double> residual);

  /// @brief Springs at masters that stand for the bodies of their slaves.
  /// @param[in] stiffness Stiffness of these bodies for each unit of contact
  /// area, zero where there is to be no spring (shape=(num_owned)).
  /// @return Springs at owned displacements (shape=(num_owned)).
  std::vector<double> master_springs(std::span<const double> stiffness) const;

  /// @brief Contact area of each owned displacement, by its forces for a
  /// multiplier of one; zero where nothing is closed (shape=(num_owned)).
  std::vector<double> areas() const;

  /// @brief Logarithm of what iterations must reduce the residual by, at least
  /// one.
  /// @param[in] rhs Right-hand side.
  /// @param[in] v Start of the iterations.
  /// @param[in] target What the norm of the residual must fall below.
  double reduction(std::span<const double> rhs, std::span<const double> v,
                   double target);

  /// @brief What turns the bulk's matrix into the condensed one.
  Transforms transforms() const;

  /// @brief Update of the bulk's matrix by contact.
  ContactUpdate contact_update();

private:
  void add_product(const Matrix& A, std::span<const double> x,
                   std::span<double> y, double factor = 1);
  std::span<const double> free_diagonal();
  std::vector<double> bound();

  std::shared_ptr<const Numbering> _numbering;
  Algebra& _algebra;
  std::shared_ptr<const Condensation> _condensation;
  Springs _springs;
  MatrixPtr _K;     // the bulk's
  MatrixPtr _right; // rows of the constrained displacements alone
  // Null where they have no entries on any rank
  MatrixPtr _S, _left, _law, _soft;
  // Whether left is the transpose of right: it is not made then
  bool _is_transposed, _is_symmetric;
  DependentConstraints _chains;
  std::unique_ptr<Chains> _of_right, _of_left; // _of_left null if transposed
  std::vector<double> _diagonal; // stands for eliminated displacements
  // That of the bulk, and with zero where displacements are prescribed
  std::vector<double> _bulk_diagonal, _free_diagonal;
  std::vector<double> _some, _z, _w, _work;
};
} // namespace contactx::condense
