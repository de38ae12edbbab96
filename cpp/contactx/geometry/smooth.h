// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#pragma once

#include "closest_point.h"
#include "nodal.h"
#include "ridge.h"

namespace contactx::geometry
{
/// @brief What makes a linear facet a patch of a smooth surface through its
/// nodes: the unit normals of that surface there.
///
/// T. Nagata, Comput. Aided Geom. Design 22, 2005: along an edge from node i to
/// node j the surface rises over the facet by k_ij s (1 - s) at the part s of
/// the edge, k_ij = (n_j - n_i) . (x_j - x_i) / 2.
struct SmoothFacet
{
  std::array<Vector<3>, 4> normal{}; ///< at the nodes
  /// Features, see `interior`, on which the surface has an edge or ends: bit by
  /// bit, from that of feature 1
  std::uint8_t sharp = 0;
};

/// @brief Find the smooth surface that facets stand for.
///
/// About each node it is the paraboloid that fits the nodes around; where the
/// surface ends, or has an edge, the nodes on one side with the normals that
/// are known of them. Nodes of the facets are taken to be on the surface.
/// @param[in] facets Facets.
/// @param[in] x Node coordinates (shape=(num_nodes, gdim)), row-major.
/// @param[in] gdim Geometric dimension, 2 or 3.
/// @return The facets (shape=(num_facets)).
std::vector<SmoothFacet> smooth_facets(const FacetList& facets,
                                       std::span<const double> x, int gdim);

/// Cosine of the angle between facets of a node from which on they make an
/// edge: a circle of less than seven chords has such nodes, too
inline constexpr double cosine_at_edges = 0.64;

/// @brief Rise over a facet whose edges rise by k_ij s (1 - s).
/// @param[in] xi Local coordinates.
/// @param[in] k k(i, j) of the edge from node i to node j.
template <class F, class Edges>
double rise_over(const Local<F>& xi, Edges&& k)
{
  if constexpr (F::flat)
  {
    const auto N = F::shape(xi);
    double sum = 0;
    for (int i = 0; i < F::nodes; ++i)
      for (int j = 0; j < i; ++j)
        sum += N[i] * N[j] * k(j, i);
    return sum;
  }
  else
  {
    const double s = xi[0], t = xi[1];
    return s * (1 - s) * ((1 - t) * k(0, 1) + t * k(2, 3))
           + t * (1 - t) * ((1 - s) * k(0, 2) + s * k(1, 3));
  }
}

/// @brief Rise of a patch over its facet.
/// @param[in] x Nodes of the facet in the reference configuration.
/// @param[in] smooth What makes it smooth.
/// @param[in] xi Local coordinates.
template <class F>
double rise(const Nodes<F>& x, const SmoothFacet& smooth, const Local<F>& xi)
{
  return rise_over<F>(xi,
                      [&](int i, int j)
                      {
                        double k = 0;
                        for (int c = 0; c < F::gdim; ++c)
                          k += 0.5 * (smooth.normal[j][c] - smooth.normal[i][c])
                               * (x[j][c] - x[i][c]);
                        return k;
                      });
}

/// @brief A point of a smooth patch.
template <class F>
struct SmoothPoint
{
  Local<F> xi;            ///< local coordinates of the point of the facet
  Vector<F::gdim> normal; ///< unit normal of the patch
  Vector<3> cone;         ///< its components in `ridge_axes` of what is `kept`
  double rise;            ///< of the patch over the facet
};

/// @brief Point of a patch at local coordinates of its facet. Patches turn with
/// their facets.
/// @param[in] reference Nodes in the reference configuration.
/// @param[in] x Nodes now.
/// @param[in] smooth What makes it smooth.
/// @param[in] xi Local coordinates.
template <class F>
SmoothPoint<F> smooth_point(const Nodes<F>& reference, const Nodes<F>& x,
                            const SmoothFacet& smooth, const Local<F>& xi)
{
  SmoothPoint<F> p{xi, {}, {}, rise<F>(reference, smooth, xi)};
  const auto N = F::shape(xi);
  Vector<F::gdim> n{};
  for (int l = 0; l < F::nodes; ++l)
    for (int k = 0; k < F::gdim; ++k)
      n[k] += N[l] * smooth.normal[l][k];
  n = (1 / norm(n)) * n;
  const auto before = ridge_axes<F>(reference, kept, xi);
  const auto now = ridge_axes<F>(x, kept, xi);
  for (int a = 0; a < F::gdim; ++a)
  {
    const double c = dot(before[a], n);
    // In 2D the second axis is the normal, in 3D the third one
    p.cone[F::gdim == 2 ? 2 * a : a] = c;
    p.normal = p.normal + c * now[a];
  }
  return p;
}

/// @brief Point of a patch whose normal leads to a given point.
/// @param[in] reference Nodes in the reference configuration.
/// @param[in] x Nodes now.
/// @param[in] smooth What makes it smooth.
/// @param[in] point The given point.
/// @param[in] xi Local coordinates to start from.
template <class F>
SmoothPoint<F> smooth_projection(const Nodes<F>& reference, const Nodes<F>& x,
                                 const SmoothFacet& smooth,
                                 const Vector<F::gdim>& point, Local<F> xi)
{
  // The distance over the radius of curvature is what each iteration leaves
  constexpr int max_iterations = 20;
  for (int it = 0; it < max_iterations; ++it)
  {
    const auto at = smooth_point<F>(reference, x, smooth, xi);
    const auto frame = geometry::frame<F>(x, xi);
    const Vector<F::gdim> d = point - combine<F>(F::shape(xi), x);
    const double far = dot(d, frame.n) / dot(at.normal, frame.n);
    const Local<F> step = tangential(frame.t, d - far * at.normal);
    if (not std::isfinite(norm(step)))
      break;
    xi = xi + step;
    if (norm(step) < 1e-14)
      break;
  }
  return smooth_point<F>(reference, x, smooth, xi);
}
} // namespace contactx::geometry
