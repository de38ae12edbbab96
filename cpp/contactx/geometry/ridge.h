// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#pragma once

#include "frame.h"

namespace contactx::geometry
{
/// @brief Vertices of the edge that gives a feature its direction: the edge
/// itself, at a vertex the edge that starts there, else the first one.
template <class F>
constexpr std::pair<int, int> feature_edge(int feature)
{
  if (feature <= interior)
    return F::edges[0];
  if constexpr (F::num_edges > 0)
    if (feature <= F::num_edges)
      return F::edges[feature - 1];
  const int vertex = feature - 1 - F::num_edges;
  for (const auto& e : F::edges)
    if (e.first == vertex)
      return e;
  return F::edges[0];
}

/// @brief Axes in which the normal of a ridge is kept: (e, e x n, n) in 3D,
/// (e, n) in 2D, with the direction e of the feature's edge and the facet's
/// normal n. They turn with the facet, so constant components give a normal
/// that is indifferent to the motion of the observer.
/// @param[in] x Node coordinates.
/// @param[in] feature A feature, but not the interior.
/// @param[in] xi Local coordinates of the point on the feature.
template <class F>
std::array<Vector<F::gdim>, F::gdim> ridge_axes(const Nodes<F>& x, int feature,
                                                const Local<F>& xi)
{
  const auto [i, j] = feature_edge<F>(feature);
  const Vector<F::gdim> edge = x[j] - x[i];
  const Vector<F::gdim> e = (1 / norm(edge)) * edge;
  const Vector<F::gdim> n = frame<F>(x, xi).n;
  if constexpr (F::gdim == 2)
    return {e, n};
  else
    return {e, cross(e, n), n};
}
} // namespace contactx::geometry
