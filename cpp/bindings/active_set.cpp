// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#include "master.h"
#include "parallel.h"
#include <contactx/active_set/cycle_guard.h>
#include <contactx/active_set/frozen_pairs.h>
#include <contactx/active_set/junctions.h>
#include <contactx/active_set/soft_path.h>
#include <contactx/active_set/step_length.h>
#include <pybind11/stl.h>
#include <stdexcept>

namespace py = pybind11;
using namespace contactx_bindings;
using namespace contactx::active_set;
using contactx::contact::HiddenGap;
using contactx::parallel::NodeMap;

void contactx_bindings::active_set(py::module_& m)
{
  m.def(
      "look_at_step",
      [](const Array<double>& pressure, const Array<double>& gap,
         const Array<double>& c, const Array<double>& area,
         const Array<std::int8_t>& status, const Array<double>& change)
      {
        for (const auto& array : {pressure, gap, c, area, change})
          if (array.size() != status.size())
            throw std::invalid_argument("the arrays of a step differ in size");
        const HardStep s = look_at_step({view(pressure), view(gap), view(c)},
                                        view(area), view(status), view(change));
        return py::make_tuple(s.work, s.local, s.closed, s.opening);
      },
      py::arg("pressure"), py::arg("gap"), py::arg("c"), py::arg("area"),
      py::arg("status"), py::arg("change"),
      "What a Newton step with hard contact is about to do to closed nodes: "
      "work, that of local stiffness, how many are closed and how many open");
  py::class_<SoftPath>(m, "SoftPath", "Path from soft to hard contact")
      .def(py::init<>())
      .def("begin_step", &SoftPath::begin_step)
      .def(
          "begins",
          [](SoftPath& self, double work, double local, double closed,
             double opening)
          { return self.begins({work, local, closed, opening}); },
          py::arg("work"), py::arg("local"), py::arg("closed"),
          py::arg("opening"))
      .def("advance", &SoftPath::advance, py::arg("changes"), py::arg("closed"),
           py::arg("is_full"))
      .def("harden", &SoftPath::harden)
      .def_property_readonly("softness", &SoftPath::softness);
  py::class_<Junctions>(m, "Junctions",
                        "Nodes that are slave in several contacts")
      .def(py::init(
               [](const std::vector<Array<std::int32_t>>& slaves)
               {
                 std::vector<std::span<const std::int32_t>> views;
                 for (const auto& nodes : slaves)
                   views.push_back(view(nodes));
                 return Junctions(views);
               }),
           py::arg("slaves"))
      .def_property_readonly("shared", [](const Junctions& self)
                             { return array(self.shared()); })
      .def_property_readonly("corners", &Junctions::corners)
      .def(
          "update",
          [](Junctions& self, const std::vector<bool>& is_tied,
             const std::vector<Array<bool>>& closes,
             const std::vector<Array<double>>& gap,
             const std::vector<Array<double>>& normal, bool first)
          {
            const std::size_t n = is_tied.size();
            if (closes.size() != n or gap.size() != n or normal.size() != n)
              throw std::invalid_argument(
                  "the arrays of contacts differ in number");
            std::vector<std::vector<std::int8_t>> flags;
            for (const auto& c : closes)
              flags.push_back(truths(c));
            std::vector<Closing> contacts;
            for (std::size_t k = 0; k < n; ++k)
              contacts.push_back(
                  {is_tied[k], flags[k], view(gap[k]), view(normal[k])});
            py::list result;
            for (const Shared& s : self.update(contacts, first))
              result.append(
                  py::make_tuple(to_bool(s.ceded), to_bool(s.smooth)));
            return result;
          },
          py::arg("is_tied"), py::arg("closes"), py::arg("gap"),
          py::arg("normal"), py::arg("first"));
  m.def(
      "fingerprint",
      [](const NodeMap& nodes, const std::vector<Array<std::int8_t>>& status)
      {
        std::vector<std::span<const std::int8_t>> views;
        for (const auto& s : status)
          views.push_back(view(s));
        return fingerprint(nodes.ranks(), views);
      },
      py::arg("nodes"), py::arg("status"),
      "Number that stands for the status of all nodes of all ranks");
  py::class_<CycleGuard>(m, "CycleGuard", "Status that comes back")
      .def(py::init<>())
      .def_property_readonly_static("part", [](const py::object&)
                                    { return CycleGuard::part; })
      .def("begin_step", &CycleGuard::begin_step)
      .def("shortens", &CycleGuard::shortens)
      .def("note", &CycleGuard::note, py::arg("status"), py::arg("residual"))
      .def_property_readonly("cycles", &CycleGuard::cycles);
  py::class_<FrozenPairs>(m, "FrozenPairs",
                          "Pairs that went back and forth between facets")
      .def(py::init<>())
      .def("begin_step", &FrozenPairs::begin_step)
      .def(
          "hide_penetration",
          [](FrozenPairs& self, const NodeMap& nodes,
             const std::vector<std::pair<double, double>>& found)
          {
            std::vector<HiddenGap> hidden;
            for (const auto& [gap, part] : found)
              hidden.push_back({gap, part});
            return self.hide_penetration(nodes.ranks(), hidden);
          },
          py::arg("nodes"), py::arg("found"))
      .def("release", &FrozenPairs::release)
      .def_property_readonly("gaps", &FrozenPairs::gaps);
  py::class_<StepLength>(m, "StepLength", "How much of a step is taken")
      .def(py::init<>())
      .def_property_readonly_static("left", [](const py::object&)
                                    { return StepLength::left; })
      .def("begin_step", &StepLength::begin_step, py::arg("damped"))
      .def("begin", &StepLength::begin, py::arg("size"),
           py::arg("within_cells"))
      .def_property_readonly("has_trial", &StepLength::has_trial)
      .def("judge", &StepLength::judge, py::arg("next_size"))
      .def_property_readonly("part", &StepLength::part)
      .def_property_readonly("limited", &StepLength::limited)
      .def_property_readonly("damped", &StepLength::damped)
      .def_property_readonly("is_stuck", &StepLength::is_stuck);
}
