// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#pragma once

#include "surface.h"

namespace contactx::search
{
/// @brief Projections of points on given facets, which are extended beyond
/// their edges; their state is that of the facets' material.
struct Projections
{
  std::vector<double> xi;  ///< local coordinates (shape=(n, 2))
  std::vector<double> gap; ///< heights over the facets (shape=(n))
};

/// @brief Project points on given facets.
/// @param[in] surface Surface.
/// @param[in] facet Facet of each point, -1 for none (shape=(n)).
/// @param[in] x Node coordinates (shape=(num_nodes, gdim)), row-major.
/// @param[in] points Points (shape=(n, gdim)), row-major.
/// @param[in] xi Local coordinates where a point has no projection
/// (shape=(n, 2)); zero gap is given there.
Projections projections(const Surface& surface,
                        std::span<const std::int32_t> facet,
                        std::span<const double> x,
                        std::span<const double> points,
                        std::span<const double> xi);

/// @brief Points of the surface and unit normals there (shape=(n, gdim)).
struct FacetPoints
{
  std::vector<double> x;
  std::vector<double> normal;
};

/// @brief Points at local coordinates of given facets.
/// @param[in] surface Surface.
/// @param[in] facet Facet of each point, -1 for none, which gives zeros
/// (shape=(n)).
/// @param[in] x Node coordinates (shape=(num_nodes, gdim)), row-major.
/// @param[in] xi Local coordinates (shape=(n, 2)).
FacetPoints facet_points(const Surface& surface,
                         std::span<const std::int32_t> facet,
                         std::span<const double> x, std::span<const double> xi);
} // namespace contactx::search
