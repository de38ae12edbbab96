// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#pragma once

#include "projection_plane.h"

namespace contactx::geometry
{
/// @brief Shape functions of a facet that lies in a plane, at points of the
/// plane.
template <class F>
struct Shape
{
  Vector<F::nodes> N;                          ///< shape functions
  std::array<Vector<F::nodes>, F::tdim> slope; ///< by the plane's coordinates
  double jacobian; ///< of the plane's coordinates by the local ones
  Local<F> xi;     ///< local coordinates
};

/// @brief Inverse of the map from local coordinates to a plane: affine, or
/// bilinear for a quadrilateral.
template <class F>
class InverseMap
{
public:
  /// @brief Create the map.
  /// @param[in] r Nodes in the plane.
  explicit InverseMap(const Flat<F>& r)
  {
    const Local<F> xi = plane_origin<F>();
    const auto N = F::shape(xi);
    const auto dN = F::derivative(xi);
    for (int i = 0; i < F::tdim; ++i)
      for (int l = 0; l < F::nodes; ++l)
      {
        _origin[i] += N[l] * r[l][i];
        for (int a = 0; a < F::tdim; ++a)
          _forward[i][a] += dN[a][l] * r[l][i];
      }
    if constexpr (F::tdim == 1)
    {
      _det = _forward[0][0];
      _back[0][0] = 1 / _det;
    }
    else
    {
      const auto& m = _forward;
      _det = m[0][0] * m[1][1] - m[0][1] * m[1][0];
      _back = {{{m[1][1] / _det, -m[0][1] / _det},
                {-m[1][0] / _det, m[0][0] / _det}}};
    }
    if constexpr (!F::flat)
    {
      Local<F> w{};
      for (int l = 0; l < F::nodes; ++l)
        w = w + F::mixed_derivative[l] * r[l];
      _twist = back(w);
    }
  }

  /// @brief True if there is an inverse that is more than round-off: not where
  /// the facet has no area in the plane, nor where it is so long that its area
  /// is lost.
  bool exists() const
  {
    double size;
    if constexpr (F::tdim == 1)
      size = 0;
    else
      size = std::abs(_forward[0][0] * _forward[1][1])
             + std::abs(_forward[0][1] * _forward[1][0]);
    return std::abs(_det) > 1e-14 * size and std::isfinite(1 / _det);
  }

  /// @brief Part of a quadrilateral that no affine map gives, in units of its
  /// tangents.
  double distortion() const
  {
    if constexpr (F::flat)
      return 0;
    else
      return std::abs(_twist[0]) + std::abs(_twist[1]);
  }

  /// @brief Shape functions at a point of the plane.
  Shape<F> at(const Local<F>& p) const
  {
    Shape<F> s;
    Local<F> y = back(p - _origin);
    // dxi_a / dp_i
    std::array<Local<F>, F::tdim> inverse = _back;
    s.jacobian = std::abs(_det);
    if constexpr (!F::flat)
    {
      y = untwist(y);
      const auto [c, d] = _twist;
      // d(affine) / dxi of the twisted map
      const Vector<2> row0{1 + y[1] * c, y[0] * c};
      const Vector<2> row1{y[1] * d, 1 + y[0] * d};
      const double det = row0[0] * row1[1] - row0[1] * row1[0];
      for (int i = 0; i < 2; ++i)
      {
        const double a = _back[0][i], b = _back[1][i];
        inverse[0][i] = (row1[1] * a - row0[1] * b) / det;
        inverse[1][i] = (row0[0] * b - row1[0] * a) / det;
      }
      s.jacobian *= std::abs(det);
    }
    s.xi = y + plane_origin<F>();
    s.N = F::shape(s.xi);
    const auto dN = F::derivative(s.xi);
    for (int i = 0; i < F::tdim; ++i)
    {
      s.slope[i] = {};
      for (int a = 0; a < F::tdim; ++a)
        s.slope[i] = s.slope[i] + inverse[a][i] * dN[a];
    }
    return s;
  }

private:
  Local<F> back(const Local<F>& r) const
  {
    Local<F> y;
    for (int a = 0; a < F::tdim; ++a)
      y[a] = dot(_back[a], r);
    return y;
  }

  // Solve y + y_1 y_2 twist = q by Newton's method
  Local<F> untwist(const Local<F>& q) const
  {
    Local<F> y = q;
    const auto [c, d] = _twist;
    if (c == 0 and d == 0)
      return y;
    for (int it = 0; it < 20; ++it)
    {
      const double f = y[0] + y[0] * y[1] * c - q[0];
      const double g = y[1] + y[0] * y[1] * d - q[1];
      const double a = 1 + y[1] * c, b = y[0] * c;
      const double e = y[1] * d, h = 1 + y[0] * d;
      const double det = a * h - b * e;
      const double s = (h * f - b * g) / det, t = (a * g - e * f) / det;
      y = {y[0] - s, y[1] - t};
      if (std::max(std::abs(s), std::abs(t)) < 1e-15)
        break;
    }
    return y;
  }

  Local<F> _origin{}, _twist{};
  std::array<Local<F>, F::tdim> _forward{}, _back{};
  double _det;
};
} // namespace contactx::geometry
