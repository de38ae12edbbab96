// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#include "master.h"
#include "parallel.h"
#include <contactx/problem/check_facing.h>
#include <contactx/problem/sides.h>
#include <pybind11/stl.h>
#include <stdexcept>

namespace py = pybind11;
using namespace contactx_bindings;
using namespace contactx::contact;
using namespace contactx::problem;
using contactx::geometry::Obstacle;
using contactx::law::Law;
using contactx::mesh::Halo;

namespace
{
/// Offsets and nodes, as Python's FacetList has them.
contactx::geometry::FacetList facets_of(const Array<std::int32_t>& offsets,
                                        const Array<std::int32_t>& nodes)
{
  return {view(offsets), view(nodes)};
}
} // namespace

void contactx_bindings::reference(py::module_& m)
{
  // It looks at the cells
  py::class_<contactx::mesh::Mesh>(m, "ReferenceMesh",
                                   "The mesh of the bulk on this rank")
      .def(py::init(
               [](std::shared_ptr<Halo> halo,
                  std::shared_ptr<contactx::mesh::Bodies> bodies,
                  const Array<std::int32_t>& cells)
               {
                 if (cells.ndim() != 2)
                   throw std::invalid_argument(
                       "cells must have a row for each cell");
                 return contactx::mesh::Mesh{std::move(halo), std::move(bodies),
                                             view(cells),
                                             static_cast<int>(cells.shape(1))};
               }),
           py::arg("halo"), py::arg("bodies"), py::arg("cells").noconvert(),
           py::keep_alive<1, 4>());
  py::class_<MasterOptions>(m, "MasterOptions", "How a master side is made")
      .def(py::init(
               [](bool is_mortar, bool is_small,
                  std::optional<double> search_distance,
                  const Array<std::int8_t>& level, bool is_self,
                  std::optional<double> excluded_distance, bool is_smooth)
               {
                 return MasterOptions{is_mortar ? Method::surface_to_surface
                                                : Method::node_to_surface,
                                      is_small ? Sliding::small
                                               : Sliding::finite,
                                      search_distance,
                                      copy(level),
                                      is_self,
                                      excluded_distance,
                                      is_smooth};
               }),
           py::kw_only(), py::arg("is_mortar"), py::arg("is_small"),
           py::arg("search_distance"), py::arg("level") = Array<std::int8_t>(),
           py::arg("is_self") = false,
           py::arg("excluded_distance") = py::none(),
           py::arg("is_smooth") = false);
  m.def(
      "make_surface_master",
      [](const contactx::mesh::Mesh& mesh,
         const std::shared_ptr<SlaveNodes>& slaves, const std::string& slave,
         const Array<std::int32_t>& offsets, const Array<std::int32_t>& nodes,
         const std::string& master, const Law& law,
         const MasterOptions& options)
      {
        return make_master(mesh, slaves, slave,
                           {master, facets_of(offsets, nodes)}, law, options);
      },
      py::arg("mesh"), py::arg("slaves"), py::arg("slave"), py::arg("offsets"),
      py::arg("nodes"), py::arg("master"), py::arg("law"), py::arg("options"),
      "Master side of a contact with a surface");
  // A subclass in Python must outlive who calls its methods
  m.def(
      "make_obstacle_master",
      [](const contactx::mesh::Mesh& mesh,
         const std::shared_ptr<SlaveNodes>& slaves, const std::string& slave,
         const std::shared_ptr<Obstacle>& obstacle, const Law& law,
         const MasterOptions& options)
      { return make_master(mesh, slaves, slave, obstacle, law, options); },
      py::arg("mesh"), py::arg("slaves"), py::arg("slave"), py::arg("obstacle"),
      py::arg("law"), py::arg("options"), py::keep_alive<0, 4>(),
      "Master side of a contact with an obstacle");
  m.def("check_facing", &check_facing, py::arg("halo"), py::arg("slaves"),
        py::arg("slave_name"), py::arg("master"), py::arg("master_name"),
        "Check that a slave surface does not face away from its master");
}
