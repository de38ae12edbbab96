// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#pragma once

#include "../contact/contact.h"
#include "blocks.h"
#include <memory>

namespace contactx::condense
{
/// @brief Entries of a sparse matrix in numbers that all ranks know.
struct Entries
{
  std::vector<std::int64_t> rows;    ///< rows
  std::vector<std::int64_t> columns; ///< columns
  std::vector<double> values;        ///< values
};

/// @brief Contacts' part of a Jacobian, of this rank's pairs.
///
/// Rows and columns are this rank's unknowns: the displacements of all nodes on
/// it, then the multipliers of the slave nodes that it owns, one contact after
/// the other. Columns of a row are in order.
class ContactBlock
{
public:
  using Contacts = std::vector<std::shared_ptr<contact::Contact>>;

  /// @brief Assemble the contacts as they are now.
  /// @param[in] contacts The contacts, of one halo.
  /// @param[in] prescribed 1 at displacements whose rows and columns are left
  /// out, else 0 (shape=(num_nodes, gdim)); empty for none.
  /// @param[in] keeps_zeros Whether entries that are zero stay, so that their
  /// places depend on the pairs alone.
  /// @param[in] d Right-hand side of the multipliers' rows: where it is zero
  /// the multipliers of open nodes are, and pairs that have no others are left
  /// out (shape=(num_multipliers)); empty for all pairs.
  /// @throws std::invalid_argument if there is no contact, or arrays do not
  /// fit.
  ContactBlock(const Contacts& contacts,
               std::span<const std::int8_t> prescribed,
               bool keeps_zeros = false, std::span<const double> d = {});

  /// @brief Number of rows.
  std::size_t size() const { return _offsets.size() - 1; }

  /// @brief The entries.
  CompressedRows entries() const { return {_offsets, _columns, _values}; }

  /// @brief The entries, in numbers of all ranks.
  /// @param[in] places Number of each unknown of this rank (shape=(size)).
  /// @throws std::invalid_argument if places has another size.
  Entries entries(std::span<const std::int64_t> places) const;

  /// @brief Multiply, y = A x.
  /// @throws std::invalid_argument if x has another size.
  std::vector<double> multiply(std::span<const double> x) const;

private:
  std::vector<std::int32_t> _offsets, _columns;
  std::vector<double> _values;
};

/// @brief What elimination reads of the slave nodes of a contact.
/// @param[in] contact Contact, which must outlive this.
Nodes nodes_of(const contact::Contact& contact);
} // namespace contactx::condense
