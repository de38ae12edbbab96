// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#include "degenerate.h"
#include "../math/scales.h"
#include "../math/vec.h"
#include "../text.h"
#include "extent.h"
#include <algorithm>
#include <array>
#include <limits>
#include <stdexcept>
#include <string>

using namespace contactx;
using namespace contactx::mesh;

namespace
{
bool is_simplex(CellType cell)
{
  return cell == CellType::triangle or cell == CellType::tetrahedron;
}

bool is_degenerate(CellType cell, std::span<const double> x)
{
  const std::vector<double> found = corner_determinants(cell, x);
  const auto [low, high] = std::ranges::minmax(found);
  return (low < -math::round_off and high > math::round_off)
         or std::max(-low, high) <= math::round_off;
}
} // namespace

std::vector<double>
contactx::mesh::corner_determinants(CellType cell, std::span<const double> x)
{
  const int gdim = mesh::dimension(cell);
  std::vector<double> determinants(is_simplex(cell) ? 1 : 1 << gdim);
  for (std::size_t corner = 0; corner < determinants.size(); ++corner)
  {
    // In the plane the third is across it
    std::array<Vector<3>, 3> tangent{{{}, {}, {0, 0, 1}}};
    for (int axis = 0; axis < gdim; ++axis)
    {
      // The first axis counts fastest
      const std::size_t bit = std::size_t(1) << axis;
      const std::size_t from = is_simplex(cell) ? 0 : corner & ~bit;
      const std::size_t to = is_simplex(cell) ? axis + 1 : corner | bit;
      const Vector<3> edge = vector_at(x, to, gdim) - vector_at(x, from, gdim);
      const double length = norm(edge);
      tangent[axis] = length > 0 ? (1 / length) * edge : Vector<3>{};
    }
    determinants[corner] = dot(cross(tangent[0], tangent[1]), tangent[2]);
  }
  return determinants;
}

void contactx::mesh::check_cells(Ranks& ranks, CellType cell,
                                 const Geometry& geometry,
                                 std::int32_t num_owned,
                                 std::span<const std::int64_t> original)
{
  const std::size_t g = geometry.gdim, width = mesh::num_vertices(cell);
  // Number and middle of the first one
  std::array<double, 4> first{std::numeric_limits<double>::infinity(), 0, 0, 0};
  std::int64_t count = 0;
  std::vector<double> x(width * g);
  for (std::int32_t c = 0; c < num_owned; ++c)
  {
    const auto points = geometry[c];
    for (std::size_t v = 0; v < width; ++v)
      for (std::size_t k = 0; k < g; ++k)
        x[g * v + k] = geometry.x[3 * points[v] + k];
    if (not is_degenerate(cell, x))
      continue;
    ++count;
    const auto number = static_cast<double>(original.empty() ? c : original[c]);
    if (number < first[0])
    {
      first = {number, 0, 0, 0};
      for (std::size_t i = 0; i < x.size(); ++i)
        first[1 + i % g] += x[i] / double(width);
    }
  }
  count = mesh::total(ranks, count);
  if (count == 0)
    return;
  const auto each = mesh::gathered<double>(ranks, first);
  std::size_t at = 0;
  for (std::size_t r = 0; r < each.size(); r += first.size())
    if (each[r] < each[at])
      at = r;
  const Vector<3> size = mesh::extent(ranks, geometry.x, 3);
  const bool is_known = not mesh::everywhere(ranks, original.empty());
  throw std::invalid_argument(
      std::to_string(count)
      + " cells of the mesh are degenerate: they have no volume, or are folded "
        "so that their Jacobian changes sign. The first is at "
      + point_text(std::span<const double>(each).subspan(at + 1, g),
                   std::ranges::max(size))
      + (is_known ? " and is cell "
                        + std::to_string(static_cast<std::int64_t>(each[at]))
                        + " of the mesh as it was made"
                  : "")
      + ": repair the mesh there. The vertices of "
        "quadrilaterals and hexahedra may be in another order than DOLFINx "
        "has: row by row, not round about (manual: errors/refused-mesh)");
}
