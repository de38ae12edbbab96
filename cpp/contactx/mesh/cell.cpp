// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#include "cell.h"
#include "../check.h"
#include <algorithm>
#include <array>
#include <stdexcept>
#include <string>

using namespace contactx;
using namespace contactx::mesh;

namespace
{
using Vertices = std::vector<int>;

constexpr std::array<std::string_view, 5> cell_names{
    "interval", "triangle", "quadrilateral", "tetrahedron", "hexahedron"};

/// Vertices of what a reference cell consists of, as Basix numbers them.
struct Reference
{
  int dim;
  int num_vertices;
  bool is_tensor; // a product of intervals, not a simplex
  std::vector<Vertices> edges;
  std::vector<Vertices> faces; // of a cell in 3D
};

const Reference& reference(CellType cell)
{
  static const std::array<Reference, 5> cells{
      {{1, 2, true, {}, {}},
       {2, 3, false, {{1, 2}, {0, 2}, {0, 1}}, {}},
       {2, 4, true, {{0, 1}, {0, 2}, {1, 3}, {2, 3}}, {}},
       {3,
        4,
        false,
        {{2, 3}, {1, 3}, {1, 2}, {0, 3}, {0, 2}, {0, 1}},
        {{1, 2, 3}, {0, 2, 3}, {0, 1, 3}, {0, 1, 2}}},
       {3,
        8,
        true,
        {{0, 1},
         {0, 2},
         {0, 4},
         {1, 3},
         {1, 5},
         {2, 3},
         {2, 6},
         {3, 7},
         {4, 5},
         {4, 6},
         {5, 7},
         {6, 7}},
        {{0, 1, 2, 3},
         {0, 1, 4, 5},
         {0, 2, 4, 6},
         {1, 3, 5, 7},
         {2, 3, 6, 7},
         {4, 5, 6, 7}}}}};
  return cells.at(static_cast<std::size_t>(cell));
}

Vertices all_vertices(const Reference& cell)
{
  Vertices all;
  for (int v = 0; v < cell.num_vertices; ++v)
    all.push_back(v);
  return all;
}

/// Vertices whose middle each node is at, by degree less one.
std::array<std::vector<Vertices>, 2> made_nodes(const Reference& cell)
{
  std::array<std::vector<Vertices>, 2> nodes;
  for (int v = 0; v < cell.num_vertices; ++v)
    nodes[0].push_back({v});
  nodes[1] = nodes[0];
  nodes[1].insert(nodes[1].end(), cell.edges.begin(), cell.edges.end());
  // Simplices have quadratic functions of vertices and edges alone
  if (cell.is_tensor)
  {
    nodes[1].insert(nodes[1].end(), cell.faces.begin(), cell.faces.end());
    nodes[1].push_back(all_vertices(cell));
  }
  return nodes;
}

/// Parts of a product of intervals, by the corners whose middle each of their
/// vertices is; the first axis counts fastest.
std::vector<std::vector<Vertices>> tensor_parts(const Vertices& corners)
{
  int dim = 0;
  while (1u << dim < corners.size())
    ++dim;
  const int num_parts = 1 << dim;
  std::vector<std::vector<Vertices>> parts;
  for (int place = 0; place < num_parts; ++place)
  {
    std::vector<Vertices>& part = parts.emplace_back();
    for (int vertex = 0; vertex < num_parts; ++vertex)
    {
      // Along an axis 0 and 2 are its ends, 1 is its middle
      Vertices& between = part.emplace_back();
      for (int c = 0; c < num_parts; ++c)
      {
        bool is_one = true;
        for (int k = 0; k < dim; ++k)
        {
          const int at = (place >> k & 1) + (vertex >> k & 1);
          is_one = is_one and (at == 1 or at == 2 * (c >> k & 1));
        }
        if (is_one)
          between.push_back(corners[c]);
      }
    }
  }
  return parts;
}

/// Parts of a triangle or a tetrahedron.
std::vector<std::vector<Vertices>> simplex_parts(const Vertices& c)
{
  const auto middle = [&c](int i, int j) { return Vertices{c[i], c[j]}; };
  if (c.size() == 3)
    return {{{c[0]}, middle(0, 1), middle(0, 2)},
            {middle(0, 1), {c[1]}, middle(1, 2)},
            {middle(0, 2), middle(1, 2), {c[2]}},
            {middle(0, 1), middle(1, 2), middle(0, 2)}};
  std::vector<std::vector<Vertices>> parts;
  for (int i = 0; i < 4; ++i)
  {
    std::vector<Vertices>& part = parts.emplace_back();
    part.push_back({c[i]});
    for (int j = 0; j < 4; ++j)
      if (j != i)
        part.push_back(middle(i, j));
  }
  // Between the corners an octahedron, about one of its diagonals
  const std::array ring{middle(0, 2), middle(0, 3), middle(1, 3), middle(1, 2)};
  for (int k = 0; k < 4; ++k)
    parts.push_back({middle(0, 1), middle(2, 3), ring[k], ring[(k + 1) % 4]});
  return parts;
}

/// Nodes of the linear parts of a part of a cell's boundary, or of all of it.
std::vector<int> linear_parts(CellType cell, int degree,
                              const Vertices& corners)
{
  const auto& nodes = node_vertices(cell, degree);
  if (degree == 1)
    return corners;
  const bool is_tensor = corners.size() == 2 or reference(cell).is_tensor;
  std::vector<int> parts;
  for (const auto& part :
       is_tensor ? tensor_parts(corners) : simplex_parts(corners))
    for (Vertices between : part)
    {
      std::ranges::sort(between);
      parts.push_back(
          static_cast<int>(std::ranges::find(nodes, between) - nodes.begin()));
    }
  return parts;
}
} // namespace

