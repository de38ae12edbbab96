// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#pragma once

#include "shape.h"

namespace contactx::geometry
{
/// @brief Surface frame of a facet at a local point.
template <class F>
struct Frame
{
  std::array<Vector<F::gdim>, F::tdim> t; ///< tangents, t_a = dx / dxi_a
  Vector<F::gdim> n;                      ///< outward unit normal
  double jacobian;                        ///< area of the cell spanned by t
};

/// @brief Tangents of a facet.
/// @param[in] x Node coordinates.
/// @param[in] xi Local coordinates.
template <class F>
std::array<Vector<F::gdim>, F::tdim> tangents(const Nodes<F>& x,
                                              const Local<F>& xi)
{
  const auto dN = F::derivative(xi);
  std::array<Vector<F::gdim>, F::tdim> t;
  for (int a = 0; a < F::tdim; ++a)
    t[a] = combine<F>(dN[a], x);
  return t;
}

/// @brief Surface frame of a facet. Where the tangents are parallel the
/// Jacobian is zero and the normal not finite.
/// @param[in] x Node coordinates.
/// @param[in] xi Local coordinates.
template <class F>
Frame<F> frame(const Nodes<F>& x, const Local<F>& xi)
{
  Frame<F> f;
  f.t = tangents<F>(x, xi);
  if constexpr (F::gdim == 2)
    f.n = {f.t[0][1], -f.t[0][0]};
  else
    f.n = cross(f.t[0], f.t[1]);
  f.jacobian = norm(f.n);
  f.n = (1 / f.jacobian) * f.n;
  return f;
}

/// @brief Solve the symmetric system H y = r of dimension 1 or 2.
/// @param[in] H Matrix as (H_11, H_12, H_22); only H_11 is read in 1D.
/// @param[in] r Right-hand side.
template <std::size_t N>
constexpr std::array<double, N> solve(const Vector<3>& H,
                                      const std::array<double, N>& r)
{
  if constexpr (N == 1)
    return {r[0] / H[0]};
  else
  {
    const double det = H[0] * H[2] - H[1] * H[1];
    return {(H[2] * r[0] - H[1] * r[1]) / det,
            (H[0] * r[1] - H[1] * r[0]) / det};
  }
}

/// @brief Metric m_ab = t_a . t_b as (m_11, m_12, m_22).
template <std::size_t D, std::size_t N>
constexpr Vector<3> metric(const std::array<std::array<double, D>, N>& t)
{
  if constexpr (N == 1)
    return {dot(t[0], t[0]), 0, 0};
  else
    return {dot(t[0], t[0]), dot(t[0], t[1]), dot(t[1], t[1])};
}

/// @brief Largest distance between two vertices of a facet.
template <class F>
double diameter(const Nodes<F>& x)
{
  double d2 = 0;
  for (int i = 0; i < F::nodes; ++i)
    for (int j = 0; j < i; ++j)
      d2 = std::max(d2, dot(x[i] - x[j], x[i] - x[j]));
  return std::sqrt(d2);
}
} // namespace contactx::geometry
