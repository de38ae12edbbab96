// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#include "bindings.h"
#include "check.h"
#include <contactx/search/pairing.h>
#include <limits>

namespace py = pybind11;
using namespace contactx_bindings;
using contactx::search::Pairing;

namespace
{
/// Positions, and a flag for each slave node.
void check_pairs(const Pairing& self, const Array<double>& x,
                 const Array<std::int8_t>& closed)
{
  check::positions(x.size(), self.num_nodes(), self.master().gdim());
  check::rows(closed.size(), std::ssize(self.slaves()), 1, "closed",
              "slave node");
}
} // namespace

void contactx_bindings::search(py::module_& m)
{
  py::class_<Pairing>(m, "Pairing",
                      "Pairs of slave nodes and master facets, kept from one "
                      "search to the next")
      .def(py::init(
               [](const Array<std::int32_t>& slave_offsets,
                  const Array<std::int32_t>& slave_nodes,
                  const Array<std::int32_t>& master_offsets,
                  const Array<std::int32_t>& master_nodes, int gdim,
                  std::int32_t num_owned)
               {
                 check::facets(view(slave_offsets), view(slave_nodes), gdim,
                               "slave_");
                 check::facets(view(master_offsets), view(master_nodes), gdim,
                               "master_");
                 return Pairing(copy(slave_offsets), copy(slave_nodes),
                                copy(master_offsets), copy(master_nodes), gdim,
                                num_owned);
               }),
           py::arg("slave_offsets"), py::arg("slave_nodes"),
           py::arg("master_offsets"), py::arg("master_nodes"), py::arg("gdim"),
           py::arg("num_owned") = std::numeric_limits<std::int32_t>::max())
      .def(
          "update",
          [](Pairing& self, const Array<double>& x, double reach,
             const Array<std::int8_t>& closed)
          {
            check_pairs(self, x, closed);
            return self.update(view(x), reach, view(closed));
          },
          py::arg("x"), py::arg("reach"), py::arg("closed"),
          "Search; returns how many closed nodes changed their facet");
}
