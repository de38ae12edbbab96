// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#include "bulk.h"
#include "check.h"
#include "master.h"
#include <contactx/mesh/bodies.h>
#include <contactx/solve/active_set.h>
#include <pybind11/eigen.h>
#include <pybind11/stl.h>
#include <stdexcept>

namespace py = pybind11;
using namespace contactx_bindings;
using namespace contactx::solve;
using contactx::contact::Contact;
using contactx::mesh::Bodies;
using contactx::mesh::NodeMap;

namespace
{
std::vector<double> values_of(const py::object& values)
{
  return copy(values.cast<Array<double>>());
}

py::object or_none(const std::optional<std::vector<double>>& values)
{
  if (not values)
    return py::none();
  return array(*values);
}
} // namespace

void contactx_bindings::bodies(py::module_& m)
{
  py::class_<Bodies, std::shared_ptr<Bodies>>(m, "Bodies",
                                              "Connected parts of a mesh")
      .def(py::init(
               [](const Array<std::int32_t>& cells, std::int32_t num_owned,
                  const Array<std::int64_t>& original,
                  std::shared_ptr<NodeMap> nodes)
               {
                 if (cells.ndim() != 2)
                   throw std::invalid_argument(
                       "cells must have a row for each cell");
                 return std::make_shared<Bodies>(
                     view(cells), static_cast<int>(cells.shape(1)), num_owned,
                     view(original), nodes);
               }),
           py::arg("cells"), py::arg("num_owned"), py::arg("original"),
           py::arg("nodes"))
      .def_property_readonly("names",
                             [](const Bodies& b) { return array(b.names()); })
      .def_property_readonly("of_node",
                             [](const Bodies& b) { return array(b.of_node()); })
      .def_property_readonly("number",
                             [](const Bodies& b) { return array(b.number()); })
      .def_property_readonly("of_cell",
                             [](const Bodies& b) { return array(b.of_cell()); })
      .def(
          "carrying", [](const Bodies& b, const Array<std::int32_t>& nodes)
          { return array(b.carrying(view(nodes))); }, py::arg("nodes"))
      .def(
          "nodes", [](const Bodies& b, std::int64_t body)
          { return array(b.nodes(body)); }, py::arg("body"))
      .def("count", &Bodies::count, py::arg("body"))
      .def(
          "cells", [](const Bodies& b, std::int64_t body)
          { return array(b.cells(body)); }, py::arg("body"))
      .def(
          "boxes_of",
          [](const Bodies& b, const Array<std::int64_t>& bodies,
             const Array<double>& x, int gdim)
          {
            return array(b.boxes(view(bodies), view(x), gdim),
                         {2, bodies.size(), gdim});
          },
          py::arg("bodies"), py::arg("x"), py::arg("gdim"));
  py::class_<Forces>(m, "Forces",
                     "Forces at an iterate, asked for where needed")
      .def(py::init(
               [](py::function residual, py::function of_bulk,
                  py::function scale)
               {
                 return Forces{[residual = std::move(residual)]
                               { return values_of(residual()); },
                               [of_bulk = std::move(of_bulk)]
                               { return values_of(of_bulk()); },
                               [scale = std::move(scale)]
                               { return scale().cast<double>(); }};
               }),
           py::arg("residual"), py::arg("of_bulk"), py::arg("scale"));
  py::class_<FreeBodies, std::shared_ptr<FreeBodies>>(
      m, "FreeBodies", "What keeps bodies without enough supports solvable")
      .def(py::init(
               [](std::shared_ptr<Bodies> bodies, py::object bulk,
                  const std::vector<std::shared_ptr<Contact>>& contacts,
                  const Array<std::int64_t>& original)
               {
                 std::vector<std::shared_ptr<FreeBodyContact>> holdings;
                 for (const auto& contact : contacts)
                   holdings.push_back(free_body_contact(contact));
                 return std::make_shared<FreeBodies>(
                     std::move(bodies),
                     std::make_shared<PythonBulk>(std::move(bulk)),
                     std::move(holdings), view(original));
               }),
           py::arg("bodies"), py::arg("bulk"), py::arg("contacts"),
           py::arg("original"))
      .def("begin_step", &FreeBodies::begin_step)
      .def("reset", &FreeBodies::reset)
      .def("stabilise", &FreeBodies::stabilise, py::arg("forces"))
      .def("drift", [](FreeBodies& self) { return or_none(self.drift()); })
      .def_property_readonly("springs", [](const FreeBodies& self)
                             { return or_none(self.springs()); })
      .def_property_readonly("free_modes", &FreeBodies::free_modes)
      .def_property_readonly("closed_for_balance",
                             &FreeBodies::closed_for_balance)
      .def_property_readonly("is_unbalanced", &FreeBodies::is_unbalanced);
}
