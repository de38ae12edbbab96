// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#include "blocks.h"
#include "obstacles.h"
#include <contactx/contact/mortar_obstacle.h>
#include <contactx/contact/node_to_surface.h>
#include <contactx/contact/obstacle_tie.h>
#include <contactx/contact/surface_to_surface.h>
#include <contactx/kernel/layout.h>
#include <contactx/problem/sides.h>
#include <typeinfo>

using namespace contactx;
using namespace contactx::tests;
using contact::Sliding;
using problem::make_master;
using problem::make_slave_nodes;
using problem::MasterOptions;
using problem::Method;

namespace
{
using MadeSides = testing::TestWithParam<int>;

/// A block on another one, 0.1 above it.
struct Stack : Stacked
{
  Side slave, master;

  explicit Stack(int gdim)
      : Stacked(gdim, 0.2, 0.1, 0.8, 2), slave(upper(gdim - 1, false)),
        master(lower(gdim - 1, true))
  {
  }

  /// Call work(rank_blocks, slave_nodes, master_facets) on ranks; what is
  /// thrown.
  template <class Work>
  std::string each(int ranks, Work work) const
  {
    return said(
        blocks, ranks,
        [&](const RankBlocks& mine)
        {
          const geometry::Facets own = mine.own(slave),
                                 other = mine.own(master);
          work(mine, make_slave_nodes(mine.halo, own.list()), other);
        },
        true);
  }

  /// The same, of which nothing is refused.
  template <class Work>
  void check(int ranks, Work work) const
  {
    EXPECT_EQ(each(ranks, work), "");
  }
};

template <class M>
bool is_a(const contact::Master& master)
{
  return typeid(master) == typeid(M);
}
} // namespace

TEST_P(MadeSides, MethodAndLawChooseTheMaster)
{
  const law::Frictionless smooth;
  const law::Coulomb rough;
  const law::Tied tied;
  const MasterOptions nodes{Method::node_to_surface, Sliding::finite, {}},
      facets{Method::surface_to_surface, Sliding::small, {}};
  const Stack stack(3);
  stack.check(
      GetParam(),
      [&](const RankBlocks& mine, const auto& slaves, const auto& other)
      {
        const mesh::NamedSurface master{"B", other.list()};
        const auto made = [&](const law::Law& law, const auto& options)
        { return make_master(mine.mesh(), slaves, "A", master, law, options); };
        EXPECT_TRUE(is_a<contact::NodeToSurface>(*made(smooth, nodes)));
        EXPECT_TRUE(is_a<contact::NodeToSurface>(*made(rough, nodes)));
        EXPECT_TRUE(is_a<contact::NodeTie>(*made(tied, nodes)));
        EXPECT_TRUE(is_a<contact::SurfaceToSurface>(*made(rough, facets)));
        EXPECT_TRUE(is_a<contact::SurfaceTie>(*made(tied, facets)));
      });
  stack.check(
      GetParam(),
      [&](const RankBlocks& mine, const auto& slaves, const auto&)
      {
        const auto made
            = [&](Kind kind, const law::Law& law, const auto& options)
        {
          return make_master(mine.mesh(), slaves, "A", make_obstacle(kind, 3),
                             law, options);
        };
        using contact::MortarObstacle;
        using contact::ObstacleMaster;
        using contact::ObstacleTie;
        EXPECT_TRUE(is_a<ObstacleMaster>(*made(Kind::bowl, smooth, nodes)));
        EXPECT_TRUE(is_a<ObstacleTie>(*made(Kind::bowl, tied, nodes)));
        EXPECT_TRUE(is_a<ObstacleTie>(*made(Kind::bowl, tied, facets)));
        EXPECT_TRUE(is_a<MortarObstacle>(*made(Kind::bowl, rough, facets)));
        EXPECT_TRUE(is_a<MortarObstacle>(*made(Kind::pipe, smooth, facets)));
        EXPECT_TRUE(
            is_a<MortarObstacle>(*made(Kind::level_set, smooth, facets)));
        // A plane's gap is linear on facets
        EXPECT_TRUE(is_a<ObstacleMaster>(*made(Kind::plane, rough, facets)));
      });
}

