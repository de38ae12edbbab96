// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#include "bindings.h"
#include "check.h"
#include <contactx/search/pairing.h>
#include <contactx/search/projections.h>
#include <limits>
#include <pybind11/stl.h>

namespace py = pybind11;
using namespace contactx_bindings;
using contactx::search::Finder;
using contactx::search::FoundNearest;
using contactx::search::Pairing;
using contactx::search::Projection;

namespace
{
contactx::Vector<3> row(std::span<const double> values, std::size_t i,
                        int width)
{
  contactx::Vector<3> v{};
  std::copy_n(values.begin() + i * width, width, v.begin());
  return v;
}

py::dict find(const Finder& self, std::span<const double> x,
              std::span<const double> points, std::span<const double> normals,
              std::span<const double> reach)
{
  const int gdim = self.surface().gdim();
  const std::size_t n = reach.size();
  check::rows(std::ssize(points), n, gdim, "points", "reach");
  check::rows(std::ssize(normals), n, gdim, "normals", "reach");
  const FoundNearest found = self.find(x, points, normals, reach);
  const auto rows = static_cast<py::ssize_t>(n);
  return py::dict(py::arg("distance") = array(found.distance),
                  py::arg("nearest") = array(found.nearest),
                  py::arg("size") = array(found.size),
                  py::arg("facet") = array(found.facet),
                  py::arg("feature") = array(found.feature),
                  py::arg("gap") = array(found.gap),
                  py::arg("xi") = array(found.xi, {rows, 2}),
                  py::arg("normal") = array(found.normal, {rows, 3}));
}

/// Positions, and what they are used with: pairs of a list of facets that was
/// exchanged for a shorter one must be restored first.
void check_pairs(const Pairing& self, const Array<double>& x)
{
  check::positions(x.size(), self.num_nodes(), self.master().gdim());
  check::numbers(self.facet(), self.master().facets().size(), "facet",
                 "master facets", -1);
}

/// As `check_pairs`, with a flag for each slave node.
void check_pairs(const Pairing& self, const Array<double>& x,
                 const Array<std::int8_t>& closed)
{
  check_pairs(self, x);
  check::rows(closed.size(), std::ssize(self.slaves()), 1, "closed",
              "slave node");
}

/// Facets and features of theirs, -1 for no facet.
void check_features(const Pairing& self, std::span<const std::int32_t> facet,
                    std::span<const std::int32_t> feature)
{
  const auto facets = self.master().facets();
  check::numbers(facet, facets.size(), "facet", "master facets", -1);
  for (std::size_t k = 0; k < facet.size(); ++k)
    if (facet[k] >= 0)
      check::between(feature[k], 0,
                     (self.master().gdim() - 1)
                         * static_cast<int>(facets[facet[k]].size()),
                     "feature");
}

std::int32_t accept_projections(Pairing& self,
                                std::span<const std::int32_t> which,
                                std::span<const std::int32_t> facet,
                                std::span<const std::int32_t> feature,
                                std::span<const double> xi,
                                std::span<const double> normal,
                                std::span<const double> x, double reach,
                                std::span<const std::int8_t> closed)
{
  const std::size_t n = which.size();
  const char* slave = "slave node of which";
  check::numbers(which, std::ssize(self.slaves()), "which", "slave nodes");
  check::rows(std::ssize(facet), n, 1, "facet", slave);
  check::rows(std::ssize(feature), n, 1, "feature", slave);
  check::rows(std::ssize(xi), n, 2, "xi", slave);
  check::rows(std::ssize(normal), n, 3, "normal", slave);
  check_features(self, facet, feature);
  std::int32_t changed = 0;
  for (std::size_t k = 0; k < n; ++k)
  {
    std::optional<Projection> found;
    if (facet[k] >= 0)
      found = Projection{facet[k],
                         feature[k],
                         {xi[2 * k], xi[2 * k + 1]},
                         {},
                         row(normal, k, 3),
                         0,
                         0,
                         0};
    changed
        += self.accept_projection(which[k], found, x, reach, closed[which[k]]);
  }
  return changed;
}
} // namespace

