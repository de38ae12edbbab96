// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#pragma once

#include "kinematics.h"

namespace contactx::kernel
{
/// @brief Derivative of the unit normal of a facet at fixed local coordinates.
/// @param[in] frame Frame of the facet there.
/// @param[in] xi Local coordinates.
template <class F>
std::array<Vector<Pair<F>::num_dofs>, F::gdim>
facet_normal_derivative(const geometry::Frame<F>& frame,
                        const geometry::Local<F>& xi)
{
  const auto m = geometry::metric(frame.t);
  const auto dN = F::derivative(xi);
  std::array<Vector<Pair<F>::num_dofs>, F::gdim> dn{};
  for (int l = 0; l < F::nodes; ++l)
  {
    geometry::Local<F> dt;
    for (int b = 0; b < F::tdim; ++b)
      dt[b] = dN[b][l];
    const geometry::Local<F> y = geometry::solve(m, dt);
    Vector<F::gdim> gradient{}; // of the node's shape function
    for (int b = 0; b < F::tdim; ++b)
      gradient = gradient + y[b] * frame.t[b];
    // n . t_b = 0
    for (int k = 0; k < F::gdim; ++k)
      for (int q = 0; q < F::gdim; ++q)
        dn[q][F::gdim * (l + 1) + k] = -frame.n[k] * gradient[q];
  }
  return dn;
}

/// @brief Movement of a slave node relative to a point that is fixed to its
/// facet, with the facet's frame turning: zero for every rigid motion.
///
/// The point has constant local coordinates xi_0 and a constant gap g_0 over
/// them: w = x_s - sum_l N_l(xi_0) x_l - g_0 n(xi_0). Frozen kinematics do not
/// turn: the point keeps its place `origin` relative to sum_l N_l(xi_0) x_l. In
/// small sliding with friction all of these are displacements, for positions.
template <class Kinematics>
struct Relative
{
  using F = typename Kinematics::F;
  static constexpr int num_dofs = Pair<F>::num_dofs;

  /// @brief Read and evaluate.
  /// @param[in] kinematics Kinematics of the pair.
  /// @param[in] w Coefficients of a law with slip.
  Relative(const Kinematics& kinematics, const double* w)
  {
    const auto from = read<FacetSlip>(
        w + offset(Law::frictional, Coefficient::slip, F::nodes, F::gdim));
    std::copy_n(from.xi.begin(), F::tdim, xi.begin());
    gap = from.gap;
    const Pair<F>& pair = kinematics.pair;
    const auto N = F::shape(xi);
    weight[0] = 1;
    for (int l = 0; l < F::nodes; ++l)
      weight[l + 1] = -N[l];
    value = pair.slave - geometry::combine<F>(N, pair.master);
    if constexpr (Kinematics::turning)
    {
      frame = geometry::frame<F>(pair.master, xi);
      value = value - gap * frame.n;
    }
    else
      for (int k = 0; k < F::gdim; ++k)
        value[k] -= from.origin[k];
  }

  /// @brief Derivative of the movement, [gdim][num_dofs].
  std::array<Vector<num_dofs>, F::gdim> derivative() const
  {
    std::array<Vector<num_dofs>, F::gdim> dw{};
    if constexpr (Kinematics::turning)
      if (gap != 0)
      {
        dw = facet_normal_derivative<F>(frame, xi);
        for (auto& row : dw)
          row = -gap * row;
      }
    for (int a = 0; a <= F::nodes; ++a)
      for (int k = 0; k < F::gdim; ++k)
        dw[k][F::gdim * a + k] += weight[a];
    return dw;
  }

  geometry::Local<F> xi;       ///< local coordinates of the point
  double gap;                  ///< its gap
  Vector<F::nodes + 1> weight; ///< 1 and -N_l(xi_0)
  geometry::Frame<F> frame;    ///< frame of the facet there, where it turns
  Vector<F::gdim> value;       ///< the movement
};
} // namespace contactx::kernel
