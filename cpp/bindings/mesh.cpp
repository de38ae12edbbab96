// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#include "bindings.h"
#include "parallel.h"
#include <contactx/mesh/degenerate.h>
#include <contactx/mesh/nodes.h>
#include <contactx/mesh/straight.h>
#include <pybind11/stl.h>
#include <stdexcept>

namespace py = pybind11;
using namespace contactx_bindings;
using contactx::mesh::cell_type;
using contactx::mesh::Cells;
using contactx::mesh::Halo;

namespace
{
int width_of(const Array<std::int32_t>& rows)
{
  if (rows.ndim() != 2)
    throw std::invalid_argument("cells and points must have a row a cell");
  return static_cast<int>(rows.shape(1));
}

Cells cells_of(const std::string& cell, int degree,
               const Array<std::int32_t>& nodes)
{
  return {cell_type(cell), degree, view(nodes)};
}
} // namespace

void contactx_bindings::mesh(py::module_& m)
{
  py::class_<contactx::mesh::Geometry>(m, "MeshGeometry",
                                       "The mesh of cells, of any order")
      .def(py::init(
               [](int gdim, int degree, const Array<std::int32_t>& points,
                  const Array<double>& x)
               {
                 return contactx::mesh::Geometry{gdim, degree, view(points),
                                                 width_of(points), view(x)};
               }),
           py::arg("gdim"), py::arg("degree"), py::arg("points").noconvert(),
           py::arg("x").noconvert(), py::keep_alive<1, 4>(),
           py::keep_alive<1, 5>());
  m.def(
      "linear_cells",
      [](const std::string& cell, int degree, const Array<std::int32_t>& nodes)
      {
        const Cells cells = cells_of(cell, degree, nodes);
        return array(contactx::mesh::linear_cells(cells),
                     {cells.size() * cells.num_parts(),
                      contactx::mesh::num_vertices(cells.type)});
      },
      py::arg("cell"), py::arg("degree"), py::arg("nodes"),
      "Cells of the linear mesh of all nodes");
  m.def(
      "node_levels",
      [](const std::string& cell, int degree, const Array<std::int32_t>& nodes,
         std::int32_t num_nodes)
      {
        return array(contactx::mesh::node_levels(cells_of(cell, degree, nodes),
                                                 num_nodes));
      },
      py::arg("cell"), py::arg("degree"), py::arg("nodes"),
      py::arg("num_nodes"), "Where nodes are on quadratic facets");
  m.def(
      "reference_positions",
      [](const std::string& cell, int degree, const Array<std::int32_t>& nodes,
         std::int32_t num_nodes, const contactx::mesh::Geometry& geometry)
      {
        return array(contactx::mesh::reference_positions(
                         cells_of(cell, degree, nodes), num_nodes, geometry),
                     {num_nodes, geometry.gdim});
      },
      py::arg("cell"), py::arg("degree"), py::arg("nodes"),
      py::arg("num_nodes"), py::arg("geometry"),
      "Reference positions of the nodes");
  m.def(
      "original_nodes",
      [](const std::string& cell, int degree, const Array<std::int32_t>& nodes,
         std::int32_t num_nodes, const contactx::mesh::Geometry& geometry,
         const Array<std::int64_t>& numbers, std::int64_t count)
      {
        return array(contactx::mesh::original_nodes(
            cells_of(cell, degree, nodes), num_nodes, geometry, view(numbers),
            count));
      },
      py::arg("cell"), py::arg("degree"), py::arg("nodes"),
      py::arg("num_nodes"), py::arg("geometry"), py::arg("numbers"),
      py::arg("count"), "Numbers of nodes in the mesh as it was made");
  m.def(
      "oriented_facets",
      [](const std::string& cell, int degree, const Array<std::int32_t>& nodes,
         const Array<std::int32_t>& of, const Array<std::int32_t>& local,
         const contactx::mesh::Geometry& geometry)
      {
        const auto found = contactx::mesh::facets(
            cells_of(cell, degree, nodes), view(of), view(local), geometry);
        return py::make_tuple(array(found.offsets), array(found.nodes));
      },
      py::arg("cell"), py::arg("degree"), py::arg("nodes"), py::arg("of"),
      py::arg("local"), py::arg("geometry"),
      "Linear parts of facets, oriented outward");
  m.def(
      "check_straight",
      [](const Halo& halo, const std::string& name, const std::string& cell,
         int degree, const Array<std::int32_t>& nodes,
         const contactx::mesh::Geometry& geometry, const Array<double>& points,
         const Array<std::int32_t>& of, const Array<std::int32_t>& local)
      {
        contactx::mesh::check_straight(halo.ranks(), name,
                                       cells_of(cell, degree, nodes), geometry,
                                       view(points), view(of), view(local));
      },
      py::arg("halo"), py::arg("name"), py::arg("cell"), py::arg("degree"),
      py::arg("nodes"), py::arg("geometry"), py::arg("points"), py::arg("of"),
      py::arg("local"), "Check that a surface is as the displacement has it");
  m.def(
      "check_cells",
      [](const Halo& halo, const std::string& cell,
         const contactx::mesh::Geometry& geometry, std::int32_t num_owned,
         const Array<std::int64_t>& original)
      {
        contactx::mesh::check_cells(halo.ranks(), cell_type(cell), geometry,
                                    num_owned, view(original));
      },
      py::arg("halo"), py::arg("cell"), py::arg("geometry"),
      py::arg("num_owned"), py::arg("original"),
      "Check that cells have a volume and are not folded");
}
