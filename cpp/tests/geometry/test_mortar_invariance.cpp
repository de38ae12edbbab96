// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#include "facing.h"
#include "polygons.h"
#include <contactx/geometry/clip.h>
#include <ctime>

using namespace contactx;
using namespace contactx::geometry;
using namespace contactx::tests;

namespace
{
/// Wavy surfaces, the slave's partly covered.
Facing wavy(int gdim)
{
  const auto at = [gdim](double height)
  {
    return [gdim, height](double s, double t)
    {
      const double z = height + 0.05 * std::sin(4 * s) * std::cos(3 * t);
      return gdim == 2 ? Vector<3>{s, z, 0} : Vector<3>{s, t, z};
    };
  };
  return {sheet(gdim, 3, Cells::mixed, false, 0, 1, at(0.1)),
          sheet(gdim, 4, Cells::mixed, true, 0.12, 1.2, at(0))};
}

void expect_scaled(const std::vector<double>& a, const std::vector<double>& b,
                   double factor, double tolerance)
{
  ASSERT_EQ(a.size(), b.size());
  for (std::size_t i = 0; i < a.size(); ++i)
    EXPECT_NEAR(a[i], factor * b[i], factor * tolerance);
}

using MortarInvariance = testing::TestWithParam<int>;

TEST_P(MortarInvariance, RigidMotionsChangeNothing)
{
  const int gdim = GetParam();
  Generator random(1);
  const Facing scene = wavy(gdim);
  const auto pairs = scene.find();
  const auto found = scene.integrals(pairs);
  for (int i = 0; i < 10; ++i)
  {
    Facing moved = scene;
    const Motion<3> motion(random, 5);
    const Motion<2> in_plane(random, 5);
    const auto rotate = [&](const Vector<3>& v)
    {
      if (gdim == 3)
        return motion.rotate(v);
      const auto w = in_plane.rotate({v[0], v[1]});
      return Vector<3>{w[0], w[1], 0};
    };
    const Vector<3> shift = motion.shift;
    moved.move([&](const Vector<3>& p) { return shift + rotate(p); });
    EXPECT_EQ(moved.find(), pairs);
    const auto other = moved.integrals(pairs);
    expect_scaled(other.area, found.area, 1, 1e-13);
    expect_scaled(other.weight, found.weight, 1, 1e-10);
    expect_scaled(other.dual, found.dual, 1, 1e-8);
    expect_scaled(other.gap, found.gap, 1, 1e-11);
    for (std::size_t f = 0; f < found.normal.size() / 3; ++f)
      EXPECT_LT(norm(vector_at(other.normal, f, 3)
                     - rotate(vector_at(found.normal, f, 3))),
                1e-13);
  }
}

TEST_P(MortarInvariance, LengthsScaleEverything)
{
  const int gdim = GetParam();
  const Facing scene = wavy(gdim);
  const auto pairs = scene.find(0.5, 0.1);
  const auto found = scene.integrals(pairs);
  for (const double length : {1e-6, 1e-3, 1e3, 1e6})
  {
    Facing scaled = scene;
    scaled.move([length](const Vector<3>& p) { return length * p; });
    EXPECT_EQ(scaled.find(0.5 * length, 0.1), pairs);
    const auto other = scaled.integrals(pairs);
    const double area = std::pow(length, gdim - 1);
    expect_scaled(other.area, found.area, area, 1e-13);
    expect_scaled(other.weight, found.weight, area, 1e-10);
    expect_scaled(other.gap, found.gap, area * length, 1e-11);
    expect_scaled(other.dual, found.dual, 1, 1e-8);
    expect_scaled(other.normal, found.normal, 1, 1e-14);
  }
}

TEST_P(MortarInvariance, FacetsFarFromTheOriginKeepTheirDigits)
{
  const int gdim = GetParam();
  const Facing scene = wavy(gdim);
  Facing far = scene;
  far.move([](const Vector<3>& p) { return p + Vector<3>{1e4, -1e4, 1e4}; });
  const auto pairs = scene.find();
  EXPECT_EQ(far.find(), pairs);
  const auto found = scene.integrals(pairs), other = far.integrals(pairs);
  expect_scaled(other.area, found.area, 1, 1e-11);
  expect_scaled(other.weight, found.weight, 1, 1e-8);
}

TEST_P(MortarInvariance, AFacetCoveredBelowTheLeastPartHasZeros)
{
  const int gdim = GetParam();
  for (const double part : {0.9, 1.1})
    for (const Cells cells : {Cells::triangles, Cells::quadrilaterals})
    {
      // The master ends so that it covers a strip along an edge. One of two
      // triangles has that edge, the other one just a tip there
      const bool triangles = gdim == 3 and cells == Cells::triangles;
      const double width
          = part * geometry::covered_fraction_min * (triangles ? 0.5 : 1);
      const Facing scene(sheet(gdim, 1, cells, false, 0, 1, level(gdim, 0.1)),
                         sheet(gdim, 1, cells, true, -1, 1,
                               [gdim, width](double s, double t)
                               {
                                 const double x = s > 0 ? width : s;
                                 return gdim == 2 ? Vector<3>{x, 0, 0}
                                                  : Vector<3>{x, 2 * t, 0};
                               }));
      const auto pairs = scene.find();
      ASSERT_GT(pairs.size(), 0u);
      const auto found = scene.integrals(pairs);
      const double tip = triangles ? 0.5 * width * width : 0;
      const double expected = part > 1 ? width - tip : 0;
      double area = 0, weights = 0;
      for (const double a : found.area)
        area += a;
      for (const double w : found.weight)
        weights += w;
      EXPECT_NEAR(area, expected, 1e-14);
      EXPECT_NEAR(weights, expected, 1e-13);
      for (const auto& values : {found.weight, found.gap, found.dual})
        EXPECT_EQ(std::ranges::count(values, 0.0) < std::ssize(values),
                  part > 1);
    }
}

INSTANTIATE_TEST_SUITE_P(Dimensions, MortarInvariance, testing::Values(2, 3));

const double nan = std::nan("");

/// Two flat squares, the slave's above.
Facing squares(int gdim, int n, Cells cells)
{
  return {sheet(gdim, n, cells, false, 0, 1, level(gdim, 0.1)),
          sheet(gdim, n + 1, cells, true, -0.1, 1.2, level(gdim, 0))};
}

/// The pairs without one slave or master facet.
FacetPairs without(const FacetPairs& pairs, std::int32_t slave,
                   std::int32_t master)
{
  FacetPairs rest;
  for (std::size_t i = 0; i < pairs.size(); ++i)
    if (pairs.slave[i] != slave and pairs.master[i] != master)
    {
      rest.slave.push_back(pairs.slave[i]);
      rest.master.push_back(pairs.master[i]);
    }
  return rest;
}

bool all_finite(const geometry::Integrals& found)
{
  for (const auto& values : {found.weight, found.gap, found.dual, found.area})
    for (const double c : values)
      if (!std::isfinite(c))
        return false;
  return true;
}

/// Seconds of the processor.
double seconds(auto&& f)
{
  const std::clock_t begin = std::clock();
  f();
  return double(std::clock() - begin) / CLOCKS_PER_SEC;
}

/// What is wrong with a facet: gives the position of node `k` that ought to be
/// at `p`.
using Spoil = Vector<3> (*)(const Vector<3>& p, int k);

class Spoiled : public testing::TestWithParam<Spoil>
{
protected:
  /// Surfaces with one more facet of nodes of its own, in the midst of them.
  static Facing with_one_more(bool of_slave, int num_nodes)
  {
    const int gdim = num_nodes == 2 ? 2 : 3;
    Scene slave = sheet(gdim, 3, Cells::mixed, false, 0, 1, level(gdim, 0.1));
    Scene master
        = sheet(gdim, 3, Cells::mixed, true, -0.1, 1.2, level(gdim, 0));
    Scene& scene = of_slave ? slave : master;
    std::vector<std::int32_t> nodes;
    for (int k = 0; k < num_nodes; ++k)
    {
      Vector<3> p{0.4 + 0.2 * (k % 2), gdim == 2 ? 0 : 0.4 + 0.2 * (k / 2), 0};
      // Looks up, like a master facet, or down
      if (of_slave)
        p[0] = 1 - p[0];
      nodes.push_back(scene.node(GetParam()(p, k)));
    }
    scene.facet(nodes);
    return {slave, master};
  }
};

TEST_P(Spoiled, FacetIsInNoPairAndHarmsNoOther)
{
  for (const bool of_slave : {true, false})
    for (const int num_nodes : {2, 3, 4})
    {
      const Facing scene = with_one_more(of_slave, num_nodes);
      const Facing clean = [&]
      {
        Facing c = scene;
        Scene& one = of_slave ? c.slave : c.master;
        one.offsets.pop_back();
        one.nodes.resize(one.offsets.back());
        return c;
      }();
      for (const double margin : {0., 0.5})
      {
        const auto pairs = clean.find(10, margin);
        EXPECT_GT(pairs.size(), 2u);
        EXPECT_EQ(scene.find(10, margin), pairs);
      }
      // Nor where the pairs are those of before
      const auto found = scene.integrals(scene.all_pairs());
      auto area = clean.integrals(clean.all_pairs()).area;
      EXPECT_TRUE(all_finite(found));
      area.insert(area.end(), found.area.begin() + area.size(),
                  found.area.end());
      EXPECT_EQ(found.area, area);
    }
}

INSTANTIATE_TEST_SUITE_P(
    Facets, Spoiled,
    testing::Values(
        // A point, nowhere, partly nowhere, infinite, a line
        +[](const Vector<3>&, int) { return Vector<3>{0.5, 0.05, 0}; },
        +[](const Vector<3>&, int) { return Vector<3>{nan, nan, nan}; },
        +[](const Vector<3>& p, int k)
        { return k == 0 ? Vector<3>{nan, nan, nan} : p; },
        +[](const Vector<3>& p, int k)
        { return k == 1 ? Vector<3>{p[0], nan, p[2]} : p; },
        +[](const Vector<3>& p, int k)
        { return k == 0 ? Vector<3>{INFINITY, p[1], p[2]} : p; },
        +[](const Vector<3>& p, int)
        { return Vector<3>{0.5, p[0] + p[1], 0}; }));

TEST(DegenerateSurfaces, WithFacetsThatAreLines)
{
  Facing scene = squares(3, 3, Cells::mixed);
  const auto pairs = scene.find();
  // One master and one slave facet, whose neighbours stretch
  for (const Scene* one : {&scene.master, &scene.slave})
  {
    const auto nodes = one->facets()[3];
    for (const std::int32_t node : nodes)
      scene.x[3 * node] = scene.x[3 * nodes[0]];
  }
  const auto found = scene.find();
  EXPECT_EQ(without(found, 3, 3), found);
  EXPECT_GT(found.size(), 10u);
  EXPECT_TRUE(all_finite(scene.integrals(found)));
  EXPECT_TRUE(all_finite(scene.integrals(pairs)));
}

TEST(DegenerateSurfaces, QuadrilateralsThatAreTriangles)
{
  // Two nodes in one place or three on a line, in turn
  for (const double at : {0., 0.5})
  {
    const auto collapsed = [at](bool up, double z)
    {
      geometry::Nodes<geometry::Quadrilateral> x{
          {{0, 0, z}, {1, 0, z}, {0, 1, z}, {at, 1 - at, z}}};
      return up ? x : turned<geometry::Quadrilateral>(x);
    };
    const Scene square
        = sheet(3, 1, Cells::quadrilaterals, true, -1, 2, level(3, 0));
    const Scene below
        = sheet(3, 1, Cells::quadrilaterals, false, -1, 2, level(3, 0.1));
    for (const Facing& scene :
         {Facing(single<geometry::Quadrilateral>(collapsed(false, 0.1)),
                 square),
          Facing(below, single<geometry::Quadrilateral>(collapsed(true, 0)))})
    {
      const auto pairs = scene.find();
      ASSERT_EQ(pairs.size(), 1u);
      const auto found = scene.integrals(pairs);
      double area = 0, gap = 0;
      Vector<3> moment{};
      for (int s = 0; s < most_nodes; ++s)
      {
        area += found.area[s];
        gap += found.gap[s];
        for (int l = 0; l < most_nodes; ++l)
          moment = moment
                   + weight(found, 0, s, l)
                         * scene.point(scene.master.facets()[0][l]);
      }
      EXPECT_NEAR(area, 0.5, 1e-10);
      EXPECT_NEAR(gap, 0.05, 1e-10);
      EXPECT_NEAR(moment[0], 0.5 / 3, 1e-8);
      EXPECT_NEAR(moment[1], 0.5 / 3, 1e-8);
    }
  }
}

TEST(DegenerateSurfaces, QuadrilateralsOfAnyShapeGiveNumbers)
{
  // Folded, crossed, warped beyond measure
  Generator random(1);
  const Facing scene(
      sheet(3, 1, Cells::quadrilaterals, false, 0, 1, level(3, 0)),
      sheet(3, 1, Cells::quadrilaterals, true, 0, 1, level(3, 0)));
  int covered = 0;
  for (int i = 0; i < 1000; ++i)
  {
    Facing wild = scene;
    const double size = i % 4 * 0.3;
    wild.move([&](const Vector<3>& p)
              { return p + random.vector<3>(-size, size); });
    const auto found = wild.integrals(wild.all_pairs());
    EXPECT_TRUE(all_finite(found));
    double whole = 0;
    for (int s = 0; s < most_nodes; ++s)
      whole += found.area[s];
    covered += whole > 0;
    for (const double w : found.weight)
      EXPECT_LT(std::abs(w), 10);
  }
  EXPECT_GT(covered, 500);
}

TEST(DegenerateSurfaces, WithoutPositionsTakeNoTime)
{
  Facing scene = squares(3, 120, Cells::triangles);
  search::FacetSearch search = scene.search();
  const auto find = [&] { return search.find(scene.x, 1, 0.1).size(); };
  const double usual = seconds([&] { EXPECT_GT(find(), 100000u); });
  const std::vector<double> x = scene.x;
  const auto slaves = scene.x.begin() + scene.slave.x.size();
  std::fill(scene.x.begin(), slaves, nan);
  EXPECT_LT(seconds([&] { EXPECT_EQ(find(), 0u); }), usual);
  scene.x = x;
  std::fill(slaves, scene.x.end(), nan);
  EXPECT_LT(seconds([&] { EXPECT_EQ(find(), 0u); }), usual);
  std::ranges::fill(scene.x, nan);
  EXPECT_LT(seconds([&] { EXPECT_EQ(find(), 0u); }), usual);
  // And are found again
  scene.x = x;
  EXPECT_GT(find(), 100000u);
}

double area_of_both(const Overlap<2>& a, const Overlap<2>& b)
{
  const auto c = clip(a, b);
  return area(Polygon<2>(c.corner.begin(), c.corner.begin() + c.size));
}

/// Either cuts the other alike, though a corner of `s` is turned by
/// rounding.
template <class M>
void expect_alike(const Flat<Quadrilateral>& s, const Flat<M>& m, double size)
{
  const auto a = outline<Quadrilateral>(s), b = outline<M>(m);
  ASSERT_TRUE(is_convex<Quadrilateral>(s));
  EXPECT_GT(area_of_both(a, b), 0.01 * size * size);
  EXPECT_NEAR(area_of_both(a, b), area_of_both(b, a), 1e-12 * size * size);
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
    EXPECT_TRUE(all_finite(scene.integrals(scene.all_pairs()))) << height;
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
  EXPECT_TRUE(all_finite(scene.integrals(scene.all_pairs())));
}
} // namespace
