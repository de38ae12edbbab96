// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#include "../input.h"
#include "../require.h"
#include <contactx/mesh/deformed_cells.h>
#include <vector>

using namespace contactx;
using namespace contactx::fuzz;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data,
                                      std::size_t size)
{
  Input in(data, size);
  const int gdim = 2 + in.below(2);
  const int width = in.flag() ? gdim + 1 : 1 << gdim;
  const int num_nodes = width + in.below(8), num_cells = in.below(4);
  std::vector<double> X(num_nodes * gdim), u(num_nodes * gdim);
  for (double& v : X)
    v = in.number();
  for (double& v : u)
    v = in.number();
  std::vector<std::int32_t> cells(num_cells * width);
  for (auto& node : cells)
    node = in.below(num_nodes);

  const auto found = mesh::deformed_cells(cells, width, X, u, gdim);
  require(found.inverted >= 0 and found.inverted <= num_cells,
          "no more cells are inverted than there are");
  require((found.inverted > 0) == (found.smallest <= 0),
          "some are where det F is not positive");
  require(found.cell >= -(num_cells == 0) and found.cell < num_cells,
          "the cell exists");
  if (!in.even())
    return 0;

  // Each cell by itself, and with its nodes displaced by all of X
  std::int64_t inverted = 0;
  double smallest = std::numeric_limits<double>::infinity();
  for (int c = 0; c < num_cells; ++c)
  {
    const auto nodes
        = std::span<const std::int32_t>(cells).subspan(c * width, width);
    const auto alone = mesh::deformed_cells(nodes, width, X, u, gdim);
    inverted += alone.inverted;
    smallest = std::min(smallest, alone.smallest);
    const auto doubled = mesh::deformed_cells(nodes, width, X, X, gdim);
    require(doubled.smallest == 1 << gdim or std::isinf(doubled.smallest),
            "det F of twice the size is a power of two, if there is any");
    require(doubled.inverted == 0, "and no cell is inverted by it");
  }
  require(inverted == found.inverted, "their numbers add up");
  // A cell is passed over without the rounding of a division
  require(smallest == found.smallest
              or std::abs(smallest - found.smallest) <= 1e-14 * smallest,
          "the smallest is one cell's");
  return 0;
}
