// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#include "facing.h"
#include "polygons.h"
#include <contactx/geometry/clip.h>

using namespace contactx;
using namespace contactx::geometry;
using namespace contactx::tests;

namespace
{
using geometry::Quadrilateral;
using geometry::Triangle;

double shared(const Overlap<2>& a, const Overlap<2>& b)
{
  const auto c = clip(a, b);
  return area(Polygon<2>(c.corner.begin(), c.corner.begin() + c.size));
}

/// Either cuts the other alike, though a corner of `s` is turned by rounding.
template <class M>
void expect_alike(const Flat<Quadrilateral>& s, const Flat<M>& m, double size)
{
  const auto a = outline<Quadrilateral>(s), b = outline<M>(m);
  ASSERT_TRUE(is_convex<Quadrilateral>(s));
  EXPECT_GT(shared(a, b), 0.01 * size * size);
  EXPECT_NEAR(shared(a, b), shared(b, a), 1e-12 * size * size);
}

TEST(RoundedFacets, NodesThatCoincideButForRounding)
{
  expect_alike<Triangle>({{{-2, -0.75},
                           {0.33333333333333348, 0.33333333333333348},
                           {-2, -0.25},
                           {0.33333333333333348, 0.33333333333333331}}},
                         {{{-0.5, -0.5}, {0.5, -0.5}, {-0.5, 0.5}}}, 1);
}

TEST(RoundedFacets, ThreeNodesOnALineButForRounding)
{
  // The shorter of the edges that meet there is no millionth of the other
  for (const double turn : {1e-9, 1e-10, 1e-11})
    expect_alike<Quadrilateral>(
        {{{turn, -2}, {-2, -0.5}, {0, 0}, {0, 3e-5}}},
        {{{-0.5, -0.5}, {0.5, -0.5}, {-0.5, 0.5}, {0.9, 1}}}, 1);
}

TEST(RoundedFacets, MasterSoLongThatItsAreaIsLost)
{
  const Scene slave = single<Triangle>(
      {{{1, 2, 0.5}, {-1523.875, -1523.875, -1525.375}, {2, 1, 0.5}}});
  for (const double height : {1e10, 1e20, 3.5935974121093748e41})
  {
    const Scene master = single<Triangle>(
        {{{-1523.875, -1525.875, height}, {2, 1, 0}, {1, 1, 0}}});
    const Facing scene(slave, master);
    const auto found = scene.integrals(scene.all_pairs());
    for (const auto& values : {found.weight, found.gap, found.dual, found.area})
      for (const double value : values)
        EXPECT_TRUE(std::isfinite(value));
  }
}

TEST(RoundedFacets, QuadrilateralsWhoseInverseRoundingLoses)
{
  const Facing scene(
      single<Triangle>({{{-1525.87890625, -1524.87890625, -1779174.416452206},
                         {1, 0.6875, 0.075735294027253985},
                         {-1524.87890625, 0, -0.11176470597274601}}}),
      single<Quadrilateral>({{{0, 1, 0},
                              {7843018.578125, 0.5, -0.5},
                              {-0.5, 1.5, -0.5},
                              {0.5, 1.5, -0.5}}}));
  const auto found = scene.integrals(scene.all_pairs());
  for (const auto& values : {found.weight, found.gap, found.dual, found.area})
    for (const double value : values)
      EXPECT_TRUE(std::isfinite(value));
}
} // namespace
