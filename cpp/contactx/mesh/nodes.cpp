// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#include "nodes.h"
#include "../check.h"
#include "../math/vec.h"
#include <algorithm>
#include <array>

using namespace contactx;
using namespace contactx::mesh;

namespace
{
void check_nodes(const Cells& cells, std::int32_t num_nodes)
{
  check::rows(std::ssize(cells.nodes), cells.size(),
              mesh::num_nodes(cells.type, cells.degree), "cells", "cell");
  check::numbers(cells.nodes, num_nodes, "cells", "nodes");
}

void check_geometry(const Cells& cells, const Geometry& geometry)
{
  check::dimension(geometry.gdim);
  check::between(geometry.points_per_cell, num_vertices(cells.type), 1 << 20,
                 "points_per_cell");
  check::rows(std::ssize(geometry.points), cells.size(),
              geometry.points_per_cell, "points", "cell");
  check::rows(std::ssize(geometry.x), std::ssize(geometry.x) / 3, 3, "x",
              "point");
  check::numbers(geometry.points, std::ssize(geometry.x) / 3, "points",
                 "points");
  check::require(geometry.degree != cells.degree
                     or geometry.points_per_cell
                            == mesh::num_nodes(cells.type, cells.degree),
                 "points must be those of cells of the degree of the mesh");
}

/// Call f(node, points) for each node of each cell: its own point where the
/// mesh has it, else the vertices whose middle it is at.
template <class Function>
void for_each_node(const Cells& cells, const Geometry& geometry, Function&& f)
{
  const auto& vertices = node_vertices(cells.type, cells.degree);
  const bool is_own = cells.degree == geometry.degree;
  std::vector<std::int32_t> ends;
  for (std::int32_t c = 0; c < cells.size(); ++c)
  {
    const auto nodes = cells[c], points = geometry[c];
    for (std::size_t i = 0; i < vertices.size(); ++i)
    {
      ends.clear();
      if (is_own)
        ends.push_back(points[i]);
      else
        for (const int v : vertices[i])
          ends.push_back(points[v]);
      f(nodes[i], std::span<const std::int32_t>(ends));
    }
  }
}

/// Whether the normal of a facet points into its cell.
/// @param[in] points Points of the cell, its vertices first.
/// @param[in] facet Vertices of the facet among those.
/// @param[in] num_vertices Vertices of the cell.
/// @param[in] x Positions of all points (shape=(num_points, 3)).
bool points_inward(std::span<const std::int32_t> points,
                   std::span<const int> facet, int num_vertices,
                   std::span<const double> x)
{
  const auto at = [&](int v) { return vector_at(x, points[v], 3); };
  const Vector<3> t = at(facet[1]) - at(facet[0]);
  const Vector<3> normal = facet.size() == 2
                               ? Vector<3>{t[1], -t[0], 0}
                               : cross(t, at(facet[2]) - at(facet[0]));
  Vector<3> of_facet{}, of_cell{};
  for (const int v : facet)
    of_facet = of_facet + at(v);
  for (int v = 0; v < num_vertices; ++v)
    of_cell = of_cell + at(v);
  return dot(normal, (1.0 / static_cast<double>(facet.size())) * of_facet
                         - (1.0 / num_vertices) * of_cell)
         < 0;
}
} // namespace

std::vector<std::int32_t> contactx::mesh::linear_cells(const Cells& cells)
{
  const std::vector<int> parts = cell_parts(cells.type, cells.degree);
  std::vector<std::int32_t> linear;
  linear.reserve(parts.size() * cells.size());
  for (std::int32_t c = 0; c < cells.size(); ++c)
  {
    const auto nodes = cells[c];
    for (const int i : parts)
      linear.push_back(nodes[i]);
  }
  return linear;
}

