// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#pragma once

#include "../geometry/facets.h"
#include "../mesh/halo.h"
#include "finder.h"
#include <map>
#include <optional>

namespace contactx::search
{
/// @brief View of points on a surface, a row a point.
struct ProbeResult
{
  /// @brief Nothing seen.
  /// @param[in] n Number of points.
  /// @param[in] width Values a facet.
  explicit ProbeResult(std::size_t n = 0, int width = 0);

  int width;                    ///< values a facet
  std::vector<double> distance; ///< from the nearest facet, infinite without
  std::vector<double> gap;      ///< height over it, NaN beside the surface
  /// The same before points and facets moved, where that is given
  std::vector<double> height;
  /// Whether the point is above or below the facet, not beside its edges
  std::vector<std::int8_t> inside;
  /// How far the point is from the surface's outer edge, as a part of the facet
  std::vector<double> margin;
  /// How far the point has moved relatively to the facet since, where that is
  /// given
  std::vector<double> displacement;
  std::vector<double> values; ///< of the facet (shape=(n, width))
};

/// @brief Displacements since the configuration that is searched: gaps then
/// are linear in them, as in small sliding.
struct Displacements
{
  std::span<const double> nodes;  ///< of all nodes (shape=(num_nodes, gdim))
  std::span<const double> points; ///< of the points (shape=(n, gdim))
};

/// @brief Finds the nearest facet of a surface, of which each rank may have a
/// part.
///
/// A search for pairs adds what it finds to the halo; this does not, so that it
/// may come after a solve.
class SurfaceProbe
{
public:
  /// @brief Take the facets.
  /// @param[in] halo Nodes of this rank.
  /// @param[in] offsets First node of each facet that this rank has, and end;
  /// several ranks may have the same facet.
  /// @param[in] nodes Nodes of these facets.
  SurfaceProbe(std::shared_ptr<mesh::Halo> halo,
               std::span<const std::int32_t> offsets,
               std::span<const std::int32_t> nodes);

  /// @brief Number of facets of this rank.
  std::int32_t num_facets() const { return _finder.surface().facets().size(); }

  /// @brief Look from points; all ranks must take part.
  /// @param[in] x Positions of all nodes (shape=(num_nodes, gdim)), row-major.
  /// @param[in] points Points (shape=(n, gdim)), row-major.
  /// @param[in] normals Outward normals there that facets must oppose, or zero
  /// (shape=(n, gdim)).
  /// @param[in] reach Largest distance, the same on all ranks.
  /// @param[in] values Values of this rank's facets
  /// (shape=(num_facets, width)), row-major.
  /// @param[in] width Values a facet, the same on all ranks.
  /// @param[in] displacements Displacements, on all ranks or none.
  ProbeResult query(std::span<const double> x, std::span<const double> points,
                    std::span<const double> normals, double reach,
                    std::span<const double> values = {}, int width = 0,
                    const std::optional<Displacements>& displacements
                    = std::nullopt);

private:
  // Projections of points on this rank's facets, with the points' displacements
  ProbeResult see(std::span<const double> x, std::span<const double> points,
                  std::span<const double> normals, double reach,
                  std::span<const double> values, int width,
                  std::span<const double> displacements,
                  std::span<const double> nodal) const;

  std::shared_ptr<mesh::Halo> _halo;
  Finder _finder;
};
} // namespace contactx::search
