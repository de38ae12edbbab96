// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#include "bindings.h"
#include "check.h"
#include "master.h"
#include <contactx/facet/facets.h>
#include <contactx/search/master_surface.h>
#include <contactx/search/outside.h>
#include <contactx/search/slave_facets.h>
#include <memory>
#include <pybind11/stl.h>

namespace py = pybind11;
using namespace contactx_bindings;
using contactx::facet::FacetList;
using contactx::parallel::Halo;
using contactx::search::Found;
using contactx::search::MasterSurface;
using contactx::search::Outside;

namespace
{
py::ssize_t length(const auto& values)
{
  return static_cast<py::ssize_t>(values.size());
}

/// Offsets and nodes.
py::tuple lists(const FacetList& facets)
{
  return py::make_tuple(array(std::vector<std::int32_t>(facets.offsets.begin(),
                                                        facets.offsets.end())),
                        array(std::vector<std::int32_t>(facets.nodes.begin(),
                                                        facets.nodes.end())));
}

/// Array of a member that has a row a point, which keeps its owner alive.
template <class T, class V>
auto column(std::vector<V> T::* member, py::ssize_t width = 0)
{
  return [member, width](py::object self)
  {
    const T& found = self.cast<const T&>();
    std::vector<py::ssize_t> shape{length(found.gap)};
    if (width > 0)
      shape.push_back(width);
    return looking(found.*member, shape, self);
  };
}

/// Facets of nodes that this rank has.
FacetList facets_of(const Halo& halo, const Array<std::int32_t>& offsets,
                    const Array<std::int32_t>& nodes)
{
  check::facets(view(offsets), view(nodes), halo.gdim());
  check::numbers(view(nodes), halo.num_nodes(), "nodes", "nodes");
  return {view(offsets), view(nodes)};
}
} // namespace

void contactx_bindings::surface(py::module_& m)
{
  py::class_<Found>(m, "Found", "What a search finds for points")
      .def_property_readonly("distance", column(&Found::distance))
      .def_property_readonly("facet", column(&Found::facet))
      .def_property_readonly("feature", column(&Found::feature))
      .def_property_readonly("gap", column(&Found::gap))
      .def_property_readonly("xi", column(&Found::xi, 2))
      .def_property_readonly("normal", column(&Found::normal, 3));
  py::class_<MasterSurface, std::shared_ptr<MasterSurface>>(
      m, "MasterSurface",
      "Facets of a master surface, as the slave nodes of a rank see them")
      .def(py::init(
               [](const std::shared_ptr<Halo>& halo,
                  const Array<std::int32_t>& offsets,
                  const Array<std::int32_t>& nodes)
               {
                 const FacetList own = facets_of(*halo, offsets, nodes);
                 return contactx::search::make_master_surface(halo, own.offsets,
                                                              own.nodes);
               }),
           py::arg("halo"), py::arg("offsets"), py::arg("nodes"))
      .def_property_readonly("facets", [](const MasterSurface& self)
                             { return lists(self.facets()); })
      .def(
          "find",
          [](MasterSurface& self, const Array<double>& x,
             const Array<double>& points, const Array<double>& normals,
             double reach)
          { return self.find(view(x), view(points), view(normals), reach); },
          py::arg("x"), py::arg("points"), py::arg("normals"),
          py::arg("reach"));
  py::class_<Outside, std::shared_ptr<Outside>>(
      m, "Outside",
      "Tells points that penetrate a body from those outside, where its "
      "surface goes around it")
      .def(py::init(
               [](const std::shared_ptr<Halo>& halo,
                  const Array<std::int32_t>& offsets,
                  const Array<std::int32_t>& nodes)
               {
                 const FacetList own = facets_of(*halo, offsets, nodes);
                 return std::make_shared<Outside>(halo, own.offsets, own.nodes);
               }),
           py::arg("halo"), py::arg("offsets"), py::arg("nodes"));
  m.def(
      "slave_facets",
      [](Halo& halo, const Array<std::int32_t>& offsets,
         const Array<std::int32_t>& nodes)
      {
        const FacetList own = facets_of(halo, offsets, nodes);
        return lists(
            contactx::search::slave_facets(halo, own.offsets, own.nodes)
                .list());
      },
      py::arg("halo"), py::arg("offsets"), py::arg("nodes"),
      "Facets of a slave surface around this rank's own nodes");
  m.def(
      "in_order",
      [](const Halo& halo, const Array<std::int32_t>& offsets,
         const Array<std::int32_t>& nodes)
      {
        const FacetList own = facets_of(halo, offsets, nodes);
        return lists(
            contactx::search::in_order(halo, own.offsets, own.nodes).list());
      },
      py::arg("halo"), py::arg("offsets"), py::arg("nodes"),
      "Facets in the order of their nodes' original numbers");
}
