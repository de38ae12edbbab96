// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#include "scene.h"
#include <contactx/search/finder.h>
#include <gtest/gtest.h>

using namespace contactx;
using namespace contactx::search;
using namespace contactx::tests;

namespace
{
TEST(SelectFolded, FacetsWhoseNormalsCancelGiveAUnitNormal)
{
  // Both sides of one triangle, so long that the point touches its vertex
  Scene scene(3);
  scene.node(
      {-3.0081176757812501e+29, -3.01971435546875e+29, 1.525878906249698e+42});
  scene.node({1, -3.01971435546875e+29, 0});
  scene.node({0, 1, 0});
  scene.facet({0, 1, 2});
  scene.facet({0, 2, 1});
  Finder finder(scene.offsets, scene.nodes, 3);
  finder.refit(scene.x);
  const auto found = finder.find(
      scene.x, {2, -3.3216857910156249e+29, -39367.67578125}, {}, INFINITY);
  ASSERT_TRUE(found.selected.has_value());
  EXPECT_NE(found.selected->feature, geometry::interior);
  EXPECT_NEAR(norm(found.selected->normal), 1, 1e-12);
}
} // namespace
