// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#include "bindings.h"
#include <contactx/law/normal.h>
#include <stdexcept>

namespace py = pybind11;
using namespace contactx_bindings;

namespace
{
/// The laws run over plain arrays: sizes are checked here, once.
template <class... A>
void check_sizes(py::ssize_t n, const A&... arrays)
{
  if (((arrays.size() != n) or ...))
    throw std::invalid_argument("the arrays of a law differ in size");
}
} // namespace

void contactx_bindings::law(py::module_& m)
{
  m.attr("OPEN") = static_cast<int>(contactx::law::open);
  m.attr("STICK") = static_cast<int>(contactx::law::stick);
  m.attr("SLIP") = static_cast<int>(contactx::law::slip);
  m.def(
      "normal_status",
      [](const Array<double>& pressure, const Array<double>& gap,
         const Array<double>& c, Array<std::int8_t> status)
      {
        check_sizes(status.size(), pressure, gap, c);
        return contactx::law::normal_status(
            {view(pressure), view(gap), view(c)}, mutable_view(status));
      },
      py::arg("pressure"), py::arg("gap"), py::arg("c"),
      py::arg("status").noconvert(),
      "Set the status of each slave node; returns how many changed");
  m.def(
      "normal_complementarity",
      [](const Array<double>& pressure, const Array<double>& gap,
         const Array<double>& c, const Array<double>& area,
         const Array<std::int8_t>& status, Array<double> value,
         Array<double> d_pressure, Array<double> d_gap)
      {
        check_sizes(status.size(), pressure, gap, c, area, value, d_pressure,
                    d_gap);
        contactx::law::normal_complementarity(
            {view(pressure), view(gap), view(c)}, view(area), view(status),
            mutable_view(value), mutable_view(d_pressure), mutable_view(d_gap));
      },
      py::arg("pressure"), py::arg("gap"), py::arg("c"), py::arg("area"),
      py::arg("status"), py::arg("value").noconvert(),
      py::arg("d_pressure").noconvert(), py::arg("d_gap").noconvert(),
      "Complementarity function of each slave node and its derivatives");
}
