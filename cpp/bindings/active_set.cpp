// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#include "master.h"
#include "parallel.h"
#include <contactx/active_set/active_set.h>
#include <contactx/active_set/step_length.h>
#include <pybind11/stl.h>

namespace py = pybind11;
using namespace contactx_bindings;
using namespace contactx::active_set;
using contactx::contact::Contact;
using contactx::parallel::Halo;

void contactx_bindings::active_set(py::module_& m)
{
  py::class_<ActiveSet> c(m, "ActiveSet", "Pairs and status of all contacts");
  py::enum_<ActiveSet::End>(c, "End", "Whether an iterate is a solution")
      .value("solution", ActiveSet::End::solution)
      .value("again", ActiveSet::End::again)
      .value("hidden", ActiveSet::End::hidden);
  c.def(py::init<std::shared_ptr<Halo>, std::vector<std::shared_ptr<Contact>>,
                 std::shared_ptr<FreeBodies>>(),
        py::arg("halo"), py::arg("contacts"), py::arg("bodies") = nullptr)
      .def_property_readonly_static("part", [](const py::object&)
                                    { return CycleGuard::part; })
      .def("begin_step", &ActiveSet::begin_step)
      .def(
          "settle",
          [](ActiveSet& self, const Forces& forces, bool is_first)
          {
            const Changes found = self.settle(forces, is_first);
            return py::make_tuple(found.status, found.pairs);
          },
          py::arg("forces"), py::arg("is_first") = false)
      .def_property_readonly("changes",
                             [](const ActiveSet& self)
                             {
                               return py::make_tuple(self.changes().status,
                                                     self.changes().pairs);
                             })
      .def("num_closed", &ActiveSet::num_closed)
      .def("num_corners", &ActiveSet::num_corners)
      .def_property_readonly("is_frozen", &ActiveSet::is_frozen)
      .def_property_readonly("is_linear", &ActiveSet::is_linear)
      .def_property_readonly("is_soft", &ActiveSet::is_soft)
      .def(
          "softens",
          [](ActiveSet& self, const std::vector<Array<double>>& step)
          {
            std::vector<std::span<const double>> parts;
            for (const auto& part : step)
              parts.push_back(view(part));
            return self.softens(parts);
          },
          py::arg("step"))
      .def("advance", &ActiveSet::advance, py::arg("is_full"))
      .def("harden", &ActiveSet::harden)
      .def("shortens", &ActiveSet::shortens)
      .def("note", &ActiveSet::note, py::arg("residual"))
      .def("may_end", &ActiveSet::may_end, py::arg("forces"))
      .def_property_readonly("cycles", &ActiveSet::cycles)
      .def_property_readonly("soft_iterations", &ActiveSet::soft_iterations)
      .def_property_readonly("hidden_gaps", &ActiveSet::hidden_gaps);
  py::class_<StepLength>(m, "StepLength", "How much of a step is taken")
      .def(py::init<>())
      .def_property_readonly_static("left", [](const py::object&)
                                    { return StepLength::left; })
      .def("begin_step", &StepLength::begin_step, py::arg("damped"))
      .def("begin", &StepLength::begin, py::arg("size"),
           py::arg("within_cells"))
      .def_property_readonly("has_trial", &StepLength::has_trial)
      .def("judge", &StepLength::judge, py::arg("next_size"))
      .def_property_readonly("part", &StepLength::part)
      .def_property_readonly("limited", &StepLength::limited)
      .def_property_readonly("damped", &StepLength::damped)
      .def_property_readonly("is_stuck", &StepLength::is_stuck);
}
