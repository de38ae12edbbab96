// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#pragma once

#include "select.h"

namespace contactx::search
{
/// @brief Result of a search for a point.
struct FoundPlace
{
  std::optional<Projection> nearest;  ///< closest point that faces it
  std::optional<Projection> selected; ///< what contact is measured with
};

/// @brief Results of a search for points, a row a point.
struct Found
{
  /// @brief Nothing found yet.
  /// @param[in] n Number of points.
  explicit Found(std::size_t n = 0);

  /// @brief Take what contact of point `i` is measured with.
  void take(std::size_t i, const Projection& selected);

  /// Distance to the nearest facet that faces a point, infinite without one
  /// (shape=(n))
  std::vector<double> distance;
  /// Facet that contact is measured with, -1 without one (shape=(n))
  std::vector<std::int32_t> facet;
  std::vector<std::int32_t> feature; ///< its feature (shape=(n))
  std::vector<double> gap;           ///< (shape=(n))
  std::vector<double> xi;            ///< local coordinates (shape=(n, 2))
  std::vector<double> normal;        ///< unit normals (shape=(n, 3))
};

/// @brief Results of a search for points, with the nearest facet of each.
struct FoundNearest : Found
{
  /// @copydoc Found::Found
  explicit FoundNearest(std::size_t n = 0);

  std::vector<std::int32_t> nearest; ///< -1 without one (shape=(n))
  std::vector<double> size;          ///< its diameter (shape=(n))
};

/// @brief Finds the place of a master surface that a point is in contact with,
/// without memory.
class Finder
{
public:
  /// @brief Create the finder.
  /// @param[in] offsets First node of each facet and the end.
  /// @param[in] nodes Nodes of the facets.
  /// @param[in] gdim Geometric dimension, 2 or 3.
  Finder(std::vector<std::int32_t> offsets, std::vector<std::int32_t> nodes,
         int gdim);

  /// @brief Master surface.
  const Surface& surface() const { return _surface; }

  /// @brief Take over moved nodes; needed before the first search.
  /// @param[in] x Node coordinates (shape=(num_nodes, gdim)), row-major.
  void refit(std::span<const double> x);

  /// @brief Search.
  /// @param[in] x Node coordinates of the last `refit`.
  /// @param[in] p Point.
  /// @param[in] normal Outward normal at the point; a zero vector accepts every
  /// facet.
  /// @param[in] reach Largest distance.
  /// @param[in] hint A facet that may be near, -1 for none.
  /// @param[in] accepts Facets that it refuses are passed over; empty for none.
  /// @param[in] view Where all are that it does not refuse.
  FoundPlace find(std::span<const double> x, const Vector<3>& p,
                  const Vector<3>& normal, double reach, std::int32_t hint = -1,
                  const Accepts& accepts = {}, const View& view = {}) const;

  /// @brief Search for points.
  /// @param[in] x Node coordinates of the last `refit`.
  /// @param[in] points Points (shape=(n, gdim)), row-major.
  /// @param[in] normals Outward normals there, or zero, as `points`.
  /// @param[in] reach Largest distance of each point (shape=(n)).
  FoundNearest find(std::span<const double> x, std::span<const double> points,
                    std::span<const double> normals,
                    std::span<const double> reach) const;

private:
  Surface _surface;
  std::optional<BoxTree> _tree;
};
} // namespace contactx::search
