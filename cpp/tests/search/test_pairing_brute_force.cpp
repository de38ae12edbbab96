// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#include "brute_force.h"
#include "random_scenes.h"
#include <contactx/search/bisector.h>
#include <contactx/search/pairing.h>
#include <contactx/search/select.h>
#include <gtest/gtest.h>

using namespace contactx;
using namespace contactx::search;
using namespace contactx::tests;

namespace
{
/// Slave facets whose nodes are where the search may find it hard.
geometry::FacetList add_slaves(Scene& scene, Generator& random,
                               std::vector<std::int32_t>& offsets,
                               std::vector<std::int32_t>& nodes)
{
  offsets = {0};
  for (int i = 0; i < 8; ++i)
  {
    for (int k = 0; k < scene.gdim; ++k)
      nodes.push_back(scene.node(random_query(scene, random, i + k)));
    offsets.push_back(static_cast<std::int32_t>(nodes.size()));
  }
  return {offsets, nodes};
}

class PairingBruteForce : public ::testing::TestWithParam<Kind>
{
};

TEST_P(PairingBruteForce, FirstPairsAreThoseOfALoop)
{
  Generator random(401 + static_cast<int>(GetParam()));
  int paired = 0;
  for (int set = 0; set < 100; ++set)
  {
    Scene scene = random_scene(GetParam(), random);
    const Surface surface = scene.surface();
    std::vector<std::int32_t> offsets, nodes;
    const geometry::FacetList slaves
        = add_slaves(scene, random, offsets, nodes);
    const std::vector<double> normals
        = geometry::nodal_normals(slaves, scene.x, scene.gdim);
    const double reach = set % 3 ? 10 : 0.3;

    Pairing pairing(offsets, nodes, scene.offsets, scene.nodes, scene.gdim);
    const std::vector<std::int8_t> open(pairing.slaves().size(), 0);
    EXPECT_EQ(pairing.update(scene.x, reach, open), 0);
    for (std::size_t i = 0; i < open.size(); ++i)
    {
      const std::int32_t node = pairing.slaves()[i];
      Vector<3> normal{};
      std::copy_n(normals.begin() + node * scene.gdim, scene.gdim,
                  normal.begin());
      const Vector<3> p = scene.point(node);
      auto expected = brute_force(surface, scene.x, p, normal, reach);
      if (expected)
        expected = select(surface, scene.x, p, *expected);
      if (expected and expected->feature == geometry::interior)
        if (const auto q = bisector(surface, scene.x, p, *expected))
          expected = q;
      ASSERT_EQ(pairing.facet()[i], expected ? expected->facet : -1);
      if (!expected)
        continue;
      ++paired;
      EXPECT_EQ(pairing.feature()[i], expected->feature);
      for (int k = 0; k < 2; ++k)
        EXPECT_EQ(pairing.xi()[2 * i + k], expected->xi[k]);
      for (int k = 0; k < 3; ++k)
        EXPECT_EQ(pairing.normal()[3 * i + k], expected->normal[k]);
    }
  }
  EXPECT_EQ(paired > 100, GetParam() != Kind::empty);
}

INSTANTIATE_TEST_SUITE_P(AllKinds, PairingBruteForce,
                         ::testing::ValuesIn(all_kinds()));
} // namespace
