// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#pragma once

#include "generator.h"
#include <contactx/geometry/facets.h>
#include <contactx/search/surface.h>
#include <functional>
#include <numbers>

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

  Scene(int dimension, const std::vector<Vector<3>>& points,
        const std::vector<std::vector<std::int32_t>>& facets)
      : gdim(dimension)
  {
    for (const Vector<3>& p : points)
      node(p);
    for (const std::vector<std::int32_t>& f : facets)
      facet(f);
  }

  std::int32_t num_nodes() const
  {
    return static_cast<std::int32_t>(x.size()) / gdim;
  }

  /// @brief Add a node; in 2D the third coordinate is dropped.
  std::int32_t node(const Vector<3>& p)
  {
    x.insert(x.end(), p.begin(), p.begin() + gdim);
    return num_nodes() - 1;
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

  template <class Map>
  void move(Map&& map)
  {
    for (std::int32_t i = 0; i < num_nodes(); ++i)
      std::copy_n(map(point(i)).begin(), gdim, &x[gdim * i]);
  }

  /// @brief Add the nodes and facets of another surface.
  void join(const Scene& other)
  {
    const std::int32_t first = num_nodes(), begin = offsets.back();
    x.insert(x.end(), other.x.begin(), other.x.end());
    for (const std::int32_t node : other.nodes)
      nodes.push_back(first + node);
    for (std::size_t f = 1; f < other.offsets.size(); ++f)
      offsets.push_back(begin + other.offsets[f]);
  }

  geometry::FacetList facets() const { return {offsets, nodes}; }

  search::Surface surface() const { return {offsets, nodes, gdim}; }
};

/// @brief Add a facet to others, whose nodes become to(node).
template <class To = std::identity>
void add_facet(geometry::Facets& facets, std::span<const std::int32_t> nodes,
               To to = {})
{
  for (const std::int32_t node : nodes)
    facets.nodes.push_back(to(node));
  facets.offsets.push_back(static_cast<std::int32_t>(facets.nodes.size()));
}

/// @brief Boundary of a regular polygon about the origin, with the body inside.
inline Scene regular_polygon(int n, double radius)
{
  Scene scene(2);
  for (int i = 0; i < n; ++i)
  {
    const double t = 2 * std::numbers::pi * i / n;
    scene.node({radius * std::cos(t), radius * std::sin(t)});
    scene.facet({i, (i + 1) % n});
  }
  return scene;
}

enum class Cells
{
  triangles,
  quadrilaterals,
  mixed
};

/// @brief Grid of n x m cells, its node (i, j) at position(i / n, j / m).
template <class Position>
Scene grid(int n, int m, Cells cells, Position position)
{
  Scene scene(3);
  for (int j = 0; j <= m; ++j)
    for (int i = 0; i <= n; ++i)
      scene.node(position(double(i) / n, double(j) / m));
  for (int j = 0; j < m; ++j)
    for (int i = 0; i < n; ++i)
    {
      const int a = j * (n + 1) + i;
      scene.patch({a, a + 1, a + n + 1, a + n + 2},
                  cells == Cells::triangles
                      or (cells == Cells::mixed and (i + j) % 2 == 0));
    }
  return scene;
}

template <class Position>
Scene grid(int n, Cells cells, Position position)
{
  return grid(n, n, cells, position);
}

/// @brief Polyline of n segments, its node i at position(i / n), from left to
/// right.
template <class Position>
Scene line(int n, Position position)
{
  Scene scene(2);
  for (int i = 0; i <= n; ++i)
    scene.node(position(double(i) / n));
  for (int i = 0; i < n; ++i)
    scene.facet({i, i + 1});
  return scene;
}

/// @brief Flat grid with the normal (0, 0, 1).
inline Scene flat_grid(int n, Cells cells)
{
  return grid(n, cells, [](double s, double t) { return Vector<3>{s, t, 0}; });
}
} // namespace contactx::tests
