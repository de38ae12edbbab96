// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#include "partitioner.h"
#include "ranks.h"
#include <contactx/mesh/partition.h>
#include <dolfinx/mesh/cell_types.h>
#include <stdexcept>
#include <string>
#include <utility>

dolfinx::mesh::CellPartitionFunction
contactx_dolfinx::partitioner(std::vector<double> x, int gdim,
                              std::vector<std::int8_t> near)
{
  return [x = std::move(x), gdim, near = std::move(near)](
             MPI_Comm comm, int nparts,
             const std::vector<dolfinx::mesh::CellType>& cell_types,
             const std::vector<std::span<const std::int64_t>>& cells)
  {
    if (cell_types.size() != 1)
      throw std::invalid_argument(
          "the mesh must have cells of one kind, not of "
          + std::to_string(cell_types.size())
          + ": contact has no mixed meshes");
    Ranks ranks(comm);
    const std::vector<std::int32_t> parts = contactx::mesh::parts_with_contact(
        ranks, cells.front(),
        dolfinx::mesh::num_cell_vertices(cell_types.front()), {x, gdim, near},
        nparts);
    return dolfinx::graph::regular_adjacency_list(parts, 1);
  };
}
