// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#include "bulk.h"
#include "master.h"
#include <contactx/check.h>
#include <contactx/solve/derivative_check.h>
#include <contactx/solve/loop.h>
#include <contactx/solve/not_finite.h>
#include <pybind11/functional.h>
#include <pybind11/stl.h>

namespace py = pybind11;
using namespace contactx_bindings;
using namespace contactx::solve;
using contactx::mesh::Halo;
using contactx::solve::ActiveSet;
using contactx::solve::FreeBodies;
using contactx::solve::StepLength;

void contactx_bindings::newton(py::module_& m)
{
  py::register_exception<NotFinite>(m, "NotFiniteError", PyExc_ArithmeticError);
  py::register_exception<contactx::check::Undefined>(m, "UndefinedError",
                                                     PyExc_ValueError);
  py::class_<System, std::shared_ptr<System>>(m, "System",
                                              "Coupled bulk and contacts")
      .def(py::init(
               [](std::shared_ptr<Halo> halo, py::object bulk,
                  System::Contacts contacts)
               {
                 return std::make_shared<System>(
                     std::move(halo),
                     std::make_shared<PythonBulk>(std::move(bulk)),
                     std::move(contacts));
               }),
           py::arg("halo"), py::arg("bulk"), py::arg("contacts"))
      .def_property_readonly("offsets", &System::offsets)
      .def_property_readonly("factors", [](const System& self)
                             { return array(self.factors()); })
      .def("begin_step", &System::begin_step)
      .def(
          "unknowns", [](const System& self, Array<double> x)
          { self.unknowns(mutable_view(x)); }, py::arg("x").noconvert())
      .def(
          "take", [](System& self, const Array<double>& x)
          { self.take(view(x)); }, py::arg("x"))
      .def("evaluate", &System::evaluate)
      .def("markers", [](const System& self) { return array(self.markers()); })
      .def("bulk_residual",
           [](System& self)
           {
             const auto b = self.bulk_residual();
             return array(std::vector<double>(b.begin(), b.end()));
           })
      .def(
          "residual", [](System& self, Array<double> b)
          { self.residual(mutable_view(b)); }, py::arg("b").noconvert())
      .def("forces", [](System& self) { return array(self.forces()); });

  py::class_<Iterate>(m, "Iterate", "An accepted iterate")
      .def_readonly("residual", &Iterate::residual)
      .def_readonly("tolerance", &Iterate::tolerance)
      .def_readonly("defect", &Iterate::defect)
      .def_readonly("closed", &Iterate::closed)
      .def_property_readonly("status_changes", [](const Iterate& self)
                             { return self.changes.status; })
      .def_property_readonly("pair_changes", [](const Iterate& self)
                             { return self.changes.pairs; });

  py::class_<Convergence>(m, "Convergence", "When residuals are small")
      .def_property_readonly("extent", [](const Convergence& self)
                             { return self.scales().length; })
      .def(
          "compare",
          [](Convergence& self, const Array<double>& b, double rtol,
             double atol)
          {
            const auto found = self.compare(view(b), rtol, atol);
            return py::make_tuple(found.residual, found.tolerance,
                                  found.defect);
          },
          py::arg("b"), py::arg("rtol"), py::arg("atol"))
      .def("scale", &Convergence::scale);

  py::class_<Loop>(m, "Loop", "Newton's method but for the linear solves")
      .def_property_readonly("active_set", &Loop::active_set,
                             py::return_value_policy::reference_internal)
      .def_property_readonly("free_bodies", &Loop::free_bodies,
                             py::return_value_policy::reference_internal)
      .def_property_readonly("convergence", &Loop::convergence,
                             py::return_value_policy::reference_internal)
      .def_property_readonly("length", &Loop::length,
                             py::return_value_policy::reference_internal)
      .def_property_readonly("iterate", &Loop::iterate,
                             py::return_value_policy::reference_internal)
      .def_property_readonly("version", &Loop::version)
      .def(
          "corrects", [](Loop& self, const Array<double>& dx)
          { return self.corrects(view(dx)); }, py::arg("dx"))
      .def(
          "limit",
          [](Loop& self, const Array<double>& dx,
             const Loop::Correction& correction)
          { return self.limit(view(dx), correction); },
          py::arg("dx"), py::arg("correction") = Loop::Correction())
      .def(
          "size_of", [](const Loop& self, const Array<double>& dx)
          { return self.size_of(view(dx)); }, py::arg("dx"))
      .def("bar_path", &Loop::bar_path)
      .def("changing", &Loop::changing);

  py::class_<ActiveSet>(m, "ActiveSet", "Pairs and status of all contacts")
      .def_property_readonly("cycles", &ActiveSet::cycles);

  py::class_<StepLength>(m, "StepLength", "How much of a step is taken")
      .def("begin", &StepLength::begin, py::arg("size"),
           py::arg("within_cells"))
      .def_property_readonly("has_trial", &StepLength::has_trial)
      .def("judge", &StepLength::judge, py::arg("next_size"))
      .def_property_readonly("part", &StepLength::part)
      .def_property_readonly("limited", &StepLength::limited)
      .def_property_readonly("damped", &StepLength::damped);

  m.def(
      "derivative_error",
      [](System& system, const Array<double>& direction, double size,
         double ahead)
      { return derivative_error(system, view(direction), size, ahead); },
      py::arg("system"), py::arg("direction"), py::arg("size"),
      py::arg("ahead") = 0.0);
  m.def(
      "least_derivative_error",
      [](System& system, const Array<double>& direction, double extent)
      { return least_derivative_error(system, view(direction), extent); },
      py::arg("system"), py::arg("direction"), py::arg("extent"));
}
