// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#pragma once

#include "crossing.h"

namespace contactx::audit
{
/// @brief Cosine between the normals of point and facet from which they oppose
/// or agree: 15 degrees from a right angle, so that round-off and what a corner
/// deforms by do not decide.
inline constexpr double oblique_cosine = 0.25;

/// @brief Judge crossings: which of them is the start of a passage.
///
/// A point passes through a surface if it enters a facet that faces it, and at
/// the end
/// - has not come out again, and is behind the plane of that facet by more than
///   its tolerance, or
/// - came out through a facet that its normal agrees with: on the other side.
///
/// It may come out through a facet that its normal opposes, as it has slid
/// around a ridge or along a round surface, and through one at a right angle to
/// its normal if it was on the surface at the start, as it has slid off. What
/// it goes through there and back does not count.
/// @param[in] crossings Crossings of all facets of the surface, in any order.
/// @param[in] tolerance Tolerance of each point (shape=(n)).
/// @return Crossing by which each point entered what it passed through, -1 for
/// no passage (shape=(n)).
std::vector<std::int32_t> passed(std::span<const Crossing> crossings,
                                 std::span<const double> tolerance);

/// @brief Passages of points.
struct Passages
{
  std::vector<std::int32_t> facet; ///< that each point entered, -1 for none
  std::vector<double> time;        ///< of that, zero for none
};

/// @brief Find the points that pass through a surface.
/// @param[in] facets All facets of the surface.
/// @param[in] x0, x1 Node coordinates at the start and at the end
/// (shape=(num_nodes, gdim)), row-major.
/// @param[in] gdim Geometric dimension, 2 or 3.
/// @param[in] points Points.
Passages passages(const geometry::FacetList& facets, std::span<const double> x0,
                  std::span<const double> x1, int gdim,
                  const MovedPoints& points);
} // namespace contactx::audit
