// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#include "threads.h"
#include "two_sheets.h"
#include <contactx/audit/passed_nodes.h>

using namespace contactx;
using namespace contactx::audit;
using namespace contactx::tests;

namespace
{
constexpr double length = 10, thickness = 0.2, distance_apart = 0.05,
                 overlap = 1.4;

/// Tips of two cantilevers, one above the other: the top of the lower one,
/// which is fixed at the left, and the bottom of the upper one, which is fixed
/// at the right.
struct Tips
{
  int gdim;
  Scene below, above;
  std::vector<double> x;
  std::shared_ptr<mesh::Halo> halo;

  explicit Tips(int dim)
      : gdim(dim), below(leaf(0, 0, 1, thickness, true)),
        above(
            leaf(length - overlap, 0.1, 0.9, thickness + distance_apart, false))
  {
    for (std::int32_t& node : above.nodes)
      node += num_below();
    x = below.x;
    x.insert(x.end(), above.x.begin(), above.x.end());
    halo = mesh::serial_halo(x, dim);
  }

  std::int32_t num_below() const
  {
    return static_cast<std::int32_t>(below.x.size()) / gdim;
  }

  /// Both bent down at their tips, their sections turned
  std::vector<double> bent(double lower, double upper) const
  {
    std::vector<double> y = x;
    for (std::size_t i = 0; i < x.size(); i += gdim)
    {
      const bool is_below = i / gdim < std::size_t(num_below());
      const double w0 = is_below ? lower : upper, way = is_below ? 1 : -1;
      const double s
          = way * (x[i] - (is_below ? 0 : 2 * length - overlap)) / length;
      const double middle
          = thickness / 2 + (is_below ? 0 : thickness + distance_apart);
      const double angle = way * 2 * w0 * s / length;
      const double up = x[i + gdim - 1] - middle;
      y[i]
          += std::sin(angle) * up - way * 2. / 3 * w0 * w0 * s * s * s / length;
      y[i + gdim - 1] = middle - w0 * s * s + std::cos(angle) * up;
    }
    return y;
  }

  /// What passes of the nodes of the upper one, and of those of the lower one
  std::array<FoundNodes, 2> both(const std::vector<double>& x1) const
  {
    return {passes(above, below, num_below(), std::ssize(x) / gdim, x1),
            passes(below, above, 0, num_below(), x1)};
  }

  FoundNodes passes(const Scene& own, const Scene& other, std::int32_t begin,
                    std::int32_t end, const std::vector<double>& x1) const
  {
    std::vector<std::int32_t> nodes(end - begin);
    for (std::int32_t i = begin; i < end; ++i)
      nodes[i - begin] = i;
    return passed_nodes(*halo, own.facets(), other.facets(), x, x1, nodes,
                        0.1 * thickness);
  }

  Scene leaf(double from, double low, double high, double height, bool up) const
  {
    const auto at = [&](double s, double t)
    {
      const double x = from + length * s;
      return gdim == 2 ? Vector<3>{x, height, 0}
                       : Vector<3>{x, low + (high - low) * t, height};
    };
    Scene scene = gdim == 2 ? line(25, [&](double s) { return at(s, 0); })
                            : grid(25, 2, Cells::quadrilaterals, at);
    // Turn facets over
    if (up == (gdim == 2))
      for (std::size_t i = gdim - 2; i < scene.nodes.size(); i += 2 * gdim - 2)
        std::swap(scene.nodes[i], scene.nodes[i + 1]);
    return scene;
  }
};

using PassedTips = testing::TestWithParam<int>;

std::vector<double> turned(std::vector<double> x, int gdim, double angle,
                           double shift)
{
  const double c = std::cos(angle), s = std::sin(angle);
  for (std::size_t i = 0; i < x.size(); i += gdim)
  {
    const double a = x[i], b = x[i + gdim - 1];
    x[i] = c * a - s * b + shift;
    x[i + gdim - 1] = s * a + c * b + shift;
  }
  return x;
}
} // namespace

TEST_P(PassedTips, PassEachOther)
{
  const int g = GetParam();
  const Tips tips(g);
  // Eleven thicknesses; of the nodes 0.4 apart four a row are over the other
  // tip. The lower one is wider: in space its outer rows are not under the
  // other
  const auto x1 = tips.bent(-3.5 * thickness, 7.5 * thickness);
  const auto [above, below] = tips.both(x1);
  EXPECT_EQ(above.count, g == 2 ? 4 : 12);
  EXPECT_EQ(below.count, 4);
  for (const FoundNodes& found : {above, below})
  {
    const auto at = x1.begin() + g * found.first;
    EXPECT_EQ(found.at, std::vector<double>(at, at + g));
  }
  EXPECT_EQ(above.first, tips.num_below()) << "the tip is its first node";
  EXPECT_LT(below.first, tips.num_below());
}

