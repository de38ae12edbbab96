// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#pragma once

#include <cstdint>
#include <span>
#include <vector>

namespace contactx::geometry
{
/// @brief Facets of a surface in compressed form.
struct FacetList
{
  std::span<const std::int32_t> offsets; ///< first node of each facet, and end
  std::span<const std::int32_t> nodes;   ///< nodes, facet after facet

  /// @brief Number of facets.
  std::int32_t size() const
  {
    return static_cast<std::int32_t>(offsets.size()) - 1;
  }

  /// @brief Nodes of facet `f`.
  std::span<const std::int32_t> operator[](std::int32_t f) const
  {
    return nodes.subspan(offsets[f], offsets[f + 1] - offsets[f]);
  }
};

/// @brief Area of each node: the integral of its shape function over the
/// surface (length in 2D, for unit thickness).
/// @param[in] facets Facets of the surface.
/// @param[in] x Node coordinates (shape=(num_nodes, gdim)), row-major.
/// @param[in] gdim Geometric dimension, 2 or 3.
/// @param[in] weight Weight of the integrals: values at the nodes, between
/// which the shape functions interpolate (shape=(num_nodes)); 1 if empty.
/// @return Areas (shape=(num_nodes)), zero off the surface.
std::vector<double> nodal_areas(const FacetList& facets,
                                std::span<const double> x, int gdim,
                                std::span<const double> weight = {});

/// @brief Weights of the nodes in the areas of a surface, beside the shape
/// functions of its facets.
struct Shares
{
  /// Weight of the integrals at each node, see nodal_areas; 1 if empty
  std::span<const double> weight = {};
  /// Where each node is on the quadratic facets that these are parts of, which
  /// share their nodes: 0 at their vertices, 1 on their edges, 2 inside; empty
  /// where facets are linear
  std::span<const std::int8_t> level = {};
  /// Whether vertices of triangles of six nodes have the areas of
  /// Basis, which takes them from the edges beside; the integrals of
  /// the shape functions are zero there
  bool of_basis = true;
};

/// @brief Reference area of each corner of each facet.
///
/// Of parts of quadratic facets they are such that the sums at the nodes are
/// the integrals of the quadratic shape functions, or of Basis, where
/// these facets are affine: by Simpson's rule 1:2 on edges and 1:2:4 on
/// quadrilaterals.
/// @param[in] facets Facets of the surface.
/// @param[in] x Node coordinates (shape=(num_nodes, gdim)), row-major.
/// @param[in] gdim Geometric dimension, 2 or 3.
/// @param[in] shares What areas are shared out by.
/// @return Areas (shape=(facets.nodes.size())).
std::vector<double> corner_areas(const FacetList& facets,
                                 std::span<const double> x, int gdim,
                                 const Shares& shares = {});

/// @brief Rows of nodes for each corner of each facet.
/// @param[in] facets Facets.
/// @param[in] values Values of the nodes (shape=(num_nodes, width)).
/// @param[in] width Values a node.
/// @return Values (shape=(facets.nodes.size(), width)).
std::vector<double> at_corners(const FacetList& facets,
                               std::span<const double> values, int width);

/// @brief Area times outward normal of each node; those of parts of a surface
/// add up to those of the whole, as areas do.
/// @param[in] facets Facets of the surface.
/// @param[in] x Node coordinates (shape=(num_nodes, gdim)), row-major.
/// @param[in] gdim Geometric dimension, 2 or 3.
/// @return Vectors (shape=(num_nodes, gdim)), zero off the surface.
std::vector<double> nodal_area_vectors(const FacetList& facets,
                                       std::span<const double> x, int gdim);

/// @brief Unit normals of nodes.
/// @param[in] vector Their area vectors (shape=(n, gdim)), row-major.
/// @param[in] area Their areas (shape=(n)).
/// @param[in] gdim Geometric dimension, 2 or 3.
/// @return Normals (shape=(n, gdim)), zero where the area vector vanishes.
std::vector<double> unit_normals(std::span<const double> vector,
                                 std::span<const double> area, int gdim);

/// @brief Outward unit normal of each node, averaged over its facets by area.
/// @param[in] facets Facets of the surface.
/// @param[in] x Node coordinates (shape=(num_nodes, gdim)), row-major.
/// @param[in] gdim Geometric dimension, 2 or 3.
/// @return Normals (shape=(num_nodes, gdim)), zero off the surface and where
/// the average vanishes.
std::vector<double> nodal_normals(const FacetList& facets,
                                  std::span<const double> x, int gdim);
} // namespace contactx::geometry
