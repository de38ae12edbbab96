// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#pragma once

#include <cstdint>
#include <span>
#include <vector>

namespace contactx::audit
{
/// Penetration, over the size of a facet, up to which a node is in contact
inline constexpr double contact_depth_max = 1. / 8;

/// Penetration, over the size of a facet, that is refused in any case, and
/// distance across which facets may press that are integrated: tips on arms,
/// which are right, were up to 0.1 apart, one that had slid off its facet 0.2
inline constexpr double harmful_depth = 0.15;

/// Penetration, over the size of a facet, that does not matter
inline constexpr double negligible_depth = 1. / 256;

/// @brief Largest depth of a master below a slave facet of size h, between its
/// nodes: what the mesh explains.
///
/// Contact holds at slave nodes, or in the mean over their facets. A depth is
/// harm where the master is nearer to the far side of what a facet resolves
/// than to its nodes: 0.15 h. Up to that,
/// - a facet of which a node is in contact may span what its other nodes do not
///   touch, as over the edge of a punch; one beside it, half of that: further
///   in the master may sink between nodes while its force fades;
/// - twice the chord of the master's curvature k is allowed, as both surfaces
///   are curved, where the chord itself is no harm, k h <= 1.1: so round a
///   master meets a node before it is as deep, and no verdict hangs on whether
///   a step ends before the first node touches or after it.
///
/// A facet that sees nothing is harmed by any depth: the edge of a punch, or a
/// ball smaller than the facet, may go on without a force; h / 256 is no
/// matter.
///
/// Where the master is smaller than the facet its size takes the place of h.
/// @param[in] size Sizes of the facets.
/// @param[in] curvature Curvatures of the master in front of them.
/// @param[in] contact 2 where a node of the facet is in contact, 1 where one of
/// a neighbour is, else 0.
/// @param[in] extent Sizes of the master there, which may be infinite.
/// @return Depths.
/// @throws std::invalid_argument If the arrays are of different sizes.
std::vector<double> allowed_penetration(std::span<const double> size,
                                        std::span<const double> curvature,
                                        std::span<const std::int8_t> contact,
                                        std::span<const double> extent);
} // namespace contactx::audit
