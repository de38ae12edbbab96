// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#pragma once

#include "fields.h"
#include <cstdint>
#include <span>

namespace contactx::solve
{
/// @brief Bodies without contact, as a Newton loop sees them.
///
/// A host provides it. All ranks must take part in what returns forces, in
/// `diagonal` and in `set_displacements`. Arrays that a function returns a view
/// of stay until the function is called again.
class Bulk
{
public:
  virtual ~Bulk() = default;

  /// @brief Geometric dimension.
  virtual int gdim() const = 0;

  /// @brief True if the stiffness does not depend on the displacement.
  virtual bool is_linear() const = 0;

  /// @brief Reference positions of all nodes (shape=(num_nodes, gdim)).
  virtual std::span<const double> reference() = 0;

  /// @brief Current positions of all nodes (shape=(num_nodes, gdim)).
  virtual std::span<const double> positions() = 0;

  /// @brief Displacements of the owned nodes (shape=(num_owned, gdim)).
  virtual std::span<const double> displacements() = 0;

  /// @brief 1 at prescribed displacements of the owned nodes, else 0
  /// (shape=(num_owned, gdim)).
  virtual std::span<const std::int8_t> markers() = 0;

  /// @brief Diagonal of the stiffness, force/length (shape=(num_owned, gdim)).
  virtual std::span<const double> diagonal() = 0;

  /// @brief Products of the stiffness with fields.
  /// @param[in] fields Displacements of the owned nodes (shape=(count,
  /// num_owned, gdim)).
  /// @param[in] count Number of fields.
  /// @return Forces, of the same shape.
  virtual std::span<const double> products(std::span<const double> fields,
                                           int count) = 0;

  /// @brief Take the displacements that the user's functions have now, and give
  /// other ranks those of their nodes.
  virtual void read() = 0;

  /// @brief True if the Jacobian was given by the user, not derived from the
  /// residual.
  virtual bool has_own_jacobian() const = 0;

  /// @brief Forces at the displacements of now, internal ones less loads,
  /// without Dirichlet conditions (shape=(num_owned, gdim)).
  virtual std::span<const double> residual() = 0;

  /// @brief Displacements minus Dirichlet values where these are prescribed,
  /// else zero (shape=(num_owned, gdim)).
  virtual std::span<const double> defect() = 0;

  /// @brief Products of the stiffness with Dirichlet values that the
  /// displacements do not have yet, less those with the displacements there
  /// (shape=(num_owned, gdim)).
  virtual std::span<const double> lifted() = 0;

  /// @brief Set the displacements of the owned nodes, and give other ranks
  /// those of theirs.
  /// @param[in] u Displacements (shape=(num_owned, gdim)).
  virtual void set_displacements(std::span<const double> u) = 0;

  /// @brief Nodes of the cells that this rank owns (shape=(num_cells,
  /// nodes_per_cell)).
  virtual std::span<const std::int32_t> cells() = 0;

  /// @brief Nodes of each cell.
  virtual int nodes_per_cell() const = 0;

  /// @brief Size of the largest cell around each owned node
  /// (shape=(num_owned)).
  virtual std::span<const double> cell_sizes() = 0;

  /// @brief Sum over cells and terms of the size of their force on each owned
  /// node (shape=(num_owned)): forces before they cancel. It is dear, and
  /// asked for once a step at most, where there are no fields.
  virtual std::span<const double> cell_forces() = 0;

  /// @brief Its unknowns beside displacements; none if null.
  virtual Fields* fields() { return nullptr; }
};
} // namespace contactx::solve
