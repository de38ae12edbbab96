// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#include "random_scenes.h"
#include "threads.h"
#include <contactx/geometry/middle.h>
#include <contactx/search/distributed.h>
#include <contactx/search/facet_search.h>
#include <contactx/search/inside_test.h>
#include <contactx/search/slave_facets.h>
#include <set>

using namespace contactx;
using namespace contactx::tests;
using mesh::Halo;
using search::MasterSurface;

namespace
{
using Name = std::vector<std::int64_t>;

/// What is known of a point, whoever found it
struct Answer
{
  Name facet; ///< numbers of its nodes in the mesh, none for none
  std::int32_t feature;
  double distance, gap;
  std::vector<double> xi, normal;

  bool operator==(const Answer&) const = default;
};

std::ostream& operator<<(std::ostream& out, const Answer& a)
{
  out << "distance " << a.distance << ", gap " << a.gap << ", feature "
      << a.feature << ", facet";
  for (const std::int64_t n : a.facet)
    out << " " << n;
  return out;
}

/// Numbers of a facet's nodes in the mesh as it was made
Name names(const Scene& scene, const DistributedScene& parts, std::int32_t f)
{
  Name name;
  for (const std::int32_t node : scene.facets()[f])
    name.push_back(parts.nodes.original[node]);
  name.resize(4, -1);
  return name;
}

Name name_of(const MasterSurface& surface, std::int32_t facet)
{
  const Name name = surface.names(std::vector{facet});
  return facet < 0 ? Name{} : name;
}

/// Names of all facets that pairs may be with
std::vector<Name> known(const MasterSurface& surface)
{
  std::vector<Name> names;
  for (std::int32_t f = 0; f < surface.facets().size(); ++f)
    names.push_back(name_of(surface, f));
  std::ranges::sort(names);
  return names;
}

/// Own facets in order, as contact takes them
geometry::Facets part(const DistributedScene& scene, const Halo& halo,
                      std::int32_t begin, std::int32_t end)
{
  const geometry::Facets own = scene.own(halo, begin, end);
  return search::in_order(halo, own.offsets, own.nodes);
}

std::shared_ptr<MasterSurface> surface_of(const DistributedScene& scene,
                                          std::shared_ptr<Halo> halo,
                                          std::int32_t begin, std::int32_t end)
{
  const geometry::Facets own = part(scene, *halo, begin, end);
  return search::make_master_surface(std::move(halo), own.offsets, own.nodes);
}

struct Points
{
  std::vector<double> points, normals;
};

Points of_rank(const Points& all, const mesh::Ranks& ranks, int gdim)
{
  Points mine;
  for (std::size_t i = 0; i * gdim < all.points.size(); ++i)
    if (static_cast<int>(i) % ranks.size() == ranks.rank())
      for (int k = 0; k < gdim; ++k)
      {
        mine.points.push_back(all.points[i * gdim + k]);
        mine.normals.push_back(all.normals[i * gdim + k]);
      }
  return mine;
}

Points random_points(const Scene& scene, Generator& random, int n)
{
  Points p;
  for (int i = 0; i < n; ++i)
  {
    const Vector<3> point = random_query(scene, random, i);
    Vector<3> normal{};
    if (i % 3 != 0)
      normal = random.unit<3>();
    if (scene.gdim == 2)
      normal[2] = 0;
    p.points.insert(p.points.end(), point.begin(), point.begin() + scene.gdim);
    p.normals.insert(p.normals.end(), normal.begin(),
                     normal.begin() + scene.gdim);
  }
  return p;
}

/// A wavy master, and a slave above it that is turned to it
Scene two_sides(Generator& random, Cells cells, int gdim,
                std::int32_t& num_master)
{
  const double wave = random(0, 0.15), gap = random(-0.05, 0.1);
  Scene scene(gdim);
  const auto bottom = [wave](double s, double t)
  { return wave * std::sin(7 * s) * std::cos(5 * t); };
  if (gdim == 2)
  {
    scene = line(13, [&](double s) { return Vector<3>{s, bottom(s, 0), 0}; });
    for (std::size_t i = 0; i < scene.nodes.size(); i += 2)
      std::swap(scene.nodes[i], scene.nodes[i + 1]);
    num_master = scene.facets().size();
    scene.join(line(9, [gap](double s)
                    { return Vector<3>{s, gap + 0.1 * s * s, 0}; }));
    return scene;
  }
  const Scene low = grid(6, cells, [&](double s, double t)
                         { return Vector<3>{s, t, bottom(s, t)}; });
  // Mirrored, so that it faces down
  const Scene high = grid(5, cells, [&](double s, double t)
                          { return Vector<3>{1.1 - s, t, gap + 0.1 * s * t}; });
  scene = low;
  num_master = low.facets().size();
  scene.join(high);
  return scene;
}

std::vector<Answer> found(const DistributedScene& scene, const Points& points,
                          double reach)
{
  const int gdim = scene.scene.gdim;
  std::vector<Answer> answers(points.points.size() / gdim);
  const auto work = [&](ThreadRanks& ranks)
  {
    const auto halo = scene.halo(ranks);
    const auto surface
        = surface_of(scene, halo, 0, scene.scene.facets().size());
    const Points mine = of_rank(points, ranks, gdim);
    const auto x = halo->now()->x;
    const search::Found found
        = surface->find(x, mine.points, mine.normals, reach);
    for (std::size_t k = 0; k < found.facet.size(); ++k)
      answers[k * ranks.size() + ranks.rank()]
          = {name_of(*surface, found.facet[k]),
             found.feature[k],
             found.distance[k],
             found.gap[k],
             {found.xi.begin() + 2 * k, found.xi.begin() + 2 * k + 2},
             {found.normal.begin() + 3 * k, found.normal.begin() + 3 * k + 3}};
  };
  on_ranks(scene.nodes.num_ranks, work);
  return answers;
}

using SurfaceOnRanks = testing::TestWithParam<int>;
} // namespace

