// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#include "master.h"
#include <contactx/law/node_state.h>
#include <contactx/law/slip_history.h>

namespace py = pybind11;
using namespace contactx_bindings;
using contactx::law::NodeState;
using contactx::law::SlipHistory;
using contactx::mesh::NodeMap;

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
  c.def(py::init<std::int32_t, int, bool, bool>(), py::arg("num_nodes"),
        py::arg("gdim"), py::arg("is_vector"), py::arg("has_means") = false);
  c.def_property_readonly("size", &NodeState::size);
  c.def_readwrite("layer_compliance", &NodeState::layer_compliance);
  c.def_readwrite("tangential_ratio", &NodeState::tangential_ratio);
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
  add(c, "slip_reversals", &NodeState::slip_reversals, nodal);
  add(c, "slip_closings", &NodeState::slip_closings, nodal);
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
  c.def_property_readonly("closable_gap",
                          [](const NodeState& nodes)
                          {
                            return each<double>(
                                nodes, [&](std::size_t i)
                                { return nodes.closable_gap(i); });
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
      "closing",
      [](const NodeState& nodes, double tie)
      {
        return each<bool>(nodes,
                          [&](std::size_t i) { return nodes.closing(i, tie); });
      },
      py::arg("tie") = -1.0);
  c.def(
      "set_factor",
      [](NodeState& nodes, const Array<double>& compliance, const NodeMap& map)
      { nodes.set_factor(map.ranks(), view(compliance)); },
      py::arg("compliance"), py::arg("nodes"));
  c.def(
      "close",
      [](NodeState& nodes,
         const py::array_t<std::int32_t,
                           py::array::c_style | py::array::forcecast>& which)
      { nodes.close({which.data(), static_cast<std::size_t>(which.size())}); },
      py::arg("which"));
  c.def("drop_open", &NodeState::drop_open);
  c.def("normalise", &NodeState::normalise);
  c.def(
      "project", [](NodeState& nodes, const Array<double>& origin)
      { nodes.project(view(origin)); }, py::arg("origin"));

  py::class_<SlipHistory, std::shared_ptr<SlipHistory>>(
      m, "SlipHistory", "What the accepted steps have slipped")
      .def(py::init<std::int32_t, int>(), py::arg("num_nodes"), py::arg("gdim"))
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

  m.def(
      "touching_gap",
      [](const NodeMap& nodes, const Array<double>& x)
      {
        const int gdim = x.ndim() == 2 ? static_cast<int>(x.shape(1)) : 0;
        return contactx::law::touching_gap(nodes.ranks(), view(x), gdim);
      },
      py::arg("nodes"), py::arg("x"),
      "Gap up to which nodes touch but for rounding");
}
