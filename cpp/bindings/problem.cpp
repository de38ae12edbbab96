// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#include "bindings.h"
#include <contactx/problem/problem.h>
#include <contactx/problem/step_plan.h>
#include <contactx/solve/not_finite.h>
#include <pybind11/functional.h>
#include <pybind11/stl.h>

namespace py = pybind11;
using namespace contactx_bindings;
using namespace contactx::problem;
using contactx::mesh::Bodies;
using contactx::results::Results;
using contactx::solve::System;

namespace
{
/// Values that an object of Python has: see
/// python/contactx/_host/nodal_values.py. The object is kept alive.
class PythonValues final : public Values
{
public:
  explicit PythonValues(py::object adapter) : _adapter(std::move(adapter)) {}

  bool vary() const override { return _adapter.attr("vary").cast<bool>(); }
  std::optional<std::vector<double>> friction() override
  {
    const py::object values = _adapter.attr("friction")();
    if (values.is_none())
      return std::nullopt;
    return copy(values.cast<Array<double>>());
  }
  std::vector<double> offset() override
  {
    return copy(_adapter.attr("offset")().cast<Array<double>>());
  }

private:
  py::object _adapter;
};
} // namespace

void contactx_bindings::problem(py::module_& m)
{
  py::class_<Settled>(
      m, "Settled",
      R"(An accepted iterate after its pairs and its active set were updated.

Attributes:
    number: Number of linear solves so far.
    residual: Norm of the forces that are out of balance, and of the contact conditions.
    tolerance: Bound that the residual must fall below.
    closed: Slave nodes in contact.
    status_changes: Slave nodes that opened or closed.
    pair_changes: Slave nodes in contact that changed their facet.
    frozen_kinematics: Whether pairs, normals and projections of finite sliding were frozen.
    dirichlet_defect: Largest difference from a Dirichlet value.
    scale: Forces of the problem, which ``tolerance`` is relative to: norm of the bulk's residual.
    converged: True if it is a solution: the residual of the updated pairs and status is below the
        tolerance, and the audit has found no fault.
    failure: Why no solution is to be expected any more, and what to do; empty while one is.
    is_final: True if damped steps would fail as well.)")
      .def_readonly("number", &Settled::number)
      .def_readonly("residual", &Settled::residual)
      .def_readonly("tolerance", &Settled::tolerance)
      .def_readonly("closed", &Settled::closed)
      .def_property_readonly("status_changes", [](const Settled& self)
                             { return self.changes.status; })
      .def_property_readonly("pair_changes", [](const Settled& self)
                             { return self.changes.pairs; })
      .def_readonly("frozen_kinematics", &Settled::is_frozen)
      .def_readonly("dirichlet_defect", &Settled::defect)
      .def_readonly("scale", &Settled::scale)
      .def_readonly("converged", &Settled::converged)
      .def_readonly("failure", &Settled::failure)
      .def_readonly("is_final", &Settled::is_final);

  py::class_<AuditReport>(m, "AuditReport", "What an audit has found")
      .def_readonly("far_side", &AuditReport::far_side)
      .def_readonly("passed", &AuditReport::passed)
      .def_readonly("depth", &AuditReport::depth)
      .def_readonly("excess", &AuditReport::excess)
      .def_readonly("radius_in_facets", &AuditReport::radius_in_facets)
      .def_readonly("chords", &AuditReport::chords)
      .def_readonly("edges", &AuditReport::edges)
      .def_readonly("inverted", &AuditReport::inverted)
      .def_readonly("smallest_det", &AuditReport::smallest_det)
      .def_readonly("faults", &AuditReport::faults)
      .def_readonly("warnings", &AuditReport::warnings);

  py::class_<Report>(m, "StepReport", "Report of a step")
      .def_readonly("audit", &Report::audit)
      .def_readonly("warnings", &Report::warnings)
      .def_readonly("seconds", &Report::seconds)
      .def_readonly("slaves", &Report::slaves)
      .def_readonly("pairs", &Report::pairs)
      .def_readonly("immobile", &Report::immobile)
      .def_readonly("frozen_pairs", &Report::frozen_pairs)
      .def_readonly("frozen_gap", &Report::frozen_gap)
      .def_readonly("slipping", &Report::slipping)
      .def_readonly("slip", &Report::slip)
      .def_readonly("dissipation", &Report::dissipation)
      .def_readonly("interior", &Report::interior)
      .def_readonly("limited", &Report::limited)
      .def_readonly("shortened", &Report::shortened)
      .def_readonly("cycles", &Report::cycles)
      .def_readonly("corners", &Report::corners)
      .def_readonly("free_modes", &Report::free_modes)
      .def_readonly("held_force", &Report::held_force)
      .def_readonly("closed_for_balance", &Report::closed_for_balance)
      .def_readonly("skipped_searches", &Report::skipped_searches);

  py::class_<Attempt>(m, "Attempt", "An attempt at a step")
      .def_readonly("start", &Attempt::start)
      .def_readonly("end", &Attempt::end)
      .def_readonly("ratio", &Attempt::ratio)
      .def_readonly("budget", &Attempt::budget);

  py::class_<StepPlan>(m, "StepPlan", "Load steps, halved where one fails")
      .def(py::init<std::vector<double>, int, std::optional<int>>(),
           py::arg("given"), py::arg("max_cuts"), py::arg("easy"))
      .def_static("equal", &StepPlan::equal, py::arg("count"), py::arg("t_end"))
      .def("__copy__", [](const StepPlan& self) { return StepPlan(self); })
      .def("__eq__", [](const StepPlan& self, const StepPlan& other)
           { return self == other; })
      .def_property_readonly("given", &StepPlan::given)
      .def_property_readonly("max_cuts", &StepPlan::max_cuts)
      .def_property_readonly("easy", &StepPlan::easy)
      .def_property_readonly("finished", &StepPlan::finished)
      .def_property_readonly("t", &StepPlan::t)
      .def_property_readonly("next", &StepPlan::next)
      .def("accept", &StepPlan::accept, py::arg("iterations"))
      .def("attempt", &StepPlan::attempt)
      .def("cut", &StepPlan::cut, py::arg("iterations"))
      .def_property_readonly("place", [](const StepPlan& self)
                             { return array(self.place()); })
      .def(
          "load",
          [](StepPlan& self, const Array<double>& given,
             const Array<double>& place)
          { self.load(view(given), view(place)); },
          py::arg("given"), py::arg("place"));

  m.def("step_log_heading", &step_log_heading);
  m.def(
      "step_log_line",
      [](int step, int attempt, double start, double end, int solves,
         std::int64_t closed, std::int64_t slipping, double residual,
         double tolerance, double seconds, std::string failure)
      {
        return step_log_line({step, attempt, start, end, solves, closed,
                              slipping, residual, tolerance, seconds,
                              std::move(failure)});
      },
      py::kw_only(), py::arg("step"), py::arg("attempt"), py::arg("start"),
      py::arg("end"), py::arg("solves"), py::arg("closed"), py::arg("slipping"),
      py::arg("residual"), py::arg("tolerance"), py::arg("seconds"),
      py::arg("failure"));

  py::enum_<Outcome>(m, "Outcome", "What has come of an attempt at a step")
      .value("converged", Outcome::converged)
      .value("failed", Outcome::failed)
      .value("is_final", Outcome::is_final);
  py::class_<Snapshot>(m, "Snapshot", "State of a system")
      .def("restore", &Snapshot::restore);

  py::class_<Problem>(m, "Problem", "Drives a load step")
      .def(
          py::init(
              [](std::shared_ptr<System> system, std::shared_ptr<Bodies> bodies,
                 const std::vector<std::tuple<std::string, py::object,
                                              std::shared_ptr<Results>>>& parts,
                 bool refuses)
              {
                std::vector<Part> given;
                for (const auto& [name, values, results] : parts)
                  given.push_back(
                      {name, std::make_shared<PythonValues>(values), results});
                return std::make_unique<Problem>(std::move(system),
                                                 std::move(bodies),
                                                 std::move(given), refuses);
              }),
          py::arg("system"), py::arg("bodies"), py::arg("parts"),
          py::arg("refuses"))
      .def_property_readonly("loop", &Problem::loop,
                             py::return_value_policy::reference_internal)
      .def_property_readonly("report", &Problem::report,
                             py::return_value_policy::copy)
      .def_property_readonly("number", &Problem::number)
      .def_property_readonly("converged", &Problem::converged)
      .def_property_readonly("has_begun", &Problem::has_begun)
      .def("set_attempt", &Problem::set_attempt, py::arg("attempt"))
      .def("allow_flight", &Problem::allow_flight)
      .def("enter", &Problem::enter, py::arg("call"),
           py::arg("numbers") = std::vector<std::pair<std::string, double>>())
      .def("prepare", &Problem::prepare)
      .def("start", &Problem::start, py::arg("damped") = false)
      .def("settle", &Problem::settle, py::arg("rtol"), py::arg("atol"),
           py::arg("max_it"), py::return_value_policy::copy)
      .def(
          "judge", [](Problem& self, double rtol, double atol, Array<double> b)
          { return self.judge(rtol, atol, mutable_view(b)); }, py::arg("rtol"),
          py::arg("atol"), py::arg("b").noconvert())
      .def("read", &Problem::read)
      .def(
          "limit", [](Problem& self, const Array<double>& dx)
          { return self.limit(view(dx)); }, py::arg("dx"))
      .def(
          "update", [](Problem& self, const Array<double>& dx, double part)
          { self.update(view(dx), part); }, py::arg("dx"), py::arg("part"))
      .def("moved", &Problem::moved)
      // Why the step is refused; empty if it is accepted
      .def("accept",
           [](Problem& self) -> std::string
           {
             try
             {
               self.accept();
             }
             catch (const ConvergenceError& error)
             {
               return error.what();
             }
             return {};
           })
      .def("summarise", &Problem::summarise)
      .def("restore", &Problem::restore)
      .def("snapshot", [](const Problem& self) { return self.snapshot(); })
      .def("find_rigid_modes", &Problem::find_rigid_modes)
      .def("attempt", &Problem::attempt, py::arg("attempt"))
      .def(
          "why_slow", [](Problem& self, const Array<double>& direction)
          { return self.why_slow(view(direction)); }, py::arg("direction"))
      .def("no_convergence", &Problem::no_convergence, py::arg("count"),
           py::arg("limit"));
}
