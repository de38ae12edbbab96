// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#include "bindings.h"
#include <contactx/kernel/registry.h>
#include <pybind11/stl.h>

namespace py = pybind11;
using namespace contactx_bindings;
using namespace contactx;

void contactx_bindings::kernel(py::module_& m)
{
  using kernel::Site;
  m.attr("pair_layout") = py::dict(py::arg("feature") = kernel::pair_feature,
                                   py::arg("xi") = kernel::pair_xi,
                                   py::arg("cone") = kernel::pair_cone,
                                   py::arg("normal") = kernel::pair_normal,
                                   py::arg("size") = kernel::pair_size);
  m.attr("rigid_layout")
      = py::dict(py::arg("gap") = kernel::rigid_gap,
                 py::arg("gradient") = kernel::rigid_gradient,
                 py::arg("normal") = kernel::rigid_normal,
                 py::arg("curvature") = kernel::rigid_curvature,
                 py::arg("size") = kernel::rigid_size);
  m.def(
      "coefficients",
      [](int num_nodes)
      {
        py::list table;
        for (const kernel::CoefficientInfo& c : kernel::coefficients(num_nodes))
        {
          const char* site = c.site == Site::nodes  ? "nodes"
                             : c.site == Site::pair ? "pair"
                                                    : "slave";
          table.append(py::make_tuple(std::string(c.name), site, c.size));
        }
        return py::tuple(table);
      },
      py::arg("num_nodes"),
      "Name, site and size of the coefficients that the kernels are given");
  m.def(
      "kernel",
      [](const std::string& sliding, const std::string& term, int num_nodes,
         int gdim)
      {
        const kernel::Entry& e = kernel::find(sliding, term, num_nodes, gdim);
        Array<std::int8_t> active(e.active.size());
        for (std::size_t i = 0; i < e.active.size(); ++i)
          active.mutable_at(i) = static_cast<std::int8_t>(e.active[i]);
        return py::make_tuple(reinterpret_cast<std::uintptr_t>(e.function),
                              active);
      },
      py::arg("sliding"), py::arg("term"), py::arg("num_nodes"),
      py::arg("gdim"),
      "Address of a kernel and the coefficients that it reads");
}
