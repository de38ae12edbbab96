// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#pragma once

#include "blocks.h"

namespace contactx::condense
{
/// @brief Multipliers that are unknowns in the place of prescribed
/// displacements.
struct RetainedMultipliers
{
  std::vector<std::int32_t> multipliers; ///< numbers (shape=(n))
  std::vector<std::int32_t> dofs;        ///< their places (shape=(n))
  std::vector<double> scale;             ///< multiplier a unit (shape=(n))
  std::vector<double> row_scale;         ///< factor of its row (shape=(n))
};

/// @brief Takes multipliers p that follow from their own rows of the law out of
/// the contact blocks.
///
/// The bulk has no row that gives those along prescribed displacements, as
/// where a plane of symmetry holds a slave node and there is no friction across
/// it; those of soft nodes whose displacements are prescribed, or given by
/// others, are the forces of springs. With the law's derivatives D by the
/// multipliers of a node, C by the displacements and the traction block T, and
/// G = D_pp^-1,
///
///     l_p = G (d - C u - D_pf l_f)
///
/// goes into the other rows: C - D G C, D - D G D and T - T G D take the place
/// of C, D and T, and -T G C is added to the stiffness.
///
/// Where D_pp is singular, as where such a node sticks to a master that is free
/// to move, a part h of p may be retained: l_h stays an unknown, in the place
/// of the prescribed displacement, whose row the bulk has no use for. What is
/// left of C_h is added to that row of the stiffness, T_h to its column, and D
/// between them, both scaled to the stiffness C_h^2 / (C_h^2 diag(K)^-1) of
/// what they hold: as everywhere a residual is a force, and an unknown a
/// length. The matrix that is left is indefinite.
///
/// All of it is of one rank alone: its slave nodes' constraints, in all nodes'
/// displacements.
class Prescribed
{
public:
  /// @brief Take them out.
  /// @param[in] contacts The contacts.
  /// @param[in] blocks Contact blocks of the Jacobian.
  /// @param[in] free 1 at displacements that are not prescribed, else 0
  /// (shape=(num_local)).
  /// @param[in] gdim Geometric dimension.
  /// @param[in] diagonal Diagonal of the bulk's matrix at this rank's own
  /// displacements, the first ones of all.
  /// @param[in] holds Whether multipliers may be retained.
  /// @throws NotCondensable where the law does not give such a multiplier, and
  /// it is not retained.
  Prescribed(std::span<const Nodes> contacts, Blocks blocks,
             std::span<const std::int8_t> free, int gdim,
             std::span<const double> diagonal, bool holds);

  /// @brief Contact blocks without these multipliers.
  const Blocks& blocks() const { return _blocks; }

  /// @brief What these multipliers add to the stiffness, which has it already,
  /// (dof, dof).
  const Triplets& springs() const { return _springs; }

  /// @brief Held multipliers.
  const RetainedMultipliers& retained() const { return _retained; }

  /// @brief 1 where a multiplier follows from a row of the bulk, else 0
  /// (shape=(num_multipliers)).
  std::span<const std::int8_t> own() const { return _own; }

  /// @brief The law's derivatives D without these multipliers.
  /// @param[in] contact Number of the contact.
  /// @return Derivatives (shape=(n, size, size)).
  std::span<const double> by_multiplier(std::size_t contact) const
  {
    return _by_multiplier[contact];
  }

  /// @brief What these multipliers change in the right-hand sides.
  /// @param[in,out] d Right-hand side of the multipliers' rows, then that
  /// without these multipliers (shape=(num_multipliers)).
  /// @param[in,out] forces Right-hand side of all nodes' displacements, which
  /// it is added to (shape=(num_local)).
  /// @param[out] retained Right-hand side of retained multipliers' rows
  /// (shape=(n)).
  void right_hand_side(std::span<double> d, std::span<double> forces,
                       std::vector<double>& retained) const;

  /// @brief Add these multipliers.
  /// @param[in] d Right-hand side of the multipliers' rows
  /// (shape=(num_multipliers)).
  /// @param[in] u Displacements of all nodes, retained multipliers over their
  /// scale in the place of theirs (shape=(num_local)).
  /// @param[in,out] multipliers The others, zero where these are to go
  /// (shape=(num_multipliers)).
  void recover(std::span<const double> d, std::span<const double> u,
               std::span<double> multipliers) const;

private:
  void mark_springs(std::span<const Nodes> contacts,
                    std::span<const std::int8_t> free, int gdim);
  void hold(const Triplets& law, std::span<const std::int8_t> free,
            std::span<const double> diagonal);
  void take_out(std::size_t num_multipliers, std::size_t num_local);

  Blocks _blocks;
  Triplets _springs;
  RetainedMultipliers _retained;
  std::vector<std::int8_t> _own;
  std::vector<std::vector<double>> _by_multiplier;

  // Multipliers of the nodes concerned, which are numbered by their place here
  std::vector<std::int32_t> _multipliers;
  // 1 for those that the law gives
  std::vector<std::int8_t> _is_given;
  // D, G, -D G and -G D of these nodes
  Triplets _law, _inverse, _rows, _columns;
  // Columns of T and rows of C at their multipliers
  Triplets _T, _C;
};
} // namespace contactx::condense
