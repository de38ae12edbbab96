// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#include "bindings.h"
#include "master.h"
#include <contactx/dynamics/impact.h>
#include <pybind11/stl.h>

namespace py = pybind11;
using namespace contactx_bindings;
using contactx::dynamics::Impact;
using contactx::parallel::Halo;

void contactx_bindings::dynamics(py::module_& m)
{
  py::class_<Impact>(m, "Impact", "Velocities after a time step with contact")
      .def(py::init<std::shared_ptr<Halo>, Impact::Contacts>(), py::arg("halo"),
           py::arg("contacts"))
      .def(
          "correct",
          [](Impact& self, double dt, Array<double> velocity,
             const py::function& solve)
          {
            self.correct(dt, mutable_view(velocity),
                         [&solve](std::span<double> values)
                         {
                           // The function writes to what is its argument
                           py::array_t<double> given(
                               static_cast<py::ssize_t>(values.size()),
                               values.data(), py::none());
                           solve(given);
                         });
          },
          py::arg("dt"), py::arg("velocity").noconvert(), py::arg("solve"))
      .def("begin_step", &Impact::begin_step)
      .def(
          "arrival",
          [](const Impact& self, const Array<double>& way,
             const Array<double>& cell_sizes)
          { return self.arrival(view(way), view(cell_sizes)); },
          py::arg("way"), py::arg("cell_sizes"))
      .def("corrections",
           [](const Impact& self)
           {
             py::list all;
             for (const auto& each : self.corrections())
               all.append(array(each));
             return all;
           });
}
