// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#pragma once

#include "../geometry/nodal.h"
#include "../mesh/ranks.h"
#include <map>

namespace contactx::search
{
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

  /// @brief Exchange the boxes of ranks that have facets; all ranks must take
  /// part.
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

  /// @brief Slave facets over which boxes may meet prisms, by ranks.
  /// @param[in] x Node coordinates (shape=(num_nodes, gdim)), row-major.
  /// @param[in] slave Slave facets.
  /// @param[in] reach Half the height of the prisms.
  /// @param[in] along Directions of the prisms (shape=(num_slave_facets, 3));
  /// empty, or where one is zero, the facets' normals.
  /// @return Numbers of facets, ascending, for each rank that has any.
  std::map<int, std::vector<std::int32_t>>
  from_facets(std::span<const double> x, const geometry::FacetList& slave,
              double reach, std::span<const double> along = {}) const;

private:
  // Of the ranks that have facets, in their order
  int size() const;
  std::span<const double> low(int i) const { return row(i).subspan(1, _gdim); }
  std::span<const double> high(int i) const
  {
    return row(i).subspan(1 + _gdim, _gdim);
  }
  std::span<const double> axis(int i) const
  {
    return row(i).subspan(1 + 2 * _gdim, _gdim);
  }
  double sine(int i) const { return row(i).back(); }
  int rank(int i) const { return static_cast<int>(row(i).front()); }
  std::span<const double> row(int i) const;

  int _gdim;
  double _slack = 0;
  // Rank, corners, axis and sine of half the angle of each
  std::vector<double> _boxes;
};
} // namespace contactx::search
