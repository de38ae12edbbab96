// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#include "bindings.h"
#include <contactx/active_set/soft_path.h>
#include <stdexcept>

namespace py = pybind11;
using namespace contactx_bindings;
using contactx::active_set::HardStep;
using contactx::active_set::SoftPath;

void contactx_bindings::active_set(py::module_& m)
{
  m.def(
      "look_at_step",
      [](const Array<double>& pressure, const Array<double>& gap,
         const Array<double>& c, const Array<double>& area,
         const Array<std::int8_t>& status, const Array<double>& change)
      {
        for (const auto& array : {pressure, gap, c, area, change})
          if (array.size() != status.size())
            throw std::invalid_argument("the arrays of a step differ in size");
        const HardStep s = contactx::active_set::look_at_step(
            {view(pressure), view(gap), view(c)}, view(area), view(status),
            view(change));
        return py::make_tuple(s.work, s.local, s.closed, s.opening);
      },
      py::arg("pressure"), py::arg("gap"), py::arg("c"), py::arg("area"),
      py::arg("status"), py::arg("change"),
      "What a Newton step with hard contact is about to do to closed nodes: "
      "work, that of local stiffness, how many are closed and how many open");
  py::class_<SoftPath>(m, "SoftPath", "Path from soft to hard contact")
      .def(py::init<>())
      .def("begin_step", &SoftPath::begin_step)
      .def(
          "begins",
          [](SoftPath& self, double work, double local, double closed,
             double opening)
          { return self.begins({work, local, closed, opening}); },
          py::arg("work"), py::arg("local"), py::arg("closed"),
          py::arg("opening"))
      .def("advance", &SoftPath::advance, py::arg("changes"), py::arg("closed"),
           py::arg("is_full"))
      .def("harden", &SoftPath::harden)
      .def_property_readonly("softness", &SoftPath::softness);
}
