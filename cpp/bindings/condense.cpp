// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#include "master.h"
#include "parallel.h"
#include <contactx/condense/condensation.h>
#include <contactx/condense/coupled_rows.h>
#include <contactx/condense/master_springs.h>
#include <contactx/condense/multigrid.h>
#include <contactx/condense/stiff_bodies.h>
#include <optional>
#include <pybind11/stl.h>

namespace py = pybind11;
using namespace contactx;
using namespace contactx_bindings;
using namespace contactx::condense;
using contactx::mesh::NodeMap;

namespace
{
std::vector<Nodes> nodes_of_all(const ContactBlock::Contacts& contacts)
{
  std::vector<Nodes> nodes;
  for (const auto& contact : contacts)
    nodes.push_back(nodes_of(*contact));
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

  py::class_<ContactBlock>(m, "ContactBlock",
                           "Contacts' part of a Jacobian on one rank")
      .def(py::init(
               [](const ContactBlock::Contacts& contacts,
                  const std::optional<Array<std::int8_t>>& prescribed,
                  bool keeps_zeros, const std::optional<Array<double>>& d)
               {
                 return ContactBlock(
                     contacts,
                     prescribed ? view(*prescribed)
                                : std::span<const std::int8_t>(),
                     keeps_zeros, d ? view(*d) : std::span<const double>());
               }),
           py::arg("contacts"), py::arg("prescribed") = py::none(),
           py::kw_only(), py::arg("keeps_zeros") = false,
           py::arg("d") = py::none())
      .def(
          "multiply", [](const ContactBlock& self, const Array<double>& x)
          { return array(self.multiply(view(x))); }, py::arg("x"));

  m.def(
      "coupled_rows",
      [](const Array<std::int64_t>& offsets, const Array<std::int64_t>& columns,
         const Array<double>& values, const ContactBlock& contact,
         const Array<std::int64_t>& places, std::size_t num_owned,
         std::size_t num_local)
      {
        const auto rows_of = [](const Rows& rows)
        {
          return py::make_tuple(array(rows.offsets), array(rows.columns),
                                array(rows.values));
        };
        const CoupledRows found
            = coupled(view(offsets), view(columns), view(values), contact,
                      view(places), num_owned, num_local);
        return py::make_tuple(rows_of(found.own), array(found.others),
                              rows_of(found.added));
      },
      py::arg("offsets"), py::arg("columns"), py::arg("values"),
      py::arg("contact"), py::arg("places"), py::arg("num_owned"),
      py::arg("num_local"),
      "Rows of the coupled system, and what is added to those of other ranks");
  py::class_<Condensation> condensation(
      m, "Condensation", "The contacts of a rank, multipliers eliminated");
  condensation
      .def(py::init(
               [](const ContactBlock& contact,
                  const ContactBlock::Contacts& contacts,
                  const Array<std::int8_t>& free, int gdim, bool holds)
               {
                 return Condensation(contact.entries(), nodes_of_all(contacts),
                                     view(free), gdim, holds);
               }),
           py::arg("contact"), py::arg("contacts"), py::arg("free"),
           py::arg("gdim"), py::kw_only(), py::arg("holds") = false)
      .def_property_readonly("is_soft", &Condensation::is_soft)
      .def_property_readonly("stiffness", &Condensation::stiffness)
      .def_property_readonly("traction", &Condensation::traction)
      .def_property_readonly("left", [](const Condensation& c) -> auto&
                             { return c.elimination().left(); })
      .def_property_readonly("rows", [](const Condensation& c) -> auto&
                             { return c.elimination().rows(); })
      .def_property_readonly("right", [](const Condensation& c) -> auto&
                             { return c.elimination().right(); })
      .def_property_readonly("law", [](const Condensation& c) -> auto&
                             { return c.elimination().law(); })
      .def("right_hand_side",
           [](const Condensation& c, const Array<double>& d)
           {
             const auto result = c.right_hand_side(view(d));
             return py::make_tuple(
                 array(result.forces), array(result.shift), array(result.extra),
                 array(result.multipliers), array(result.retained));
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
      .def(
          "dependent_constraints",
          [](const Condensation& c, const NodeMap& nodes)
          {
            DependentConstraints found
                = dependent_constraints(c.elimination(), nodes);
            return py::make_tuple(std::move(found.right),
                                  std::move(found.left));
          },
          "Entries by which eliminations need one another, of right and left")
      .def_property_readonly(
          "retained",
          [](const Condensation& c)
          {
            const RetainedMultipliers& retained = c.retained();
            return py::make_tuple(array(retained.dofs),
                                  array(retained.multipliers),
                                  array(retained.scale));
          },
          "Places of retained multipliers, their numbers, and their scale")
      .def(
          "stiff_bodies",
          [](const Condensation& c, const contactx::mesh::Bodies& bodies,
             const Array<double>& diagonal)
          { return array(stiff_bodies(c, bodies, view(diagonal))); },
          py::arg("bodies"), py::arg("diagonal"))
      .def(
          "master_springs",
          [](const Condensation& c, const Array<double>& stiffness)
          { return array(master_springs(c, view(stiffness))); },
          py::arg("stiffness"))
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
  add_array(condensation, "recovered", [](const Condensation& c) -> auto&
            { return c.elimination().recovered(); });
  add_array(condensation, "slave_dofs", [](const Condensation& c) -> auto&
            { return c.elimination().slave_dofs(); });
}
