// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#pragma once

#include "halo.h"

namespace contactx::mesh
{
/// @brief Nodes of all ranks; on each rank the same.
struct FoundNodes
{
  std::int64_t count = 0;  ///< their number
  std::int64_t first = -1; ///< the first one in the mesh as it was made
  std::vector<double> at;  ///< where that one is (shape=(gdim)); empty for none
};

/// @brief The nodes that each rank found, together; all ranks must take part.
/// @param[in] halo Nodes of this rank.
/// @param[in] nodes Nodes that this rank owns.
/// @param[in] x Positions of all nodes (shape=(num_nodes, gdim)), row-major.
FoundNodes found_nodes(const Halo& halo, std::span<const std::int32_t> nodes,
                       std::span<const double> x);
} // namespace contactx::mesh