void contactx_bindings::search(py::module_& m)
{
  m.attr("margin") = contactx::geometry::facet_margin;
  py::class_<Finder>(m, "Finder",
                     "Finds the place of a master surface that points are in "
                     "contact with")
      .def(py::init(
               [](const Array<std::int32_t>& offsets,
                  const Array<std::int32_t>& nodes, int gdim)
               {
                 check::facets(view(offsets), view(nodes), gdim);
                 return Finder(copy(offsets), copy(nodes), gdim);
               }),
           py::arg("offsets"), py::arg("nodes"), py::arg("gdim"))
      .def(
          "find",
          [](Finder& self, const Array<double>& x, const Array<double>& points,
             const Array<double>& normals, const Array<double>& reach)
          {
            check::positions(x.size(), self.surface().num_nodes(),
                             self.surface().gdim());
            self.refit(view(x));
            return find(self, view(x), view(points), view(normals),
                        view(reach));
          },
          py::arg("x"), py::arg("points"), py::arg("normals"), py::arg("reach"),
          "Nearest facets that face points, and the projections that contact "
          "is measured with");
  py::class_<Pairing>(m, "Pairing",
                      "Pairs of slave nodes and master facets, kept from one "
                      "search to the next")
      .def(py::init(
               [](const Array<std::int32_t>& slave_offsets,
                  const Array<std::int32_t>& slave_nodes,
                  const Array<std::int32_t>& master_offsets,
                  const Array<std::int32_t>& master_nodes, int gdim,
                  std::int32_t num_owned)
               {
                 check::facets(view(slave_offsets), view(slave_nodes), gdim,
                               "slave_");
                 check::facets(view(master_offsets), view(master_nodes), gdim,
                               "master_");
                 return Pairing(copy(slave_offsets), copy(slave_nodes),
                                copy(master_offsets), copy(master_nodes), gdim,
                                num_owned);
               }),
           py::arg("slave_offsets"), py::arg("slave_nodes"),
           py::arg("master_offsets"), py::arg("master_nodes"), py::arg("gdim"),
           py::arg("num_owned") = std::numeric_limits<std::int32_t>::max())
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
          {
            check_pairs(self, x, closed);
            return self.update(view(x), reach, view(closed));
          },
          py::arg("x"), py::arg("reach"), py::arg("closed"),
          "Search; returns how many closed nodes changed their facet")
      .def(
          "set_master",
          [](Pairing& self, const Array<std::int32_t>& offsets,
             const Array<std::int32_t>& nodes)
          {
            check::facets(view(offsets), view(nodes), self.master().gdim());
            self.set_master(copy(offsets), copy(nodes));
          },
          py::arg("offsets"), py::arg("nodes"),
          "Take another list of master facets")
      .def(
          "seek",
          [](Pairing& self, const Array<double>& x, double reach)
          {
            check_pairs(self, x);
            return array(self.seek(view(x), reach));
          },
          py::arg("x"), py::arg("reach"),
          "Slave nodes that do not keep their facet")
      .def(
          "settle",
          [](Pairing& self, const Array<std::int32_t>& which,
             const Array<std::int32_t>& facet,
             const Array<std::int32_t>& feature, const Array<double>& xi,
             const Array<double>& normal, const Array<double>& x, double reach,
             const Array<std::int8_t>& closed)
          {
            check_pairs(self, x, closed);
            return accept_projections(self, view(which), view(facet),
                                      view(feature), view(xi), view(normal),
                                      view(x), reach, view(closed));
          },
          py::arg("which"), py::arg("facet"), py::arg("feature"), py::arg("xi"),
          py::arg("normal"), py::arg("x"), py::arg("reach"), py::arg("closed"),
          "Take what was found for them; returns how many closed nodes changed "
          "their facet")
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
          "feet",
          [](const Pairing& self, const Array<double>& x,
             const Array<double>& points)
          {
            const auto n = py::ssize_t(self.facet().size());
            check_pairs(self, x);
            check::rows(points.size(), n, self.master().gdim(), "points",
                        "slave node");
            const auto feet = contactx::search::projections(
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
            check_pairs(self, x);
            check::rows(xi.size(), n, 2, "xi", "slave node");
            const py::ssize_t gdim = self.master().gdim();
            const auto at = contactx::search::facet_points(
                self.master(), self.facet(), view(x), view(xi));
            return py::make_tuple(array(at.x, {n, gdim}),
                                  array(at.normal, {n, gdim}));
          },
          py::arg("x"), py::arg("xi"),
          "Points at local coordinates of the slave nodes' facets, and unit "
          "normals there");
}
