// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#pragma once

#include "nodal.h"

namespace contactx::geometry
{
/// @brief Facets of a surface in compressed form, with their own arrays.
struct Facets
{
  std::vector<std::int32_t> offsets{0}; ///< first node of each facet, and end
  std::vector<std::int32_t> nodes;      ///< nodes, facet after facet

  /// @brief View of the facets; it lives no longer than they do.
  FacetList list() const { return {offsets, nodes}; }

  bool operator==(const Facets&) const = default;
};

/// @brief Facets with arrays of their own, as they are now.
inline Facets copied(const FacetList& facets)
{
  return {{facets.offsets.begin(), facets.offsets.end()},
          {facets.nodes.begin(), facets.nodes.end()}};
}
} // namespace contactx::geometry
