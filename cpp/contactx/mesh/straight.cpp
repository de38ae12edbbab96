// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#include "straight.h"
#include "../check.h"
#include "../math/scales.h"
#include "../math/vec.h"
#include "../text.h"
#include "extent.h"
#include <algorithm>
#include <array>
#include <cmath>
#include <stdexcept>

using namespace contactx;
using namespace contactx::mesh;

namespace
{
/// Whether each point of a cell is on each facet: functions of other vertices
/// are zero there.
std::vector<std::vector<std::size_t>>
points_of_facets(CellType cell, std::span<const double> shape)
{
  const std::size_t num = mesh::num_vertices(cell);
  std::vector<std::vector<std::size_t>> points;
  for (const std::vector<int>& own : mesh::facet_vertices(cell))
  {
    points.emplace_back();
    for (std::size_t i = 0; i < shape.size() / num; ++i)
    {
      double inside = 0;
      for (std::size_t v = 0; v < num; ++v)
        if (std::ranges::find(own, static_cast<int>(v)) == own.end())
          inside += std::abs(shape[num * i + v]);
      if (inside < math::equal_rel_tol)
        points.back().push_back(i);
    }
  }
  return points;
}

/// Farthest point of a curved facet from the straight one.
struct Deviation
{
  double away = 0;
  double size = 0; ///< of the facet
  Vector<3> at{};
};

Deviation deviation(const Geometry& geometry,
                    std::span<const std::int32_t> cell,
                    std::span<const std::size_t> facet,
                    std::span<const double> shape, std::size_t num_vertices)
{
  const auto at = [&](std::size_t i)
  {
    Vector<3> x{};
    for (int k = 0; k < geometry.gdim; ++k)
      x[k] = geometry.x[3 * std::size_t(cell[i]) + k];
    return x;
  };
  Deviation most;
  Vector<3> low{infinity, infinity, infinity}, high = -1.0 * low;
  for (const std::size_t i : facet)
  {
    const Vector<3> x = at(i);
    Vector<3> straight{};
    for (std::size_t v = 0; v < num_vertices; ++v)
      straight = straight + shape[num_vertices * i + v] * at(v);
    for (int k = 0; k < 3; ++k)
    {
      low[k] = std::min(low[k], x[k]);
      high[k] = std::max(high[k], x[k]);
    }
    if (const double away = norm(x - straight); away > most.away)
    {
      most.away = away;
      most.at = x;
    }
  }
  most.size = norm(high - low);
  return most;
}
} // namespace

void contactx::mesh::check_straight(Ranks& ranks, const std::string& name,
                                    const Cells& cells,
                                    const Geometry& geometry,
                                    std::span<const double> points,
                                    std::span<const std::int32_t> of,
                                    std::span<const std::int32_t> local)
{
  if (geometry.degree == 1 or geometry.degree == cells.degree)
    return;
  std::int64_t count = 0;
  double most = 0;
  std::array<double, 3> first{infinity, infinity, infinity};
  ranks.agree(
      [&]
      {
        check::dimension(geometry.gdim);
        check::rows(std::ssize(points), geometry.points_per_cell, geometry.gdim,
                    "points", "point of a cell");
        check::numbers(of, cells.size(), "of", "cells");
        check::rows(std::ssize(local), std::ssize(of), 1, "local", "facet");
        const std::vector<double> shape
            = mesh::linear_shape(cells.type, points);
        const auto facets = points_of_facets(cells.type, shape);
        check::numbers(local, std::ssize(facets), "local", "facets of a cell");
        for (std::size_t f = 0; f < of.size(); ++f)
        {
          const Deviation found
              = deviation(geometry, geometry[of[f]], facets[local[f]], shape,
                          mesh::num_vertices(cells.type));
          most = std::max(most, found.away);
          if (not(found.away > math::negligible_part * found.size))
            continue;
          ++count;
          first = std::min(first, found.at);
        }
      });
  count = mesh::total(ranks, count);
  if (count == 0)
    return;
  most = mesh::largest(ranks, most);
  const auto all = mesh::gathered<double>(ranks, first);
  for (std::size_t r = 0; r < all.size(); r += 3)
    first = std::min(first, {all[r], all[r + 1], all[r + 2]});
  const Vector<3> size = mesh::extent(ranks, geometry.x, 3);
  throw std::invalid_argument(
      name + " is curved: the mesh is of order "
      + std::to_string(geometry.degree) + ", and " + std::to_string(count)
      + " of these facets have nodes up to " + number_text(most, 3)
      + " away from where straight ones have them, first at "
      + point_text(std::span(first).first(geometry.gdim),
                   *std::ranges::max_element(size))
      + ". Contact and the displacement take facets as straight: make the mesh "
        "of order 1, in gmsh by gmsh.model.mesh.setOrder(1), and finer where "
        "it is round; or of order 2 with a displacement of degree 2 (manual: "
        "errors/refused-mesh)");
}
