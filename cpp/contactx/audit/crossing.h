// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#pragma once

#include "../geometry/rigid_motion.h"

namespace contactx::audit
{
/// @brief Nodes of one surface that may have gone through another one.
struct MovedPoints
{
  /// Positions at the start and at the end (shape=(n, gdim)), row-major
  std::span<const double> x0, x1;
  /// Outward unit normals there, zero for none (shape=(n, gdim)), row-major
  std::span<const double> normal0, normal1;
  /// Depths that a point may be behind a surface and still be on it: larger
  /// than zero, and than what round-off leaves of positions (shape=(n))
  std::span<const double> tolerance;
  /// Numbers of the points among the facets' nodes, -1 for those that are none
  /// of them (shape=(n)): a point does not cross facets that it is a node of
  std::span<const std::int32_t> node;
};

/// @brief A point goes through a facet.
struct Crossing
{
  std::int32_t point;
  std::int32_t facet;
  double time;   ///< from 0 at the start to 1 at the end
  bool entering; ///< from in front of the facet to behind it
  /// Of the angle between the normals of point and facet: at the start if it is
  /// entered, at the end if it is left
  double cosine;
  double before; ///< height of the point over the facet's plane at the start
  double after;  ///< the same at the end
};

/// @brief Find where points go through facets, each tried at all times.
///
/// Points and nodes move on straight lines, as seen by an observer who takes
/// part in the rigid motion. A point is taken back into its own body by its
/// tolerance: what it is behind a surface by less than that, at the start or at
/// the end or between, is in front of it.
///
/// A quadrilateral is four triangles around its middle, which is closer to the
/// bilinear facet than two triangles are, does not depend on the order of its
/// nodes, and meets its neighbours at the same edges.
/// @param[in] facets Facets.
/// @param[in] x0, x1 Node coordinates at the start and at the end
/// (shape=(num_nodes, gdim)), row-major.
/// @param[in] gdim Geometric dimension, 2 or 3.
/// @param[in] motion Motion of the facets' surface as a whole.
/// @param[in] points Points.
std::vector<Crossing> crossings(const geometry::FacetList& facets,
                                std::span<const double> x0,
                                std::span<const double> x1, int gdim,
                                const geometry::RigidMotion& motion,
                                const MovedPoints& points);
} // namespace contactx::audit