TEST(QuadraticSides, ObstaclesAreNodalByBothMethods)
{
  Blocks blocks(3);
  blocks.add(4, {0, 0, 0}, {1, 1, 1});
  const Side bottom = blocks.side(0, 2, false);
  EXPECT_EQ(
      said(blocks, 1,
           [&](const RankBlocks& mine)
           {
             // Each cell of a block of eight cells has eight of these as parts
             const auto x = mine.halo->reference();
             std::vector<std::int8_t> level(mine.halo->num_nodes());
             for (std::size_t i = 0; i < level.size(); ++i)
             {
               int odd = 0;
               for (int k = 0; k < 3; ++k)
                 odd += std::lround(4 * x[3 * i + k]) % 2;
               level[i] = static_cast<std::int8_t>(std::min(odd, 2));
             }
             const geometry::Facets facets = mine.own(bottom);
             const auto law = std::make_shared<law::Coulomb>();
             const auto made = [&](Method method, bool is_quadratic)
             {
               const std::vector<std::int8_t> levels
                   = is_quadratic ? level : std::vector<std::int8_t>();
               const auto slaves = make_slave_nodes(mine.halo, facets.list(),
                                                    levels, method, true);
               EXPECT_EQ(slaves->is_quadratic(), is_quadratic);
               EXPECT_FALSE(slaves->is_mortar());
               const auto master = make_master(
                   mine.mesh(), slaves, "A", make_obstacle(Kind::bowl, 3), *law,
                   {method, Sliding::finite, {}, levels});
               EXPECT_EQ(is_a<contact::MortarObstacle>(*master),
                         method == Method::surface_to_surface
                             and not is_quadratic);
               law->set_friction(
                   std::vector<double>(slaves->owned().size(), 0.1));
               const contact::Contact contact(
                   mine.halo, slaves, master, law,
                   {Sliding::finite,
                    method,
                    std::vector<std::int8_t>(3 * mine.halo->num_bulk(), 0),
                    {}});
               return contact.nodes()->mean.has_value();
             };
             EXPECT_TRUE(made(Method::surface_to_surface, false));
             EXPECT_FALSE(made(Method::surface_to_surface, true));
             EXPECT_FALSE(made(Method::node_to_surface, true));
             EXPECT_TRUE(make_slave_nodes(mine.halo, facets.list(), level,
                                          Method::surface_to_surface)
                             ->is_mortar());
           }),
      "");
}

TEST_P(MadeSides, SlipIsMeasuredAsLawAndSlidingNeedIt)
{
  const Stack stack(2);
  const auto length_of = [&](const law::Law& law, Sliding sliding)
  {
    double length = 0;
    stack.check(
        GetParam(),
        [&](const RankBlocks& mine, const auto& slaves, const auto& other)
        {
          const auto master
              = make_master(mine.mesh(), slaves, "A", {"B", other.list()}, law,
                            {Method::node_to_surface, sliding, {}});
          const std::size_t n = slaves->owned().size();
          // As a contact does where the search brings nodes of other ranks
          const auto observer
              = mine.halo->on_change([&] { master->nodes_changed(); });
          std::vector<double> u(mine.halo->now()->u);
          for (const std::int32_t node : slaves->owned())
            u[mine.halo->gdim() * node + 1] = 0.1;
          mine.halo->set_start(u);
          master->search(mine.halo->now()->x, std::vector<std::int8_t>(n, 0));
          master->begin_step();
          // Small sliding starts from what has moved
          double sum = 0;
          for (const kernel::Pairs& pairs : master->pairs())
            for (std::size_t i = 0; pairs.slip_size > 0 and i < pairs.size();
                 ++i)
              sum += std::abs(pairs.slip_row<kernel::FacetSlip>(i).origin[1]);
          sum = mesh::total(mine.halo->ranks(), sum);
          if (mine.halo->ranks().rank() == 0)
            length = sum;
        });
    return length;
  };
  EXPECT_EQ(length_of(law::Frictionless(), Sliding::small), 0);
  EXPECT_NEAR(length_of(law::Coulomb(), Sliding::small), 4 * 0.1, 1e-14);
  EXPECT_EQ(length_of(law::Coulomb(), Sliding::finite), 0);
}

