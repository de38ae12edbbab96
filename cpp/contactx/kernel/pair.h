// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#pragma once

#include "../geometry/closest_point.h"
#include "../geometry/ridge.h"
#include "layout.h"

namespace contactx::kernel
{
/// @brief A pair as the kernels see it.
///
/// Positions are those relative to the slave node's in the reference
/// configuration, so that rounding errors do not grow with its distance from
/// the origin.
template <class F>
struct Pair
{
  static constexpr int num_dofs = F::gdim * (F::nodes + 1);

  Vector<F::gdim> slave;     ///< position of the slave node
  geometry::Nodes<F> master; ///< positions of the facet's nodes
  int feature;               ///< interior, kept, edge or vertex
  geometry::Local<F> xi;     ///< local coordinates that the search found
  Vector<3> cone;            ///< components of a ridge's normal
  Vector<F::gdim> normal;    ///< unit normal that the search found

  /// @brief Read a pair from the coefficients.
  /// @param[in] w Coefficients.
  explicit Pair(const double* w)
  {
    // The first coefficients are those of every law
    constexpr Law law = Law::frictionless;
    const double* u
        = w + offset(law, Coefficient::displacement, F::nodes, F::gdim);
    const double* x = w + offset(law, Coefficient::position, F::nodes, F::gdim);
    const auto found = read<FacetPair>(
        w + offset(law, Coefficient::pair, F::nodes, F::gdim));
    std::copy_n(u, F::gdim, slave.begin());
    for (int l = 0; l < F::nodes; ++l)
      for (int k = 0; k < F::gdim; ++k)
      {
        const int i = F::gdim * (l + 1) + k;
        master[l][k] = (x[i] - x[k]) + u[i];
      }
    feature = static_cast<int>(found.feature);
    std::copy_n(found.xi.begin(), F::tdim, xi.begin());
    cone = found.cone;
    std::copy_n(found.normal.begin(), F::gdim, normal.begin());
  }
};

/// @brief The point of the master that a slave node is measured against.
template <class F>
struct ContactPoint
{
  geometry::Local<F> xi;       ///< local coordinates
  Vector<F::nodes + 1> weight; ///< 1 and -N_l(xi): x_s - x_m = weight x
  Vector<F::gdim> normal;      ///< unit normal
  Vector<F::gdim> d;           ///< x_s - x_m(xi)
  double gap;                  ///< normal . d
};

/// @brief Unit normal of a pair at a point of its facet, now.
template <class F>
Vector<F::gdim> current_normal(const Pair<F>& pair,
                               const geometry::Local<F>& xi)
{
  if (pair.feature == geometry::interior)
    return geometry::frame<F>(pair.master, xi).n;
  const auto axes = geometry::ridge_axes<F>(pair.master, pair.feature, xi);
  if constexpr (F::gdim == 2)
    return pair.cone[0] * axes[0] + pair.cone[2] * axes[1];
  else
    return pair.cone[0] * axes[0] + pair.cone[1] * axes[1]
           + pair.cone[2] * axes[2];
}

/// @brief The contact point for given local coordinates and normal.
template <class F>
ContactPoint<F> contact_point(const Pair<F>& pair, const geometry::Local<F>& xi,
                              const Vector<F::gdim>& normal)
{
  ContactPoint<F> c;
  c.xi = xi;
  const auto N = F::shape(xi);
  c.weight[0] = 1;
  for (int l = 0; l < F::nodes; ++l)
    c.weight[l + 1] = -N[l];
  c.normal = normal;
  c.d = pair.slave - geometry::combine<F>(N, pair.master);
  c.gap = dot(c.normal, c.d);
  return c;
}

/// @brief Project the slave node on the pair's feature: the facet's extended
/// surface, the line of an edge, or a vertex; what is kept stays.
template <class F>
ContactPoint<F> project(const Pair<F>& pair)
{
  geometry::Local<F> xi = pair.xi;
  if (pair.feature == geometry::interior)
    geometry::project<F>(pair.master, pair.slave, xi);
  else if (pair.feature == geometry::kept)
    ;
  else if (F::num_edges > 0 and pair.feature <= F::num_edges)
  {
    const auto [i, j] = geometry::feature_edge<F>(pair.feature);
    const auto e = pair.master[j] - pair.master[i];
    const double s = dot(pair.slave - pair.master[i], e) / dot(e, e);
    xi = (1 - s) * F::vertices[i] + s * F::vertices[j];
  }
  else
    xi = F::vertices[pair.feature - 1 - F::num_edges];
  return contact_point(pair, xi, current_normal(pair, xi));
}
} // namespace contactx::kernel
