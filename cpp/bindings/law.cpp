// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#include "bindings.h"
#include <contactx/law/coulomb.h>
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

/// Dimension of vectors, of which there is one a slave node.
int dimension(const Array<double>& vectors, const char* name, py::ssize_t n)
{
  if (n == 0)
    return 3;
  const py::ssize_t gdim = vectors.size() / n;
  if ((gdim != 2 and gdim != 3) or vectors.size() != gdim * n)
    throw std::invalid_argument(std::string(name)
                                + " must have two or three values for each of "
                                + std::to_string(n) + " slave nodes, not "
                                + std::to_string(vectors.size()) + " in all");
  return static_cast<int>(gdim);
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
         Array<double> d_pressure, Array<double> d_gap, double softness)
      {
        check_sizes(status.size(), pressure, gap, c, area, value, d_pressure,
                    d_gap);
        if (!(softness >= 0))
          throw std::invalid_argument("softness must not be negative");
        contactx::law::normal_complementarity(
            {view(pressure), view(gap), view(c), softness}, view(area),
            view(status), mutable_view(value), mutable_view(d_pressure),
            mutable_view(d_gap));
      },
      py::arg("pressure"), py::arg("gap"), py::arg("c"), py::arg("area"),
      py::arg("status"), py::arg("value").noconvert(),
      py::arg("d_pressure").noconvert(), py::arg("d_gap").noconvert(),
      py::arg("softness") = 0.0,
      "Complementarity function of each slave node and its derivatives");
  m.def(
      "frictional_status",
      [](const Array<double>& traction, const Array<double>& gap,
         const Array<double>& normal, const Array<double>& slip,
         const Array<double>& c, const Array<double>& friction, double reach,
         Array<std::int8_t> status)
      {
        const int gdim = dimension(traction, "traction", status.size());
        check_sizes(status.size(), gap, c, friction);
        check_sizes(gdim * status.size(), traction, normal, slip);
        return contactx::law::frictional_status(
            {gdim, view(traction), view(gap), view(normal), view(slip), view(c),
             view(friction)},
            reach, mutable_view(status));
      },
      py::arg("traction"), py::arg("gap"), py::arg("normal"), py::arg("slip"),
      py::arg("c"), py::arg("friction"), py::arg("reach"),
      py::arg("status").noconvert(),
      "Set the status of each slave node; returns how many changed");
  m.def(
      "frictional_complementarity",
      [](const Array<double>& traction, const Array<double>& gap,
         const Array<double>& normal, const Array<double>& slip,
         const Array<double>& c, const Array<double>& friction,
         const Array<double>& area, const Array<std::int8_t>& status,
         const Array<double>& mobile, Array<double> value,
         Array<double> by_traction, Array<double> by_gap, Array<double> by_slip,
         Array<double> by_normal)
      {
        const int gdim = dimension(traction, "traction", status.size());
        check_sizes(status.size(), gap, c, friction, area);
        check_sizes(gdim * status.size(), traction, normal, slip, mobile, value,
                    by_gap);
        check_sizes(gdim * gdim * status.size(), by_traction, by_slip,
                    by_normal);
        contactx::law::frictional_complementarity(
            {gdim, view(traction), view(gap), view(normal), view(slip), view(c),
             view(friction)},
            view(area), view(status), view(mobile),
            {mutable_view(value), mutable_view(by_traction),
             mutable_view(by_gap), mutable_view(by_slip),
             mutable_view(by_normal)});
      },
      py::arg("traction"), py::arg("gap"), py::arg("normal"), py::arg("slip"),
      py::arg("c"), py::arg("friction"), py::arg("area"), py::arg("status"),
      py::arg("mobile"), py::arg("value").noconvert(),
      py::arg("by_traction").noconvert(), py::arg("by_gap").noconvert(),
      py::arg("by_slip").noconvert(), py::arg("by_normal").noconvert(),
      "Complementarity function with friction of each slave node and its "
      "derivatives");
}
