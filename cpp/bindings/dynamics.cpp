// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#include "bindings.h"
#include "bulk.h"
#include <contactx/problem/time_step.h>
#include <pybind11/stl.h>

namespace py = pybind11;
using namespace contactx_bindings;
using namespace contactx::problem;
using contactx::problem::Problem;
using contactx::results::Results;
using contactx::solve::System;

namespace
{
/// Masses that an object of Python looks after: see
/// python/contactx/dynamics.py. The object is kept alive.
class PythonInertia final : public Inertia
{
public:
  explicit PythonInertia(py::object adapter)
      : _adapter(std::move(adapter)),
        _diagonal(_adapter.attr("diagonal").cast<Array<double>>())
  {
  }

  std::span<const double> diagonal() const override { return view(_diagonal); }
  bool is_lumped() const override
  {
    return _adapter.attr("is_lumped").cast<bool>();
  }
  std::span<const double> product(std::span<const double> velocity) override
  {
    return keep(_product, _adapter.attr("product")(py::array_t<double>(
                              static_cast<py::ssize_t>(velocity.size()),
                              velocity.data())));
  }
  void constrain(std::span<const std::int8_t> markers) override
  {
    _adapter.attr("constrain")(py::array_t<std::int8_t>(
        static_cast<py::ssize_t>(markers.size()), markers.data()));
  }
  void solve(std::span<double> values) override
  {
    _adapter.attr("solve")(lend(values));
  }
  std::optional<double> strain_energy() override
  {
    return _adapter.attr("strain_energy")().cast<std::optional<double>>();
  }
  std::span<const double> loads() override
  {
    const py::object loads = _adapter.attr("loads")();
    return loads.is_none() ? std::span<const double>() : keep(_loads, loads);
  }

private:
  py::object _adapter;
  Array<double> _diagonal, _product, _loads;
};

/// A number in 2D, shape (3,) in 3D
py::object moment(const std::vector<double>& values)
{
  if (values.size() == 1)
    return py::float_(values.front());
  return array(values);
}
} // namespace

void contactx_bindings::dynamics(py::module_& m)
{
  py::class_<Balance>(
      m, "Balance",
      R"(Energy and momentum at the end of a time step, and the work done in it.

For linear elastic bodies energy is balanced to rounding: kinetic and strain energy grow by
``work_of_loads + work_of_supports - contact_loss``. In a nonlinear body the rest is the error of
the midpoint rule. Momentum grows by the impulses of loads, supports and contacts.

Attributes:
    dt: Length of the step, a time.
    kinetic: Kinetic energy at its end.
    strain: Strain energy at its end; None where no ``strain_energy`` was given.
    energy: Kinetic and, where it is known, strain energy.
    momentum: Momentum at its end, shape (gdim,).
    angular_momentum: Moment of momentum about the origin at its end: a number in 2D, shape (3,)
        in 3D.
    work_of_loads: Work of ``loads`` in the step.
    work_of_supports: Work of Dirichlet conditions in the step.
    contact_loss: Energy that contact has taken in the step, by impact and friction; negative
        where rigid obstacles that move have done work, or nodes have slid over curved or
        faceted surfaces, which turn in the step.
    impulse: Impulse on the slave side of each contact in the step, impacts included: a list
        of arrays of shape (gdim,). Over dt it is the mean force.
)")
      .def_readonly("dt", &Balance::dt)
      .def_readonly("kinetic", &Balance::kinetic)
      .def_readonly("strain", &Balance::strain)
      .def_property_readonly("energy", &Balance::energy)
      .def_property_readonly("momentum", [](const Balance& self)
                             { return array(self.momentum); })
      .def_property_readonly("angular_momentum", [](const Balance& self)
                             { return moment(self.angular_momentum); })
      .def_readonly("work_of_loads", &Balance::work_of_loads)
      .def_readonly("work_of_supports", &Balance::work_of_supports)
      .def_readonly("contact_loss", &Balance::contact_loss)
      .def_property_readonly("impulse",
                             [](const Balance& self)
                             {
                               py::list all;
                               for (const auto& each : self.impulse)
                                 all.append(array(each));
                               return all;
                             })
      .def("lines", &Balance::lines, "The balance as lines of text.");

  py::class_<TimeStep, std::shared_ptr<TimeStep>>(
      m, "TimeStep", "A time step of bodies with inertia and contact")
      .def(py::init(
               [](std::shared_ptr<System> system,
                  std::vector<std::shared_ptr<Results>> results,
                  py::object inertia, std::optional<double> impact_travel)
               {
                 return std::make_shared<TimeStep>(
                     std::move(system), std::move(results),
                     std::make_shared<PythonInertia>(std::move(inertia)),
                     impact_travel);
               }),
           py::arg("system"), py::arg("results"), py::arg("inertia"),
           py::arg("impact_travel"))
      .def(
          "attach", [](std::shared_ptr<TimeStep> self, Problem& problem)
          { attach(problem, std::move(self)); }, py::arg("problem"))
      .def(
          "begin", [](TimeStep& self, double dt, const Array<double>& velocity)
          { self.begin(dt, view(velocity)); }, py::arg("dt"),
          py::arg("velocity"))
      .def_property_readonly("velocity", [](const TimeStep& self)
                             { return array(self.velocity()); })
      .def("balance", &TimeStep::balance)
      .def(
          "kinetic_energy", [](TimeStep& self, const Array<double>& velocity)
          { return self.kinetic_energy(view(velocity)); }, py::arg("velocity"))
      .def(
          "momentum", [](TimeStep& self, const Array<double>& velocity)
          { return array(self.momentum(view(velocity))); }, py::arg("velocity"))
      .def(
          "angular_momentum", [](TimeStep& self, const Array<double>& velocity)
          { return moment(self.angular_momentum(view(velocity))); },
          py::arg("velocity"))
      .def("strain_energy", &TimeStep::strain_energy);
}
