// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#include "slip_weights.h"
#include "../math/scales.h"
#include <array>
#include <cmath>

using namespace contactx;
using namespace contactx::contact;

namespace
{
/// What masters of a slave node are in its tangent plane, or on its tangent:
/// weights, first and second moments
struct Moments
{
  double w = 0;
  std::array<double, 2> first{};
  std::array<double, 3> second{}; // xx, xy, yy
};

/// Unit vectors across a normal: two in 3D, the first alone in 2D.
std::array<std::array<double, 3>, 2> tangents(std::span<const double> n,
                                              int gdim)
{
  if (gdim == 2)
    return {{{-n[1], n[0], 0}, {0, 0, 0}}};
  // Away from the axis that the normal is closest to
  int k = 0;
  for (int j = 1; j < 3; ++j)
    if (std::abs(n[j]) < std::abs(n[k]))
      k = j;
  std::array<double, 3> t{-n[k] * n[0], -n[k] * n[1], -n[k] * n[2]};
  t[k] += 1;
  const double size = std::hypot(t[0], t[1], t[2]);
  for (double& c : t)
    c /= size;
  return {{t,
           {n[1] * t[2] - n[2] * t[1], n[2] * t[0] - n[0] * t[2],
            n[0] * t[1] - n[1] * t[0]}}};
}
} // namespace

Mortar contactx::contact::slip_weights(Mortar now, const MortarSides& sides,
                                       std::span<const double> distances,
                                       std::span<const double> normals,
                                       std::span<const double> x, int gdim)
{
  const std::size_t n = sides.size();
  // Two tangents of each node
  std::vector<std::array<std::array<double, 3>, 2>> across(n);
  for (std::size_t i = 0; i < n; ++i)
    across[i] = tangents(normals.subspan(3 * i, 3), gdim);
  const auto along = [&](std::size_t i, std::span<const double> p)
  {
    std::array<double, 2> y{};
    for (int t = 0; t < gdim - 1; ++t)
      for (int k = 0; k < gdim; ++k)
        y[t] += across[i][t][k] * p[k];
    return y;
  };
  const auto for_each = [&](auto&& f)
  {
    for (std::size_t p = 0; p < now.size(); ++p)
      for (int s = 0; s < now.width; ++s)
      {
        const std::size_t i = sides.numbers(now.slave[p])[s];
        if (i >= n)
          continue;
        const auto nodes = sides.master_nodes(now.master[p]);
        for (int l = 0; l < now.width; ++l)
        {
          double& w = now.weight[(p * now.width + s) * now.width + l];
          if (w != 0)
            f(i, w, along(i, x.subspan(std::size_t(nodes[l]) * gdim, gdim)));
        }
      }
  };
  std::vector<Moments> moments(n);
  for_each(
      [&](std::size_t i, double w, const std::array<double, 2>& y)
      {
        moments[i].w += std::abs(w);
        for (int t = 0; t < 2; ++t)
          moments[i].first[t] += std::abs(w) * y[t];
      });
  const auto from_middle = [&](std::size_t i, std::array<double, 2> y)
  {
    for (int t = 0; t < 2; ++t)
      y[t] -= moments[i].first[t] / moments[i].w;
    return y;
  };
  for_each(
      [&](std::size_t i, double w, const std::array<double, 2>& y)
      {
        const auto [a, b] = from_middle(i, y);
        moments[i].second[0] += std::abs(w) * a * a;
        moments[i].second[1] += std::abs(w) * a * b;
        moments[i].second[2] += std::abs(w) * b * b;
      });
  std::vector<std::array<double, 2>> slope(n);
  for (std::size_t i = 0; i < n; ++i)
  {
    const auto [aa, ab, bb] = moments[i].second;
    const auto d = along(i, distances.subspan(gdim * i, gdim));
    if (gdim == 2 and aa > 0)
      slope[i] = {d[0] / aa, 0};
    const double area = aa * bb - ab * ab;
    // Masters of a node that are on a line tell no slope in both directions
    if (gdim == 3 and area > math::negligible_part * (aa + bb) * (aa + bb))
      slope[i]
          = {(bb * d[0] - ab * d[1]) / area, (aa * d[1] - ab * d[0]) / area};
  }
  for_each(
      [&](std::size_t i, double& w, const std::array<double, 2>& y)
      {
        const auto [a, b] = from_middle(i, y);
        w += std::abs(w) * (slope[i][0] * a + slope[i][1] * b);
      });
  return now;
}
