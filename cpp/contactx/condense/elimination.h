// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#pragma once

#include "prescribed.h"
#include <array>

namespace contactx::condense
{
/// @brief Transforms that take the multipliers out of J (du, dl) = (b, d).
///
/// A multiplier follows from its slave node's own rows, T_s dl = b_s - K_s du,
/// as the slave side is diagonal. What it does to other rows is taken over by
/// `left`; a constraint without the multiplier gives a displacement of the
/// slave node, du = (I + right) v + shift, and where it slips the tangential
/// rows are those of the law: with tangential vectors tau_i the row of the
/// displacement i becomes tau_i (C_u - C_l T_s^-1 K_s), the natural one for no
/// friction.
///
/// So the displacements v follow from
///
///     (I + left + rows) ((K + S) ((I + right) v + shift) - b)
///         + law ((I + right) v + shift) = extra
///
/// but for the rows of eliminated displacements, in which v is zero.
///
/// That holds where no elimination needs another one. But what is integrated
/// over slave facets depends on all of their nodes as they slide, and a node
/// may be slave in one contact and master in another. With C_r the entries of
/// `right` between eliminated displacements and C_l those of `left` between
/// rows that give multipliers (see `chains`), (I - C_r)^-1 right takes the
/// place of `right`, (I - C_r)^-1 shift that of `shift`, (left + rows)
/// (I - C_l)^-1 that of left + rows, and multipliers follow from (I - C_l)^-1
/// times their rows.
///
/// A soft node, which has a derivative D by its multipliers where others that
/// stick or carry a scalar have none, is a spring. With B the coefficients of
/// its own displacements in C, its relative displacement g = B^-1 C u has the
/// stiffness k = -T_s D^-1 B, from zero to what is eliminated. So that it is
/// never stiff for the bulk, with the diagonal K_ss, its unknowns are neither
/// its displacements nor g but between both,
///
///     g(u) = Q g(v) + (1 - Q) B^-1 d,    Q = (1 + k / (r K_ss))^-1/2 :
///
/// `right` and `shift` have 1 - Q times the rows of an eliminated displacement,
/// `left` 1 - Q times the columns, and v has the spring Q k Q, that of k and
/// r K_ss in series. Where a node has several displacements k is a matrix, Q a
/// root of one.
///
/// All of it is of one rank alone: its slave nodes, in the numbers of all
/// nodes' displacements on the rank, those of its own nodes first.
class Elimination
{
public:
  /// @brief Find the transforms.
  /// @param[in] contacts The contacts.
  /// @param[in] contact Contact blocks of the Jacobian, without multipliers
  /// that the bulk cannot give.
  /// @param[in] free 1 at displacements that are not prescribed, else 0
  /// (shape=(num_local)).
  /// @param[in] gdim Geometric dimension.
  /// @param[in] diagonal Diagonal of the bulk's matrix, which soft nodes are
  /// compared with (shape=(num_owned)).
  /// @throws NotCondensable where a multiplier has no equation of its own.
  Elimination(std::span<const Nodes> contacts, const Prescribed& contact,
              std::span<const std::int8_t> free, int gdim,
              std::span<const double> diagonal);

  /// @brief Geometric dimension.
  int gdim() const { return _gdim; }

  /// @brief What rows take over from those that give multipliers, (dof, dof).
  const Triplets& left() const { return _left; }

  /// @brief What the law makes of rows that give multipliers, (dof, dof).
  const Triplets& rows() const { return _rows; }

  /// @brief Change of the displacements, (dof, dof).
  const Triplets& right() const { return _right; }

  /// @brief Rows of the law that are added, (dof, dof).
  const Triplets& law() const { return _law; }

  /// @brief Springs of soft nodes, by v, (dof, dof).
  const Triplets& springs() const { return _springs; }

  /// @brief The same as `right` if soft nodes were not soft.
  const Triplets& rigid_right() const
  {
    return is_soft() ? _rigid_right : _right;
  }

  /// @brief The same as `left` if soft nodes were not soft.
  const Triplets& rigid_left() const { return is_soft() ? _rigid_left : _left; }

