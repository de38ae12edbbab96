// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#include "../facets.h"
#include "../require.h"
#include <contactx/search/pairing.h>
#include <contactx/search/projections.h>

using namespace contactx;
using namespace contactx::fuzz;
using search::Pairing;
using search::Projection;

namespace
{
void check(const Pairing& pairing, const Scene& scene, Input& in)
{
  const auto facets = pairing.master().facets();
  const auto feet = search::projections(
      pairing.master(), pairing.facet(), scene.x,
      std::vector<double>(scene.gdim * pairing.facet().size(), 0.5),
      pairing.xi());
  const auto places
      = search::places(pairing.master(), pairing.facet(), scene.x, feet.xi);
  for (std::size_t i = 0; i < pairing.facet().size(); ++i)
  {
    const std::int32_t f = pairing.facet()[i];
    require(f >= -1 and f < facets.size(), "a pair's facet exists");
    if (f < 0)
      continue;
    const int n = static_cast<int>(facets[f].size());
    require(pairing.feature()[i] >= 0
                and pairing.feature()[i] <= (scene.gdim - 1) * n,
            "so does its feature");
  }
  if (!in.finite())
    return;
  require(all_finite(pairing.xi()), "local coordinates are finite");
  require(all_finite(pairing.cone()), "a ridge's normal is finite");
  require(all_finite(pairing.normal()), "normals are finite");
  require(all_finite(feet.xi) and all_finite(feet.gap), "feet are finite");
  require(all_finite(places.x), "places are finite");
}

/// What another process may have found for a slave node.
std::optional<Projection> any_projection(const Pairing& pairing, Input& in)
{
  const auto facets = pairing.master().facets();
  const std::int32_t f = in.below(facets.size() + 1) - 1;
  if (f < 0)
    return std::nullopt;
  Projection q{};
  q.facet = f;
  const int n = static_cast<int>(facets[f].size());
  q.feature = in.below((pairing.master().gdim() - 1) * n + 1);
  q.xi = {in.unscaled(), in.unscaled()};
  q.normal = in.unit<3>();
  return q;
}

void step(Pairing& pairing, const Scene& scene, Input& in)
{
  const double reach = in.flag() ? INFINITY : in.positive();
  std::vector<std::int8_t> closed(pairing.slaves().size());
  for (auto& c : closed)
    c = in.flag();
  switch (in.below(6))
  {
  case 0:
    pairing.begin_step();
    break;
  case 1:
  {
    const auto facet = pairing.facet();
    const auto feature = pairing.feature();
    const auto xi = pairing.xi(), cone = pairing.cone();
    const auto normal = pairing.normal();
    pairing.restore(facet, feature, xi, cone, normal);
    break;
  }
  case 2:
  {
    // One facet more
    List more = scene.master;
    more.nodes.insert(more.nodes.end(), more.nodes.begin(),
                      more.nodes.begin() + (more.size() ? more.offsets[1] : 0));
    if (more.size() > 0)
      more.offsets.push_back(static_cast<std::int32_t>(more.nodes.size()));
    pairing.set_master(more.offsets, more.nodes);
    break;
  }
  case 3:
    for (const std::int32_t i : pairing.seek(scene.x, reach))
      if (const auto q = any_projection(pairing, in); !q or in.even())
        pairing.accept_projection(i, std::nullopt, scene.x, reach, closed[i]);
      else
        pairing.accept_projection(
            i, q->feature == geometry::interior ? q : std::nullopt, scene.x,
            reach, closed[i]);
    break;
  default:
  {
    const std::int32_t changed = pairing.update(scene.x, reach, closed);
    require(changed >= 0 and changed <= std::ssize(closed),
            "no more nodes change than there are");
  }
  }
}
} // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data,
                                      std::size_t size)
{
  Input in(data, size);
  Scene scene(in);
  Pairing pairing(scene.slave.offsets, scene.slave.nodes, scene.master.offsets,
                  scene.master.nodes, scene.gdim,
                  in.flag() ? scene.num_nodes() : in.below(20));
  for (int k = 1 + in.below(6); k > 0; --k)
  {
    step(pairing, scene, in);
    check(pairing, scene, in);
    scene.move(in);
  }
  for (const std::int32_t i : pairing.frozen())
    require(i >= 0 and i < std::ssize(pairing.slaves()),
            "what is frozen exists");
  return 0;
}
