// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#pragma once

#include "shape.h"
#include <cstdint>
#include <span>

namespace contactx::geometry
{
/// @brief Coordinates of one node.
/// @param[in] node Node.
/// @param[in] x Node coordinates (shape=(num_nodes, D)), row-major.
template <int D>
Vector<D> point(std::int32_t node, std::span<const double> x)
{
  Vector<D> p;
  for (int k = 0; k < D; ++k)
    p[k] = x[static_cast<std::size_t>(node) * D + k];
  return p;
}

/// @brief Coordinates of the nodes of a facet.
/// @param[in] nodes Nodes of the facet.
/// @param[in] x Node coordinates (shape=(num_nodes, gdim)), row-major.
template <class F>
Nodes<F> gather(std::span<const std::int32_t> nodes, std::span<const double> x)
{
  Nodes<F> xf;
  for (int l = 0; l < F::nodes; ++l)
    xf[l] = point<F::gdim>(nodes[l], x);
  return xf;
}
} // namespace contactx::geometry