TEST_P(PassedTips, StayApart)
{
  const Tips tips(GetParam());
  for (const auto& [lower, upper] :
       {std::array{0., 0.}, {3.5, 2.6}, {7.5, -3.5}, {0.2, 0.4}})
    for (const FoundNodes& found :
         tips.both(tips.bent(lower * thickness, upper * thickness)))
    {
      EXPECT_EQ(found.count, 0);
      EXPECT_EQ(found.first, -1);
      EXPECT_TRUE(found.at.empty());
    }
}

TEST_P(PassedTips, AllTurnedAround)
{
  const int g = GetParam();
  const Tips tips(g);
  const auto x1 = tips.bent(-3.5 * thickness, 7.5 * thickness);
  const auto expected = tips.both(x1);
  for (const double degrees : {10., 60., 120., 180.})
  {
    const double angle = degrees * std::numbers::pi / 180;
    const auto found = tips.both(turned(x1, g, angle, 7));
    const auto none = tips.both(turned(tips.x, g, angle, 7));
    for (int k = 0; k < 2; ++k)
    {
      EXPECT_EQ(found[k].count, expected[k].count);
      EXPECT_EQ(none[k].count, 0);
    }
  }
}

TEST_P(PassedTips, OnlyOfCandidates)
{
  const Tips tips(GetParam());
  const auto x1 = tips.bent(-3.5 * thickness, 7.5 * thickness);
  const std::int32_t tip = tips.num_below();
  const auto count = [&](std::int32_t begin, std::int32_t end)
  { return tips.passes(tips.above, tips.below, begin, end, x1).count; };
  EXPECT_EQ(count(tip, tip), 0);
  EXPECT_EQ(count(tip, tip + 3), 3);
  EXPECT_EQ(count(tip + 4, tip + 26), 0);
}

INSTANTIATE_TEST_SUITE_P(All, PassedTips, testing::Values(2, 3));

namespace
{
/// What passes of two sheets that bend, turn and slide, and normals of the
/// slave by the numbers of the mesh as it was made.
struct Passed
{
  std::array<FoundNodes, 2> found;
  std::map<std::int64_t, std::vector<double>> normals;
};

Passed passed_on(int num_ranks, const TwoSheets& sheets,
                 const std::vector<double>& end, bool scattered)
{
  const int g = sheets.gdim;
  Scene scene(g);
  scene.x = sheets.x;
  scene.nodes = sheets.slave.nodes;
  scene.offsets = sheets.slave.offsets;
  const auto num_slave = sheets.slave.list().size();
  for (std::int32_t f = 0; f < sheets.master.list().size(); ++f)
  {
    const auto nodes = sheets.master.list()[f];
    scene.facet({nodes.begin(), nodes.end()});
  }
  const DistributedScene parts(scene, num_ranks, 5, scattered);
  Passed result;
  std::mutex mutex;
  const auto work = [&](ThreadRanks& ranks)
  {
    const auto halo = parts.halo(ranks);
    const std::vector<geometry::Facets> sides{
        parts.own(*halo, 0, num_slave),
        parts.own(*halo, num_slave, scene.facets().size())};
    std::vector<std::int32_t> every(halo->num_nodes());
    std::iota(every.begin(), every.end(), 0);
    const auto mesh = parts.mesh_nodes(*halo, every);
    std::vector<double> x1(every.size() * g);
    for (std::size_t i = 0; i < every.size(); ++i)
      std::copy_n(end.begin() + g * mesh[i], g, x1.begin() + g * i);
    std::array<FoundNodes, 2> found;
    for (int k = 0; k < 2; ++k)
    {
      std::vector<std::int32_t> nodes;
      for (std::int32_t i = 0; i < halo->num_owned(); ++i)
        if ((mesh[i] < sheets.num_slaves) == (k == 0))
          nodes.push_back(i);
      found[k] = passed_nodes(*halo, sides[k].list(), sides[1 - k].list(),
                              halo->reference(), x1, nodes, 0.02);
    }
    const auto normals = normals_of_all(*halo, sides[0].list(), x1);
    const std::lock_guard lock(mutex);
    for (std::int32_t i = 0; i < halo->num_owned(); ++i)
      result.normals[halo->original()[i]]
          = {normals.begin() + g * i, normals.begin() + g * (i + 1)};
    if (ranks.rank() > 0 and result.found[0].first != -1)
    {
      for (int k = 0; k < 2; ++k)
        EXPECT_EQ(result.found[k].first, found[k].first);
    }
    result.found = found;
  };
  on_ranks(num_ranks, work);
  return result;
}
} // namespace

