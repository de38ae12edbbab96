// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#include "slave_sheet.h"
#include <contactx/geometry/facing.h>

using namespace contactx;
using namespace contactx::contact;
using namespace contactx::tests;

namespace
{
std::vector<std::int8_t> some(std::size_t n, double part, Generator& random)
{
  std::vector<std::int8_t> which(n);
  for (auto& w : which)
    w = random(0, 1) < part;
  return which;
}

/// How near facets are to nodes, from facets' common nodes.
std::vector<std::int8_t> near(const Scene& scene,
                              const std::vector<std::int8_t>& which)
{
  const auto facets = scene.facets();
  const auto has = [&](std::int32_t f)
  {
    return std::ranges::any_of(facets[f],
                               [&](auto node) { return which[node] != 0; });
  };
  std::vector<std::int8_t> level(facets.size(), 0);
  for (std::int32_t f = 0; f < facets.size(); ++f)
    for (std::int32_t g = 0; g < facets.size(); ++g)
      if (has(g)
          and std::ranges::any_of(facets[f],
                                  [&](auto node)
                                  {
                                    return std::ranges::find(facets[g], node)
                                           != facets[g].end();
                                  }))
        level[f] = std::max<std::int8_t>(level[f], f == g ? 2 : 1);
  return level;
}
} // namespace

TEST(SlaveNodes, AreThoseOfTheFacetsInOrder)
{
  Generator random(1);
  for (Facets kind : all_facets)
  {
    const auto [bulk, place] = in_bulk(slave_sheet(kind, 4, random), random);
    const auto slaves = slave_nodes(bulk);
    EXPECT_EQ(slaves->around(), place);
    EXPECT_TRUE(std::ranges::equal(slaves->owned(), place));
    ASSERT_EQ(slaves->corners().size(), bulk.nodes.size());
    for (std::size_t c = 0; c < bulk.nodes.size(); ++c)
      EXPECT_EQ(place[slaves->corners()[c]], bulk.nodes[c]);
  }
}

TEST(SlaveNodes, OfNoFacetsAreNone)
{
  const Scene scene(3);
  const auto slaves = slave_nodes(scene);
  EXPECT_TRUE(slaves->owned().empty());
  EXPECT_TRUE(slaves->largest({}).empty());
  EXPECT_TRUE(slaves->near({}).empty());
  EXPECT_TRUE(slaves->facing({}, {}, 3).empty());
  EXPECT_TRUE(slaves->facing_areas({}, {}, {}, 3).empty());
}

TEST(SlaveNodes, LargestAndSmallestOfFacets)
{
  Generator random(2);
  const auto [bulk, place]
      = in_bulk(slave_sheet(Cells::mixed, 5, random), random);
  const auto slaves = slave_nodes(bulk);
  std::vector<double> values = random.numbers(place.size(), -1, 1);
  values[7] = std::nan("");
  const auto largest = slaves->largest(values);
  const auto smallest = slaves->smallest(values);
  const geometry::FacetList facets = slaves->local();
  int num_nan = 0;
  for (std::int32_t f = 0; f < facets.size(); ++f)
  {
    std::vector<double> at;
    for (std::int32_t node : facets[f])
      at.push_back(values[node]);
    if (std::ranges::any_of(at, [](double v) { return std::isnan(v); }))
    {
      EXPECT_TRUE(std::isnan(largest[f]) and std::isnan(smallest[f]));
      ++num_nan;
      continue;
    }
    EXPECT_EQ(largest[f], std::ranges::max(at));
    EXPECT_EQ(smallest[f], std::ranges::min(at));
  }
  EXPECT_GT(num_nan, 1);
}

TEST(SlaveNodes, NearFacetsHaveANodeOrANeighbourWithOne)
{
  Generator random(3);
  for (Facets kind : all_facets)
    for (double part : {0.02, 0.1})
    {
      const Scene scene = slave_sheet(kind, 8, random);
      const auto slaves = slave_nodes(scene);
      const auto which = some(slaves->owned().size(), part, random);
      EXPECT_EQ(slaves->near(which), near(scene, which));
    }
}

