// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#pragma once

#include "inverse_map.h"
#include "quadratic.h"

namespace contactx::geometry
{
/// @brief Local coordinates that a slave facet has its normal at.
template <class S>
constexpr Local<S> normal_place()
{
  if constexpr (geometry::is_linear<S>)
    return plane_origin<S>();
  else
    return S::centre;
}

/// @brief Normal of a slave facet, which all of its parts are projected along,
/// and its variation. Were the normals those of the parts, their sums would not
/// be those of the facet, whose side is diagonal but in the sum.
template <class S>
struct FacetNormal
{
  explicit FacetNormal(const Nodes<S>& x)
      : frame(geometry::frame<S>(x, normal_place<S>())),
        slope(S::derivative(normal_place<S>()))
  {
    const Vector<3> m = geometry::metric(frame.t);
    for (int k = 0; k < S::gdim; ++k)
    {
      Local<S> r;
      for (int a = 0; a < S::tdim; ++a)
        r[a] = frame.t[a][k];
      const Local<S> y = geometry::solve(m, r);
      for (int a = 0; a < S::tdim; ++a)
        dual[a][k] = y[a];
    }
  }

  /// @brief Derivative of a component of the normal by one of a node's
  /// position.
  double derivative(int i, int node, int k) const
  {
    double d = 0;
    for (int a = 0; a < S::tdim; ++a)
      d -= dual[a][i] * frame.n[k] * slope[a][node];
    return d;
  }

  Frame<S> frame;
  std::array<Vector<S::nodes>, S::tdim> slope;
  std::array<Vector<S::gdim>, S::tdim> dual;
};

/// @brief Plane of a part of a slave facet.
/// @param[in] part Nodes of the part.
/// @param[in] normal Normal of the facet.
template <class S>
ProjectionPlane<Part<S>> part_plane(const Nodes<Part<S>>& part,
                                    const Vector<S::gdim>& normal)
{
  if constexpr (geometry::is_linear<S>)
    return ProjectionPlane<S>(part);
  else
    return {part, normal};
}

/// @brief Shape functions of a facet at a point of one of its parts.
/// @param[in] s Those of the part there.
/// @param[in] places Places of the part's nodes.
template <class F>
Vector<F::nodes> trace(const Shape<Part<F>>& s, const Places<F>& places)
{
  if constexpr (geometry::is_linear<F>)
    return s.N;
  else
  {
    Local<F> xi{};
    for (int j = 0; j < Part<F>::nodes; ++j)
      xi = xi + s.N[j] * F::points[places[j]];
    return F::shape(xi);
  }
}

/// @brief Their derivatives by the plane's coordinates.
/// @param[in] s Shape functions of the part there.
/// @param[in] places Places of the part's nodes.
template <class F>
std::array<Vector<F::nodes>, F::tdim> trace_slope(const Shape<Part<F>>& s,
                                                  const Places<F>& places)
{
  if constexpr (geometry::is_linear<F>)
    return s.slope;
  else
  {
    Local<F> xi{};
    std::array<Local<F>, F::tdim> by_plane{}; // dxi / dr_i
    for (int j = 0; j < Part<F>::nodes; ++j)
    {
      xi = xi + s.N[j] * F::points[places[j]];
      for (int i = 0; i < F::tdim; ++i)
        by_plane[i] = by_plane[i] + s.slope[i][j] * F::points[places[j]];
    }
    const auto dN = F::derivative(xi);
    std::array<Vector<F::nodes>, F::tdim> slope{};
    for (int i = 0; i < F::tdim; ++i)
      for (int a = 0; a < F::tdim; ++a)
        slope[i] = slope[i] + by_plane[i][a] * dN[a];
    return slope;
  }
}
} // namespace contactx::geometry
