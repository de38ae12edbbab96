// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#include "bindings.h"
#include "check.h"
#include <algorithm>
#include <contactx/kernel/layout.h>
#include <contactx/kernel/registry.h>
#include <cstddef>
#include <pybind11/stl.h>
#include <stdexcept>

namespace py = pybind11;
using namespace contactx_bindings;
using namespace contactx;

namespace
{
contactx::kernel::Law law_named(const std::string& name)
{
  using contactx::kernel::Law;
  if (name == "frictionless")
    return Law::frictionless;
  if (name == "frictional")
    return Law::frictional;
  if (name == "tied")
    return Law::tied;
  throw std::invalid_argument("there is no contact law " + name);
}

/// Numbers of nodes that arrays are laid out for: any, but no negative or huge
/// ones, whose products are no sizes.
void check_sizes(int num_nodes, int gdim, int num_slaves)
{
  check::between(num_nodes, 0, 9, "num_nodes");
  check::dimension(gdim);
  check::between(num_slaves, 1, 9, "num_slaves");
}
} // namespace

void contactx_bindings::kernel(py::module_& m)
{
  using contactx::kernel::Site;
  using Pair = contactx::kernel::FacetPair;
  const auto place = [](std::size_t bytes) { return bytes / sizeof(double); };
  m.attr("pair_layout")
      = py::dict(py::arg("feature") = place(offsetof(Pair, feature)),
                 py::arg("xi") = place(offsetof(Pair, xi)),
                 py::arg("cone") = place(offsetof(Pair, cone)),
                 py::arg("normal") = place(offsetof(Pair, normal)),
                 py::arg("size") = contactx::kernel::num_values<Pair>);
  m.def(
      "coefficients",
      [](const std::string& law, int num_nodes, int gdim, int num_slaves)
      {
        check_sizes(num_nodes, gdim, num_slaves);
        py::list table;
        for (const contactx::kernel::CoefficientInfo& c :
             contactx::kernel::coefficients(law_named(law), num_nodes, gdim,
                                            num_slaves))
        {
          if (c.size == 0)
            continue;
          const char* site = c.site == Site::nodes  ? "nodes"
                             : c.site == Site::pair ? "pair"
                                                    : "slave";
          table.append(py::make_tuple(std::string(c.name), site, c.size));
        }
        return py::tuple(table);
      },
      py::arg("law"), py::arg("num_nodes"), py::arg("gdim"),
      py::arg("num_slaves") = 1,
      "Name, site and size of the coefficients that the kernels are given");
  m.def(
      "terms",
      [](const std::string& law, const std::string& sliding, int num_nodes,
         int gdim, int num_slaves)
      {
        py::list terms;
        for (const contactx::kernel::Entry& e : contactx::kernel::registry())
          if (e.law == law_named(law) and e.sliding == sliding
              and e.num_nodes == num_nodes and e.gdim == gdim
              and e.num_slaves == num_slaves)
            terms.append(std::string(e.term));
        return terms;
      },
      py::arg("law"), py::arg("sliding"), py::arg("num_nodes"), py::arg("gdim"),
      py::arg("num_slaves") = 1, "Terms that have a kernel");
  m.def(
      "nodal_kernel", [](int num_values)
      { return reinterpret_cast<std::uintptr_t>(kernel::nodal(num_values)); },
      py::arg("num_values"),
      "Address of the kernel that adds its one coefficient");
  m.attr("area_elsewhere") = kernel::area_elsewhere;
  m.def(
      "kernel",
      [](const std::string& law, const std::string& sliding,
         const std::string& term, int num_nodes, int gdim, int num_slaves)
      {
        const contactx::kernel::Entry& e = contactx::kernel::find(
            law_named(law), sliding, term, num_nodes, gdim, num_slaves);
        const auto table = contactx::kernel::coefficients(e.law, num_nodes,
                                                          gdim, num_slaves);
        Array<std::int8_t> active(e.active.size());
        for (std::size_t i = 0; i < e.active.size(); ++i)
        {
          // Its place among the coefficients that exist
          const auto c = static_cast<std::int8_t>(e.active[i]);
          active.mutable_at(i)
              = std::count_if(table.begin(), table.begin() + c,
                              [](const contactx::kernel::CoefficientInfo& info)
                              { return info.size > 0; });
        }
        return py::make_tuple(reinterpret_cast<std::uintptr_t>(e.function),
                              active);
      },
      py::arg("law"), py::arg("sliding"), py::arg("term"), py::arg("num_nodes"),
      py::arg("gdim"), py::arg("num_slaves") = 1,
      "Address of a kernel and the coefficients that it reads");
}
