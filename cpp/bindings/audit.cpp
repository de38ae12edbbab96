// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#include "bindings.h"
#include <contactx/mesh/deformed_cells.h>
#include <stdexcept>

namespace py = pybind11;
using namespace contactx_bindings;

void contactx_bindings::audit(py::module_& m)
{
  m.def(
      "deformed_cells",
      [](const Array<std::int32_t>& cells, const Array<double>& X,
         const Array<double>& u, int gdim)
      {
        if (cells.ndim() != 2)
          throw std::invalid_argument("cells must have a row for each cell");
        const auto found = contactx::mesh::deformed_cells(
            view(cells), static_cast<int>(cells.shape(1)), view(X), view(u),
            gdim);
        return py::make_tuple(found.smallest, found.cell, found.inverted);
      },
      py::arg("cells"), py::arg("X"), py::arg("u"), py::arg("gdim"),
      "Smallest det F, the cell that has it, and the number of inverted cells "
      "(cells: shape=(num_cells, nodes_per_cell))");
}