TEST(SlaveNodes, SumsOfCornersAreThoseOfTheirNodes)
{
  Generator random(4);
  const auto [bulk, place]
      = in_bulk(slave_sheet(Cells::mixed, 5, random), random);
  const auto slaves = slave_nodes(bulk);
  // All corners face a normal of length zero
  const std::vector<double> none(place.size() * 3, 0);
  const auto area = slaves->sums(slaves->facing_areas(bulk.x, bulk.x, none, 3));
  const auto expected = geometry::nodal_areas(bulk.facets(), bulk.x, 3);
  for (std::size_t i = 0; i < place.size(); ++i)
    EXPECT_NEAR(area[i], expected[place[i]], 1e-14);
}

TEST(SlaveNodes, FaceAMasterAsTheirFacetsDo)
{
  Generator random(5);
  for (Facets kind : all_facets)
  {
    const Scene scene = slave_sheet(kind, 6, random);
    const auto [bulk, place] = in_bulk(scene, random);
    const int gdim = bulk.gdim;
    const auto slaves = slave_nodes(bulk);
    std::vector<double> normal, every(bulk.x.size(), 0);
    for (std::int32_t node : place)
    {
      const Vector<3> n = gdim == 2 ? Vector<3>{random(-1, 1), random(-1, 1), 0}
                                    : random.unit<3>();
      normal.insert(normal.end(), n.begin(), n.begin() + gdim);
      std::copy_n(n.begin(), gdim, every.begin() + node * gdim);
    }
    const auto faces = slaves->facing(bulk.x, normal, gdim);
    const auto expected
        = geometry::facing_nodes(bulk.facets(), bulk.x, every, gdim);
    for (std::size_t i = 0; i < place.size(); ++i)
      EXPECT_EQ(faces[i], expected[place[i]]);
    std::vector<double> moved = bulk.x;
    for (double& c : moved)
      c += 0.02 * random(-1, 1);
    EXPECT_EQ(
        slaves->facing_areas(bulk.x, moved, normal, gdim),
        geometry::facing_areas(bulk.facets(), bulk.x, moved, every, gdim));
  }
}

TEST(SlaveNodes, AreTheSameOnRanks)
{
  Generator random(6);
  for (Facets kind : all_facets)
    for (int size : {1, 2, 3})
    {
      const Scene whole = slave_sheet(kind, 7, random);
      const int gdim = whole.gdim;
      const std::size_t n = whole.x.size() / gdim;
      std::vector<int> owner(n);
      for (int& r : owner)
        r = static_cast<int>(random(0, size));
      const auto which = some(n, 0.05, random);
      const auto values = random.numbers(2 * n, -1, 1);
      std::vector<std::int64_t> tags(n);
      std::iota(tags.begin(), tags.end(), std::int64_t(1) << 40);
      const auto level = near(whole, which);
      const auto area = geometry::nodal_areas(whole.facets(), whole.x, gdim);
      std::vector<std::int64_t> own(size);
      const auto work = [&](mesh::Ranks& rank)
      {
        const Part part = part_of(whole, owner, rank);
        const SlaveNodes& slaves = *part.slaves;
        EXPECT_EQ(std::ssize(slaves.owned()), part.num_owned);
        own[rank.rank()] = slaves.own().size();
        // What owners have
        const auto w = slaves.scatter_forward(part.take(which));
        const auto v = slaves.scatter_forward(part.take(values, 2), 2);
        const auto t = slaves.scatter_forward(part.take(tags));
        for (std::size_t i = 0; i < slaves.around().size(); ++i)
        {
          const auto node = part.numbers[slaves.around()[i]];
          EXPECT_EQ(w[i], which[node]);
          EXPECT_EQ(t[i], tags[node]);
          EXPECT_EQ(v[2 * i], values[2 * node]);
          EXPECT_EQ(v[2 * i + 1], values[2 * node + 1]);
        }
        // A facet of this rank by its nodes
        const auto mine = slaves.near(part.take(which));
        const auto facets = whole.facets(), here = part.scene.facets();
        for (std::int32_t f = 0, g = 0; f < here.size(); ++f, ++g)
        {
          const auto same = [&](std::int32_t a, std::int32_t b)
          { return part.numbers[a] == b; };
          while (not std::ranges::equal(here[f], facets[g], same))
            ++g;
          EXPECT_EQ(mine[f], level[g]);
        }
        const std::vector<double> none(slaves.owned().size() * gdim);
        expect_near(slaves.sums(slaves.facing_areas(part.scene.x, part.scene.x,
                                                    none, gdim)),
                    part.take(area), 1e-15);
      };
      on_ranks(size, work);
      EXPECT_EQ(std::accumulate(own.begin(), own.end(), std::int64_t(0)),
                whole.facets().size());
    }
}

