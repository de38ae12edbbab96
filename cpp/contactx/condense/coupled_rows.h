// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#pragma once

#include "contact_block.h"

namespace contactx::condense
{
/// @brief Rows of a sparse matrix in numbers that all ranks know.
struct Rows
{
  std::vector<std::int64_t> offsets; ///< where rows begin, and the end
  std::vector<std::int64_t> columns; ///< columns, in order within a row
  std::vector<double> values;        ///< values
};

/// @brief This rank's rows of the coupled system of bulk and contacts, and
/// what its pairs add to the rows of others.
struct CoupledRows
{
  Rows own; ///< of the bulk's unknowns, then of multipliers
  std::vector<std::int64_t> others; ///< numbers of other rows
  Rows added;                       ///< what is added to these
};

/// @brief Add the contacts to the rows of the bulk.
/// @param[in] offsets Where rows of the bulk's matrix begin, and the end, those
/// of owned displacements first (shape=(num_bulk + 1)).
/// @param[in] columns Columns of its entries, in order within a row.
/// @param[in] values Its entries.
/// @param[in] contact Contacts' part of the Jacobian.
/// @param[in] places Number of each unknown of this rank: displacements of
/// owned nodes first, then of others, then multipliers
/// (shape=(contact.size())).
/// @param[in] num_owned Number of displacements of owned nodes.
/// @param[in] num_local Number of displacements of all nodes on this rank.
/// @throws std::invalid_argument if sizes do not fit.
CoupledRows coupled(std::span<const std::int64_t> offsets,
                    std::span<const std::int64_t> columns,
                    std::span<const double> values, const ContactBlock& contact,
                    std::span<const std::int64_t> places, std::size_t num_owned,
                    std::size_t num_local);
} // namespace contactx::condense
