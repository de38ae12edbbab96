// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#pragma once

#include "../facet/nodal.h"
#include "box.h"
#include <optional>

namespace contactx::search
{
/// @brief Master surface: its facets and which facets meet at a node.
class Surface
{
public:
  /// @brief Create the surface.
  /// @param[in] offsets First node of each facet and the end
  /// (shape=(num_facets + 1)).
  /// @param[in] nodes Nodes of the facets, of two, three or four a facet.
  /// @param[in] gdim Geometric dimension, 2 or 3.
  Surface(std::vector<std::int32_t> offsets, std::vector<std::int32_t> nodes,
          int gdim);

  /// @brief Geometric dimension.
  int gdim() const { return _gdim; }

  /// @brief Facets of the surface.
  facet::FacetList facets() const { return {_offsets, _nodes}; }

  /// @brief Facets that hold all of the given nodes of facet `f`.
  /// @param[in] f Facet.
  /// @param[in] local Local numbers of the nodes on `f`: one for the star of
  /// a vertex, two for the facets at an edge.
  std::vector<std::int32_t> star(std::int32_t f,
                                 std::span<const int> local) const;

  /// @brief Facets that share the feature's nodes with facet `f`.
  /// @param[in] f Facet.
  /// @param[in] feature Feature of the facet; its interior gives `f` alone.
  std::vector<std::int32_t> star(std::int32_t f, int feature) const;

  /// @brief Whether a feature of facet `f` lies on the outer edge of the
  /// surface.
  bool on_boundary(std::int32_t f, int feature) const;

  /// @brief Boxes of the facets.
  /// @param[in] x Node coordinates (shape=(num_nodes, gdim)), row-major.
  std::vector<Box> boxes(std::span<const double> x) const;

private:
  int _gdim;
  std::vector<std::int32_t> _offsets, _nodes;
  // Facets at a node, for nodes numbered in the order of _vertices
  std::vector<std::int32_t> _vertices, _star_offsets, _stars;
};

/// @brief Projection of a point on one facet.
struct Projection
{
  std::int32_t facet;
  int feature;
  Vec<2> xi;     ///< local coordinates; in 2D only the first is used
  Vec<3> d;      ///< vector from the projection to the point
  Vec<3> normal; ///< outward unit normal of the facet there
  double gap;    ///< normal . d
  double excess; ///< how far xi lies outside the facet
  double size;   ///< diameter of the facet
};

/// @brief Closest point of a facet.
/// @param[in] surface Surface.
/// @param[in] f Facet.
/// @param[in] x Node coordinates (shape=(num_nodes, gdim)), row-major.
/// @param[in] p Point.
/// @return Nothing where the facet has no area.
std::optional<Projection> closest(const Surface& surface, std::int32_t f,
                                  std::span<const double> x, const Vec<3>& p);

/// @brief Projection on the facet's extended surface, beyond its edges.
/// @param[in] surface Surface.
/// @param[in] f Facet.
/// @param[in] x Node coordinates (shape=(num_nodes, gdim)), row-major.
/// @param[in] p Point.
/// @return Nothing where there is no projection.
std::optional<Projection> extended(const Surface& surface, std::int32_t f,
                                   std::span<const double> x, const Vec<3>& p);

/// @brief Point of a facet's surface and the unit normal there.
struct SurfacePoint
{
  Vec<3> x;
  Vec<3> normal;
};

/// @brief Point of a facet at local coordinates, inside of it or not.
/// @param[in] surface Surface.
/// @param[in] f Facet.
/// @param[in] x Node coordinates (shape=(num_nodes, gdim)), row-major.
/// @param[in] xi Local coordinates.
SurfacePoint point_at(const Surface& surface, std::int32_t f,
                      std::span<const double> x, const Vec<2>& xi);
} // namespace contactx::search