TEST_P(SurfaceOnRanks, FindsWhatOneRankFinds)
{
  Generator random(1);
  for (const Kind kind : all_kinds())
  {
    // Of which one rank alone has several that nothing tells apart
    if (kind == Kind::coincident)
      continue;
    for (unsigned seed = 0; seed < 6; ++seed)
    {
      const Scene scene = random_scene(kind, random);
      const Points points = random_points(scene, random, 60);
      const double reach = seed == 0 ? infinity : random(0, 1);
      const auto expected
          = found(DistributedScene(scene, 1, seed, false), points, reach);
      const auto answers = found(
          DistributedScene(scene, GetParam(), seed, seed % 2), points, reach);
      for (std::size_t i = 0; i < answers.size(); ++i)
        EXPECT_EQ(answers[i], expected[i])
            << "of kind " << static_cast<int>(kind) << ", point " << i;
    }
  }
}

TEST_P(SurfaceOnRanks, PairsAreThoseOfOneRank)
{
  Generator random(2);
  for (unsigned seed = 0; seed < 9; ++seed)
  {
    std::int32_t num_master = 0;
    const int gdim = seed % 3 == 0 ? 2 : 3;
    const Scene scene = two_sides(
        random, seed % 2 ? Cells::mixed : Cells::triangles, gdim, num_master);
    const Vector<3> way = random.vector<3>(-0.1, 0.1);
    // Facets of the slave nodes after each search, and changes of all ranks
    const auto pairs = [&](int num_ranks)
    {
      const DistributedScene parts(scene, num_ranks, seed, seed % 2);
      std::map<std::pair<int, std::int64_t>, Answer> result;
      std::mutex mutex;
      const auto work = [&](ThreadRanks& ranks)
      {
        const auto halo = parts.halo(ranks);
        const auto own = part(parts, *halo, num_master, scene.facets().size());
        const auto slave = search::slave_facets(*halo, own.offsets, own.nodes);
        const auto surface = surface_of(parts, halo, 0, num_master);
        search::Pairing pairing(
            slave.offsets, slave.nodes,
            {surface->facets().offsets.begin(),
             surface->facets().offsets.end()},
            {surface->facets().nodes.begin(), surface->facets().nodes.end()},
            gdim, halo->num_owned());
        const std::vector<std::int8_t> closed(pairing.slaves().size(), 1);
        for (int step = 0; step < 5; ++step)
        {
          auto x = halo->now()->x;
          for (const std::int32_t node : slave.nodes)
            for (int k = 0; k < gdim; ++k)
              x[node * gdim + k]
                  = halo->reference()[node * gdim + k] + step * way[k];
          const auto changed = mesh::total(
              ranks, surface->pair(pairing, slave.list(), x, 0.3, closed));
          const std::lock_guard lock(mutex);
          result[{step, -1}].feature = changed;
          for (std::size_t i = 0; i < pairing.slaves().size(); ++i)
          {
            Answer& a = result[{step, halo->original()[pairing.slaves()[i]]}];
            a = {name_of(*surface, pairing.facet()[i]),
                 pairing.feature()[i],
                 0,
                 0,
                 {},
                 {}};
            if (pairing.facet()[i] < 0)
              continue;
            a.xi = {pairing.xi().begin() + 2 * i,
                    pairing.xi().begin() + 2 * i + 2};
            a.normal = {pairing.normal().begin() + 3 * i,
                        pairing.normal().begin() + 3 * i + 3};
          }
        }
      };
      on_ranks(num_ranks, work);
      return result;
    };
    const auto expected = pairs(1), result = pairs(GetParam());
    ASSERT_EQ(result.size(), expected.size());
    int paired = 0;
    for (const auto& [key, answer] : expected)
    {
      EXPECT_EQ(result.at(key), answer) << "seed " << seed << ", step "
                                        << key.first << ", node " << key.second;
      paired += !answer.facet.empty();
    }
    EXPECT_GT(paired, 10);
  }
}