TEST(PassedNodes, AreTheSameOnAnyNumberOfRanks)
{
  Generator random(1);
  std::int64_t count = 0;
  for (const int gdim : {2, 3})
    for (int run = 0; run < 8; ++run)
    {
      const TwoSheets sheets(gdim, 0.1);
      const auto wave = random.vector<3>(-0.3, 0.3);
      const auto way = random.vector<3>(-0.8, 0.8);
      const double phase = random(0, 6), angle = random(1, 3);
      auto end = sheets.moved(
          [&](Vector<3> p, bool is_slave)
          {
            const double s = std::sin(5 * p[0] + phase);
            for (int k = 0; k < gdim; ++k)
              p[k] += s * wave[k] + (is_slave ? way[k] : 0);
            return p;
          });
      end = turned(end, gdim, angle, 0);
      const Passed expected = passed_on(1, sheets, end, false);
      for (const int ranks : {2, 3, 5})
        for (const bool scattered : {false, true})
        {
          const Passed passed = passed_on(ranks, sheets, end, scattered);
          for (int k = 0; k < 2; ++k)
          {
            EXPECT_EQ(passed.found[k].count, expected.found[k].count);
            EXPECT_EQ(passed.found[k].first, expected.found[k].first);
            EXPECT_EQ(passed.found[k].at, expected.found[k].at);
          }
          for (const auto& [node, normal] : expected.normals)
            for (int k = 0; k < gdim; ++k)
              EXPECT_NEAR(passed.normals.at(node)[k], normal[k], 1e-13);
        }
      count += expected.found[0].count + expected.found[1].count;
    }
  EXPECT_GT(count, 20);
}

TEST(FoundNodes, AreThoseOfAllRanks)
{
  const Scene scene = flat_grid(4, Cells::triangles);
  const DistributedScene parts(scene, 3, 5, true);
  std::int64_t least = std::numeric_limits<std::int64_t>::max();
  for (std::size_t i = 0; i < parts.nodes.owner.size(); ++i)
    if (parts.nodes.owner[i] > 0)
      least = std::min(least, parts.nodes.original[i]);
  const auto work = [&](ThreadRanks& ranks)
  {
    const auto halo = parts.halo(ranks);
    const auto x = halo->now()->x;
    EXPECT_EQ(found_nodes(*halo, {}, x).count, 0);
    // All nodes but those of the first rank
    std::vector<std::int32_t> nodes;
    for (std::int32_t i = 0; ranks.rank() > 0 and i < halo->num_owned(); ++i)
      nodes.push_back(i);
    const FoundNodes found = found_nodes(*halo, nodes, x);
    EXPECT_EQ(found.count, std::ssize(parts.nodes.owner)
                               - std::ranges::count(parts.nodes.owner, 0));
    EXPECT_EQ(found.first, least);
    const auto at = std::ranges::find(parts.nodes.original, least)
                    - parts.nodes.original.begin();
    const auto row = scene.x.begin() + 3 * at;
    EXPECT_EQ(found.at, std::vector<double>(row, row + 3));
  };
  on_ranks(3, work);
}

TEST(Depths, TheLargestExcessOfAllRanksCounts)
{
  const auto work = [](ThreadRanks& ranks)
  {
    EXPECT_FALSE(deepest(ranks, std::nullopt, 2).has_value());
    // The third and the fourth rank have the same excess
    const double r = ranks.rank();
    std::optional<Depth> mine;
    if (r > 0)
      mine = Depth{std::min(r, 2.) - 5, 0.1 * r, 10 * r, r > 1, {r, -r}};
    const auto found = deepest(ranks, mine, 2);
    ASSERT_TRUE(found.has_value());
    EXPECT_EQ(found->excess, -3);
    EXPECT_EQ(found->depth, 0.2);
    EXPECT_EQ(found->size, 20);
    EXPECT_TRUE(found->is_held);
    EXPECT_EQ(found->at, (std::vector<double>{2, -2}));
  };
  on_ranks(4, work);
}

TEST(Depths, TheWorstIsTheFirstOfTheLargest)
{
  const double nan = std::nan(""), infinite = INFINITY;
  EXPECT_EQ(worst_of(std::vector<double>{}), -1);
  EXPECT_EQ(worst_of(std::vector<double>{-infinite, nan}), -1);
  EXPECT_EQ(worst_of(std::vector<double>{nan, -2, -1, -1, -infinite}), 2);
}
