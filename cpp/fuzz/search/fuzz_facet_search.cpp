// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#include "../facets.h"
#include "../require.h"
#include <contactx/geometry/gather.h>
#include <contactx/search/facet_search.h>

using namespace contactx;
using namespace contactx::fuzz;
using geometry::FacetPairs;
using geometry::Integrals;
using geometry::most_nodes;
using search::FacetSearch;

namespace
{
void check(const FacetPairs& pairs, const Scene& scene)
{
  for (std::size_t i = 0; i < pairs.size(); ++i)
  {
    require(pairs.slave[i] >= 0 and pairs.slave[i] < scene.slave.size()
                and pairs.master[i] >= 0
                and pairs.master[i] < scene.master.size(),
            "the facets of a pair exist");
    if (i > 0)
      require(pairs.slave[i - 1] < pairs.slave[i]
                  or (pairs.slave[i - 1] == pairs.slave[i]
                      and pairs.master[i - 1] < pairs.master[i]),
              "pairs ascend");
  }
  require(search::contains(pairs, pairs), "pairs contain themselves");
}

/// Area of a flat facet, none of others.
double flat_area(const List& list, std::int32_t f, std::span<const double> x)
{
  const auto nodes = list.facets()[f];
  return geometry::visit(
      nodes.size(),
      [nodes, x]<class F>(F)
      {
        const double j
            = geometry::frame<F>(geometry::gather<F>(nodes, x), {}).jacobian;
        return F::nodes == 3 ? 0.5 * j : F::flat ? j : NAN;
      });
}

/// What the integrals of each slave facet sum to.
void check_sums(const Integrals& all, const FacetPairs& pairs,
                const Scene& scene, std::span<const double> reference)
{
  constexpr int n = most_nodes;
  std::vector<double> by_weight(all.area.size(), 0);
  std::vector<int> layers(scene.slave.size(), 0);
  for (std::size_t i = 0; i < pairs.size(); ++i)
  {
    ++layers[pairs.slave[i]];
    for (int s = 0; s < n; ++s)
      for (int l = 0; l < n; ++l)
        by_weight[n * pairs.slave[i] + s] += all.weight[n * (n * i + s) + l];
  }
  for (std::int32_t f = 0; f < scene.slave.size(); ++f)
  {
    double covered = 0, most = 0;
    for (int s = 0; s < n; ++s)
    {
      require(all.area[n * f + s] >= 0, "no node's area is negative");
      covered += all.area[n * f + s];
      for (int t = 0; t < n; ++t)
        most = std::max(most, std::abs(all.dual[n * (n * f + s) + t]));
    }
    // The dual functions of a facet that is hardly covered are large
    for (int s = 0; s < n; ++s)
      require(std::abs(by_weight[n * f + s] - all.area[n * f + s])
                  <= 1e-9 * (1 + most) * covered,
              "weights of the master's nodes sum to the slave's");
    const double whole = flat_area(scene.slave, f, reference);
    if (std::isfinite(whole))
      // Facets that share a node may lie over one another
      require(covered <= (1 + 1e-9) * layers[f] * whole,
              "no more is covered than is there");
  }
}
} // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data,
                                      std::size_t size)
{
  Input in(data, size);
  Scene scene(in);
  // Integrals over pairs of quadrilaterals take thousands of points each
  scene.slave.cut(1);
  scene.master.cut(2);
  FacetSearch search(scene.slave.offsets, scene.slave.nodes,
                     scene.master.offsets, scene.master.nodes, scene.gdim);
  const std::vector<double> reference = scene.x;
  if (in.flag())
    scene.move(in);
  const double reach = in.flag() ? INFINITY : in.positive();
  const double margin = in.flag() ? 0 : 0.125 * in.below(9);
  const bool all_layers = in.flag();
  const FacetPairs pairs = search.find(scene.x, reach, margin, all_layers);
  check(pairs, scene);
  const auto all = geometry::integrals(search.slave(), search.master(), pairs,
                                       scene.x, reference, scene.gdim);
  std::vector<double> normal = all.normal;
  const bool found = !all_layers and in.even();
  if (found)
    check_sums(all, pairs, scene, reference);
  if (in.finite())
    for (const auto& values : {all.weight, all.gap, all.dual, all.area, normal})
      require(all_finite(values), "all integrals are finite");
  // The pairs of one search are used after others have been: with other
  // positions, along the normals of before
  if (in.flag())
    return 0;
  scene.move(in);
  geometry::integrals(search.slave(), search.master(), pairs, scene.x,
                      reference, scene.gdim, normal);
  search.find(scene.x, reach, margin, all_layers);
  return 0;
}
