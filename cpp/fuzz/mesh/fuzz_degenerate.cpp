// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#include "../input.h"
#include "../require.h"
#include <cmath>
#include <contactx/mesh/degenerate.h>
#include <numeric>
#include <stdexcept>
#include <vector>

using namespace contactx;
using namespace contactx::fuzz;

namespace
{
bool is_refused(mesh::CellType cell, const std::vector<double>& x)
{
  const int width = mesh::num_vertices(cell);
  std::vector<std::int32_t> nodes(width);
  std::iota(nodes.begin(), nodes.end(), 0);
  mesh::OneRank ranks;
  try
  {
    mesh::check_cells(ranks, cell, {mesh::dimension(cell), 1, nodes, width, x},
                      1, {});
    return false;
  }
  catch (const std::invalid_argument&)
  {
    return true;
  }
}
} // namespace

/// A cell of any shape: determinants of unit tangents are at most one in size,
/// and the verdict is the same for the cell twice as large, and for its mirror
/// image.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data,
                                      std::size_t size)
{
  Input in(data, size);
  const std::array kinds{
      mesh::CellType::triangle, mesh::CellType::quadrilateral,
      mesh::CellType::tetrahedron, mesh::CellType::hexahedron};
  const mesh::CellType cell = kinds[in.below(4)];
  const int gdim = mesh::dimension(cell);
  std::vector<double> x(std::size_t(3) * mesh::num_vertices(cell), 0), flat;
  for (std::size_t i = 0; i < x.size(); ++i)
    if (static_cast<int>(i % 3) < gdim)
      flat.push_back(x[i] = in.number());
  const std::vector<double> found = mesh::corner_determinants(cell, flat);
  const bool refused = is_refused(cell, x);
  if (not in.even())
    return 0;
  for (const double d : found)
    require(std::abs(d) <= 1 + 1e-12, "unit tangents span at most one");
  std::vector<double> larger = x, mirrored = x;
  for (std::size_t i = 0; i < x.size(); ++i)
  {
    larger[i] *= 2;
    if (i % 3 == 0)
      mirrored[i] *= -1;
  }
  require(is_refused(cell, larger) == refused, "size does not matter");
  require(is_refused(cell, mirrored) == refused,
          "which way round does not matter");
  return 0;
}
