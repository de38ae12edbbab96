// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#pragma once

#include "../geometry/smooth.h"
#include "records.h"
#include <map>

namespace contactx::search
{
/// @brief The smooth surface that linear facets stand for, of all ranks.
///
/// It is found once, on each rank for all facets: a rank is told the corners of
/// the whole surface.
class SmoothSurface
{
public:
  /// @brief Find it; collective.
  /// @param[in] halo Nodes of this rank.
  /// @param[in] own Facets of this rank.
  SmoothSurface(const mesh::Halo& halo, const geometry::FacetList& own);

  /// @brief The patch that a facet stands for.
  /// @param[in] halo Nodes of this rank.
  /// @param[in] nodes Nodes of the facet, in the order that it has on its own
  /// rank.
  const geometry::SmoothFacet& of(const mesh::Halo& halo,
                                  std::span<const std::int32_t> nodes) const;

  /// @brief The patches that some facets stand for.
  std::vector<geometry::SmoothFacet>
  of(const mesh::Halo& halo, const geometry::FacetList& facets) const;

private:
  std::map<FacetKey, geometry::SmoothFacet> _facets;
};
} // namespace contactx::search
