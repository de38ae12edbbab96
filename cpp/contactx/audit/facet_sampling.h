// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#pragma once

#include "../geometry/nodal.h"

namespace contactx::audit
{
/// @brief Looks for the places of facets that are deeper inside an obstacle
/// than allowed.
///
/// An obstacle may reach through a facet between its nodes. The facets are
/// sampled at the middles of pieces, which are halved as long as a part of one
/// may be too deep: the gap, a distance, changes by no more than the point
/// moves. The obstacle is only asked for gaps:
///
///     while (!sampling.points().empty())
///       sampling.take(gaps of the obstacle at sampling.points());
class FacetSampling
{
public:
  /// @brief Start with whole facets.
  /// @param[in] facets Facets.
  /// @param[in] x Positions (shape=(num_nodes, gdim)), row-major.
  /// @param[in] gdim Geometric dimension, 2 or 3.
  /// @param[in] allowed Depth that is allowed below each facet
  /// (shape=(num_facets)).
  /// @param[in] levels How often pieces are halved at most: an obstacle whose
  /// width is a 2^levels-th part of a facet is still seen.
  /// @throws std::invalid_argument If the sizes do not fit.
  FacetSampling(const geometry::FacetList& facets, std::span<const double> x,
                int gdim, std::vector<double> allowed, int levels);

  /// @brief Geometric dimension.
  int gdim() const { return _gdim; }

  /// @brief Points to evaluate the gap at (shape=(n, gdim)), row-major.
  std::span<const double> points() const { return _points; }

  /// @brief Take the gaps there, and go on to smaller pieces.
  /// @param[in] gap Gaps; what is not a number counts as far
  /// (shape=(n)).
  /// @throws std::invalid_argument If there are not as many as points.
  void take(std::span<const double> gap);

  /// @brief Smallest gap that was seen below each facet, infinite if none
  /// (shape=(num_facets)).
  const std::vector<double>& gaps() const { return _gap; }

  /// @brief Place of the largest depth, not a number if none
  /// (shape=(num_facets, gdim)), row-major.
  const std::vector<double>& deepest() const { return _deepest; }

private:
  void add(std::int32_t facet, std::span<const double> corners);
  void halve(std::int32_t facet, std::span<const double> corners);

  int _gdim, _levels;
  std::vector<double> _allowed, _gap, _deepest;
  // Pieces of one size: their facet, first corner and corners
  std::vector<std::int32_t> _facet;
  std::vector<std::size_t> _first;
  std::vector<double> _corners, _points, _radius;
};
} // namespace contactx::audit
