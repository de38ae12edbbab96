// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#include "master.h"
#include "parallel.h"
#include <contactx/condense/condensation.h>
#include <contactx/condense/multigrid.h>
#include <optional>
#include <pybind11/stl.h>

namespace py = pybind11;
using namespace contactx_bindings;
using namespace contactx::condense;
using contactx::parallel::NodeMap;

namespace
{
/// Arrays of Python with what looks at them
struct HeldNodes
{
  Array<std::int32_t> slaves;
  Array<std::int8_t> status;
  Array<double> area, normal, by_multiplier;
  Nodes nodes;
};

std::vector<Nodes> nodes_of(const std::vector<const HeldNodes*>& contacts)
{
  std::vector<Nodes> nodes;
  for (const HeldNodes* held : contacts)
    nodes.push_back(held->nodes);
  return nodes;
}

template <class T>
py::array_t<T> all_of(const std::vector<T>& values, py::handle owner)
{
  return looking(values, {static_cast<py::ssize_t>(values.size())}, owner);
}

/// Adds a property: an array that looks at values of the object
template <class Class, class F>
void add_array(Class& c, const char* name, F of)
{
  c.def_property_readonly(
      name, [of](py::object self)
      { return all_of(of(self.cast<const typename Class::type&>()), self); });
}
} // namespace

void contactx_bindings::condense(py::module_& m)
{
  py::register_exception<NotCondensable>(m, "NotCondensable");

  py::class_<Triplets> triplets(m, "Triplets", "Entries of a sparse matrix");
  add_array(triplets, "rows",
            [](const Triplets& t) -> auto& { return t.rows; });
  add_array(triplets, "columns",
            [](const Triplets& t) -> auto& { return t.columns; });
  add_array(triplets, "values",
            [](const Triplets& t) -> auto& { return t.values; });
  triplets.def("__len__", &Triplets::size);

  py::class_<HeldNodes>(m, "ContactNodes",
                        "What elimination reads of a contact's slave nodes")
      .def(py::init(
               [](Array<std::int32_t> slaves, int size,
                  Array<std::int8_t> status, Array<double> area,
                  Array<double> normal, Array<double> by_multiplier,
                  double softness)
               {
                 const Nodes nodes{view(slaves), size,
                                   view(status), view(area),
                                   view(normal), view(by_multiplier),
                                   softness};
                 return HeldNodes{std::move(slaves),        std::move(status),
                                  std::move(area),          std::move(normal),
                                  std::move(by_multiplier), nodes};
               }),
           py::arg("slaves"), py::arg("size"), py::arg("status"),
           py::arg("area"), py::arg("normal"), py::arg("by_multiplier"),
           py::arg("softness"));

  m.def(
      "slave_marks",
      [](const NodeMap& nodes, const std::vector<const HeldNodes*>& contacts)
      {
        return array(slave_marks(nodes, nodes_of(contacts)),
                     {static_cast<py::ssize_t>(nodes.num_nodes()),
                      static_cast<py::ssize_t>(contacts.size())});
      },
      py::arg("nodes"), py::arg("contacts"),
      "Which of all nodes are slave in each contact; all ranks take part");

  py::class_<Condensation> condensation(
      m, "Condensation", "The contacts of a rank, multipliers eliminated");
  condensation
      .def(py::init(
               [](const Array<std::int32_t>& offsets,
                  const Array<std::int32_t>& columns,
                  const Array<double>& values,
                  const std::vector<const HeldNodes*>& contacts,
                  const Array<std::int8_t>& is_slave,
                  const Array<std::int8_t>& free, int gdim)
               {
                 return Condensation(
                     {view(offsets), view(columns), view(values)},
                     nodes_of(contacts), view(is_slave), view(free), gdim);
               }),
           py::arg("offsets"), py::arg("columns"), py::arg("values"),
           py::arg("contacts"), py::arg("is_slave"), py::arg("free"),
           py::arg("gdim"))
      .def_property_readonly("is_exact", &Condensation::is_exact)
      .def_property_readonly("is_soft", &Condensation::is_soft)
      .def_property_readonly("stiffness", &Condensation::stiffness)
      .def_property_readonly("left", [](const Condensation& c) -> auto&
                             { return c.elimination().left(); })
      .def_property_readonly("right", [](const Condensation& c) -> auto&
                             { return c.elimination().right(); })
      .def_property_readonly("law", [](const Condensation& c) -> auto&
                             { return c.elimination().law(); })
      .def("right_hand_side",
           [](const Condensation& c, const Array<double>& d)
           {
             const auto result = c.right_hand_side(view(d));
             return py::make_tuple(array(result.forces), array(result.shift),
                                   array(result.extra),
                                   array(result.multipliers));
           })
      .def(
          "recover",
          [](const Condensation& c, const Array<double>& d,
             const Array<double>& defect, const Array<double>& u,
             Array<double> multipliers)
          {
            c.recover(view(d), view(defect), view(u),
                      mutable_view(multipliers));
          },
          py::arg("d"), py::arg("defect"), py::arg("u"),
          py::arg("multipliers").noconvert())
      .def("check_chains", [](const Condensation& c, const NodeMap& nodes)
           { check_chains(c.elimination(), nodes); })
      .def("is_symmetric", [](const Condensation& c, const NodeMap& nodes)
           { return is_symmetric(c.elimination(), nodes); })
      .def("bound", [](const Condensation& c, const NodeMap& nodes,
                       const Array<double>& diagonal)
           { return array(bound(c.elimination(), nodes, view(diagonal))); })
      .def(
          "elastic",
          [](const Condensation& c, const NodeMap& nodes,
             const std::optional<Array<double>>& diagonal)
          {
            return elastic(
                c.elimination(), nodes, c.is_soft() ? c.springs() : Triplets(),
                diagonal ? view(*diagonal) : std::span<const double>());
          },
          py::arg("nodes"), py::arg("diagonal").none(true));
  add_array(condensation, "eliminated", [](const Condensation& c) -> auto&
            { return c.elimination().eliminated(); });
  add_array(condensation, "slave_dofs", [](const Condensation& c) -> auto&
            { return c.elimination().slave_dofs(); });
}
