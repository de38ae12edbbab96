// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#pragma once

#include "pair.h"

namespace contactx::kernel
{
/// @brief First variation of a contact point with respect to the positions of
/// the slave node and the facet's nodes.
///
/// Consistent linearisation of the closest-point projection: T. A. Laursen,
/// Computational Contact and Impact Mechanics, Springer 2002, chapter 5.
template <class F>
struct Variation
{
  static constexpr int num_dofs = Pair<F>::num_dofs;

  std::array<Vector<num_dofs>, F::tdim> xi;     ///< local coordinates
  std::array<Vector<num_dofs>, F::gdim> normal; ///< unit normal
  Vector<num_dofs> gap;                         ///< gap

  /// @brief Compute the variation.
  /// @param[in] pair Pair.
  /// @param[in] c Its contact point, projected on the pair's feature.
  Variation(const Pair<F>& pair, const ContactPoint<F>& c)
  {
    const auto frame = geometry::frame<F>(pair.master, c.xi);
    const auto m = geometry::metric(frame.t);
    const auto dN = F::derivative(c.xi);
    Vector<F::gdim> twist{}; // d^2 x / dxi_1 dxi_2
    if constexpr (!F::flat)
      twist = geometry::combine<F>(F::mixed_derivative, pair.master);
    const double curvature = dot(frame.n, twist);

    // Feature data; unused in the facet's interior
    const bool interior = pair.feature == geometry::interior;
    const bool on_edge
        = pair.feature > geometry::interior and pair.feature <= F::num_edges;
    const auto [i, j] = geometry::feature_edge<F>(pair.feature);
    const auto edge = pair.master[j] - pair.master[i];
    const double length = norm(edge);
    const auto e = (1 / length) * edge;

    Vector<3> H = m; // m_ab - g k_ab
    H[1] -= c.gap * curvature;

    // Tangents solved with m and with H; the same where the facet is flat
    std::array<Vector<F::gdim>, F::tdim> dual, along;
    for (int k = 0; k < F::gdim; ++k)
    {
      geometry::Local<F> r;
      for (int b = 0; b < F::tdim; ++b)
        r[b] = frame.t[b][k];
      const geometry::Local<F> y = geometry::solve(m, r);
      const geometry::Local<F> z = F::flat ? y : geometry::solve(H, r);
      for (int b = 0; b < F::tdim; ++b)
      {
        dual[b][k] = y[b];
        along[b][k] = z[b];
      }
    }

    for (int a = 0; a <= F::nodes; ++a)
    {
      // Variation of the tangents at fixed xi is dt along a unit vector
      geometry::Local<F> dt{};
      if (a > 0)
        for (int b = 0; b < F::tdim; ++b)
          dt[b] = dN[b][a - 1];
      const geometry::Local<F> slope = geometry::solve(H, dt);
      Vector<F::gdim> gradient{}; // of the node's shape function
      for (int b = 0; b < F::tdim; ++b)
        gradient = gradient + dt[b] * dual[b];
      const double dedge = (a == j + 1) - (a == i + 1);

      for (int k = 0; k < F::gdim; ++k)
      {
        const int col = F::gdim * a + k;
        geometry::Local<F> dxi{};
        if (interior)
          for (int b = 0; b < F::tdim; ++b)
            dxi[b] = c.weight[a] * along[b][k] + c.d[k] * slope[b];
        else if (on_edge)
        {
          const double ds
              = (c.weight[a] * edge[k] + dedge * c.d[k]) / (length * length);
          dxi = ds * (F::vertices[j] - F::vertices[i]);
        }

        // n . t_a = 0 gives the variation of the facet's normal
        Vector<F::gdim> dn = -frame.n[k] * gradient;
        if constexpr (!F::flat)
          dn = dn - (curvature * dxi[1]) * dual[0]
               - (curvature * dxi[0]) * dual[1];

        if (!interior)
        {
          Vector<F::gdim> de = (-dedge * e[k] / length) * e;
          de[k] += dedge / length;
          if constexpr (F::gdim == 2)
            dn = pair.cone[0] * de + pair.cone[2] * dn;
          else
            dn = pair.cone[0] * de
                 + pair.cone[1] * (cross(de, frame.n) + cross(e, dn))
                 + pair.cone[2] * dn;
        }

        gap[col] = c.normal[k] * c.weight[a];
        if (!interior)
        {
          gap[col] += dot(dn, c.d);
          for (int b = 0; b < F::tdim; ++b)
            gap[col] -= dot(c.normal, frame.t[b]) * dxi[b];
        }
        for (int b = 0; b < F::tdim; ++b)
          xi[b][col] = dxi[b];
        for (int q = 0; q < F::gdim; ++q)
          normal[q][col] = dn[q];
      }
    }
  }
};
} // namespace contactx::kernel
