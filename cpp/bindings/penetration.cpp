// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#include "bindings.h"
#include "check.h"
#include <contactx/audit/facet_sampling.h>
#include <contactx/audit/far_side.h>
#include <contactx/audit/penetration.h>

namespace py = pybind11;
using namespace contactx_bindings;
using contactx::audit::FacetSampling;

void contactx_bindings::penetration(py::module_& m)
{
  m.def(
      "nodal_curvatures",
      [](const Array<std::int32_t>& offsets, const Array<std::int32_t>& nodes,
         const Array<double>& x, const Array<double>& normal, int gdim)
      {
        check::surface(view(offsets), view(nodes), x.size(), gdim);
        return array(contactx::audit::nodal_curvatures(
            {view(offsets), view(nodes)}, view(x), view(normal), gdim));
      },
      py::arg("offsets"), py::arg("nodes"), py::arg("x"), py::arg("normal"),
      py::arg("gdim"), "How much nodal normals turn on the way to a neighbour");
  m.def(
      "facet_turns",
      [](const Array<std::int32_t>& offsets, const Array<std::int32_t>& nodes,
         const Array<double>& x, const Array<double>& normal, int gdim)
      {
        check::surface(view(offsets), view(nodes), x.size(), gdim);
        return array(contactx::audit::facet_turns({view(offsets), view(nodes)},
                                                  view(x), view(normal), gdim));
      },
      py::arg("offsets"), py::arg("nodes"), py::arg("x"), py::arg("normal"),
      py::arg("gdim"), "How much normals turn along each facet");
  m.def(
      "facet_sizes",
      [](const Array<std::int32_t>& offsets, const Array<std::int32_t>& nodes,
         const Array<double>& x, int gdim)
      {
        check::surface(view(offsets), view(nodes), x.size(), gdim);
        return array(contactx::audit::facet_sizes({view(offsets), view(nodes)},
                                                  view(x), gdim));
      },
      py::arg("offsets"), py::arg("nodes"), py::arg("x"), py::arg("gdim"),
      "Longest distance between two nodes of each facet");
  m.def(
      "explained_depths",
      [](const Array<double>& size, const Array<double>& curvature,
         const Array<std::int8_t>& contact, const Array<double>& extent)
      {
        return array(contactx::audit::explained_depths(
            view(size), view(curvature), view(contact), view(extent)));
      },
      py::arg("size"), py::arg("curvature"), py::arg("contact"),
      py::arg("extent"),
      "How deep a master may be below slave facets between their nodes");
  m.def(
      "far_side",
      [](const Array<double>& own_before, const Array<double>& own_after,
         const Array<double>& before, const Array<double>& after, int gdim)
      {
        check::dimension(gdim);
        return array(contactx::audit::far_side(view(own_before),
                                               view(own_after), view(before),
                                               view(after), gdim));
      },
      py::arg("own_before"), py::arg("own_after"), py::arg("before"),
      py::arg("after"), py::arg("gdim"),
      "Which nodes came to the far side of a rigid obstacle");
  py::class_<FacetSampling>(m, "FacetSampling",
                            "Places of facets that are too deep in an obstacle")
      .def(py::init(
               [](const Array<std::int32_t>& offsets,
                  const Array<std::int32_t>& nodes, const Array<double>& x,
                  int gdim, const Array<double>& allowed, int levels)
               {
                 check::surface(view(offsets), view(nodes), x.size(), gdim);
                 return FacetSampling({view(offsets), view(nodes)}, view(x),
                                      gdim, copy(allowed), levels);
               }),
           py::arg("offsets"), py::arg("nodes"), py::arg("x"), py::arg("gdim"),
           py::arg("allowed"), py::arg("levels"))
      .def_property_readonly(
          "points",
          [](const FacetSampling& self)
          {
            const auto p = self.points();
            return array(std::vector<double>(p.begin(), p.end()),
                         {static_cast<py::ssize_t>(p.size()) / self.gdim(),
                          self.gdim()});
          })
      .def(
          "take", [](FacetSampling& self, const Array<double>& gap)
          { self.take(view(gap)); }, py::arg("gap"))
      .def_property_readonly(
          "deepest",
          [](const FacetSampling& self)
          {
            const auto& p = self.deepest();
            return array(p, {static_cast<py::ssize_t>(p.size()) / self.gdim(),
                             self.gdim()});
          })
      .def_property_readonly("gaps", [](const FacetSampling& self)
                             { return array(self.gaps()); });
}
