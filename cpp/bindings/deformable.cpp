// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#include "master.h"
#include <contactx/contact/node_to_surface.h>
#include <contactx/contact/surface_to_surface.h>

namespace py = pybind11;
using namespace contactx_bindings;
using namespace contactx::contact;

namespace
{
template <class T>
void bind(py::module_& m, const char* name, const char* text)
{
  py::class_<T, DeformableMaster, std::shared_ptr<T>>(m, name, text);
}
} // namespace

void contactx_bindings::deformable(py::module_& m)
{
  using contactx::search::MasterSurface;
  py::class_<MasterSurface, std::shared_ptr<MasterSurface>>(
      m, "MasterSurface",
      "Facets of a master surface, as the slave nodes of a rank see them")
      .def_property_readonly("facets", [](const MasterSurface& self)
                             { return to_tuple(self.facets()); });
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
