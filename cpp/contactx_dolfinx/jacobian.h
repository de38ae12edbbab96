// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#pragma once

#include <contactx/condense/contact_block.h>
#include <memory>
#include <optional>
#include <petscmat.h>
#include <span>
#include <vector>

namespace contactx::solve
{
class System;
}

namespace contactx_dolfinx
{
class Bulk;
class Conductance;

/// @brief Jacobian of bulk and contacts as a matrix of PETSc: a saddle point.
///
/// Each rank's unknowns are its displacements, followed by its multipliers. All
/// ranks must take part in everything.
class Jacobian
{
public:
  /// @brief Lay out the unknowns.
  /// @param[in] system The system.
  /// @param[in] bulk Its bulk.
  Jacobian(std::shared_ptr<contactx::solve::System> system,
           std::shared_ptr<Bulk> bulk);

  /// @brief Assemble the Jacobian at the state of now.
  /// @param[in] A Matrix of the system's sizes, as `Assembler::create_matrix`
  /// makes it: written to, with another pattern if pairs have changed.
  /// @param[in] springs Stiffness that is added to the diagonal of the
  /// displacements (shape=(num_displacements)), or nothing.
  void assemble(::Mat A, const std::optional<std::vector<double>>& springs);

  /// @brief Add what holds free bodies to an assembled Jacobian, and take the
  /// units of the unknowns.
  /// @param[in] A Jacobian by displacements and multipliers.
  /// @param[in] system The system.
  /// @param[in] springs As for `assemble`.
  static void finish(::Mat A, const contactx::solve::System& system,
                     const std::optional<std::vector<double>>& springs);

private:
  /// Places of the displacements of all nodes, then of this rank's multipliers.
  std::vector<std::int64_t> places() const;

  /// Entries of the bulk's Jacobian, kept while it stays.
  const contactx::condense::Entries& of_bulk();

  /// Appends the entries of a block.
  /// @param[in] K The block.
  /// @param[out] columns Their columns, as the block has them; null if the rows
  /// are known, too.
  /// @param[in] places Places of its rows.
  void append(::Mat K, std::vector<std::int64_t>* columns,
              std::span<const std::int64_t> places);

  /// Places of the dofs of a function that this rank owns.
  std::vector<std::int64_t> places_of(int function) const;

  /// Places of some dofs of a function, of any ranks.
  /// @param[in] function Number of the function.
  /// @param[in] wanted The dofs.
  std::vector<std::int64_t> places_of(int function,
                                      std::span<const std::int64_t> wanted);

  /// Derivatives of a conductance.
  /// @param[in] conductance What flows.
  /// @param[in] places Those of the displacements of all nodes, then of this
  /// rank's multipliers.
  contactx::condense::Entries
  of_conductance(Conductance& conductance,
                 std::span<const std::int64_t> places) const;

  std::shared_ptr<contactx::solve::System> _system;
  std::shared_ptr<Bulk> _bulk;
  std::int64_t _start = 0; // place of this rank's first unknown
  // Those of the bulk, and the assembly that they are of
  contactx::condense::Entries _of_bulk;
  int _assemblies = -1;
  // The matrix that has places for rows and columns
  PetscObjectId _matrix = 0;
  std::vector<std::int64_t> _rows, _columns;
};
} // namespace contactx_dolfinx
