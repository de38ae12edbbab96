// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#pragma once

#include "../geometry/nodal.h"
#include "../geometry/shape.h"
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

  /// @brief Number of nodes that positions are needed of: one more than the
  /// largest of the facets' nodes.
  std::int32_t num_nodes() const { return _num_nodes; }

  /// @brief Facets of the surface.
  geometry::FacetList facets() const { return {_offsets, _nodes}; }

  /// @brief Visit the facets that share the feature's nodes with facet `f`, in
  /// ascending order.
  /// @param[in] f Facet.
  /// @param[in] feature Feature of the facet; its interior gives `f` alone.
  /// @param[in] visit Called as visit(facet).
  template <class Visitor>
  void for_each_around(std::int32_t f, int feature, Visitor&& visit) const
  {
    if (feature == geometry::interior)
      visit(f);
    else
      for_each_at(f, feature_ends(facets()[f].size(), feature), visit);
  }

  /// @brief Facets that `for_each_around` visits.
  std::vector<std::int32_t> star(std::int32_t f, int feature) const;

  /// @brief True if a feature of facet `f` lies on the outer edge of the
  /// surface.
  bool on_boundary(std::int32_t f, int feature) const;

  /// @brief Box of a facet.
  /// @param[in] f Facet.
  /// @param[in] x Node coordinates (shape=(num_nodes, gdim)), row-major.
  Box box(std::int32_t f, std::span<const double> x) const;

  /// @brief Boxes of the facets.
  /// @param[in] x Node coordinates (shape=(num_nodes, gdim)), row-major.
  std::vector<Box> boxes(std::span<const double> x) const;

private:
  // Local numbers of two nodes; the same one twice for a vertex
  using Ends = std::pair<int, int>;

  static Ends feature_ends(int num_nodes, int feature);

  // Visit the facets that hold both of the nodes of facet f
  template <class Visitor>
  void for_each_at(std::int32_t f, const Ends& ends, Visitor&& visit) const
  {
    const std::int32_t v = _vertex[_offsets[f] + ends.first];
    const std::int32_t other = _nodes[_offsets[f] + ends.second];
    for (std::int32_t i = _star_offsets[v]; i < _star_offsets[v + 1]; ++i)
      if (ends.first == ends.second
          or std::ranges::find(facets()[_stars[i]], other)
                 != facets()[_stars[i]].end())
        visit(_stars[i]);
  }

  std::int32_t count_at(std::int32_t f, const Ends& ends) const;

  int _gdim;
  std::int32_t _num_nodes = 0;
  std::vector<std::int32_t> _offsets, _nodes;
  // Facets at a node, for nodes in the order of their numbers; _vertex is the
  // place in that order, for each of _nodes
  std::vector<std::int32_t> _vertex, _star_offsets, _stars;
};

/// @brief Nodes in ascending order, each once.
/// @param[in] nodes Nodes, none negative.
std::vector<std::int32_t> sorted_unique(std::span<const std::int32_t> nodes);

/// @brief Projection of a point on one facet.
struct Projection
{
  std::int32_t facet;
  int feature;
  Vector<2> xi;     ///< local coordinates; in 2D only the first is used
  Vector<3> d;      ///< vector from the projection to the point
  Vector<3> normal; ///< outward unit normal of the facet there
  double gap;       ///< normal . d
  double excess;    ///< how far xi lies outside the facet
  double size;      ///< diameter of the facet
};

/// @brief Distance of a place on a facet from the surface's outer edge, in the
/// facet's local coordinates; one where the facet is not at the outer edge.
/// @param[in] surface Surface.
/// @param[in] f Facet.
/// @param[in] xi Local coordinates.
double outer_margin(const Surface& surface, std::int32_t f,
                    const Vector<2>& xi);

/// @brief Closest point of a facet.
/// @param[in] surface Surface.
/// @param[in] f Facet.
/// @param[in] x Node coordinates (shape=(num_nodes, gdim)), row-major.
/// @param[in] p Point.
/// @return Nothing where the facet has no area.
std::optional<Projection> closest(const Surface& surface, std::int32_t f,
                                  std::span<const double> x,
                                  const Vector<3>& p);

/// @brief Closest point of a facet that may be near enough to matter.
/// @param[in] surface Surface.
/// @param[in] f Facet.
/// @param[in] x Node coordinates (shape=(num_nodes, gdim)), row-major.
/// @param[in] p Point.
/// @param[in] bound2 Squared distance above which the answer is not needed.
/// @return As `closest`, or nothing where the facet is farther away.
std::optional<Projection> closest_within(const Surface& surface, std::int32_t f,
                                         std::span<const double> x,
                                         const Vector<3>& p, double bound2);

/// @brief Projection on the facet's extended surface, beyond its edges.
/// @param[in] surface Surface.
/// @param[in] f Facet.
/// @param[in] x Node coordinates (shape=(num_nodes, gdim)), row-major.
/// @param[in] p Point.
/// @return Nothing where there is no projection.
std::optional<Projection> extended(const Surface& surface, std::int32_t f,
                                   std::span<const double> x,
                                   const Vector<3>& p);

/// @brief Point of a facet's surface and the unit normal there.
struct SurfacePoint
{
  Vector<3> x;
  Vector<3> normal;
};

/// @brief Point of a facet at local coordinates, inside of it or not.
/// @param[in] surface Surface.
/// @param[in] f Facet.
/// @param[in] x Node coordinates (shape=(num_nodes, gdim)), row-major.
/// @param[in] xi Local coordinates.
SurfacePoint point_at(const Surface& surface, std::int32_t f,
                      std::span<const double> x, const Vector<2>& xi);
} // namespace contactx::search
