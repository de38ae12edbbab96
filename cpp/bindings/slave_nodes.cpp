// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#include "master.h"
#include "parallel.h"
#include <contactx/problem/sides.h>
#include <contactx/results/recovery.h>

namespace py = pybind11;
using namespace contactx_bindings;
using namespace contactx::contact;
using contactx::mesh::Halo;
using contactx::mesh::NodeMap;

namespace
{
int width_of(const Array<double>& x)
{
  if (x.ndim() != 2)
    throw std::invalid_argument("x must have a row for each node");
  return static_cast<int>(x.shape(1));
}
} // namespace

void contactx_bindings::slave_nodes(py::module_& m)
{
  py::class_<SlaveNodes, std::shared_ptr<SlaveNodes>>(
      m, "SlaveNodes",
      "Slave nodes that a rank owns, and those of others that share a facet "
      "with them")
      .def(
          py::init(
              [](const std::shared_ptr<Halo>& halo,
                 const Array<std::int32_t>& offsets,
                 const Array<std::int32_t>& nodes,
                 const Array<std::int8_t>& level, bool is_mortar, bool is_rigid)
              {
                return contactx::problem::make_slave_nodes(
                    halo, {view(offsets), view(nodes)}, view(level),
                    is_mortar ? Method::surface_to_surface
                              : Method::node_to_surface,
                    is_rigid);
              }),
          py::arg("halo"), py::arg("offsets"), py::arg("nodes"),
          py::arg("level") = Array<std::int8_t>(), py::kw_only(),
          py::arg("is_mortar") = false, py::arg("is_rigid") = false)
      .def_property_readonly("facets", [](const SlaveNodes& self)
                             { return to_tuple(self.facets()); })
      .def_property_readonly("owned",
                             [](py::object self)
                             {
                               const auto& s = self.cast<const SlaveNodes&>();
                               return looking(s.around(),
                                              {std::ssize(s.owned())}, self);
                             })
      .def_property_readonly("around",
                             [](py::object self)
                             {
                               const auto& s = self.cast<const SlaveNodes&>();
                               return looking(s.around(),
                                              {std::ssize(s.around())}, self);
                             })
      .def(
          "facing",
          [](const SlaveNodes& self, const Array<double>& x,
             const Array<double>& normal)
          { return to_bool(self.facing(view(x), view(normal), width_of(x))); },
          py::arg("x"), py::arg("normal"))
      .def(
          "sums", [](const SlaveNodes& self, const Array<double>& corners)
          { return array(self.sums(view(corners))); }, py::arg("corners"));
  py::class_<contactx::results::Recovery>(
      m, "Recovery", "Nodal tractions that scatter less than multipliers")
      .def(py::init(
               [](std::shared_ptr<SlaveNodes> slaves, const Array<double>& x)
               {
                 return std::make_unique<contactx::results::Recovery>(
                     std::move(slaves), view(x), width_of(x));
               }),
           py::arg("slaves"), py::arg("x"))
      .def(
          "pressure",
          [](const contactx::results::Recovery& self, const Array<double>& p,
             const Array<double>& area, const Array<bool>& closed)
          { return array(self.pressure(view(p), view(area), truths(closed))); },
          py::arg("p"), py::arg("area"), py::arg("closed"));
}
