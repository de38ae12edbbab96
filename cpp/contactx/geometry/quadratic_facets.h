// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#pragma once

#include "nodal.h"

namespace contactx::geometry
{
/// @brief Facets that a list of linear ones are the parts of: quadratic ones,
/// of which each linear facet between their nodes is a part, or the same again.
struct QuadraticFacets
{
  int width = 4;                    ///< places for nodes, 4 or 9
  std::vector<std::int32_t> nodes;  ///< of each part's whole, the last one
                                    ///< again and again (shape=(n, width))
  std::vector<int> sizes;           ///< nodes of each part's whole (shape=(n))
  std::vector<std::int32_t> number; ///< of each part's whole (shape=(n))
  /// Places of the part's nodes among those of the whole (shape=(n, 4))
  std::vector<std::int8_t> places;
  std::vector<std::int32_t> offsets{0}, parts; ///< parts of each whole

  /// @brief Number of wholes.
  std::int32_t size() const
  {
    return static_cast<std::int32_t>(offsets.size()) - 1;
  }

  /// @brief Nodes of the whole of a part.
  std::span<const std::int32_t> of(std::int32_t part) const
  {
    return std::span(nodes).subspan(std::size_t(part) * width, sizes[part]);
  }

  /// @brief Parts of the whole of a part, itself included.
  std::span<const std::int32_t> parts_of(std::int32_t part) const
  {
    const std::int32_t first = offsets[number[part]];
    return std::span(parts).subspan(first, offsets[number[part] + 1] - first);
  }

  /// @brief Nodes of the whole of a part in all places.
  std::span<const std::int32_t> row(std::int32_t part) const
  {
    return std::span(nodes).subspan(std::size_t(part) * width, width);
  }
};

/// @brief Find the wholes of linear facets.
/// @param[in] parts Linear facets.
/// @param[in] level Where each node is on the whole facets, see Shares; empty
/// where these are linear.
/// @return The wholes, in the order of their first parts.
/// @throws std::invalid_argument If a quadratic facet lacks a part.
QuadraticFacets quadratic_facets(const FacetList& parts,
                                 std::span<const std::int8_t> level);
} // namespace contactx::geometry
