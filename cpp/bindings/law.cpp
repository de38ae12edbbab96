// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#include "master.h"
#include <contactx/law/law.h>
#include <memory>
#include <pybind11/stl.h>

namespace py = pybind11;
using namespace contactx_bindings;
using namespace contactx::law;
using contactx::law::NodeState;

BoundFunction contactx_bindings::bound_of(const py::function& bound)
{
  return [bound](std::span<const double> p, std::span<const double> slip)
  {
    const auto given = [](std::span<const double> values)
    {
      return py::array_t<double>(static_cast<py::ssize_t>(values.size()),
                                 values.data());
    };
    const auto found
        = bound(given(p), given(slip)).cast<std::array<Array<double>, 3>>();
    return Bounds{copy(found[0]), copy(found[1]), copy(found[2])};
  };
}

void contactx_bindings::law(py::module_& m)
{
  m.attr("OPEN") = static_cast<int>(contactx::law::open);
  m.attr("STICK") = static_cast<int>(contactx::law::stick);
  m.attr("SLIP") = static_cast<int>(contactx::law::slip);
  py::class_<Law, std::shared_ptr<Law>>(m, "Law",
                                        "Complementarity of the slave nodes")
      .def_property_readonly("name", &Law::name)
      .def_property_readonly("is_vector", &Law::is_vector)
      .def_property_readonly("is_tied", &Law::is_tied)
      .def("begin_step", &Law::begin_step)
      .def("evaluate", &Law::evaluate, py::arg("state"));
  py::class_<Frictionless, Law, std::shared_ptr<Frictionless>>(
      m, "Frictionless", "Unilateral contact")
      .def(py::init());
  py::class_<Coulomb, Law, std::shared_ptr<Coulomb>>(
      m, "Coulomb", "Unilateral contact with dry friction")
      .def(
          "set_friction", [](Coulomb& self, const Array<double>& friction)
          { self.set_friction(view(friction)); }, py::arg("friction"))
      .def(
          "friction", [](const Coulomb& self, const NodeState& state)
          { return array(self.friction(state)); }, py::arg("state"));
  py::class_<Tied, Law, std::shared_ptr<Tied>>(
      m, "Tied", "Slave nodes keep their place on the master");
}
