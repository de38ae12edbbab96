// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#include "../facets.h"
#include "../require.h"
#include <contactx/search/finder.h>

using namespace contactx;
using namespace contactx::fuzz;
using search::Finder;
using search::FoundPlace;

namespace
{
void check(const Finder& finder, const Scene& scene, Input& in)
{
  const Vector<3> p = scene.point(in);
  Vector<3> normal{};
  if (in.flag())
  {
    const auto n = in.unit<3>();
    std::copy_n(n.begin(), scene.gdim, normal.begin());
  }
  const double reach = in.flag() ? in.positive() : INFINITY;
  const std::int32_t num_facets = finder.surface().facets().size();
  const FoundPlace found = finder.find(scene.x, p, normal, reach);
  const FoundPlace hinted
      = finder.find(scene.x, p, normal, reach, in.below(num_facets + 1) - 1);
  if (!in.finite())
    return;
  // A facet that is larger by many orders is at all distances as far, and what
  // is at the very reach may be in or out
  const auto& any = found.nearest ? found.nearest : hinted.nearest;
  if (!any)
    return;
  const double distance = norm(any->d),
               rounding = 1e-9 * (distance + any->size);
  if (in.even() and std::abs(distance - reach) > rounding)
    require(found.nearest and hinted.nearest
                and found.nearest->facet == hinted.nearest->facet,
            "a hint does not change what is found");
  if (!found.nearest)
    return;
  require(norm(found.nearest->d) <= reach * (1 + 1e-9), "it is in reach");
  if (!found.selected)
    return;
  const auto& q = *found.selected;
  require(q.facet >= 0 and q.facet < num_facets, "the facet exists");
  require(all_finite(q.xi) and std::isfinite(q.gap), "all is finite");
  require(is_unit(std::span(q.normal).first(scene.gdim)),
          "the normal has length one");
  if (q.feature != geometry::interior)
  {
    const Vector<3> cone
        = search::cone_components(finder.surface(), scene.x, q);
    require(all_finite(cone), "a ridge's normal has finite components");
  }
}
} // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data,
                                      std::size_t size)
{
  Input in(data, size);
  Scene scene(in);
  Finder finder(scene.master.offsets, scene.master.nodes, scene.gdim);
  for (int k = 0; k < 2; ++k)
  {
    finder.refit(scene.x);
    check(finder, scene, in);
    scene.move(in);
  }
  return 0;
}
