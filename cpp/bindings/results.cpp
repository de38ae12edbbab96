// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#include "bindings.h"
#include <contactx/results/results.h>
#include <contactx/results/wetted.h>
#include <pybind11/stl.h>

namespace py = pybind11;
using namespace contactx_bindings;
using contactx::Vector;
using contactx::contact::Contact;
using contactx::geometry::FacetList;
using contactx::mesh::Halo;
using contactx::results::Results;
using contactx::results::Totals;

namespace
{
/// Vectors of the slave nodes (n, gdim).
py::array_t<double> vectors(const Results& self,
                            const std::vector<double>& values)
{
  return array(values, {std::ssize(self.gap()), self.gdim()});
}

/// Moments: the last component in 2D, else all.
py::array_t<double> moments(const Results& self, const Vector<3>& m)
{
  const bool is_plane = self.gdim() == 2;
  return py::array_t<double>(is_plane ? 1 : 3, m.data() + (is_plane ? 2 : 0));
}

/// Facets in compressed form.
FacetList facets(const Array<std::int32_t>& offsets,
                 const Array<std::int32_t>& nodes)
{
  return {view(offsets), view(nodes)};
}

/// The gdim components of a vector.
py::array_t<double> components(const Results& self, const Vector<3>& v)
{
  return py::array_t<double>(self.gdim(), v.data());
}
} // namespace

void contactx_bindings::results(py::module_& m)
{
  py::class_<Totals>(m, "Totals", "Sums and extremes over all ranks")
      .def_readonly("closed", &Totals::closed)
      .def_readonly("slipping", &Totals::slipping)
      .def_readonly("area", &Totals::area)
      .def_readonly("largest_pressure", &Totals::largest_pressure)
      .def_readonly("smallest_gap", &Totals::smallest_gap)
      .def_readonly("dissipation", &Totals::dissipation);
  py::class_<Results, std::shared_ptr<Results>>(
      m, "Results", "Results of a contact at its slave nodes")
      .def(py::init<std::shared_ptr<Contact>>(), py::arg("contact"))
      .def("update", &Results::update)
      .def_property_readonly("pressure", [](const Results& self)
                             { return array(self.pressure()); })
      .def_property_readonly("traction", [](const Results& self)
                             { return vectors(self, self.traction()); })
      .def_property_readonly("master_pressure", [](const Results& self)
                             { return array(self.master_pressure()); })
      .def_property_readonly("gap", [](const Results& self)
                             { return array(self.gap()); })
      .def_property_readonly("status", [](const Results& self)
                             { return array(self.status()); })
      .def_property_readonly("slip", [](const Results& self)
                             { return vectors(self, self.slip()); })
      .def_property_readonly("slip_total", [](const Results& self)
                             { return array(self.slip_total()); })
      .def_property_readonly("force", [](const Results& self)
                             { return components(self, self.force()); })
      .def_property_readonly("imbalance", [](const Results& self)
                             { return components(self, self.imbalance()); })
      .def_property_readonly("recovery_change", &Results::recovery_change)
      .def_property_readonly("is_axisymmetric", &Results::is_axisymmetric)
      .def(
          "moment", [](const Results& self, const Array<double>& point)
          { return moments(self, self.moment(view(point))); }, py::arg("point"))
      .def(
          "moment_of",
          [](const Results& self, const Array<double>& point,
             const Array<double>& shares)
          { return moments(self, self.moment(view(point), view(shares))); },
          py::arg("point"), py::arg("shares"))
      .def(
          "force_of", [](const Results& self, const Array<double>& shares)
          { return components(self, self.force(view(shares))); },
          py::arg("shares"))
      .def("totals", [](const Results& self) { return self.totals(); })
      .def(
          "totals_of", [](const Results& self, const Array<double>& shares)
          { return self.totals(view(shares)); }, py::arg("shares"))
      .def(
          "shares",
          [](const Results& self, const Array<std::int32_t>& part_offsets,
             const Array<std::int32_t>& part_nodes,
             const Array<std::int32_t>& offsets,
             const Array<std::int32_t>& nodes)
          {
            return array(self.shares(facets(part_offsets, part_nodes),
                                     facets(offsets, nodes)));
          },
          py::arg("part_offsets"), py::arg("part_nodes"), py::arg("offsets"),
          py::arg("nodes"))
      .def("recovered_pressure",
           [](const Results& self) { return array(self.recovered_pressure()); })
      .def(
          "on_both",
          [](const Results& self, const Array<double>& values, double missing)
          { return array(self.on_both(view(values), missing)); },
          py::arg("values"), py::arg("missing"))
      .def(
          "across", [](const Results& self, const Array<double>& field)
          { return array(self.across(view(field))); }, py::arg("field"));
  m.def(
      "wetted_nodes",
      [](const std::shared_ptr<Halo>& halo, const Array<std::int32_t>& offsets,
         const Array<std::int32_t>& nodes, const Array<std::int8_t>& is_entry,
         const std::vector<std::shared_ptr<Contact>>& contacts)
      {
        const std::vector<std::shared_ptr<const Contact>> all(contacts.begin(),
                                                              contacts.end());
        return array(contactx::results::wetted_nodes(
            halo, {view(offsets), view(nodes)}, view(is_entry), all));
      },
      py::arg("halo"), py::arg("offsets"), py::arg("nodes"),
      py::arg("is_entry"), py::arg("contacts"),
      "Nodes that a fluid wets, up to closed contacts");
}
