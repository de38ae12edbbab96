// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#include "contact_scene.h"
#include <contactx/condense/contact_block.h>

using namespace contactx;
using namespace contactx::condense;
using namespace contactx::tests;

TEST(ContactBlock, EntriesInNumbersOfAllRanksMakeTheSameProducts)
{
  std::mt19937 random(7);
  for (const bool keeps_zeros : {false, true})
  {
    ContactScene scene(2);
    auto law = std::make_shared<law::Coulomb>();
    law->set_friction(std::vector<double>(scene.sheets.num_slaves, 0.3));
    const auto contact = scene.contact<contact::NodeToSurface>(law);
    scene.shake(random, 0.01);
    contact->search();
    law::NodeState& nodes = *contact->nodes();
    std::ranges::fill(nodes.multiplier, 0.5);
    std::ranges::fill(nodes.c, 1.0);
    for (std::size_t i = 0; i < nodes.status.size(); ++i)
      nodes.status[i] = static_cast<std::int8_t>(i % 3);
    const std::vector<std::shared_ptr<contact::Contact>> contacts{contact};
    residual(contacts);
    const ContactBlock block(contacts, {}, keeps_zeros);

    const std::size_t n = block.size();
    std::vector<std::int64_t> places(n);
    std::vector<double> x(n), y(2 * n, 0);
    for (std::size_t i = 0; i < n; ++i)
    {
      places[i] = std::int64_t(2 * (n - i) - 1);
      x[i] = std::sin(double(i));
    }
    const Entries found = block.entries(places);
    ASSERT_EQ(found.rows.size(), found.values.size());
    ASSERT_EQ(found.columns.size(), found.values.size());
    EXPECT_GT(found.values.size(), n);
    for (std::size_t e = 0; e < found.values.size(); ++e)
      y.at(found.rows[e])
          += found.values[e] * x.at(n - (found.columns[e] + 1) / 2);
    const std::vector<double> wanted = block.multiply(x);
    for (std::size_t i = 0; i < n; ++i)
      EXPECT_NEAR(y[places[i]], wanted[i], 1e-13);
    places.pop_back();
    EXPECT_REFUSED(block.entries(places));
  }
}
