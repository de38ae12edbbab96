// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#include "expect.h"
#include "facing.h"
#include "mortar_reference.h"
#include <contactx/geometry/projection_plane.h>
#include <contactx/geometry/segment.h>
#include <numeric>
#include <set>

using namespace contactx;
using namespace contactx::geometry;
using namespace contactx::tests;
using search::contains;

namespace
{
/// @brief Area that two facets share as seen from the slave facet, none where
/// they do not look at one another.
/// @param[in] size What the slave facet is scaled with.
template <class S, class M>
double common_area(const geometry::Nodes<S>& xs, const geometry::Nodes<M>& xm,
                   double reach, double size = 1)
{
  const auto n = geometry::frame<S>(xs, geometry::plane_origin<S>()).n;
  if (dot(n, geometry::frame<M>(xm, geometry::plane_origin<M>()).n) > -0.1)
    return 0;
  const auto middle = position<S>(xs, geometry::plane_origin<S>());
  double low = 0, high = 0, nearest = INFINITY, farthest = -INFINITY;
  for (const auto& p : xs)
  {
    low = std::min(low, dot(n, p - middle));
    high = std::max(high, dot(n, p - middle));
  }
  for (const auto& p : xm)
  {
    nearest = std::min(nearest, dot(n, p - middle));
    farthest = std::max(farthest, dot(n, p - middle));
  }
  if (nearest > high + reach or farthest < low - reach)
    return 0;
  const Across<S::gdim> across(n);
  auto outline = across.template outline<S>(xs);
  geometry::Local<S> centre{};
  for (const auto& p : outline)
    centre = centre + (1.0 / outline.size()) * p;
  for (auto& p : outline)
    p = p + (size - 1) * (p - centre);
  return area(shared(outline, across.template outline<M>(xm)));
}

/// @brief Whether a facet is no simple polygon, or none that is convex, as seen
/// from another one.
template <class S, class M>
bool looks_folded(const geometry::Nodes<S>& xs, const geometry::Nodes<M>& xm)
{
  if constexpr (M::nodes < 4)
    return false;
  else
  {
    const Across<3> across(
        geometry::frame<S>(xs, geometry::plane_origin<S>()).n);
    const auto p = across.template outline<M>(xm);
    bool left = true;
    for (int i = 0; i < 4; ++i)
      left = left and turn(p[i], p[(i + 1) % 4], p[(i + 2) % 4]) > 0;
    return !left;
  }
}

/// @brief What must be found: 1 if they share an area, 0 if they are apart, -1
/// where rounding decides.
template <class S, class M>
int must_be_found(const geometry::Nodes<S>& xs, const geometry::Nodes<M>& xm,
                  double reach)
{
  if (looks_folded<S, M>(xs, xm))
    return 0;
  if (common_area<S, M>(xs, xm, reach) > 1e-12)
    return 1;
  return common_area<S, M>(xs, xm, reach, 1 + 1e-9) > 0 ? -1 : 0;
}

using Pairs = std::set<std::pair<std::int32_t, std::int32_t>>;

Pairs set_of(const FacetPairs& pairs)
{
  Pairs all;
  for (std::size_t i = 0; i < pairs.size(); ++i)
    all.emplace(pairs.slave[i], pairs.master[i]);
  EXPECT_EQ(all.size(), pairs.size());
  return all;
}

/// The search without a tree.
void expect_brute_force(const Facing& scene, double reach)
{
  const Pairs found = set_of(scene.find(reach));
  const auto slave = scene.slave.facets(), master = scene.master.facets();
  int expected = 0;
  for (std::int32_t f = 0; f < slave.size(); ++f)
    for (std::int32_t g = 0; g < master.size(); ++g)
    {
      const int must = geometry::visit(
          slave[f].size(), master[g].size(),
          [&]<class S, class M>(S, M)
          {
            return must_be_found<S, M>(gather<S>(slave[f], scene.x),
                                       gather<M>(master[g], scene.x), reach);
          });
      if (must >= 0)
      {
        EXPECT_EQ(found.contains({f, g}), must) << f << " " << g;
      }
      expected += must > 0;
    }
  EXPECT_GT(expected, 0);
}

/// Surfaces of some kind over one another, the slave's above.
Facing waves(int gdim, Cells cells, double turn, double wave)
{
  const auto at = [=](double height, double phi)
  {
    return [=](double s, double t)
    {
      const double c = std::cos(phi), d = std::sin(phi);
      const double z = height + wave * std::sin(3 * s) * std::cos(4 * t);
      return gdim == 2 ? Vector<3>{s, z, 0}
                       : Vector<3>{c * s - d * t, d * s + c * t, z};
    };
  };
  return {sheet(gdim, 6, cells, false, -0.9, 1.1, at(0.1, turn)),
          sheet(gdim, 5, cells, true, -1, 1, at(0, 0))};
}

TEST_2D_3D(FacetSearch, FindsWhatALoopFinds, gdim)
{
  for (const Cells cells :
       {Cells::triangles, Cells::quadrilaterals, Cells::mixed})
    for (const double turn : {0., 0.3, 0.785})
      for (const double wave : {0., 0.1, 0.25})
      {
        const Facing scene = waves(gdim, cells, turn, wave);
        expect_brute_force(scene, 10);
        expect_brute_force(scene, 0.12);
      }
}

TEST(FacetSearch, FindsWhatALoopFindsOfFacetsAnywhere)
{
  // One master facet each, so that there are no layers
  Generator random(1);
  int found = 0, folded = 0;
  for (int i = 0; i < 4000; ++i)
  {
    const double reach = i % 2 ? 10 : 0.2;
    geometry::for_all_kinds(
        [&]<class S, class M>(S, M)
        {
          const auto xs = random_facet<S>(random, 0.1);
          auto xm = random_facet<M>(random, 0.1);
          const auto d = position<S>(xs, geometry::plane_origin<S>())
                         - position<M>(xm, geometry::plane_origin<M>());
          for (auto& p : xm) // into reach
            p = p + 0.9 * d;
          const Facing scene(single<S>(xs), single<M>(xm));
          const int must = must_be_found<S, M>(xs, xm, reach);
          if (must >= 0)
          {
            EXPECT_EQ(scene.find(reach).size(), std::size_t(must));
          }
          found += must > 0;
          folded += looks_folded<S, M>(xs, xm);
        });
  }
  EXPECT_GT(folded, 10);
  EXPECT_GT(found, 4000);
}

TEST_2D_3D(FacetSearch, ReachesSoFar, gdim)
{
  for (const double height : {0.5, -0.5}) // apart, and penetrated
  {
    const Facing scene(
        sheet(gdim, 1, Cells::mixed, false, 0, 1, level(gdim, height)),
        sheet(gdim, 1, Cells::mixed, true, 0, 1, level(gdim, 0)));
    EXPECT_EQ(scene.find(0.499).size(), 0u);
    EXPECT_GT(scene.find(0.501).size(), 0u);
    EXPECT_EQ(scene.find(infinity), scene.find(0.501));
  }
}

TEST_2D_3D(FacetSearch, FindsWhatIsInFrontAlongOtherDirections, gdim)
{
  const Facing scene = waves(gdim, Cells::mixed, 0.3, 0.1);
  const FacetPairs all = scene.all_pairs();
  std::vector<double> along = scene.integrals(all, scene.x).normal;
  for (std::size_t f = 0; f < along.size() / 3; ++f)
  {
    // Of every second facet: tilted
    Vector<3> n = vector_at(along, f, 3) + Vector<3>{f % 2 ? 1.0 : 0.0, 0, 0};
    n = (1 / norm(n)) * n;
    std::ranges::copy(n, along.begin() + 3 * static_cast<std::ptrdiff_t>(f));
  }
  const Pairs along_normals = set_of(scene.find()),
              found = set_of(scene.search().find(scene.x, 10, 0, false, along));
  const Integrals shared = scene.integrals(all, scene.x, along);
  const std::size_t n = shared.weight.size() / all.size();
  int others = 0;
  for (std::size_t p = 0; p < all.size(); ++p)
  {
    const auto first
        = shared.weight.begin() + static_cast<std::ptrdiff_t>(n * p);
    if (std::accumulate(first, first + static_cast<std::ptrdiff_t>(n), 0.0)
        < 1e-12)
      continue;
    const std::pair pair{all.slave[p], all.master[p]};
    EXPECT_TRUE(found.contains(pair));
    others += not along_normals.contains(pair);
  }
  EXPECT_GT(others, 0);
}

TEST(FacetSearch, FindsFacetsThatFaceEachOther)
{
  // A master facet that is tilted by an angle
  const auto found = [](double degrees)
  {
    const double phi = degrees * std::numbers::pi / 180;
    const Facing scene(
        sheet(3, 1, Cells::quadrilaterals, false, -1, 1, level(3, 0)),
        sheet(3, 1, Cells::quadrilaterals, true, -1, 1,
              [phi](double s, double t)
              { return Vector<3>{std::cos(phi) * s, t, std::sin(phi) * s}; }));
    return scene.find().size() > 0;
  };
  EXPECT_TRUE(found(0));
  EXPECT_TRUE(found(-60));
  EXPECT_TRUE(found(84)); // the cosine is at least 0.1
  EXPECT_FALSE(found(85));
  EXPECT_FALSE(found(90));
  EXPECT_FALSE(found(120));
  EXPECT_FALSE(found(180)); // looks the same way
}

TEST_2D_3D(FacetSearch, LooksBeyondAFacetsEdges, gdim)
{
  // The master begins at a distance of 0.1 of a slave facet of size 1
  const Facing scene(
      sheet(gdim, 1, Cells::quadrilaterals, false, 0, 1, level(gdim, 0)),
      sheet(
          gdim, 1, Cells::quadrilaterals, true, 1.1, 2,
          [gdim](double s, double t)
          { return gdim == 2 ? Vector<3>{s, 0, 0} : Vector<3>{s, t - 1, 0}; }));
  EXPECT_EQ(scene.find(1, 0.19).size(), 0u);
  EXPECT_EQ(scene.find(1, 0.21).size(), 1u);
}

TEST(FacetSearch, FollowsMovingFacets)
{
  Facing scene = waves(3, Cells::mixed, 0.2, 0.1);
  search::FacetSearch search = scene.search();
  const std::size_t slaves = scene.slave.x.size();
  std::set<std::size_t> numbers;
  for (int i = 0; i < 6; ++i)
  {
    const FacetPairs pairs = search.find(scene.x, 1, 0.1);
    EXPECT_EQ(pairs, scene.find(1, 0.1));
    EXPECT_GT(pairs.size(), 0u);
    numbers.insert(pairs.size());
    // The slave surface and the master in turn, both to the right
    for (std::size_t j = i % 2 ? 0 : slaves;
         j < (i % 2 ? slaves : scene.x.size()); j += 3)
      scene.x[j] += i % 2 ? 0.2 : 0.7;
  }
  EXPECT_GT(numbers.size(), 3u);
}

TEST(FacetSearch, NeedsFacetsOfItsDimension)
{
  using search::FacetSearch;
  EXPECT_REFUSED(FacetSearch({0, 2}, {0, 1}, {0, 3}, {2, 3, 4}, 3));
  EXPECT_REFUSED(FacetSearch({0, 3}, {0, 1, 2}, {0, 2}, {3, 4}, 3));
  EXPECT_REFUSED(FacetSearch({0, 3}, {0, 1, 2}, {0, 2}, {3, 4}, 2));
}

TEST(FacetSearch, TakesEmptySurfaces)
{
  const Scene some = sheet(3, 2, Cells::mixed, false, 0, 1, level(3, 0));
  EXPECT_EQ(Facing(some, Scene(3)).find().size(), 0u);
  EXPECT_EQ(Facing(Scene(3), some).find().size(), 0u);
  EXPECT_EQ(Facing(Scene(3), Scene(3)).find().size(), 0u);
}

TEST(Contains, KnowsEachPair)
{
  const FacetPairs all{{0, 0, 1, 3}, {2, 5, 2, 0}};
  EXPECT_TRUE(contains(all, all));
  EXPECT_TRUE(contains(all, {}));
  EXPECT_TRUE(contains({}, {}));
  EXPECT_FALSE(contains({}, all));
  for (std::size_t i = 0; i < all.size(); ++i)
  {
    const FacetPairs one{{all.slave[i]}, {all.master[i]}};
    EXPECT_TRUE(contains(all, one));
    EXPECT_FALSE(contains(one, all));
    EXPECT_FALSE(contains(all, {{all.slave[i]}, {all.master[i] + 1}}));
    EXPECT_FALSE(contains(all, {{all.slave[i] + 1}, {all.master[i] + 3}}));
    FacetPairs rest = all;
    rest.slave.erase(rest.slave.begin() + i);
    rest.master.erase(rest.master.begin() + i);
    EXPECT_TRUE(contains(all, rest));
    EXPECT_FALSE(contains(rest, all));
  }
}
} // namespace
