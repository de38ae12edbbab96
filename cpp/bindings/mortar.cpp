// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#include "bindings.h"
#include "check.h"
#include <contactx/search/facet_search.h>

namespace py = pybind11;
using namespace contactx_bindings;
using contactx::geometry::FacetPairs;
using contactx::search::FacetSearch;

void contactx_bindings::mortar(py::module_& m)
{
  py::class_<FacetPairs>(m, "FacetPairs", "Pairs of slave and master facets")
      .def_property_readonly("slave", [](const FacetPairs& self)
                             { return array(self.slave); })
      .def_property_readonly("master", [](const FacetPairs& self)
                             { return array(self.master); });
  py::class_<FacetSearch>(m, "FacetSearch",
                          "Finds the master facets in front of slave facets")
      .def(py::init(
               [](const Array<std::int32_t>& slave_offsets,
                  const Array<std::int32_t>& slave_nodes,
                  const Array<std::int32_t>& master_offsets,
                  const Array<std::int32_t>& master_nodes, int gdim)
               {
                 check::facets(view(slave_offsets), view(slave_nodes), gdim,
                               "slave_");
                 check::facets(view(master_offsets), view(master_nodes), gdim,
                               "master_");
                 return FacetSearch(copy(slave_offsets), copy(slave_nodes),
                                    copy(master_offsets), copy(master_nodes),
                                    gdim);
               }),
           py::arg("slave_offsets"), py::arg("slave_nodes"),
           py::arg("master_offsets"), py::arg("master_nodes"), py::arg("gdim"))
      .def(
          "find",
          [](FacetSearch& self, const Array<double>& x, double reach,
             double margin, bool all_layers)
          {
            check::positions(x.size(), self.num_nodes(), self.gdim());
            return self.find(view(x), reach, margin, all_layers);
          },
          py::arg("x"), py::arg("reach"), py::arg("margin"),
          py::arg("all_layers") = false, "Find the pairs")
      .def(
          "integrals",
          [](const FacetSearch& self, const FacetPairs& pairs,
             const Array<double>& x, const Array<double>& reference,
             const Array<double>& normal)
          {
            const auto slaves = self.slave().size();
            check::positions(x.size(), self.num_nodes(), self.gdim());
            check::positions(reference.size(), self.num_nodes(), self.gdim(),
                             "reference");
            check::numbers(pairs.slave, slaves, "pairs.slave", "slave facets");
            check::numbers(pairs.master, self.master().size(), "pairs.master",
                           "master facets");
            if (normal.size() > 0)
              check::rows(normal.size(), slaves, 3, "normal", "slave facet");
            const auto all = contactx::geometry::integrals(
                self.slave(), self.master(), pairs, view(x), view(reference),
                self.gdim(), view(normal));
            const auto shaped =
                [](const std::vector<double>& v, std::vector<py::ssize_t> width)
            {
              py::ssize_t stride = 1;
              for (const py::ssize_t n : width)
                stride *= n;
              width.insert(width.begin(), py::ssize_t(v.size()) / stride);
              return array(v, width);
            };
            return py::dict(py::arg("weight") = shaped(all.weight, {4, 4}),
                            py::arg("gap") = shaped(all.gap, {4}),
                            py::arg("dual") = shaped(all.dual, {4, 4}),
                            py::arg("area") = shaped(all.area, {4}),
                            py::arg("normal") = shaped(all.normal, {3}));
          },
          py::arg("pairs"), py::arg("x"), py::arg("reference"),
          py::arg("normal") = Array<double>(0),
          "Integrals of the dual basis functions");
}
