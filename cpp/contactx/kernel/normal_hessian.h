// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#pragma once

#include "../geometry/frame.h"

namespace contactx::kernel
{
/// A vector that is not normalised, t_1 x t_2 or in 2D the turned tangent, and
/// its derivative by the master nodes.
template <class F>
struct AreaVector
{
  AreaVector(const geometry::Frame<F>& frame, const geometry::Local<F>& xi)
      : dN(F::derivative(xi))
  {
    for (int l = 0; l < F::nodes; ++l)
      for (int k = 0; k < F::gdim; ++k)
      {
        Vector<F::gdim> e{};
        e[k] = 1;
        if constexpr (F::gdim == 2)
          first[F::gdim * l + k] = {dN[0][l] * e[1], -dN[0][l] * e[0]};
        else
          first[F::gdim * l + k] = dN[0][l] * cross(e, frame.t[1])
                                   + dN[1][l] * cross(frame.t[0], e);
      }
  }

  /// Second derivative by components `k` of node `l` and `q` of node `m`.
  Vector<F::gdim> second(int l, int k, int m, int q) const
  {
    if constexpr (F::gdim == 2)
      return {};
    else
    {
      Vector<3> a{}, b{};
      a[k] = 1;
      b[q] = 1;
      return (dN[0][l] * dN[1][m] - dN[0][m] * dN[1][l]) * cross(a, b);
    }
  }

  std::array<Vector<F::nodes>, F::tdim> dN;
  std::array<Vector<F::gdim>, F::gdim * F::nodes> first;
};

/// @brief Second derivative of lambda . n by the positions of a facet's nodes,
/// n its unit normal.
/// @param[in] frame Frame of the facet.
/// @param[in] xi Local coordinates there.
/// @param[in] lambda Vector that does not change.
/// @param[in] add Called as add(i, j, value) for the components i and j of the
/// nodes.
template <class F, class Add>
void for_each_normal_hessian(const geometry::Frame<F>& frame,
                             const geometry::Local<F>& xi,
                             const Vector<F::gdim>& lambda, Add&& add)
{
  constexpr int gdim = F::gdim;
  const AreaVector<F> a(frame, xi);
  const double p = dot(lambda, frame.n);
  const double size = frame.jacobian;
  const Vector<gdim> across = lambda - p * frame.n;
  for (int i = 0; i < gdim * F::nodes; ++i)
    for (int j = 0; j < gdim * F::nodes; ++j)
    {
      const Vector<gdim>& di = a.first[i];
      const Vector<gdim>& dj = a.first[j];
      const double ni = dot(frame.n, di), nj = dot(frame.n, dj);
      const double curvature = -(ni * dot(across, dj) + dot(across, di) * nj
                                 + p * (dot(di, dj) - ni * nj))
                               / size;
      const double bend
          = dot(across, a.second(i / gdim, i % gdim, j / gdim, j % gdim));
      add(i, j, (curvature + bend) / size);
    }
}
} // namespace contactx::kernel
