// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#include "bindings.h"
#include "check.h"
#include <algorithm>
#include <contactx/audit/passage.h>
#include <stdexcept>

namespace py = pybind11;
using namespace contactx_bindings;
using contactx::audit::Crossing;
using contactx::audit::Moments;

namespace
{
/// Facets and the positions of their nodes at the start and at the end.
void check_moved(const Array<std::int32_t>& offsets,
                 const Array<std::int32_t>& nodes, const Array<double>& x0,
                 const Array<double>& x1, int gdim)
{
  check::facets(view(offsets), view(nodes), gdim);
  const std::int32_t n = check::num_nodes(view(nodes));
  check::positions(x0.size(), n, gdim, "x0");
  check::positions(x1.size(), n, gdim, "x1");
}

contactx::Vector<3> origin(const Array<double>& values, int gdim,
                           const std::string& name)
{
  check::rows(values.size(), 1, gdim, name, "origin");
  contactx::Vector<3> v{};
  std::ranges::copy(view(values), v.begin());
  return v;
}
} // namespace

void contactx_bindings::passage(py::module_& m)
{
  PYBIND11_NUMPY_DTYPE(Crossing, point, facet, time, entering, cosine, before,
                       after);
  m.def(
      "moments",
      [](const Array<std::int32_t>& offsets, const Array<std::int32_t>& nodes,
         const Array<double>& x0, const Array<double>& x1, int gdim,
         const Array<double>& origin0, const Array<double>& origin1)
      {
        check_moved(offsets, nodes, x0, x1, gdim);
        const auto sums = contactx::audit::moments(
            {view(offsets), view(nodes)}, view(x0), view(x1), gdim,
            origin(origin0, gdim, "origin0"), origin(origin1, gdim, "origin1"));
        return array(std::vector<double>(sums.begin(), sums.end()));
      },
      py::arg("offsets"), py::arg("nodes"), py::arg("x0"), py::arg("x1"),
      py::arg("gdim"), py::arg("origin0"), py::arg("origin1"),
      "Sums that the motion of a surface as a whole follows from");
  m.def(
      "crossings",
      [](const Array<std::int32_t>& offsets, const Array<std::int32_t>& nodes,
         const Array<double>& x0, const Array<double>& x1, int gdim,
         const Array<double>& moments, const Array<double>& origin0,
         const Array<double>& origin1, const Array<double>& points0,
         const Array<double>& points1, const Array<double>& normals0,
         const Array<double>& normals1, const Array<double>& tolerance,
         const Array<std::int32_t>& node)
      {
        check_moved(offsets, nodes, x0, x1, gdim);
        const py::ssize_t n = tolerance.size();
        Moments sums;
        check::rows(moments.size(), 1, sums.size(), "moments", "surface");
        check::rows(points0.size(), n, gdim, "points0", "point");
        check::rows(points1.size(), n, gdim, "points1", "point");
        check::rows(normals0.size(), n, gdim, "normals0", "point");
        check::rows(normals1.size(), n, gdim, "normals1", "point");
        check::rows(node.size(), n, 1, "node", "point");
        std::ranges::copy(view(moments), sums.begin());
        const auto motion = contactx::audit::rigid_motion(
            sums, gdim, origin(origin0, gdim, "origin0"),
            origin(origin1, gdim, "origin1"));
        return array(contactx::audit::crossings(
            {view(offsets), view(nodes)}, view(x0), view(x1), gdim, motion,
            {view(points0), view(points1), view(normals0), view(normals1),
             view(tolerance), view(node)}));
      },
      py::arg("offsets"), py::arg("nodes"), py::arg("x0"), py::arg("x1"),
      py::arg("gdim"), py::arg("moments"), py::arg("origin0"),
      py::arg("origin1"), py::arg("points0"), py::arg("points1"),
      py::arg("normals0"), py::arg("normals1"), py::arg("tolerance"),
      py::arg("node"),
      "Where points go through facets, each with the moments of the whole "
      "surface");
  m.def(
      "passed",
      [](const Array<Crossing>& crossings, const Array<double>& tolerance)
      {
        for (const Crossing& c : view(crossings))
          if (c.point < 0 or c.point >= tolerance.size())
            throw std::invalid_argument(
                "crossings must be of points that have a tolerance");
        return array(contactx::audit::passed(view(crossings), view(tolerance)));
      },
      py::arg("crossings"), py::arg("tolerance"),
      "Crossing by which each point entered what it passed through, -1 for "
      "none");
}
