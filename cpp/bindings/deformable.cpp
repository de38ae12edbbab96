// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#include "bindings.h"
#include <contactx/contact/node_to_surface.h>
#include <contactx/contact/surface_to_surface.h>

namespace py = pybind11;
using namespace contactx_bindings;
using namespace contactx;
using namespace contactx::contact;

namespace
{
template <class T>
void bind(py::module_& m, const char* name, const char* text)
{
  py::class_<T, DeformableMaster, std::shared_ptr<T>>(m, name, text)
      .def(py::init(
               [](std::shared_ptr<parallel::Halo> halo,
                  std::shared_ptr<SlaveNodes> slaves,
                  std::shared_ptr<search::MasterSurface> surface,
                  std::shared_ptr<search::Outside> outside, double reach,
                  bool is_small, bool measures_slip)
               {
                 return std::make_shared<T>(
                     std::move(halo), std::move(slaves), surface, outside,
                     PairingOptions{reach, is_small, measures_slip});
               }),
           py::arg("halo"), py::arg("slaves"), py::arg("surface"),
           py::arg("outside"), py::arg("reach"), py::arg("is_small"),
           py::arg("measures_slip"));
}
} // namespace

void contactx_bindings::deformable(py::module_& m)
{
  py::class_<DeformableMaster, Master, std::shared_ptr<DeformableMaster>>(
      m, "DeformableMaster", "Pairs with facets of a deformable body")
      .def_property_readonly("surface", &DeformableMaster::surface);
  bind<NodeToSurface>(m, "NodeToSurface",
                      "Pairs of slave nodes with facets of a deformable body");
  bind<NodeTie>(m, "NodeTie", "Slave nodes tied to facets");
  bind<SurfaceToSurface>(m, "SurfaceToSurface",
                         "Pairs of slave facets with facets of a deformable "
                         "body, with dual multipliers");
  bind<SurfaceTie>(m, "SurfaceTie", "Slave facets tied to facets");
}
