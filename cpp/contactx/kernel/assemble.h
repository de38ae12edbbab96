// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#pragma once

#include "../math/triplets.h"
#include "layout.h"
#include "pairs.h"
#include <functional>
#include <span>
#include <string_view>

namespace contactx::kernel
{
/// @brief Arrays of nodes and of slave nodes that the kernels read beside the
/// data of pairs, row-major. What a term does not read may be left out.
///
/// Slave nodes are numbered as Pairs::slaves does, those of other ranks last; n
/// is their number. The multiplier has `size` components: one, the pressure, or
/// with friction and of ties gdim, the traction.
struct NodalArrays
{
  /// Displacement and reference position of all nodes (shape=(num_nodes, gdim))
  std::span<const double> displacement, position;
  std::span<const double> multiplier; ///< force/area (shape=(n, size))
  std::span<const double> area;       ///< reference area (shape=(n))
  /// Derivatives of the complementarity function: by the gap (shape=(n,
  /// size)), the slip and the normal (shape=(n, gdim, gdim))
  std::span<const double> gap_derivative, slip_derivative, normal_derivative;
};

/// @brief True if a term of pairs has a kernel: it vanishes where there is
/// none. The stiffness does in small sliding, and for vector multipliers on a
/// rigid obstacle; pairs that measure movement have "slip" and "constraint"
/// alone.
/// @param[in] law Contact law.
/// @param[in] sliding "finite" or "small".
/// @param[in] term Term, see kernel::find.
/// @param[in] pairs Pairs.
/// @param[in] gdim Geometric dimension, 2 or 3.
/// @throws std::invalid_argument If there is no such term, or no kernel at all
/// for pairs of this kind.
bool has_term(Law law, std::string_view sliding, std::string_view term,
              const Pairs& pairs, int gdim);

/// @brief Add a vector term of pairs; nothing where the term vanishes.
///
/// Where a pair of several slave nodes has a share in a node only, the shares
/// of all pairs, on all ranks that have some, sum up to the gap, normal or
/// slip.
/// @param[in] law Contact law.
/// @param[in] sliding "finite" or "small".
/// @param[in] term "gap" (one row a slave node), "normal", "slip" (a row of
/// gdim values) or "residual" (gdim values a node): the forces of the pairs.
/// @param[in] pairs Pairs.
/// @param[in] arrays Nodal arrays that the kernels read.
/// @param[in] gdim Geometric dimension, 2 or 3.
/// @param[in,out] b Vector. One over slave nodes may end before the last of
/// them: what is assembled for those beyond, of other ranks, is left out.
/// @throws std::invalid_argument If arguments do not fit; `b` has not changed.
void add_vector(Law law, std::string_view sliding, std::string_view term,
                const Pairs& pairs, const NodalArrays& arrays, int gdim,
                std::span<double> b);

/// @brief Takes the nodes or slave nodes of a pair's rows, those of its
/// columns, and its block, row by row.
using UsePair = std::function<void(std::span<const std::int32_t>,
                                   std::span<const std::int32_t>,
                                   std::span<const double>)>;

/// @brief Tabulate a matrix term pair by pair; nothing where the term vanishes.
///
/// See `assemble_matrix` for the term, the order of a block and arguments.
/// @param[in] use Called for each pair.
/// @throws std::invalid_argument If arguments do not fit.
void for_each_pair(Law law, std::string_view sliding, std::string_view term,
                   const Pairs& pairs, const NodalArrays& arrays, int gdim,
                   std::span<const std::int8_t> which, const UsePair& use);

/// @brief Assemble a matrix term of pairs.
///
/// The component k of a node is row or column gdim * node + k, the component k
/// of a slave node's multiplier size * slave + k. Each pair gives all entries
/// of its block, row by row, whether they are zero or not: where they are
/// depends on the pairs alone.
/// @param[in] law Contact law.
/// @param[in] sliding "finite" or "small".
/// @param[in] term "stiffness" (nodes by nodes), "traction" (nodes by
/// multipliers) or "constraint" (multipliers by nodes).
/// @param[in] pairs Pairs.
/// @param[in] arrays Nodal arrays that the kernels read.
/// @param[in] gdim Geometric dimension, 2 or 3.
/// @param[in] which 1 at slave nodes of which all pairs are assembled, the
/// others having none; empty for all pairs. It may end before the last slave
/// node.
/// @return The entries; none where the term vanishes.
/// @throws std::invalid_argument If arguments do not fit.
Triplets assemble_matrix(Law law, std::string_view sliding,
                         std::string_view term, const Pairs& pairs,
                         const NodalArrays& arrays, int gdim,
                         std::span<const std::int8_t> which = {});
} // namespace contactx::kernel
