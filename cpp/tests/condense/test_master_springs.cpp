// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#include <contactx/condense/master_springs.h>
#include <gtest/gtest.h>
#include <numeric>

#include "saddle.h"
#include "status.h"

using namespace contactx;
using namespace contactx::condense;
using namespace contactx::tests;

namespace
{
/// Nodes 0, 1, 2 are slaves, 4, 5, 6 their masters
class MasterSprings : public testing::TestWithParam<int>
{
protected:
  static constexpr std::size_t num_nodes = 8;

  std::size_t n() const { return GetParam() * num_nodes; }

  Saddle saddle(std::vector<std::int8_t> status) const
  {
    return Saddle(GetParam(), num_nodes,
                  {{{0, 1, 2}, {4, 5, 6}, GetParam(), std::move(status)}}, {},
                  4);
  }
};

/// Springs along each axis in all
std::vector<double> sums(const std::vector<double>& springs, int gdim)
{
  std::vector<double> result(gdim, 0);
  for (std::size_t i = 0; i < springs.size(); ++i)
    result[i % gdim] += springs[i];
  return result;
}
} // namespace

TEST_P(MasterSprings, AreInAllThoseOfTheSlaves)
{
  const int gdim = GetParam();
  const Saddle scene = saddle({stick, slip, open});
  const Condensation condensed = scene.condensed();
  std::vector<double> stiffness(n());
  for (std::size_t i = 0; i < n(); ++i)
    stiffness[i] = 1.0 + static_cast<double>(i % 7);
  std::vector<double> area(n(), 0), expected(gdim, 0);
  const Triplets& T = condensed.traction();
  for (std::size_t e = 0; e < T.size(); ++e)
    area[T.rows[e]] += std::abs(T.values[e]);
  // Those of open nodes are no one's
  for (int i = 0; i < 2 * gdim; ++i)
    expected[i % gdim] += stiffness[i] * area[i];
  const std::vector<double> found = master_springs(condensed, stiffness);
  ASSERT_EQ(found.size(), n());
  for (int k = 0; k < gdim; ++k)
    EXPECT_NEAR(sums(found, gdim)[k], expected[k], 1e-12 * expected[k]);
  for (std::size_t i = 0; i < found.size(); ++i)
  {
    EXPECT_GE(found[i], 0);
    const std::size_t node = i / gdim;
    if (node < 4 or node > 6)
    {
      EXPECT_EQ(found[i], 0) << "displacement " << i;
    }
  }
}

TEST_P(MasterSprings, AreNoneOfBodiesWithoutStiffness)
{
  const Saddle scene = saddle({stick, slip, stick});
  for (const double spring :
       master_springs(scene.condensed(), std::vector<double>(n(), 0)))
    EXPECT_EQ(spring, 0);
}

TEST_P(MasterSprings, RefuseStiffnessesThatDoNotFit)
{
  const Saddle scene = saddle({stick, stick, stick});
  EXPECT_THROW(master_springs(scene.condensed(), std::vector<double>(n() + 1)),
               std::invalid_argument);
}

INSTANTIATE_TEST_SUITE_P(InSpace, MasterSprings, testing::Values(2, 3));