TEST_P(MadeSides, ReachIsTheDiameterOfTheLargerSurface)
{
  for (const int gdim : {2, 3})
  {
    const Stack stack(gdim);
    const double diameter = gdim == 2 ? 2 : 2 * std::sqrt(2);
    const auto reach_of = [&](bool is_swapped, std::optional<double> given)
    {
      stack.check(
          GetParam(),
          [&](const RankBlocks& mine, const auto& slaves, const auto& other)
          {
            auto sides = std::pair(slaves, other);
            if (is_swapped)
              sides = {make_slave_nodes(mine.halo, other.list()),
                       geometry::copied(slaves->own())};
            const auto master = make_master(
                mine.mesh(), sides.first, "A", {"B", sides.second.list()},
                law::Frictionless(),
                {Method::node_to_surface, Sliding::finite, given});
            EXPECT_NEAR(master->reach(), given.value_or(diameter), 1e-14);
          });
    };
    reach_of(false, {});
    reach_of(true, {});
    reach_of(false, 0.3);
  }
}

TEST_P(MadeSides, AnObstacleIsAnywhereInReach)
{
  const Stack stack(3);
  const auto obstacle = make_obstacle(Kind::bowl, 3);
  const auto look = [&](std::optional<double> given)
  {
    return stack.each(
        GetParam(),
        [&](const RankBlocks& mine, const auto& slaves, const auto&)
        {
          const auto mine_alone = make_obstacle(Kind::bowl, 3);
          const auto master = make_master(
              mine.mesh(), slaves, "A", mine_alone, law::Frictionless(),
              {Method::node_to_surface, Sliding::finite, given});
          EXPECT_EQ(master->reach(), given.value_or(infinity));
          // It knows the largest edge of the slave surface
          EXPECT_NEAR(mine_alone->extent, 0.8, 1e-15);
          mine_alone->extent = 3;
          make_master(mine.mesh(), slaves, "A", mine_alone, law::Frictionless(),
                      {});
          EXPECT_EQ(mine_alone->extent, 3);
        });
  };
  EXPECT_EQ(look({}), "");
  EXPECT_EQ(look(0.7), "");
}

TEST_P(MadeSides, FacetsComeInTheOrderOfTheMeshAsItWasMade)
{
  // However a rank has them in order
  const Stack stack(3);
  stack.check(
      GetParam(),
      [&](const RankBlocks& mine, const auto& slaves, const auto& other)
      {
        geometry::Facets reversed;
        for (std::int32_t f = other.list().size(); f-- > 0;)
        {
          const auto nodes = other.list()[f];
          reversed.nodes.insert(reversed.nodes.end(), nodes.begin(),
                                nodes.end());
          reversed.offsets.push_back(
              static_cast<std::int32_t>(reversed.nodes.size()));
        }
        const auto identity = [&](const geometry::Facets& facets)
        {
          return make_master(mine.mesh(), slaves, "A", {"B", facets.list()},
                             law::Frictionless(), {})
              ->surface()
              ->identity();
        };
        const auto found = identity(other);
        EXPECT_EQ(found, identity(reversed));
        std::vector<std::array<std::int64_t, 4>> keys;
        for (std::size_t i = 0; i < found.size(); i += 4)
        {
          auto& key = keys.emplace_back();
          std::copy_n(&found[i], 4, key.begin());
          std::ranges::sort(key);
        }
        EXPECT_TRUE(std::ranges::is_sorted(keys));
        EXPECT_EQ(
            make_slave_nodes(mine.halo, reversed.list())->own().nodes.size(),
            other.nodes.size());
        EXPECT_TRUE(std::ranges::equal(
            make_slave_nodes(mine.halo, reversed.list())->own().nodes,
            make_slave_nodes(mine.halo, other.list())->own().nodes));
      });
}

TEST_P(MadeSides, AllFacetsAroundOwnSlaveNodesAreThere)
{
  const Stack stack(3);
  stack.check(
      GetParam(),
      [&](const RankBlocks& mine, const auto& slaves, const auto&)
      {
        // Each node within the surface has four
        std::vector<int> count(mine.halo->num_nodes(), 0);
        for (const std::int32_t node : slaves->facets().nodes)
          ++count[node];
        const auto x = mine.halo->reference();
        const auto sides
            = [&](double c) { return std::abs(c - 0.6) < 0.39 ? 2 : 1; };
        for (const std::int32_t i : slaves->owned())
          EXPECT_EQ(count[i], sides(x[3 * i]) * sides(x[3 * i + 1]));
        EXPECT_EQ(mesh::total(mine.halo->ranks(), std::ssize(slaves->owned())),
                  16);
      });
}

