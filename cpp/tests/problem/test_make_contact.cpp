// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#include "spring_bodies.h"
#include <contactx/contact/surface_to_surface.h>
#include <contactx/geometry/plane.h>
#include <contactx/problem/make_contact.h>

using namespace contactx;
using namespace contactx::problem;
using namespace contactx::tests;

namespace
{
/// Two sheets, of which a contact is made by its options.
struct Input : SpringBodies
{
  explicit Input(int dim)
      : SpringBodies(dim), mesh{scene.halo, bodies(), bulk->cells(), 2},
        sides{.slave = {"upper", scene.sheets.slave.list()},
              .master = mesh::NamedSurface{"lower", scene.sheets.master.list()}}
  {
  }

  std::shared_ptr<contact::Contact> make(const ContactOptions& options = {})
  {
    return make_contact(mesh, sides, options, scene.prescribed);
  }

  mesh::Mesh mesh;
  Sides sides;
};
} // namespace

TEST_2D_3D(MakeContact, OptionsDecideOnMethodAndLaw, dim)
{
  Input input(dim);
  const auto plain = input.make();
  EXPECT_FALSE(plain->law()->is_vector());
  EXPECT_EQ(plain->history(), nullptr);
  const auto rough = input.make({.method = contact::Method::surface_to_surface,
                                 .sliding = contact::Sliding::small,
                                 .has_friction = true,
                                 .tangential_factor = 0.1});
  EXPECT_NE(dynamic_cast<contact::SurfaceToSurface*>(rough->master().get()),
            nullptr);
  EXPECT_EQ(rough->sliding(), contact::Sliding::small);
  EXPECT_NE(rough->history(), nullptr);
  EXPECT_EQ(rough->nodes()->tangential_ratio, 0.1);
  EXPECT_TRUE(input.make({.tied = true})->law()->is_tied());
  for (const auto& contact : {plain, rough})
    for (const std::int8_t paired : contact->master()->paired())
      EXPECT_TRUE(paired);
}

TEST(MakeContact, ALawOfOnesOwnCountsWhatStepsHaveSlipped)
{
  Input input(2);
  std::vector<double> counted;
  const auto contact = input.make(
      {.has_friction = true,
       .bound = [&](std::span<const double> p, std::span<const double> slip)
       {
         counted.assign(slip.begin(), slip.end());
         const std::vector<double> zero(p.size(), 0);
         return law::Bounds{std::vector<double>(p.size(), 1), zero, zero};
       }});
  const auto n = std::size_t(contact->nodes()->num_nodes());
  contact->history()->restore(std::vector<double>(2 * n, 0),
                              std::vector<double>(n, 0.25),
                              std::vector<double>(n, 0));
  contact->nodes()->slip[0] = 0.5;
  contact->law()->evaluate(*contact->nodes());
  ASSERT_EQ(counted.size(), n);
  EXPECT_DOUBLE_EQ(counted[0], 0.75);
  EXPECT_DOUBLE_EQ(counted[1], 0.25);
}

TEST(MakeContact, AWeightIsAskedForAtTheSlaveNodes)
{
  Input input(2);
  const std::vector<double> plain = input.make()->nodes()->area;
  input.sides.weight = [](std::span<const std::int32_t> nodes)
  { return std::vector<double>(nodes.size(), 3); };
  const std::vector<double> thick = input.make()->nodes()->area;
  for (std::size_t i = 0; i < plain.size(); ++i)
    EXPECT_DOUBLE_EQ(thick[i], 3 * plain[i]);
}

TEST(MakeContact, WhatExcludesEachOtherIsRefused)
{
  Input input(2);
  const auto expect = [&](const ContactOptions& options, const char* words)
  { expect_refusal([&] { input.make(options); }, words); };
  expect({.tied = true, .has_friction = true}, "tied excludes");
  expect({.tangential_factor = 0}, "tangential_factor");
  expect({.search_distance = -1.0}, "search_distance");
  expect({.excluded_distance = 1.0}, "not the same surface");
}

TEST(MakeContact, NamesAreThoseOfMessages)
{
  Input input(2);
  EXPECT_EQ(name_of(input.sides, contact::Sliding::small),
            "Contact(slave=upper, master=lower, sliding='small')");
  input.sides.master = std::make_shared<geometry::Plane>(
      std::vector<double>{0, 0}, std::vector<double>{0, 1});
  EXPECT_EQ(name_of(input.sides, contact::Sliding::finite),
            "Contact(slave=upper, master=Plane, sliding='finite')");
  input.sides.is_self = true;
  EXPECT_EQ(name_of(input.sides, contact::Sliding::finite),
            "Contact of upper with itself");
}
