// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#include <contactx/solve/residual_weights.h>
#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <numeric>
#include <stdexcept>

using namespace contactx;
using solve::residual_weight;

namespace
{
/// Two bodies of three nodes in the plane
class Softness : public testing::Test
{
protected:
  static constexpr int gdim = 2;

  static mesh::Bodies bodies()
  {
    std::vector<std::int32_t> cells(6);
    std::iota(cells.begin(), cells.end(), 0);
    const std::vector<std::int64_t> original(cells.begin(), cells.end());
    return {cells, 3, 2, original, std::make_shared<mesh::SerialNodes>(6)};
  }

  /// An entry for each displacement of the bodies
  static std::vector<double> values(double first, double second)
  {
    std::vector<double> v(6 * gdim, first);
    std::fill(v.begin() + 3 * gdim, v.end(), second);
    return v;
  }

  static double part(double first, double second, double r, double s)
  {
    return residual_weight(bodies(), values(first, second), values(r, s), gdim);
  }
};
} // namespace

TEST_F(Softness, IsOneWhereBodiesAreAlikeOrTheSoftOneIsLoaded)
{
  EXPECT_DOUBLE_EQ(part(1, 1, 3, 4), 1);
  EXPECT_DOUBLE_EQ(part(1, 9, 0, 4), 1);
  EXPECT_DOUBLE_EQ(part(1, 1e6, 3, 0), 1);
}

TEST_F(Softness, FallsWithTheStiffnessOfALoadedBody)
{
  EXPECT_DOUBLE_EQ(part(1, 20, 0, 4), 0.05);
  EXPECT_DOUBLE_EQ(part(1, 1e3, 0, 4), 1e-3);
  EXPECT_DOUBLE_EQ(part(1e9, 1, 5, 0), 1e-9);
  EXPECT_DOUBLE_EQ(part(1, 1e2, 3, 4), std::hypot(3, 0.04) / 5);
}

TEST_F(Softness, DoesNotDependOnUnits)
{
  EXPECT_DOUBLE_EQ(part(1e-9, 1e-6, 3e7, 4e7), part(1, 1e3, 3, 4));
}

TEST_F(Softness, IsOneWithoutResidual) { EXPECT_EQ(part(1, 1e3, 0, 0), 1); }

TEST_F(Softness, LeavesOutWhatIsPrescribed)
{
  EXPECT_DOUBLE_EQ(part(0, 1, 3, 4), 1);
  EXPECT_DOUBLE_EQ(part(0, 0, 3, 4), 1);
}

TEST_F(Softness, RefusesArraysThatDoNotFit)
{
  const std::vector<double> fits(6 * gdim, 1), none;
  EXPECT_THROW(residual_weight(bodies(), none, fits, gdim),
               std::invalid_argument);
  EXPECT_THROW(residual_weight(bodies(), fits, none, gdim),
               std::invalid_argument);
}