std::vector<std::int8_t> contactx::mesh::node_levels(const Cells& cells,
                                                     std::int32_t num_nodes)
{
  check_nodes(cells, num_nodes);
  if (cells.degree == 1)
    return {};
  const auto& vertices = node_vertices(cells.type, cells.degree);
  std::vector<std::int8_t> levels(num_nodes, 0);
  for (std::int32_t c = 0; c < cells.size(); ++c)
  {
    const auto nodes = cells[c];
    for (std::size_t i = 0; i < vertices.size(); ++i)
      levels[nodes[i]] = vertices[i].size() == 1   ? 0
                         : vertices[i].size() == 2 ? 1
                                                   : 2;
  }
  return levels;
}

std::vector<double>
contactx::mesh::reference_positions(const Cells& cells, std::int32_t num_nodes,
                                    const Geometry& geometry)
{
  check_nodes(cells, num_nodes);
  check_geometry(cells, geometry);
  const std::size_t gdim = geometry.gdim;
  std::vector<double> x(num_nodes * gdim, 0);
  for_each_node(cells, geometry,
                [&](std::int32_t node, std::span<const std::int32_t> ends)
                {
                  const std::size_t n = ends.size();
                  for (std::size_t k = 0; k < gdim; ++k)
                  {
                    const auto at = [&](std::size_t i)
                    { return geometry.x[3 * std::size_t(ends[i]) + k]; };
                    double sum = n == 1 ? at(0) : at(0) + at(n - 1);
                    // Opposite vertices are added first
                    for (std::size_t i = 1; i < n / 2; ++i)
                      sum += at(i) + at(n - 1 - i);
                    x[gdim * node + k] = sum / static_cast<double>(n);
                  }
                });
  return x;
}

std::vector<std::int64_t> contactx::mesh::original_nodes(
    const Cells& cells, std::int32_t num_nodes, const Geometry& geometry,
    std::span<const std::int64_t> numbers, std::int64_t count)
{
  check_nodes(cells, num_nodes);
  check_geometry(cells, geometry);
  check::rows(std::ssize(numbers), std::ssize(geometry.x) / 3, 1, "numbers",
              "point");
  std::vector<std::int64_t> original(num_nodes, -1);
  for_each_node(cells, geometry,
                [&](std::int32_t node, std::span<const std::int32_t> ends)
                {
                  const std::size_t n = ends.size();
                  if (n == 1)
                  {
                    original[node] = numbers[ends[0]];
                    return;
                  }
                  // The smallest vertex and the one opposite to it, which no
                  // other middle has
                  std::size_t low = 0;
                  for (std::size_t i = 1; i < n; ++i)
                    if (numbers[ends[i]] < numbers[ends[low]])
                      low = i;
                  original[node] = count * (1 + numbers[ends[low]])
                                   + numbers[ends[n - 1 - low]];
                });
  return original;
}

geometry::Facets contactx::mesh::facets(const Cells& cells,
                                        std::span<const std::int32_t> of,
                                        std::span<const std::int32_t> local,
                                        const Geometry& geometry)
{
  const auto& vertices = facet_vertices(cells.type);
  check_geometry(cells, geometry);
  check::numbers(of, cells.size(), "of", "cells");
  check::rows(std::ssize(local), std::ssize(of), 1, "local", "facet");
  check::numbers(local, std::ssize(vertices), "local", "facets of a cell");
  // Parts of each facet as it is, and turned
  std::vector<std::array<std::vector<int>, 2>> parts;
  for (int i = 0; i < static_cast<int>(vertices.size()); ++i)
    parts.push_back({facet_parts(cells.type, cells.degree, i, false),
                     facet_parts(cells.type, cells.degree, i, true)});
  geometry::Facets result;
  for (std::size_t f = 0; f < of.size(); ++f)
  {
    const auto nodes = cells[of[f]];
    const std::vector<int>& own = vertices[local[f]];
    const bool is_turned = points_inward(geometry[of[f]], own,
                                         num_vertices(cells.type), geometry.x);
    const std::vector<int>& places = parts[local[f]][is_turned];
    for (std::size_t i = 0; i < places.size(); ++i)
    {
      result.nodes.push_back(nodes[places[i]]);
      if ((i + 1) % own.size() == 0)
        result.offsets.push_back(
            static_cast<std::int32_t>(result.nodes.size()));
    }
  }
  return result;
}