TEST_P(SurfaceOnRanks, SlaveFacetsAreThoseAroundOwnNodes)
{
  Generator random(3);
  for (unsigned seed = 0; seed < 4; ++seed)
  {
    const Scene scene = random_scene(Kind::grid, random);
    const DistributedScene parts(scene, GetParam(), seed, seed % 2);
    const auto work = [&](ThreadRanks& ranks)
    {
      const auto halo = parts.halo(ranks);
      const auto own = part(parts, *halo, 0, scene.facets().size());
      const auto slave = search::slave_facets(*halo, own.offsets, own.nodes);
      std::vector<std::vector<std::int32_t>> expected, facets;
      for (std::int32_t f = 0; f < scene.facets().size(); ++f)
      {
        const auto nodes = scene.facets()[f];
        if (std::ranges::any_of(
                nodes, [&](std::int32_t node)
                { return parts.nodes.owner[node] == ranks.rank(); }))
          expected.emplace_back(nodes.begin(), nodes.end());
      }
      for (std::int32_t f = 0; f < slave.list().size(); ++f)
        facets.push_back(parts.mesh_nodes(*halo, slave.list()[f]));
      std::ranges::sort(expected);
      std::ranges::sort(facets);
      EXPECT_EQ(facets, expected);
      const std::int32_t here = halo->num_nodes();
      halo->shrink();
      EXPECT_EQ(halo->num_nodes(), here) << "they stay for good";
    };
    on_ranks(GetParam(), work);
  }
}

TEST_P(SurfaceOnRanks, LookingFindsAllFacetsInFront)
{
  Generator random(4);
  for (unsigned seed = 0; seed < 6; ++seed)
  {
    std::int32_t num_master = 0;
    const int gdim = seed % 3 == 0 ? 2 : 3;
    const Scene scene = two_sides(
        random, seed % 2 ? Cells::mixed : Cells::triangles, gdim, num_master);
    const double reach = random(0.02, 0.3), margin = seed % 2 ? 0.1 : 0;
    // All layers of all facets on one rank
    const auto first = scene.offsets.begin();
    const std::int32_t begin = scene.offsets[num_master];
    std::vector<std::int32_t> slave_offsets(first + num_master,
                                            scene.offsets.end());
    for (std::int32_t& offset : slave_offsets)
      offset -= begin;
    search::FacetSearch one(
        slave_offsets, {scene.nodes.begin() + begin, scene.nodes.end()},
        {first, first + num_master + 1},
        {scene.nodes.begin(), scene.nodes.begin() + begin}, gdim);
    // Along the facets' normals, or other directions
    const auto along
        = [&](const geometry::FacetList& slave, std::span<const double> x)
    {
      std::vector<double> directions;
      for (std::int32_t f = 0; seed % 3 == 1 and f < slave.size(); ++f)
      {
        Vector<3> n = geometry::corner_normals(slave[f], x).mean();
        n = Vector<3>{0.3, 0, 0} - (1 / norm(n)) * n;
        n = (1 / norm(n)) * n;
        directions.insert(directions.end(), n.begin(), n.end());
      }
      return directions;
    };
    const auto pairs
        = one.find(scene.x, reach, margin, true, along(one.slave(), scene.x));
    EXPECT_GT(pairs.size(), 5);
    const DistributedScene parts(scene, GetParam(), seed, seed % 2);
    const auto work = [&](ThreadRanks& ranks)
    {
      const auto halo = parts.halo(ranks);
      const auto own = part(parts, *halo, num_master, scene.facets().size());
      const auto surface = surface_of(parts, halo, 0, num_master);
      const int before = ranks.num_exchanges;
      const auto x = halo->now()->x;
      surface->add_facets_within(x, own.list(), reach, margin,
                                 along(own.list(), x));
      EXPECT_LE(ranks.num_exchanges - before, 2);
      std::set<Name> expected;
      for (std::size_t i = 0; i < pairs.size(); ++i)
        if (parts.facet_rank[num_master + pairs.slave[i]] == ranks.rank())
          expected.insert(names(scene, parts, pairs.master[i]));
      for (std::int32_t f = 0; f < num_master; ++f)
        if (ranks.size() == 1)
          expected.insert(names(scene, parts, f));
      EXPECT_EQ(known(*surface),
                (std::vector<Name>{expected.begin(), expected.end()}));
    };
    on_ranks(GetParam(), work);
  }
}

