// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#include "bindings.h"
#include <contactx/mesh/mesh.h>
#include <memory>
#include <stdexcept>

namespace py = pybind11;
using namespace contactx_bindings;
using contactx::mesh::Halo;

void contactx_bindings::reference(py::module_& m)
{
  // It looks at the cells
  py::class_<contactx::mesh::Mesh>(m, "ReferenceMesh",
                                   "The mesh of the bulk on this rank")
      .def(py::init(
               [](std::shared_ptr<Halo> halo,
                  std::shared_ptr<contactx::mesh::Bodies> bodies,
                  const Array<std::int32_t>& cells)
               {
                 if (cells.ndim() != 2)
                   throw std::invalid_argument(
                       "cells must have a row for each cell");
                 return contactx::mesh::Mesh{std::move(halo), std::move(bodies),
                                             view(cells),
                                             static_cast<int>(cells.shape(1))};
               }),
           py::arg("halo"), py::arg("bodies"), py::arg("cells").noconvert(),
           py::keep_alive<1, 4>());
}
