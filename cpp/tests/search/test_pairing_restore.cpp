// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#include "pairing_scene.h"
#include <gtest/gtest.h>
#include <stdexcept>

using namespace contactx;
using namespace contactx::search;
using namespace contactx::tests;

namespace
{
const std::vector<Vector<2>> flat{{0, 0}, {1, 0}, {2, 0}};
const std::vector<Vector<2>> ridge{{0, 0}, {1, 1}, {2, 0}};

using Ints = std::vector<std::int32_t>;

void take_over(Pairing& to, const Pairing& from)
{
  to.restore(from.facet(), from.feature(), from.xi(), from.cone(),
             from.normal());
}

TEST(PairingRestore, GoesOnAsTheOther)
{
  // Inside the margin memory decides, on a ridge the normal that was found
  for (const auto& [line, first, then] :
       {std::tuple{flat, Vector<2>{1.5, 0},
                   Vector<2>{1 - 0.5 * geometry::facet_margin, 0}},
        std::tuple{ridge, Vector<2>{1.01, 1.2}, Vector<2>{0.99, 1.2}}})
  {
    SlidingSegment a(line), b(line);
    a.search_at(first, true);
    take_over(b.pairing, a.pairing);
    EXPECT_EQ(a.search_at(then, true), b.search_at(then, true));
    EXPECT_EQ(a.pairing.facet(), b.pairing.facet());
    EXPECT_EQ(a.pairing.feature(), b.pairing.feature());
    EXPECT_EQ(a.pairing.xi(), b.pairing.xi());
    EXPECT_EQ(a.pairing.cone(), b.pairing.cone());
    EXPECT_EQ(a.pairing.normal(), b.pairing.normal());
  }
}

TEST(PairingRestore, Unfreezes)
{
  SlidingSegment s(flat);
  for (double x : {0.5, 1.5, 0.5, 1.5})
    s.search_at({x, 0}, true);
  ASSERT_EQ(s.pairing.frozen().size(), 1u);
  take_over(s.pairing, Pairing(s.pairing));
  EXPECT_TRUE(s.pairing.frozen().empty());
  EXPECT_EQ(s.facet(), 0);
}

TEST(PairingRestore, RefusesWhatDoesNotFit)
{
  SlidingSegment s(flat);
  s.search_at({0.5, 0.1}, true);
  const Ints before = s.pairing.facet();
  const std::vector<double> xi(4), xyz(6);
  const auto with = [&](const Ints& facet, const Ints& feature)
  { s.pairing.restore(facet, feature, xi, xyz, xyz); };
  EXPECT_THROW(with({0}, {0}), std::invalid_argument);
  EXPECT_THROW(with({1, 2}, {0, 0}), std::invalid_argument);
  EXPECT_THROW(with({1, -2}, {0, 0}), std::invalid_argument);
  EXPECT_THROW(with({1, 1}, {0, 3}), std::invalid_argument);
  EXPECT_THROW(with({1, -1}, {0, 1}), std::invalid_argument);
  EXPECT_THROW(with({1, 1}, {0, -1}), std::invalid_argument);
  EXPECT_EQ(s.pairing.facet(), before);
  with({1, -1}, {2, 0});
  EXPECT_EQ(s.pairing.facet(), (Ints{1, -1}));
}
} // namespace
