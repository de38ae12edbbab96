// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#include "bindings.h"
#include "check.h"
#include <algorithm>
#include <contactx/geometry/shape.h>

namespace py = pybind11;
using namespace contactx_bindings;

void contactx_bindings::facet(py::module_& m)
{
  m.def(
      "shape_functions",
      [](int num_nodes, const Array<double>& xi)
      {
        check::between(num_nodes, 2, 4, "num_nodes");
        const py::ssize_t n = xi.size() / 2;
        check::rows(xi.size(), n, 2, "xi", "point");
        py::array_t<double> values({n, static_cast<py::ssize_t>(num_nodes)});
        contactx::geometry::visit(
            num_nodes,
            [&values, &xi, n]<class F>(F)
            {
              for (py::ssize_t i = 0; i < n; ++i)
              {
                contactx::geometry::Local<F> at;
                std::copy_n(xi.data() + 2 * i, F::tdim, at.begin());
                const auto N = F::shape(at);
                std::copy(N.begin(), N.end(),
                          values.mutable_data() + i * F::nodes);
              }
            });
        return values;
      },
      py::arg("num_nodes"), py::arg("xi"),
      "Shape functions at local coordinates (shape=(n, 2))");
}
