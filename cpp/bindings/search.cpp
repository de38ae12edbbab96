// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#include "bindings.h"
#include <contactx/search/foot.h>
#include <contactx/search/pairing.h>
#include <pybind11/stl.h>

namespace py = pybind11;
using namespace contactx_bindings;
using contactx::search::Pairing;

void contactx_bindings::search(py::module_& m)
{
  m.attr("margin") = contactx::search::margin;
  py::class_<Pairing>(m, "Pairing",
                      "Pairs of slave nodes and master facets, kept from one "
                      "search to the next")
      .def(py::init(
               [](const Array<std::int32_t>& slave_offsets,
                  const Array<std::int32_t>& slave_nodes,
                  const Array<std::int32_t>& master_offsets,
                  const Array<std::int32_t>& master_nodes, int gdim)
               {
                 return Pairing(copy(slave_offsets), copy(slave_nodes),
                                copy(master_offsets), copy(master_nodes), gdim);
               }),
           py::arg("slave_offsets"), py::arg("slave_nodes"),
           py::arg("master_offsets"), py::arg("master_nodes"), py::arg("gdim"))
      .def("begin_step", &Pairing::begin_step,
           "Forget what was learnt in the last step")
      .def(
          "restore",
          [](Pairing& self, const Array<std::int32_t>& facet,
             const Array<std::int32_t>& feature, const Array<double>& xi,
             const Array<double>& cone, const Array<double>& normal)
          {
            self.restore(view(facet), view(feature), view(xi), view(cone),
                         view(normal));
          },
          py::arg("facet"), py::arg("feature"), py::arg("xi"), py::arg("cone"),
          py::arg("normal"), "Take over the pairs of another pairing")
      .def(
          "update",
          [](Pairing& self, const Array<double>& x, double reach,
             const Array<std::int8_t>& closed)
          { return self.update(view(x), reach, view(closed)); },
          py::arg("x"), py::arg("reach"), py::arg("closed"),
          "Search; returns how many closed nodes changed their facet")
      .def_property_readonly("slaves", [](const Pairing& self)
                             { return array(self.slaves()); })
      .def_property_readonly("facet", [](const Pairing& self)
                             { return array(self.facet()); })
      .def_property_readonly("feature", [](const Pairing& self)
                             { return array(self.feature()); })
      .def_property_readonly(
          "xi", [](const Pairing& self)
          { return array(self.xi(), {py::ssize_t(self.xi().size() / 2), 2}); })
      .def_property_readonly("cone",
                             [](const Pairing& self)
                             {
                               const auto& c = self.cone();
                               return array(c, {py::ssize_t(c.size() / 3), 3});
                             })
      .def_property_readonly("normal",
                             [](const Pairing& self)
                             {
                               const auto& n = self.normal();
                               return array(n, {py::ssize_t(n.size() / 3), 3});
                             })
      .def(
          "frozen", [](const Pairing& self) { return array(self.frozen()); },
          "Slave nodes whose pair is frozen, by their place in slaves")
      .def(
          "natural_gaps",
          [](Pairing& self, const Array<double>& x, double reach,
             const Array<std::int32_t>& which)
          { return array(self.natural_gaps(view(x), reach, view(which))); },
          py::arg("x"), py::arg("reach"), py::arg("which"),
          "Gaps that a search without memory finds")
      .def(
          "distance", [](Pairing& self, const Array<double>& x)
          { return self.distance(view(x)); }, py::arg("x"),
          "Distance from the nearest slave node to the master surface")
      .def(
          "feet",
          [](const Pairing& self, const Array<double>& x,
             const Array<double>& points)
          {
            const auto n = py::ssize_t(self.facet().size());
            if (points.size() != n * self.master().gdim())
              throw std::invalid_argument("points must be one a slave node");
            const auto feet = contactx::search::feet(
                self.master(), self.facet(), view(x), view(points), self.xi());
            return py::make_tuple(array(feet.xi, {n, 2}), array(feet.gap));
          },
          py::arg("x"), py::arg("points"),
          "Local coordinates and gaps of points, one a slave node, over the "
          "slave nodes' facets")
      .def(
          "places",
          [](const Pairing& self, const Array<double>& x,
             const Array<double>& xi)
          {
            const auto n = py::ssize_t(self.facet().size());
            if (xi.size() != 2 * n)
              throw std::invalid_argument("xi must be one a slave node");
            const py::ssize_t gdim = self.master().gdim();
            const auto at = contactx::search::places(
                self.master(), self.facet(), view(x), view(xi));
            return py::make_tuple(array(at.x, {n, gdim}),
                                  array(at.normal, {n, gdim}));
          },
          py::arg("x"), py::arg("xi"),
          "Points at local coordinates of the slave nodes' facets, and unit "
          "normals there");
}
