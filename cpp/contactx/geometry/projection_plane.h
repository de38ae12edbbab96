// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#pragma once

#include "frame.h"

/// @brief Integrals over the parts of slave facets that face master facets.
namespace contactx::geometry
{
/// @brief Local coordinates that a slave facet's plane has its origin at.
template <class S>
constexpr Local<S> plane_origin()
{
  if constexpr (S::flat)
    return {};
  else
    return {0.5, 0.5};
}

/// @brief The plane that a slave facet and the master facets in front of it are
/// projected on: that of the facet, or of a quadrilateral's centre.
///
/// M. A. Puso and T. A. Laursen, Comput. Methods Appl. Mech. Engrg. 193, 2004.
/// A point is o + r_a t_a + height n, with the tangents t_a and the direction n
/// of the projection; on a flat facet r are its local coordinates.
template <class S>
struct ProjectionPlane
{
  Vector<S::gdim> origin;
  std::array<Vector<S::gdim>, S::tdim> t;    ///< tangents
  std::array<Vector<S::gdim>, S::tdim> dual; ///< t_a . dual_b = delta_ab
  Vector<S::gdim> n;        ///< unit vector that is projected along, outward
  Vector<S::gdim> conormal; ///< across the tangents, conormal . n = 1

  /// @brief Create the plane and project along its normal.
  /// @param[in] x Nodes of the slave facet.
  explicit ProjectionPlane(const Nodes<S>& x)
  {
    const Local<S> xi = plane_origin<S>();
    const auto frame = geometry::frame<S>(x, xi);
    origin = geometry::combine<S>(S::shape(xi), x);
    t = frame.t;
    n = conormal = frame.n;
    const Vector<3> m = geometry::metric(t);
    for (int k = 0; k < S::gdim; ++k)
    {
      Local<S> r;
      for (int a = 0; a < S::tdim; ++a)
        r[a] = t[a][k];
      const Local<S> y = geometry::solve(m, r);
      for (int a = 0; a < S::tdim; ++a)
        dual[a][k] = y[a];
    }
  }

  /// @brief Create the plane and project along another direction.
  /// @param[in] x Nodes of the slave facet.
  /// @param[in] direction Unit vector on the outer side of the facet.
  ProjectionPlane(const Nodes<S>& x, const Vector<S::gdim>& direction)
      : ProjectionPlane(x)
  {
    const double cosine = dot(conormal, direction);
    for (auto& d : dual)
      d = d - (dot(d, direction) / cosine) * conormal;
    n = direction;
    conormal = (1 / cosine) * conormal;
  }

  /// @brief Coordinates r of a point's projection.
  Local<S> project(const Vector<S::gdim>& x) const
  {
    Local<S> r;
    for (int a = 0; a < S::tdim; ++a)
      r[a] = dot(dual[a], x - origin);
    return r;
  }

  /// @brief Height of a point over the plane, along n.
  double height(const Vector<S::gdim>& x) const
  {
    return dot(conormal, x - origin);
  }
};

/// @brief Coordinates of a facet's nodes in a plane.
template <class F>
using Flat = std::array<Local<F>, F::nodes>;

/// @brief Project the nodes of a facet on a plane.
template <class F, class S>
Flat<F> project(const ProjectionPlane<S>& plane, const Nodes<F>& x)
{
  Flat<F> r;
  for (int l = 0; l < F::nodes; ++l)
    r[l] = plane.project(x[l]);
  return r;
}
} // namespace contactx::geometry