CellType contactx::mesh::cell_type(std::string_view name)
{
  const auto found = std::ranges::find(cell_names, name);
  if (found == cell_names.end())
    throw std::invalid_argument("contact needs triangles, quadrilaterals, "
                                "tetrahedra or hexahedra, not cells of the "
                                "kind "
                                + std::string(name));
  return static_cast<CellType>(found - cell_names.begin());
}

int contactx::mesh::dimension(CellType cell) { return reference(cell).dim; }

int contactx::mesh::num_vertices(CellType cell)
{
  return reference(cell).num_vertices;
}

const std::vector<std::vector<int>>&
contactx::mesh::facet_vertices(CellType cell)
{
  const Reference& is = reference(cell);
  return is.dim == 2 ? is.edges : is.faces;
}

const std::vector<std::vector<int>>&
contactx::mesh::node_vertices(CellType cell, int degree)
{
  check::between(degree, 1, 2, "degree");
  static const std::array all{made_nodes(reference(CellType::interval)),
                              made_nodes(reference(CellType::triangle)),
                              made_nodes(reference(CellType::quadrilateral)),
                              made_nodes(reference(CellType::tetrahedron)),
                              made_nodes(reference(CellType::hexahedron))};
  return all.at(static_cast<std::size_t>(cell))[degree - 1];
}

int contactx::mesh::num_nodes(CellType cell, int degree)
{
  return static_cast<int>(node_vertices(cell, degree).size());
}

std::vector<double> contactx::mesh::linear_shape(CellType cell,
                                                 std::span<const double> points)
{
  const Reference& is = reference(cell);
  check::rows(std::ssize(points), std::ssize(points) / is.dim, is.dim, "points",
              "point");
  std::vector<double> values;
  for (std::size_t at = 0; at < points.size(); at += is.dim)
  {
    const auto x = points.subspan(at, is.dim);
    for (int v = 0; v < is.num_vertices; ++v)
    {
      double N = 1;
      if (is.is_tensor)
        for (int k = 0; k < is.dim; ++k)
          N *= v >> k & 1 ? x[k] : 1 - x[k];
      else if (v > 0)
        N = x[v - 1];
      else
        for (const double xk : x)
          N -= xk;
      values.push_back(N);
    }
  }
  return values;
}

std::vector<int> contactx::mesh::cell_parts(CellType cell, int degree)
{
  return linear_parts(cell, degree, all_vertices(reference(cell)));
}

std::vector<int> contactx::mesh::facet_parts(CellType cell, int degree,
                                             int facet, bool is_turned)
{
  Vertices corners = facet_vertices(cell).at(facet);
  if (is_turned)
  {
    const int first = dimension(cell) == 2 ? 0 : 1;
    std::swap(corners[first], corners[first + 1]);
  }
  return linear_parts(cell, degree, corners);
}
