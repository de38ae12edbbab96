// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#include "bindings.h"
#include <contactx/results/conductance.h>
#include <pybind11/stl.h>

namespace py = pybind11;
using namespace contactx_bindings;
using namespace contactx::results;
using contactx::contact::Contact;
using contactx::results::Results;

namespace
{
/// Coefficients that a function of Python gives: of arrays of pressures and
/// gaps an array, or one number for all.
contactx::law::Function coefficients_of(const py::function& h)
{
  return [h](std::span<const double> p, std::span<const double> gap)
  {
    const auto given = [](std::span<const double> values)
    {
      return py::array_t<double>(static_cast<py::ssize_t>(values.size()),
                                 values.data());
    };
    const py::array_t<double, py::array::c_style | py::array::forcecast> found(
        h(given(p), given(gap)));
    if (found.ndim() == 0)
      return std::vector<double>(p.size(), *found.data());
    if (found.ndim() != 1 or found.size() != std::ssize(p))
      throw py::value_error("coefficient() of a conductance returned the shape "
                            + py::str(found.attr("shape")).cast<std::string>()
                            + " for " + std::to_string(p.size())
                            + " nodes: return a value for each");
    return std::vector<double>(found.data(), found.data() + found.size());
  };
}
} // namespace

void contactx_bindings::conductance(py::module_& m)
{
  m.def("check_obstacle_value", &check_obstacle_value,
        py::arg("obstacle_value"), py::arg("is_rigid"));
  py::class_<contactx::law::Coefficient>(
      m, "Coefficient", "Coefficient of the flow across a contact")
      .def(py::init([](const py::function& h)
                    { return contactx::law::Coefficient(coefficients_of(h)); }),
           py::arg("coefficient"))
      .def(py::init<double>(), py::arg("coefficient"));
  py::class_<Conductance>(m, "Conductance", "Flow of a field across a contact")
      .def(py::init<std::shared_ptr<Contact>, std::shared_ptr<Results>,
                    contactx::law::Coefficient, std::optional<double>>(),
           py::arg("contact"), py::arg("results"), py::arg("coefficient"),
           py::arg("obstacle_value"))
      .def(
          "flow", [](Conductance& self, const Array<double>& field)
          { return self.flow(view(field)); }, py::arg("field"))
      .def(
          "residual", [](Conductance& self, const Array<double>& field)
          { return array(self.residual(view(field))); }, py::arg("field"))
      .def("by_field", &Conductance::by_field)
      .def(
          "derivatives",
          [](Conductance& self, const Array<double>& field)
          {
            auto [by_field, by_displacement, by_multiplier]
                = self.derivatives(view(field));
            return py::make_tuple(std::move(by_field),
                                  std::move(by_displacement),
                                  std::move(by_multiplier));
          },
          py::arg("field"));
}