TEST_P(SurfaceOnRanks, NamesComeBackAfterTheHaloShrinks)
{
  Generator random(5);
  for (unsigned seed = 0; seed < 4; ++seed)
  {
    const Scene scene = random_scene(Kind::grid, random);
    const Points points = random_points(scene, random, 50);
    const DistributedScene parts(scene, GetParam(), seed, seed % 2);
    const auto work = [&](ThreadRanks& ranks)
    {
      const auto halo = parts.halo(ranks);
      const auto surface = surface_of(parts, halo, 0, scene.facets().size());
      const Points mine = of_rank(points, ranks, 3);
      const auto found
          = surface->find(halo->now()->x, mine.points, mine.normals, 2);
      const auto names = surface->names(found.facet);
      ASSERT_EQ(names.size(), 4 * found.facet.size());
      for (std::size_t i = 0; i < found.facet.size(); ++i)
        EXPECT_EQ(names[4 * i] < 0, found.facet[i] < 0);
      EXPECT_EQ(surface->named(names), found.facet);

      // Some are kept when the halo shrinks
      std::vector<std::int32_t> used = found.facet;
      for (std::size_t i = 0; i < used.size(); i += 2)
        used[i] = -1;
      const auto wanted = surface->names(used);
      const int version = surface->version();
      halo->shrink();
      const auto kept = surface->keep(used);
      EXPECT_EQ(surface->names(kept), wanted);
      if (ranks.size() > 1)
      {
        EXPECT_NE(surface->version(), version);
        std::vector<std::int32_t> sorted = kept;
        std::erase(sorted, -1);
        EXPECT_EQ(surface->facets().size(),
                  std::ssize(search::sorted_unique(sorted)));
      }
      // Those that were dropped are asked for again
      EXPECT_EQ(surface->names(surface->named(names)), names);

      // Of no facet, on one rank alone
      std::vector<std::int64_t> wrong = names;
      if (ranks.rank() == ranks.size() - 1)
        wrong.insert(wrong.end(), {0, 0, 0, 1});
      EXPECT_REFUSED(surface->named(wrong));
      if (ranks.rank() == ranks.size() - 1)
        wrong = {1, 2};
      EXPECT_REFUSED(surface->named(wrong));
      EXPECT_REFUSED(surface->names(std::vector{1000}));
    };
    on_ranks(GetParam(), work);
  }
}

