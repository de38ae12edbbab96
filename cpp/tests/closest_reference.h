// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#pragma once

#include "facets.h"
#include <limits>

namespace contactx::tests
{
/// @brief Distance from a facet by sampling it, with a finer grid around each
/// of the best samples of the last one. No better than 1e-9 in xi, so that
/// the distance has about nine digits near the facet.
template <class F>
double sampled_distance(const geometry::Nodes<F>& x, const Vector<F::gdim>& p)
{
  constexpr int n = 24;
  double best = std::numeric_limits<double>::infinity();
  // The coarse grid's cells are searched on their own, for a warped facet may
  // have several points of least distance
  for (int i = 0; i <= n; i += 4)
    for (int j = 0; j <= n; j += 4)
    {
      geometry::Local<F> centre{double(i) / n, double(j) / n};
      for (double h = 1. / 8; h > 1e-10; h *= 0.6)
      {
        double least = std::numeric_limits<double>::infinity();
        const geometry::Local<F> around = centre;
        for (double a : {-h, 0.0, h})
          for (double b : {-h, 0.0, h})
          {
            geometry::Local<F> xi{std::clamp(around[0] + a, 0.0, 1.0),
                                  std::clamp(around[1] + b, 0.0, 1.0)};
            if (F::nodes == 3 and xi[0] + xi[1] > 1)
              xi = (1 / (xi[0] + xi[1])) * xi;
            const double d = norm(p - position<F>(x, xi));
            if (d < least)
            {
              least = d;
              centre = xi;
            }
          }
        best = std::min(best, least);
      }
    }
  return best;
}

/// @brief Distance from a triangle in extended precision, for slivers.
inline double long_distance(const geometry::Nodes<geometry::Triangle>& x,
                            const Vector<3>& p)
{
  using Real = long double;
  using Long = std::array<Real, 3>;
  const auto minus = [](const auto& a, const auto& b)
  { return Long{Real(a[0]) - b[0], Real(a[1]) - b[1], Real(a[2]) - b[2]}; };
  const auto product = [](const Long& a, const Long& b)
  { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; };
  const auto combined = [](const Long& d, Real s, const Long& a)
  { return Long{d[0] - s * a[0], d[1] - s * a[1], d[2] - s * a[2]}; };

  Real best = std::numeric_limits<Real>::infinity();
  for (const auto& [i, j] : geometry::Triangle::edges)
  {
    const Long e = minus(x[j], x[i]), d = minus(p, x[i]);
    const Real s = std::clamp(product(d, e) / product(e, e), Real(0), Real(1));
    const Long r = combined(d, s, e);
    best = std::min(best, product(r, r));
  }
  const Long a = minus(x[1], x[0]), d = minus(p, x[0]);
  Long b = minus(x[2], x[0]);
  const Real shear = product(a, b) / product(a, a);
  b = combined(b, shear, a);
  const Real t = product(d, b) / product(b, b);
  const Real s = product(d, a) / product(a, a) - shear * t;
  if (s >= 0 and t >= 0 and s + t <= 1)
  {
    const Long r = combined(combined(d, s + shear * t, a), t, b);
    best = std::min(best, product(r, r));
  }
  return std::sqrt(best);
}
} // namespace contactx::tests
