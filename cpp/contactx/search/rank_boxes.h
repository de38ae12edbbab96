// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#pragma once

#include "../geometry/nodal.h"
#include "../mesh/ranks.h"

namespace contactx::search
{
/// @brief Widening of boxes, over their coordinates, of the sines of cones and
/// of distances, so that round-off hides no rank.
inline constexpr double box_slack = 1e-9;

/// @brief Ranks that have facets within reach, by boxes of the ranks' facets,
/// and cones around their normals.
class RankBoxes
{
public:
  /// @brief Distances from points to the boxes of ranks that may matter.
  struct Near
  {
    std::vector<int> ranks; ///< ascending
    /// Distances, rounded down, infinite where no facet of the rank matters
    /// (shape=(num_points, num_ranks)), row-major
    std::vector<double> distance;
  };

  /// @brief Exchange the boxes; all ranks must take part.
  /// @param[in] ranks The ranks.
  /// @param[in] own Facets of this rank.
  /// @param[in] x Node coordinates (shape=(num_nodes, gdim)), row-major.
  /// @param[in] gdim Geometric dimension, 2 or 3.
  RankBoxes(mesh::Ranks& ranks, const geometry::FacetList& own,
            std::span<const double> x, int gdim);

  /// @brief Ranks that may matter to points, and how far away they are.
  /// @param[in] points Points (shape=(n, gdim)), row-major.
  /// @param[in] normals Normals there that facets must oppose, or zero, as
  /// `points`.
  /// @param[in] bound Largest distance that matters to each point (shape=(n)).
  Near from_points(std::span<const double> points,
                   std::span<const double> normals,
                   std::span<const double> bound) const;

  /// @brief True if boxes may meet the prisms over slave facets.
  /// @param[in] x Node coordinates (shape=(num_nodes, gdim)), row-major.
  /// @param[in] slave Slave facets.
  /// @param[in] reach Half the height of the prisms.
  /// @param[in] margin By which part they are wider than the facets.
  /// @return Whether they may (shape=(num_facets, number of ranks)).
  std::vector<std::int8_t> from_facets(std::span<const double> x,
                                       const geometry::FacetList& slave,
                                       double reach, double margin) const;

private:
  // Of a rank without facets the box is empty
  bool there(int rank) const;
  std::span<const double> low(int rank) const;
  std::span<const double> high(int rank) const;
  std::span<const double> axis(int rank) const;
  double sine(int rank) const;

  int _gdim, _num_ranks;
  double _slack = 0;
  // Corners, axis and sine of half the angle of each rank
  std::vector<double> _every;
};
} // namespace contactx::search
