// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#include "bindings.h"
#include "parallel.h"
#include <contactx/audit/audit.h>
#include <contactx/mesh/deformed_cells.h>
#include <pybind11/stl.h>
#include <stdexcept>

namespace py = pybind11;
using namespace contactx_bindings;
using contactx::audit::Audit;
using contactx::audit::Chords;
using contactx::audit::Depth;
using contactx::audit::EdgeForce;
using contactx::audit::Findings;
using contactx::audit::FoundNodes;
using contactx::contact::Contact;
using contactx::mesh::Halo;

void contactx_bindings::audit(py::module_& m)
{
  py::class_<FoundNodes>(m, "FoundNodes", "Nodes of all ranks")
      .def_readonly("count", &FoundNodes::count)
      .def_readonly("first", &FoundNodes::first)
      .def_property_readonly("at", [](const FoundNodes& self)
                             { return array(self.at); });
  py::class_<Depth>(m, "Depth", "How deep a master is below a slave facet")
      .def_readonly("excess", &Depth::excess)
      .def_readonly("depth", &Depth::depth)
      .def_readonly("size", &Depth::size)
      .def_readonly("is_held", &Depth::is_held)
      .def_property_readonly("at",
                             [](const Depth& self) { return array(self.at); });
  py::class_<Chords>(m, "Chords", "How round surfaces that fit are for facets")
      .def_readonly("mean", &Chords::mean)
      .def_readonly("scatter", &Chords::scatter)
      .def_readonly("sagitta", &Chords::sagitta)
      .def_readonly("pressed", &Chords::pressed)
      .def_property_readonly("ratio", &Chords::ratio);
  py::class_<EdgeForce>(m, "EdgeForce", "What becomes of the master's edges")
      .def_readonly("share", &EdgeForce::share)
      .def_readonly("off", &EdgeForce::off)
      .def_property_readonly("at", [](const EdgeForce& self)
                             { return array(self.at); })
      .def_readonly("unseen", &EdgeForce::unseen)
      .def_readonly("depth", &EdgeForce::depth)
      .def_readonly("size", &EdgeForce::size)
      .def_property_readonly("hidden", [](const EdgeForce& self)
                             { return array(self.hidden); })
      .def_property_readonly("ratio", &EdgeForce::ratio);
  py::class_<Findings>(m, "ContactFindings", "What was found of one contact")
      .def_readonly("passed", &Findings::passed)
      .def_readonly("inside", &Findings::inside)
      .def_readonly("deepest", &Findings::deepest)
      .def_readonly("is_too_deep", &Findings::penetrates_too_deep)
      .def_readonly("facet_size", &Findings::facet_size)
      .def_readonly("chords", &Findings::chords)
      .def_readonly("edges", &Findings::edges)
      .def_readonly("warnings", &Findings::warnings);
  py::class_<Audit>(m, "Audit", "Looks at the contacts of converged iterates")
      .def(py::init<std::shared_ptr<Halo>,
                    std::vector<std::shared_ptr<Contact>>>(),
           py::arg("halo"), py::arg("contacts"))
      .def("begin_step", &Audit::begin_step)
      .def("accept", &Audit::accept)
      .def("find", &Audit::find);
  m.def(
      "deformed_cells",
      [](const Array<std::int32_t>& cells, const Array<double>& X,
         const Array<double>& u, int gdim)
      {
        if (cells.ndim() != 2)
          throw std::invalid_argument("cells must have a row for each cell");
        const auto found = contactx::mesh::deformed_cells(
            view(cells), static_cast<int>(cells.shape(1)), view(X), view(u),
            gdim);
        return py::make_tuple(found.smallest, found.cell, found.inverted);
      },
      py::arg("cells"), py::arg("X"), py::arg("u"), py::arg("gdim"),
      "Smallest det F, the cell that has it, and the number of inverted cells "
      "(cells: shape=(num_cells, nodes_per_cell))");
}
