// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#pragma once

#include "generator.h"
#include <contactx/search/surface.h>

namespace contactx::tests
{
/// @brief A surface with its node coordinates, built node by node.
struct Scene
{
  int gdim;
  std::vector<double> x;
  std::vector<std::int32_t> offsets{0};
  std::vector<std::int32_t> nodes;

  explicit Scene(int dimension) : gdim(dimension) {}

  /// @brief Add a node; in 2D the third coordinate is dropped.
  std::int32_t node(const Vector<3>& p)
  {
    x.insert(x.end(), p.begin(), p.begin() + gdim);
    return static_cast<std::int32_t>(x.size()) / gdim - 1;
  }

  void facet(std::vector<std::int32_t> n)
  {
    nodes.insert(nodes.end(), n.begin(), n.end());
    offsets.push_back(static_cast<std::int32_t>(nodes.size()));
  }

  /// @brief A quadrilateral, or the two triangles that it splits into.
  void patch(const std::array<std::int32_t, 4>& n, bool split)
  {
    if (split)
    {
      facet({n[0], n[1], n[2]});
      facet({n[1], n[3], n[2]});
    }
    else
      facet({n.begin(), n.end()});
  }

  Vector<3> point(std::int32_t i) const { return vector_at(x, i, gdim); }

  /// @brief Add the nodes and facets of another surface.
  void join(const Scene& other)
  {
    const auto first = static_cast<std::int32_t>(x.size()) / gdim;
    x.insert(x.end(), other.x.begin(), other.x.end());
    for (const std::int32_t node : other.nodes)
      nodes.push_back(first + node);
    const std::int32_t begin = offsets.back();
    for (std::size_t f = 1; f < other.offsets.size(); ++f)
      offsets.push_back(begin + other.offsets[f]);
  }

  geometry::FacetList facets() const { return {offsets, nodes}; }

  search::Surface surface() const { return {offsets, nodes, gdim}; }
};

/// @brief What a grid is made of.
enum class Cells
{
  triangles,
  quadrilaterals,
  mixed
};

/// @brief Grid of n x n cells over the unit square, its node (i, j) at
/// position(i / n, j / n).
template <class Position>
Scene grid(int n, Cells cells, Position position)
{
  Scene scene(3);
  for (int j = 0; j <= n; ++j)
    for (int i = 0; i <= n; ++i)
      scene.node(position(double(i) / n, double(j) / n));
  for (int j = 0; j < n; ++j)
    for (int i = 0; i < n; ++i)
    {
      const int a = j * (n + 1) + i;
      scene.patch({a, a + 1, a + n + 1, a + n + 2},
                  cells == Cells::triangles
                      or (cells == Cells::mixed and (i + j) % 2 == 0));
    }
  return scene;
}

/// @brief Flat grid with the normal (0, 0, 1).
inline Scene flat_grid(int n, Cells cells)
{
  return grid(n, cells, [](double s, double t) { return Vector<3>{s, t, 0}; });
}
} // namespace contactx::tests
