// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#pragma once

#include "../geometry/facets.h"
#include "bodies.h"
#include "halo.h"
#include <memory>
#include <string>

/// @brief A contact in the reference configuration: what its surfaces and
/// bodies must be like, and the sides that it is made of.
namespace contactx::mesh
{
/// @brief A part of the boundary, and what messages call it.
struct NamedSurface
{
  std::string name;           ///< for example "Surface(tags=(1,), 4 facets)"
  geometry::FacetList facets; ///< of this rank's cells, each on one rank alone
};

/// @brief The mesh of the bulk on this rank.
struct Mesh
{
  std::shared_ptr<Halo> halo;           ///< its nodes
  std::shared_ptr<const Bodies> bodies; ///< its connected parts
  /// Nodes of the cells, as the bodies were found from (shape=(num_cells,
  /// nodes_per_cell)), row-major
  std::span<const std::int32_t> cells;
  int nodes_per_cell; ///< width of `cells`
};
} // namespace contactx::mesh