TEST(SlaveNodes, RefuseWhatDoesNotFit)
{
  Generator random(7);
  const Scene scene = slave_sheet(Cells::triangles, 2, random);
  const auto slaves = slave_nodes(scene);
  const std::vector<double> few(3);
  EXPECT_REFUSED(slaves->scatter_forward(std::span(few)));
  EXPECT_REFUSED(slaves->scatter_forward(std::span(few).first(0), 0));
  EXPECT_REFUSED(slaves->sums(few));
  EXPECT_REFUSED(slaves->facing({}, {}, 0));
  EXPECT_REFUSED(slaves->largest(few));
  EXPECT_REFUSED(slaves->smallest(few));
  EXPECT_REFUSED(slaves->facing(few, few, 3));
  EXPECT_REFUSED(slaves->facing(scene.x, few, 3));
  const auto nodes = std::make_shared<mesh::SerialNodes>(3);
  EXPECT_REFUSED(SlaveNodes(nodes, scene.facets(), Scene(3).facets()));
  const std::vector<std::int32_t> offsets{0, 3, 4}, three{0, 1, 2};
  EXPECT_REFUSED(SlaveNodes(nodes, {offsets, three}, Scene(3).facets()));
  EXPECT_REFUSED(SlaveNodes(nullptr, scene.facets(), scene.facets()));
}

TEST(SlaveNodes, WeightsAreThoseOfTheirCorners)
{
  Generator random(6);
  for (Facets kind : all_facets)
  {
    const auto [bulk, place] = in_bulk(slave_sheet(kind, 4, random), random);
    const auto slaves = slave_nodes(bulk);
    EXPECT_TRUE(slaves->corner_weight().empty());
    std::vector<double> weight = random.numbers(slaves->owned().size(), 0.5, 2);
    // On the axis but for rounding
    weight[0] = -1e-14;
    slaves->set_weight(weight);
    weight[0] = 0;
    EXPECT_EQ(slaves->weight(), weight);
    const auto at = slaves->corner_weight();
    ASSERT_EQ(at.size(), bulk.nodes.size());
    for (std::size_t c = 0; c < at.size(); ++c)
      EXPECT_EQ(at[c], weight[slaves->corners()[c]]);
  }
}

TEST(SlaveNodes, WeightsThatAreNoneAreRefused)
{
  Generator random(7);
  const auto [bulk, place]
      = in_bulk(slave_sheet(all_facets.front(), 4, random), random);
  const auto slaves = slave_nodes(bulk);
  std::vector<double> weight(slaves->owned().size(), 1);
  const auto refused = [&](double value)
  {
    auto wrong = weight;
    wrong.back() = value;
    EXPECT_REFUSED(slaves->set_weight(wrong));
  };
  refused(-1e-6);
  refused(NAN);
  refused(INFINITY);
  EXPECT_REFUSED(slaves->set_weight(std::vector<double>(weight.size() + 1, 1)));
  EXPECT_REFUSED(slaves->set_weight(std::vector<double>(weight.size(), 0)));
}
