// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#include "bindings.h"
#include "check.h"
#include <contactx/contact/facing.h>

namespace py = pybind11;
using namespace contactx_bindings;

void contactx_bindings::contact(py::module_& m)
{
  m.def(
      "facing_nodes",
      [](const Array<std::int32_t>& offsets, const Array<std::int32_t>& nodes,
         const Array<double>& x, const Array<double>& normal, int gdim)
      {
        check::surface(view(offsets), view(nodes), x.size(), gdim);
        return array(contactx::contact::facing_nodes(
            {view(offsets), view(nodes)}, view(x), view(normal), gdim));
      },
      py::arg("offsets"), py::arg("nodes"), py::arg("x"), py::arg("normal"),
      py::arg("gdim"), "Which nodes have a normal that opposes the master's");
  m.def(
      "facing_areas",
      [](const Array<std::int32_t>& offsets, const Array<std::int32_t>& nodes,
         const Array<double>& reference, const Array<double>& x,
         const Array<double>& normal, int gdim)
      {
        check::surface(view(offsets), view(nodes), x.size(), gdim);
        return array(contactx::contact::facing_areas(
            {view(offsets), view(nodes)}, view(reference), view(x),
            view(normal), gdim));
      },
      py::arg("offsets"), py::arg("nodes"), py::arg("reference"), py::arg("x"),
      py::arg("normal"), py::arg("gdim"),
      "Area of each corner of each facet in front of the master");
}