TEST_P(SurfaceOnRanks, SurfaceIsKnownByItsFacets)
{
  Generator random(6);
  const Scene scene = random_scene(Kind::grid, random);
  const DistributedScene parts(scene, GetParam(), 1, true);
  std::vector<Name> all, expected;
  for (std::int32_t f = 0; f < scene.facets().size(); ++f)
    expected.push_back(names(scene, parts, f));
  double sum = 0;
  for (const std::int32_t node : scene.nodes)
    sum += static_cast<double>(parts.nodes.original[node]);
  std::mutex mutex;
  double nearest = 10;
  const auto work = [&](ThreadRanks& ranks)
  {
    const auto halo = parts.halo(ranks);
    const auto surface = surface_of(parts, halo, 0, scene.facets().size());
    const auto identity = surface->identity();
    std::vector<double> nodal(halo->original().begin(), halo->original().end());
    EXPECT_NEAR(surface->mean(nodal),
                sum / static_cast<double>(scene.nodes.size()), 1e-12);
    // A point far above on one rank alone; other ranks have none
    std::vector<double> point;
    if (ranks.rank() == ranks.size() - 1)
      point = {scene.x[0], scene.x[1], 7};
    const double distance = surface->distance(halo->now()->x, point);
    const std::lock_guard lock(mutex);
    nearest = std::min(nearest, distance);
    EXPECT_EQ(std::isinf(distance), point.empty());
    for (std::size_t i = 0; i < identity.size(); i += 4)
      all.emplace_back(identity.begin() + i, identity.begin() + i + 4);
  };
  on_ranks(GetParam(), work);
  std::ranges::sort(all);
  std::ranges::sort(expected);
  EXPECT_EQ(all, expected);
  EXPECT_NEAR(nearest, 7 - scene.x[2], 0.3);
}

TEST_P(SurfaceOnRanks, OnlookersSeeWhatOneRankSees)
{
  int compared = 0;
  Generator random(7);
  for (unsigned seed = 0; seed < 8; ++seed)
  {
    const Scene scene
        = random_scene(seed % 4 == 3 ? Kind::polygon : Kind::grid, random);
    if (scene.facets().size() < 3)
      continue;
    const int gdim = scene.gdim;
    const Points points = random_points(scene, random, 80);
    std::vector<double> u;
    for (std::size_t i = 0; i < scene.x.size(); ++i)
      u.push_back(random(-0.1, 0.1));
    const bool moves = seed % 2;
    const auto look = [&](int num_ranks, bool around)
    {
      const DistributedScene parts(scene, num_ranks, seed, false);
      const std::size_t n = points.points.size() / gdim;
      search::ProbeResult all(n, 2);
      const auto work = [&](ThreadRanks& ranks)
      {
        const auto halo = parts.halo(ranks, u);
        geometry::Facets own = part(parts, *halo, 0, scene.facets().size());
        if (around)
          own = search::slave_facets(*halo, own.offsets, own.nodes);
        const int version = halo->version();
        search::SurfaceProbe probe(halo, own.offsets, own.nodes);
        const Points mine = of_rank(points, ranks, gdim);
        std::vector<double> values;
        for (std::int32_t f = 0; f < own.list().size(); ++f)
        {
          double sum = 0;
          for (const std::int32_t node : own.list()[f])
            sum += static_cast<double>(halo->original()[node]);
          values.insert(values.end(), {sum, -sum});
        }
        const auto x0 = halo->reference();
        std::vector<double> nodal = halo->now()->x;
        for (std::size_t i = 0; i < nodal.size(); ++i)
          nodal[i] -= x0[i];
        std::optional<search::Displacements> ways;
        if (moves)
          ways = search::Displacements{nodal, mine.normals};
        const search::ProbeResult seen
            = probe.query(x0, mine.points, mine.normals, 1.2, values, 2, ways);
        EXPECT_EQ(halo->version(), version);
        for (std::size_t k = 0; k < seen.gap.size(); ++k)
        {
          const std::size_t i = k * ranks.size() + ranks.rank();
          all.distance[i] = seen.distance[k];
          all.gap[i] = seen.gap[k];
          all.height[i] = seen.height[k];
          all.inside[i] = seen.inside[k];
          all.margin[i] = seen.margin[k];
          all.displacement[i] = seen.displacement[k];
          std::copy_n(seen.values.begin() + 2 * k, 2,
                      all.values.begin() + 2 * i);
        }
      };
      on_ranks(num_ranks, work);
      return all;
    };
    const search::ProbeResult expected = look(1, false);
    for (const bool around : {false, true})
    {
      const search::ProbeResult seen = look(GetParam(), around);
      for (std::size_t i = 0; i < seen.gap.size(); ++i)
      {
        EXPECT_TRUE(seen.distance[i] == expected.distance[i]
                    or std::abs(seen.distance[i] - expected.distance[i])
                           <= 1e-14);
        // Next to an edge what is beyond counts, which another rank may have
        const bool clear = i % 4 == 0 and expected.inside[i]
                           and std::abs(expected.height[i])
                                   >= expected.distance[i] * (1 - 1e-12);
        if (GetParam() > 1 and not clear)
          continue;
        ++compared;
        if (std::isnan(expected.gap[i]))
        {
          EXPECT_TRUE(std::isnan(seen.gap[i]));
          continue;
        }
        EXPECT_EQ(seen.height[i], expected.height[i]);
        EXPECT_EQ(seen.values[2 * i], expected.values[2 * i]);
        EXPECT_EQ(seen.values[2 * i + 1], -expected.values[2 * i]);
        EXPECT_NEAR(seen.gap[i], expected.gap[i], 1e-14);
        EXPECT_NEAR(seen.displacement[i], expected.displacement[i], 1e-14);
      }
    }
  }
  EXPECT_GT(compared, 50);
}