  /// @brief Whether a node is soft.
  bool is_soft() const { return not _rigid_right.values.empty(); }

  /// @brief Displacements that the constraints give, in order (shape=(k)).
  const std::vector<std::int32_t>& eliminated() const { return _eliminated; }

  /// @brief The same and those of soft nodes, in order.
  const std::vector<std::int32_t>& constrained() const { return _constrained; }

  /// @brief Displacements whose rows give multipliers (shape=(m)).
  const std::vector<std::int32_t>& recovered() const { return _recovered; }

  /// @brief Displacements of all slave nodes, in order.
  const std::vector<std::int32_t>& slave_dofs() const { return _slave_dofs; }

  /// @brief Whether a node slips with friction.
  bool slips() const { return _slips; }

  /// @brief Whether a node sticks to a master along several displacements.
  bool sticks() const { return _sticks; }

  /// @brief What the constraints' right-hand side gives of displacements.
  /// @param[in] d Right-hand side (shape=(num_multipliers)).
  /// @return Displacements (shape=(num_local)).
  std::vector<double> shift(std::span<const double> d) const;

  /// @brief What the law's right-hand side adds to the rows.
  /// @param[in] d Right-hand side (shape=(num_multipliers)).
  /// @return Forces (shape=(num_local)).
  std::vector<double> extra(std::span<const double> d) const;

  /// @brief What the constraints' right-hand side adds to the rows by springs.
  /// @param[in] d Right-hand side (shape=(num_multipliers)).
  /// @return Forces, those at masters of other ranks among them
  /// (shape=(num_local)).
  std::vector<double> preload(std::span<const double> d) const;

  /// @brief Multipliers that no displacement enters, zero elsewhere.
  /// @param[in] d Right-hand side (shape=(num_multipliers)).
  /// @return Multipliers (shape=(num_multipliers)).
  std::vector<double> open_multipliers(std::span<const double> d) const;

  /// @brief Set the multipliers of closed nodes.
  /// @param[in] d Right-hand side of the constraints (shape=(num_multipliers)).
  /// @param[in] defect b - K du, of rows that need none of each other
  /// (shape=(num_owned)).
  /// @param[in] u Displacements of all nodes (shape=(num_local)).
  /// @param[in,out] multipliers Values to write into (shape=(num_multipliers)).
  void recover(std::span<const double> d, std::span<const double> defect,
               std::span<const double> u, std::span<double> multipliers) const;

private:
  class Rows;
  struct SoftNodes;

  void add_force(const Triplets& T, std::span<const std::int32_t> entries,
                 std::int32_t row, std::int32_t multiplier, double factor);
  void add_scalar(const Triplets& C, std::span<const std::int32_t> entries,
                  std::int32_t multiplier, const Pivot& own);
  void add_stick(std::int32_t multiplier, std::int32_t first,
                 std::span<const std::int8_t> own, const Rows& rows,
                 const std::array<double, 9>& D,
                 const std::array<double, 3>& factors, SoftNodes& soft);
  void add_slip(std::int32_t multiplier, std::int32_t first,
                std::span<const std::int8_t> own, const double* normal,
                const double* by, const std::array<double, 3>& factors,
                const Rows& rows);

  void soften(const SoftNodes& soft);

  int _gdim;
  std::size_t _num_local;
  std::vector<std::int32_t> _eliminated, _constrained, _recovered, _slave_dofs;
  Triplets _left, _rows, _right, _law, _springs, _rigid_left, _rigid_right;
  bool _slips = false, _sticks = false;

  // Displacements and rows by the rows of d
  Triplets _shift, _extra, _preload;
  // Forces of soft nodes by the defect, by displacements and by the rows of d
  Triplets _by_defect, _by_displacement, _by_constraint;
  // Multipliers that rows of the bulk give, and their factors there
  std::vector<std::int32_t> _given;
  std::vector<double> _factors;
  // Multipliers of open nodes, and their factors in their own rows; how many
  // there are in all
  std::vector<std::int32_t> _open;
  std::vector<double> _diagonal;
  std::size_t _num_multipliers;
};
} // namespace contactx::condense
