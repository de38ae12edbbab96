// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#include "master.h"
#include <contactx/law/node_state.h>
#include <contactx/law/slip_history.h>

namespace py = pybind11;
using namespace contactx_bindings;
using contactx::law::NodeState;
using contactx::law::SlipHistory;

namespace
{
using Class = py::class_<NodeState, std::shared_ptr<NodeState>>;

/// Shape of so many values, rows of which have a shape
std::vector<py::ssize_t> shape_of(std::size_t count,
                                  std::vector<py::ssize_t> row)
{
  py::ssize_t width = 1;
  for (py::ssize_t w : row)
    width *= w;
  row.insert(row.begin(), static_cast<py::ssize_t>(count) / width);
  return row;
}

/// Attribute that looks at an array of the state, which may be written to.
template <class T, class Row>
void add(Class& c, const char* name, std::vector<T> NodeState::* values,
         Row row)
{
  c.def_property_readonly(name,
                          [values, row](py::object self)
                          {
                            auto& nodes = self.cast<NodeState&>();
                            std::vector<T>& v = nodes.*values;
                            return py::array_t<T>(
                                shape_of(v.size(), row(nodes)), v.data(), self);
                          });
}

/// Attribute of truth values, likewise.
void add_flags(Class& c, const char* name,
               std::vector<std::int8_t> NodeState::* values)
{
  c.def_property_readonly(
      name,
      [values](py::object self)
      {
        std::vector<std::int8_t>& v = self.cast<NodeState&>().*values;
        return py::array(py::dtype::of<bool>(),
                         {static_cast<py::ssize_t>(v.size())}, v.data(), self);
      });
}

/// What a function says of each node.
template <class T, class F>
py::array_t<T> each(const NodeState& nodes, F&& function)
{
  py::array_t<T> result(static_cast<py::ssize_t>(nodes.num_nodes()));
  T* values = result.mutable_data();
  for (std::int32_t i = 0; i < nodes.num_nodes(); ++i)
    values[i] = function(static_cast<std::size_t>(i));
  return result;
}
} // namespace

void contactx_bindings::node_state(py::module_& m)
{
  using Shape = std::vector<py::ssize_t>;
  const auto nodal = [](const NodeState&) { return Shape{}; };
  const auto vectors = [](const NodeState& n) { return Shape{n.gdim()}; };
  const auto matrices
      = [](const NodeState& n) { return Shape{n.size(), n.size()}; };

  Class c(m, "NodeState", "State of the slave nodes of one contact");
  c.def_property_readonly("size", &NodeState::size);
  add(c, "multiplier", &NodeState::multiplier, nodal);
  add(c, "area", &NodeState::area, nodal);
  add(c, "status", &NodeState::status, nodal);
  add(c, "gap", &NodeState::gap, nodal);
  add(c, "normal", &NodeState::normal, vectors);
  add(c, "slip", &NodeState::slip, vectors);
  add(c, "c", &NodeState::c, nodal);
  add_flags(c, "immobile", &NodeState::immobile);
  add(c, "mobile", &NodeState::mobile, vectors);
  add_flags(c, "redundant", &NodeState::redundant);
  add_flags(c, "frictionless", &NodeState::frictionless);
  add(c, "value", &NodeState::value, nodal);
  add(c, "by_multiplier", &NodeState::by_multiplier, matrices);
  add(c, "by_gap", &NodeState::by_gap, nodal);
  add(c, "by_slip", &NodeState::by_slip, nodal);
  add(c, "by_normal", &NodeState::by_normal, nodal);

  c.def_property_readonly("closed",
                          [](const NodeState& nodes)
                          {
                            return each<bool>(nodes, [&](std::size_t i)
                                              { return nodes.closed(i); });
                          });
  c.def_property_readonly("pressure",
                          [](py::object self) -> py::object
                          {
                            const auto& nodes = self.cast<const NodeState&>();
                            if (not nodes.is_vector())
                              return self.attr("multiplier");
                            return each<double>(nodes, [&](std::size_t i)
                                                { return nodes.pressure(i); });
                          });
  c.def(
      "close",
      [](NodeState& nodes,
         const py::array_t<std::int32_t,
                           py::array::c_style | py::array::forcecast>& which)
      { nodes.close({which.data(), static_cast<std::size_t>(which.size())}); },
      py::arg("which"));
  c.def(
      "project", [](NodeState& nodes, const Array<double>& origin)
      { nodes.project(view(origin)); }, py::arg("origin"));

  py::class_<SlipHistory, std::shared_ptr<SlipHistory>>(
      m, "SlipHistory", "What the accepted steps have slipped")
      .def_property_readonly(
          "slip",
          [](const SlipHistory& self)
          {
            return array(
                self.slip(),
                {static_cast<py::ssize_t>(self.total().size()), self.gdim()});
          })
      .def_property_readonly("total", [](const SlipHistory& self)
                             { return array(self.total()); })
      .def_property_readonly("dissipation", [](const SlipHistory& self)
                             { return array(self.dissipation()); })
      .def("add", &SlipHistory::add, py::arg("nodes"))
      .def(
          "restore",
          [](SlipHistory& self, const Array<double>& slip,
             const Array<double>& total, const Array<double>& dissipation)
          { self.restore(copy(slip), copy(total), copy(dissipation)); },
          py::arg("slip"), py::arg("total"), py::arg("dissipation"));
}
