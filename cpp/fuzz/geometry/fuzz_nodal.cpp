// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#include "../facets.h"
#include "../require.h"
#include <contactx/geometry/gather.h>
#include <numeric>

using namespace contactx;
using namespace contactx::fuzz;

namespace
{
/// Area of a facet, by the midpoint rule where it is bilinear.
double area_of(std::span<const std::int32_t> nodes, std::span<const double> x)
{
  return geometry::visit(nodes.size(),
                         [nodes, x]<class F>(F)
                         {
                           const auto xf = geometry::gather<F>(nodes, x);
                           geometry::Local<F> middle;
                           middle.fill(0.5);
                           const double j
                               = geometry::frame<F>(xf, middle).jacobian;
                           return F::nodes == 3 ? 0.5 * j : j;
                         });
}
} // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data,
                                      std::size_t size)
{
  Input in(data, size);
  const Scene scene(in);
  const auto facets = scene.slave.facets();
  const auto area = geometry::nodal_areas(facets, scene.x, scene.gdim);
  const auto normal = geometry::nodal_normals(facets, scene.x, scene.gdim);
  if (!in.finite())
    return 0;
  require(all_finite(area) and all_finite(normal), "all is finite");
  for (std::size_t i = 0; i < area.size(); ++i)
  {
    require(area[i] >= 0, "no area is negative");
    const auto n = std::span(normal).subspan(i * scene.gdim, scene.gdim);
    require(largest(n) == 0 or is_unit(n), "normals have length one or none");
  }
  double whole = 0;
  for (std::int32_t f = 0; f < facets.size(); ++f)
  {
    if (facets[f].size() == 4)
      return 0;
    whole += area_of(facets[f], scene.x);
  }
  const double sum = std::reduce(area.begin(), area.end());
  require(std::abs(sum - whole) <= 1e-9 * whole, "the areas' sum is the whole");
  return 0;
}