TEST_P(MadeSides, SurfacesAreChecked)
{
  // Each by the check that it fails
  const law::Frictionless law;
  const auto text = [&](const Stack& stack, const MasterOptions& options = {})
  {
    return stack.each(
        GetParam(),
        [&](const RankBlocks& mine, const auto& slaves, const auto& other)
        {
          make_master(mine.mesh(), slaves, "A", {"B", other.list()}, law,
                      options);
        });
  };
  const auto on_plane = [&](const Stack& stack)
  {
    return stack.each(
        GetParam(),
        [&](const RankBlocks& mine, const auto& slaves, const auto&)
        {
          make_master(mine.mesh(), slaves, "A", make_obstacle(Kind::plane, 2),
                      law, {});
        });
  };
  EXPECT_EQ(text(Stack(2)), "");
  Stack bad_slave(2);
  bad_slave.blocks.x[0] = bad_slave.blocks.x[2];
  expect_says(text(bad_slave), "of the slave surface A are degenerate");
  expect_says(on_plane(bad_slave), "of the slave surface A are degenerate");
  Stack bad_master(2);
  double* last = &bad_master.blocks.x[bad_master.blocks.x.size() - 2];
  last[0] = last[-2];
  expect_says(text(bad_master), "of the master surface B are degenerate");
  Stack same(2);
  same.master = same.slave;
  EXPECT_TRUE(text(same).starts_with("slave and master overlap: A and B"));
  Stack inside(2);
  for (std::size_t i = 1; i < 32; i += 2)
    inside.blocks.x[i] = 0.5 * inside.blocks.x[i] - 0.8;
  expect_says(text(inside), "wholly inside");
  // The bottom goes back above itself: only nodes need a normal
  Stack folded(2);
  folded.blocks.x[4] = folded.blocks.x[0];
  folded.blocks.x[6] = folded.blocks.x[0] - 0.1;
  expect_says(text(folded), "is folded at");
  EXPECT_EQ(text(folded, {Method::surface_to_surface, Sliding::finite, {}})
                .find("is folded at"),
            std::string::npos);
}

TEST_P(MadeSides, ArgumentsAreChecked)
{
  const Stack stack(2);
  const law::Frictionless law;
  const auto text = [&](auto&& change, std::optional<double> reach = {})
  {
    return stack.each(
        GetParam(),
        [&](const RankBlocks& mine, const auto& slaves, auto other)
        {
          mesh::Mesh mesh = mine.mesh();
          // On one rank alone
          if (mine.halo->ranks().rank() == 0)
            change(mesh, other);
          make_master(mesh, slaves, "A", {"B", other.list()}, law,
                      {Method::node_to_surface, Sliding::finite, reach});
        });
  };
  const auto nothing = [](auto&, auto&) {};
  EXPECT_EQ(text(nothing), "");
  for (const double reach : {0.0, -1.0})
    EXPECT_TRUE(
        text(nothing, reach)
            .starts_with("search_distance must be larger than zero, not "));
  EXPECT_EQ(text(nothing, std::nan("")),
            "search_distance must be larger than zero, not nan");
  EXPECT_TRUE(text([](auto& mesh, auto&) { mesh.nodes_per_cell = 3; })
                  .starts_with("cells must have"));
  EXPECT_TRUE(text([](auto& mesh, auto&) { mesh.bodies = nullptr; })
                  .starts_with("mesh and slaves"));
  EXPECT_TRUE(text([](auto&, auto& other) { other.offsets.push_back(77); })
                  .starts_with("master_offsets must end"));
  EXPECT_TRUE(text(
                  [](auto&, auto& other)
                  {
                    other.nodes.insert(other.nodes.end(), {0, 1000});
                    other.offsets.push_back(
                        static_cast<std::int32_t>(other.nodes.size()));
                  })
                  .starts_with("master_nodes must be numbers"));
  EXPECT_TRUE(stack
                  .each(GetParam(),
                        [](const RankBlocks& mine, const auto&, const auto&)
                        {
                          const std::vector<std::int32_t> offsets{0, 3},
                              nodes{0, 1, 2};
                          make_slave_nodes(mine.halo, {offsets, nodes});
                        })
                  .starts_with("offsets must give a facet two nodes"));
}

INSTANTIATE_TEST_SUITE_P(Ranks, MadeSides, testing::Values(1, 2, 3, 4));
