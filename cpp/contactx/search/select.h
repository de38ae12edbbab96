// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#pragma once

#include "box_tree.h"
#include "surface.h"
#include <functional>
#include <limits>

namespace contactx::search
{
/// @brief Decides if a closest point of a facet may be taken.
using Accepts = std::function<bool(const Projection&)>;

/// @brief Where facets are that a point may see: in front of it, near it, or
/// where motions may have taken what was in front of it.
struct View
{
  /// Distance up to which it sees behind itself, length
  double near = std::numeric_limits<double>::infinity();
  /// How far any point has moved since it had others in front of it, length
  double moved = 0;
  /// Change of its unit normal since then
  double turned = 0;
  /// How far behind it, over a facet's size, it still has one in front of it
  double level = 0;

  /// @brief True if a facet in a box may be seen.
  /// @param[in] box The box.
  /// @param[in] p The point.
  /// @param[in] normal Its outward unit normal.
  bool has(const Box& box, const Vector<3>& p, const Vector<3>& normal) const;
};

/// @brief Closest facet of a master surface that faces a point.
/// @param[in] surface Master surface.
/// @param[in] tree Tree of the surface's boxes.
/// @param[in] x Node coordinates (shape=(num_nodes, gdim)), row-major.
/// @param[in] p Point.
/// @param[in] normal Outward normal at the point; facets whose normal does
/// not oppose it are passed over. A zero vector accepts every facet.
/// @param[in] reach Largest distance.
/// @param[in] hint A facet that may be near, -1 for none: the search is faster,
/// its result the same.
/// @param[in] accepts Facets that it refuses are passed over; empty for none.
/// @param[in] view Where all are that it does not refuse.
/// @return The closest point of that facet, nothing where none is in reach.
std::optional<Projection>
nearest_facet(const Surface& surface, const BoxTree& tree,
              std::span<const double> x, const Vector<3>& p,
              const Vector<3>& normal, double reach, std::int32_t hint = -1,
              const Accepts& accepts = {}, const View& view = {});

/// @brief The projection that contact is measured with.
///
/// Starts from the closest facet; where the closest point is ambiguous:
/// - next to an edge, the facet whose surface, extended by the margin, holds
///   the projection;
/// - beyond the margin of a convex ridge, a unit normal from the ridge's cone;
/// - behind the edge of a concave valley, the facet that is penetrated deepest;
/// - beyond the margin of the surface's outer edge, nothing.
///
/// The feature of the result is the facet's interior, where the kernels
/// project on the extended facet, or the ridge or vertex that `normal` is of.
/// @param[in] surface Master surface.
/// @param[in] x Node coordinates (shape=(num_nodes, gdim)), row-major.
/// @param[in] p Point.
/// @param[in] nearest Closest point of the surface to `p`.
std::optional<Projection> select(const Surface& surface,
                                 std::span<const double> x, const Vector<3>& p,
                                 const Projection& nearest);

/// @brief Components of a ridge's normal in the frame of its facet.
///
/// The frame (e, e x n, n) has the direction e of the edge and the facet's
/// normal n; at a vertex e is the edge that starts there. In 2D it is (e, n)
/// with the segment's direction away from the vertex, and the second component
/// is zero.
/// @param[in] surface Master surface.
/// @param[in] x Node coordinates (shape=(num_nodes, gdim)), row-major.
/// @param[in] projection Projection whose feature is an edge or a vertex.
Vector<3> cone_components(const Surface& surface, std::span<const double> x,
                          const Projection& projection);
} // namespace contactx::search
