// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#include "contact_scene.h"
#include <contactx/results/wetted.h>

using namespace contactx;
using namespace contactx::contact;
using namespace contactx::tests;

namespace
{
using Contacts = std::vector<std::shared_ptr<const Contact>>;

/// A slave sheet over [0, 1] above a master sheet over [-1, 2], and a fluid
/// that enters at the left ends of both.
struct WettedSheets
{
  ContactScene scene;
  std::shared_ptr<Contact> contact;
  geometry::Facets master;

  explicit WettedSheets(int dim, mesh::Ranks* ranks = nullptr)
      : scene(dim, 0.05, Cells::mixed, ranks),
        contact(scene.contact<NodeToSurface>()),
        master(scene.mesh.here(scene.sheets.master, false))
  {
    contact->search();
  }

  double x(std::int64_t node) const
  {
    return scene.sheets.x[scene.sheets.gdim * node];
  }

  bool is_slave(std::int64_t node) const
  {
    return node < scene.sheets.num_slaves;
  }

  /// Close the slave nodes within some bounds.
  void close(double low, double high)
  {
    const auto owned = scene.slaves->owned();
    for (std::size_t i = 0; i < owned.size(); ++i)
    {
      const double at = x(scene.mesh.number[owned[i]]);
      contact->nodes()->status[i]
          = at > low and at < high ? law::slip : law::open;
    }
  }

  std::vector<std::int8_t> find() const
  {
    std::vector<std::int8_t> is_entry;
    for (std::int32_t i = 0; i < scene.halo->num_owned(); ++i)
    {
      const std::int64_t node = scene.mesh.number[i];
      is_entry.push_back(x(node) < (is_slave(node) ? 0.01 : -0.99));
    }
    return results::wetted_nodes(scene.halo, master.list(), is_entry,
                                 Contacts{contact});
  }

  /// Whether all nodes of this rank are wetted as a function of their place
  /// says.
  template <class Expected>
  void expect(Expected expected) const
  {
    const std::vector<std::int8_t> wetted = find();
    ASSERT_EQ(std::ssize(wetted), scene.halo->num_owned());
    for (std::int32_t i = 0; i < scene.halo->num_owned(); ++i)
    {
      const std::int64_t node = scene.mesh.number[i];
      EXPECT_EQ(wetted[i] != 0, expected(x(node), is_slave(node)))
          << "node " << node << " at " << x(node);
    }
  }
};

class Wetted : public testing::TestWithParam<int>
{
};
} // namespace

TEST_P(Wetted, AFluidGoesThroughAnOpenGap)
{
  WettedSheets sheets(GetParam());
  sheets.expect([](double, bool) { return true; });
}

TEST(WettedNodes, BothSidesEndAtTheSamePlaceOnAnyRanks)
{
  // The slave has nodes at 0, 1/3, 2/3 and 1, the master at -1, -0.4, 0.2, 0.8,
  // 1.4 and 2: in front of 0.2 the slave is wetted to two fifths, which is less
  // than a half, or wholly
  for (const double closed : {0.3, 0.6})
    for (const int size : {1, 3})
      on_ranks(size,
               [closed](mesh::Ranks& ranks)
               {
                 WettedSheets sheets(2, &ranks);
                 sheets.close(closed, 0.7);
                 sheets.expect(
                     [closed](double x, bool is_slave)
                     { return x < (is_slave or closed > 0.5 ? closed : 0.1); });
               });
}

TEST_P(Wetted, ItGoesRoundAContactInSpaceAndEndsAtOneInThePlane)
{
  const int dim = GetParam();
  WettedSheets sheets(dim);
  sheets.close(-1, 2);
  const std::vector<std::int8_t> wetted = sheets.find();
  const std::vector<double>& all = sheets.scene.sheets.x;
  for (std::size_t i = 0; i < wetted.size(); ++i)
  {
    bool is_beside = false;
    for (int k = 0; k < dim - 1; ++k)
      is_beside = is_beside or all[dim * i + k] < 0 or all[dim * i + k] > 1;
    const bool is_reached = dim == 3 ? is_beside : all[dim * i] < 0;
    EXPECT_EQ(wetted[i] != 0, not sheets.is_slave(i) and is_reached) << i;
  }
}

TEST_P(Wetted, ContactsThatAreSwitchedOffStopNothing)
{
  WettedSheets sheets(GetParam());
  sheets.close(-1, 2);
  sheets.contact->set_active(false);
  sheets.expect([](double, bool) { return true; });
}

TEST(WettedNodes, WhatDoesNotFitIsRefusedOnAllRanks)
{
  const WettedSheets sheets(2);
  const auto& halo = sheets.scene.halo;
  const std::vector<std::int8_t> entry(halo->num_owned(), 0);
  const geometry::FacetList facets = sheets.master.list();
  expect_refusal([&] { results::wetted_nodes(halo, facets, {}, {}); },
                 "is_entry");
  expect_refusal(
      [&] { results::wetted_nodes(halo, facets, entry, Contacts{nullptr}); },
      "contacts must be those of one problem");
  const WettedSheets other(2);
  expect_refusal(
      [&]
      { results::wetted_nodes(halo, facets, entry, Contacts{other.contact}); },
      "contacts must be those of one problem");
  const std::vector<std::int32_t> offsets{0, 2}, nodes{0, 1000};
  expect_refusal([&]
                 { results::wetted_nodes(halo, {offsets, nodes}, entry, {}); },
                 "facets");
}

INSTANTIATE_TEST_SUITE_P(Dimensions, Wetted, testing::Values(2, 3));