TEST_P(SurfaceOnRanks, PointsOutsideOfAThinPlate)
{
  // A closed box, thin in its third direction, of two grids and no sides
  const int n = 4;
  const double thick = 0.02;
  Scene scene = flat_grid(n, Cells::quadrilaterals);
  scene.join(grid(n, Cells::quadrilaterals, [&](double s, double t)
                  { return Vector<3>{1 - s, t, -thick}; }));
  for (const bool closed : {true, false})
    for (const bool scattered : {true, false})
    {
      const DistributedScene parts(scene, GetParam(), 1, scattered);
      const auto work = [&](ThreadRanks& ranks)
      {
        const auto halo = parts.halo(ranks);
        const auto own
            = part(parts, *halo, 0, closed ? scene.facets().size() : n * n);
        search::InsideTest outside(halo, own.offsets, own.nodes);
        EXPECT_EQ(outside.is_around(), closed);
        EXPECT_EQ(mesh::total(ranks, outside.probe().num_facets()),
                  closed ? 2 * n * n : n * n);
        // Above, inside, below, inside but not deep, below and not asked
        Generator random(static_cast<unsigned>(ranks.rank()));
        const std::vector<double> height{0.1, -0.005, -0.1, -0.005, -0.1};
        const std::vector<double> depth{0.1, 0.1, 0.1, 0.01, 0.01};
        std::vector<double> points;
        for (const double h : height)
        {
          // In the middle of a facet
          const double s = std::floor(random(0, n)),
                       t = std::floor(random(0, n));
          points.insert(points.end(), {(s + random(0.3, 0.7)) / n,
                                       (t + random(0.3, 0.7)) / n, h});
        }
        const auto find = [&](bool within_depth)
        {
          return outside.find(halo->now()->x, points, depth,
                              std::vector<double>(5, 0.25), within_depth);
        };
        using Which = std::vector<std::int8_t>;
        EXPECT_EQ(find(false), closed ? Which({1, 0, 1, 0, 0}) : Which(5, 0));
        // Below it is 0.08 to the plate, which is nearer than the depth
        EXPECT_EQ(find(true), closed ? Which({0, 0, 1, 0, 0}) : Which(5, 0));
        EXPECT_REFUSED(outside.find(halo->now()->x, points, depth, {}));
      };
      on_ranks(GetParam(), work);
    }
}

TEST_P(SurfaceOnRanks, WrongArgumentsAreNamed)
{
  const Scene scene = flat_grid(3, Cells::mixed);
  const DistributedScene parts(scene, GetParam(), 1, false);
  const auto work = [&](ThreadRanks& ranks)
  {
    const auto halo = parts.halo(ranks);
    const auto surface = surface_of(parts, halo, 0, scene.facets().size());
    const auto x = halo->now()->x;
    const std::vector<double> one(3), two(6), four(4);
    EXPECT_REFUSED(surface->find(one, one, one, 1));
    EXPECT_REFUSED(surface->find(x, four, one, 1));
    EXPECT_REFUSED(surface->find(x, one, two, 1));
    EXPECT_REFUSED(surface->mean(one));
    const auto own = surface->own();
    search::SurfaceProbe probe(halo, own.offsets, own.nodes);
    EXPECT_REFUSED(probe.query(one, one, one, 1));
    EXPECT_REFUSED(probe.query(x, one, two, 1));
    EXPECT_REFUSED(probe.query(x, one, one, 1, {}, 1));
    EXPECT_REFUSED(
        probe.query(x, one, one, 1, {}, 0, search::Displacements{x, two}));
  };
  on_ranks(GetParam(), work);
}

INSTANTIATE_TEST_SUITE_P(Distributed, SurfaceOnRanks, testing::Range(1, 5));
