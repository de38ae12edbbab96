// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#include <contactx/condense/stiff_bodies.h>
#include <gtest/gtest.h>

#include "saddle.h"
#include "status.h"

using namespace contactx;
using namespace contactx::condense;
using namespace contactx::tests;

namespace
{
using Stiff = std::vector<std::int8_t>;

/// Three bodies of four nodes each; the first is slave of the second
class StiffBodies : public testing::Test
{
protected:
  static constexpr int gdim = 3;

  /// Which are stiff, by stiffnesses of the bodies
  Stiff stiff(const std::vector<double>& stiffness, std::int8_t status = stick)
  {
    std::vector<std::int32_t> cells(12);
    for (std::int32_t i = 0; i < 12; ++i)
      cells[i] = i;
    const std::vector<std::int64_t> original(cells.begin(), cells.end());
    const auto nodes = std::make_shared<mesh::SerialNodes>(12);
    const mesh::Bodies bodies(cells, 4, 3, original, nodes);
    const Saddle saddle(
        gdim, 12, {{{0, 1, 2}, {4, 5, 6}, gdim, {status, status, status}}}, {},
        4);
    std::vector<double> diagonal;
    for (std::size_t i = 0; i < saddle.n; ++i)
      diagonal.push_back(stiffness[i / (4 * gdim)]);
    return stiff_bodies(saddle.condensed(), bodies, diagonal);
  }
};
} // namespace

TEST_F(StiffBodies, AreThoseBeyondTheWidestGap)
{
  // A body without contact counts as stiff
  EXPECT_EQ(stiff({1, 1e3, 1}), (Stiff{0, 1, 1}));
  EXPECT_EQ(stiff({1e-9, 1e-6, 1}), (Stiff{0, 1, 1}));
  EXPECT_EQ(stiff({1, 40, 1}), (Stiff{0, 1, 1}));
}

TEST_F(StiffBodies, AreNoneWhereBodiesAreAlike)
{
  EXPECT_EQ(stiff({1, 1, 1}), (Stiff{0, 0, 0}));
  EXPECT_EQ(stiff({1, 5, 1e6}), (Stiff{0, 0, 0}));
}

TEST_F(StiffBodies, AreNoneWhereAStiffBodyIsSlaveOfASoftOne)
{
  EXPECT_EQ(stiff({1e3, 1, 1}), (Stiff{0, 0, 0}));
}

TEST_F(StiffBodies, RefuseADiagonalThatDoesNotFit)
{
  std::vector<std::int32_t> cells{0, 1, 2, 3};
  const std::vector<std::int64_t> original(cells.begin(), cells.end());
  const auto nodes = std::make_shared<mesh::SerialNodes>(4);
  const mesh::Bodies bodies(cells, 4, 1, original, nodes);
  const Saddle saddle(gdim, 4, {{{0}, {1, 2}, gdim, {stick}}}, {}, 4);
  EXPECT_THROW(stiff_bodies(saddle.condensed(), bodies, std::vector<double>(5)),
               std::invalid_argument);
}
