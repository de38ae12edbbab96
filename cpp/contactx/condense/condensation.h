// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#pragma once

#include "elimination.h"

namespace contactx::condense
{
/// @brief The contacts of this rank with their multipliers eliminated.
///
/// With b the right-hand side of the displacements' rows, d that of the
/// multipliers' and h = (I + right) v + shift the displacements,
///
///     (I + left + rows) ((K + S) h - b - forces) + law h + springs v
///         = extra + preload
///
/// gives v, see Elimination; `recover` gives the multipliers.
class Condensation
{
public:
  /// @brief What right-hand sides become.
  struct RightHandSide
  {
    std::vector<double> forces; ///< what is added to b (shape=(num_local))
    std::vector<double> shift;  ///< of the displacements (shape=(num_local))
    std::vector<double> extra;  ///< of the law's rows (shape=(num_local))
    /// Forces of soft nodes, to be added over ranks (shape=(num_local))
    std::vector<double> preload;
    /// Multipliers of open nodes, zero elsewhere (shape=(num_multipliers))
    std::vector<double> multipliers;
    std::vector<double> retained; ///< rows of retained multipliers (shape=(n))
  };

  /// @brief Eliminate the multipliers.
  /// @param[in] contact Contact part of the Jacobian, of this rank's pairs, in
  /// displacements of all nodes and multipliers.
  /// @param[in] contacts The contacts; they are not read later on.
  /// @param[in] free 1 at displacements that are not prescribed, else 0
  /// (shape=(num_local)).
  /// @param[in] gdim Geometric dimension.
  /// @param[in] diagonal Diagonal of the bulk's matrix, which soft nodes are
  /// compared with (shape=(num_owned)).
  /// @param[in] holds Whether multipliers without an equation of their own may
  /// stay unknowns; see Prescribed.
  /// @throws NotCondensable where a multiplier has no equation of its own.
  /// @throws std::invalid_argument if arrays do not fit.
  Condensation(const CompressedRows& contact, std::span<const Nodes> contacts,
               std::span<const std::int8_t> free, int gdim,
               std::span<const double> diagonal, bool holds = false);

  /// @brief Number of displacements of all nodes.
  std::size_t num_local() const { return _num_local; }

  /// @brief Contact's part S of the stiffness, (dof, dof).
  const Triplets& stiffness() const { return _prescribed.blocks().stiffness; }

  /// @brief Contact's block of forces by multipliers that are eliminated.
  const Triplets& traction() const { return _prescribed.blocks().traction; }

  /// @brief Multipliers that stay unknowns.
  const RetainedMultipliers& retained() const { return _prescribed.retained(); }

  /// @brief What multipliers that the law gives have added to it, (dof, dof).
  const Triplets& springs() const { return _prescribed.springs(); }

  /// @brief The transforms.
  const Elimination& elimination() const { return _elimination; }

  /// @brief Change right-hand sides.
  /// @param[in] d Right-hand side of the multipliers' rows
  /// (shape=(num_multipliers)).
  RightHandSide right_hand_side(std::span<const double> d) const;

  /// @brief Find the multipliers.
  /// @param[in] d Right-hand side of the multipliers' rows
  /// (shape=(num_multipliers)).
  /// @param[in] defect b + forces - (K + S) u, of rows that need none of each
  /// other (shape=(num_owned)).
  /// @param[in] u Displacements of all nodes, retained multipliers over their
  /// scale in the place of theirs (shape=(num_local)).
  /// @param[in,out] multipliers Those of open nodes, then all
  /// (shape=(num_multipliers)).
  void recover(std::span<const double> d, std::span<const double> defect,
               std::span<const double> u, std::span<double> multipliers) const;

private:
  std::size_t _num_local, _num_multipliers;
  Prescribed _prescribed;
  Elimination _elimination;
};
} // namespace contactx::condense
