// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#pragma once

#include "../math/triplets.h"
#include <stdexcept>

/// @brief Multipliers eliminated from the linear system of contact.
namespace contactx::condense
{
/// @brief A multiplier has no equation of its own; the message says which.
class NotCondensable : public std::runtime_error
{
public:
  using std::runtime_error::runtime_error;
};

/// @brief What elimination reads of the slave nodes of one contact. Arrays have
/// a row for each of the n slave nodes that this rank owns, row-major.
struct Nodes
{
  /// Slave nodes among all nodes of this rank (shape=(n))
  std::span<const std::int32_t> slaves;
  int size = 1; ///< components of the multiplier: 1, or the dimension
  std::span<const std::int8_t> status; ///< see law::Status (shape=(n))
  std::span<const double> area;        ///< reference area (shape=(n))
  /// Unit normals of the master; not read for scalars (shape=(n, gdim))
  std::span<const double> normal;
  /// The law's derivative by the multiplier, a force over a traction
  /// (shape=(n, size, size))
  std::span<const double> by_multiplier;

  /// @brief Number of slave nodes.
  std::size_t count() const { return slaves.size(); }

  /// @brief Whether a node is in contact.
  bool is_closed(std::size_t node) const;
};

/// @brief Number of multipliers of some contacts.
std::size_t num_multipliers(std::span<const Nodes> contacts);

/// @brief Check the arrays of contacts.
/// @param[in] contacts The contacts.
/// @param[in] num_nodes Number of all nodes on this rank.
/// @param[in] gdim Geometric dimension.
/// @throws std::invalid_argument if one does not fit.
void check(std::span<const Nodes> contacts, std::size_t num_nodes, int gdim);

/// @brief Blocks of a rank's contact part of a Jacobian, in its unknowns:
/// displacements of all nodes on the rank, then the contacts' multipliers, one
/// contact after the other.
///
/// Entries of one place add up, those of other ranks included.
struct Blocks
{
  /// Derivative of the displacements' rows by the multipliers, (dof,
  /// multiplier)
  Triplets traction;
  /// Derivative of the multipliers' rows by the displacements, (multiplier,
  /// dof)
  Triplets constraint;
  /// Derivative of the displacements' rows by the displacements
  Triplets stiffness;
};

/// @brief A displacement and its coefficient in a constraint.
struct Pivot
{
  std::int32_t dof = -1;  ///< the displacement, -1 for none
  double coefficient = 0; ///< its coefficient
};

/// @brief The free displacement of a slave node that has the largest
/// coefficient in a scalar constraint.
/// @param[in] constraint Constraints, (multiplier, dof).
/// @param[in] entries Entries of one constraint.
/// @param[in] first First displacement of the slave node.
/// @param[in] free 1 at displacements that are not prescribed, else 0.
/// @param[in] gdim Geometric dimension.
Pivot pivot(const Triplets& constraint, std::span<const std::int32_t> entries,
            std::int32_t first, std::span<const std::int8_t> free, int gdim);

/// @brief Sort a matrix into blocks; entries that are zero are left out.
/// @param[in] contact Contact part of the Jacobian, of this rank's pairs.
/// @param[in] num_local Number of displacements of all nodes on this rank.
/// @throws std::invalid_argument if the matrix is none, or is not square.
Blocks sorted(const CompressedRows& contact, std::size_t num_local);
} // namespace contactx::condense
