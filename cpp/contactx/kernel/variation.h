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

  std::array<Vec<num_dofs>, F::tdim> xi;     ///< local coordinates
  std::array<Vec<num_dofs>, F::gdim> normal; ///< unit normal
  Vec<num_dofs> gap;                         ///< gap

  /// @brief Compute the variation.
  /// @param[in] pair Pair.
  /// @param[in] c Its contact point, projected on the pair's feature.
  Variation(const Pair<F>& pair, const ContactPoint<F>& c)
  {
    const auto frame = facet::frame<F>(pair.master, c.xi);
    const auto m = facet::metric(frame.t);
    const auto dN = F::derivative(c.xi);
    Vec<F::gdim> twist{}; // d^2 x / dxi_1 dxi_2
    if constexpr (!F::flat)
      twist = facet::combine<F>(F::mixed_derivative, pair.master);
    const double curvature = dot(frame.n, twist);

    // Feature data; unused in the facet's interior
    const bool interior = pair.feature == facet::interior;
    const bool on_edge = !interior and pair.feature <= F::num_edges;
    const auto [i, j] = facet::feature_edge<F>(interior ? 1 : pair.feature);
    const auto edge = pair.master[j] - pair.master[i];
    const double length = norm(edge);
    const auto e = (1 / length) * edge;

    Vec<3> H = m; // m_ab - g k_ab
    H[1] -= c.gap * curvature;

    for (int a = 0; a <= F::nodes; ++a)
    {
      for (int k = 0; k < F::gdim; ++k)
      {
        const int col = F::gdim * a + k;
        // Variation of the tangents at fixed xi, along unit vector k
        facet::Local<F> dt{};
        if (a > 0)
          for (int b = 0; b < F::tdim; ++b)
            dt[b] = dN[b][a - 1];

        facet::Local<F> dxi{};
        const double dedge = (a == j + 1) - (a == i + 1);
        if (interior)
        {
          facet::Local<F> r;
          for (int b = 0; b < F::tdim; ++b)
            r[b] = frame.t[b][k] * c.weight[a] + c.d[k] * dt[b];
          dxi = facet::solve(H, r);
        }
        else if (on_edge)
        {
          const double ds
              = (c.weight[a] * edge[k] + dedge * c.d[k]) / (length * length);
          dxi = ds * (F::vertices[j] - F::vertices[i]);
        }

        // n . t_a = 0 gives the variation of the facet's normal
        facet::Local<F> w;
        for (int b = 0; b < F::tdim; ++b)
          w[b] = -frame.n[k] * dt[b];
        if constexpr (!F::flat)
        {
          w[0] -= curvature * dxi[1];
          w[1] -= curvature * dxi[0];
        }
        const facet::Local<F> y = facet::solve(m, w);
        Vec<F::gdim> dn{};
        for (int b = 0; b < F::tdim; ++b)
          dn = dn + y[b] * frame.t[b];

        if (!interior)
        {
          Vec<F::gdim> de = (-dedge * e[k] / length) * e;
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
