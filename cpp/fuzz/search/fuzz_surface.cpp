// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#include "../facets.h"
#include "../require.h"
#include <contactx/search/surface.h>

using namespace contactx;
using namespace contactx::fuzz;
using search::Projection;
using search::Surface;

namespace
{
void check_topology(const Surface& surface, std::int32_t f)
{
  const int n = static_cast<int>(surface.facets()[f].size());
  const int features = n == 2 ? 2 : 2 * n;
  for (int feature = 0; feature <= features; ++feature)
  {
    const auto star = surface.star(f, feature);
    require(std::ranges::find(star, f) != star.end(),
            "a facet is among those around its features");
    for (const std::int32_t g : star)
      require(g >= 0 and g < surface.facets().size(), "all of them exist");
    surface.on_boundary(f, feature);
  }
}

void check(const Projection& q, int gdim)
{
  require(all_finite(q.xi) and all_finite(q.d), "a projection is finite");
  require(std::isfinite(q.gap) and std::isfinite(q.size), "so are its lengths");
  require(is_unit(std::span(q.normal).first(gdim)), "its normal is a unit one");
}
} // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data,
                                      std::size_t size)
{
  Input in(data, size);
  const Scene scene(in);
  const Surface surface(scene.master.offsets, scene.master.nodes, scene.gdim);
  const auto boxes = surface.boxes(scene.x);
  const Vector<3> p = scene.point(in);
  if (const int n = surface.facets().size(); n > 0)
    check_topology(surface, in.below(n));
  for (std::int32_t f = 0; f < surface.facets().size(); ++f)
  {
    const auto near = search::closest(surface, f, scene.x, p);
    const auto over = search::extended(surface, f, scene.x, p);
    const Vector<2> xi{0.125 * in.below(17) - 0.5, 0.125 * in.below(17) - 0.5};
    const auto at = search::point_at(surface, f, scene.x, xi);
    if (!in.finite())
      continue;
    require(all_finite(at.x), "points at local coordinates are finite");
    if (over)
      check(*over, scene.gdim);
    if (!near)
      continue;
    check(*near, scene.gdim);
    const double distance = norm(near->d);
    require(boxes[f].distance2(p) <= distance * distance * (1 + 1e-9)
                                         + 1e-9 * near->size * near->size,
            "the box is no farther than the facet");
  }
  return 0;
}
