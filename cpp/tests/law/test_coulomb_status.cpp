// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#include "coulomb_node.h"
#include <cmath>
#include <gtest/gtest.h>
#include <vector>

using namespace contactx;
using namespace contactx::law;
using namespace contactx::tests;

namespace
{
template <class Dimension>
class CoulombStatus : public ::testing::Test
{
};
using Dimensions = ::testing::Types<std::integral_constant<int, 2>,
                                    std::integral_constant<int, 3>>;
TYPED_TEST_SUITE(CoulombStatus, Dimensions);

TYPED_TEST(CoulombStatus, IsOpenWhereTheTrialPressureIsNotPositive)
{
  constexpr int D = TypeParam::value;
  EXPECT_EQ((upright<D>(0, 0, 0, 0, 0.5).status()), open);
  EXPECT_EQ((upright<D>(2, 0, 0.25, 0, 0.5).status()), open);
  EXPECT_EQ((upright<D>(std::nextafter(2, 3), 0, 0.25, 0, 0.5).status()),
            stick);
  EXPECT_EQ((upright<D>(0, 0, -0.25, 0, 0.5).status()), stick);
  EXPECT_EQ((upright<D>(-1, 0, 0, 0, 0.5).status()), open);
  EXPECT_EQ((upright<D>(-2, 5, -0.125, 0, 0.5).status()), open);
}

TYPED_TEST(CoulombStatus, AClosedNodeOpensOnlyWithoutPressure)
{
  constexpr int D = TypeParam::value;
  for (std::int8_t closed : {stick, slip})
  {
    // mu p_hat = 1, however wide the gap is
    EXPECT_EQ((upright<D>(2, 0.5, 1e3, 0, 0.5).status(closed)), stick);
    EXPECT_EQ((upright<D>(2, 1.5, 1e3, 0, 0.5).status(closed)), slip);
    EXPECT_EQ((upright<D>(0, 0, 0.25, 0, 0.5).status(closed)), open);
    EXPECT_EQ((upright<D>(-1, 0, 0.25, 0, 0.5).status(closed)), open);
    EXPECT_EQ((upright<D>(-1, 0, -0.25, 0, 0.5).status(closed)), stick);
    EXPECT_EQ((upright<D>(-3, 0, -0.25, 0, 0.5).status(closed)), open);
    EXPECT_EQ((upright<D>(1, 0, NAN, 0, 0.5).status(closed)), open);
  }
}

TYPED_TEST(CoulombStatus, IsOpenWithoutAPair)
{
  constexpr int D = TypeParam::value;
  EXPECT_EQ((upright<D>(1, 0, NAN, 0, 0.5).status()), open);
  EXPECT_EQ((upright<D>(NAN, 0, -1, 0, 0.5).status()), open);
}

TYPED_TEST(CoulombStatus, SticksUpToTheBound)
{
  constexpr int D = TypeParam::value;
  for (double sign : {1.0, -1.0})
  {
    // mu p_hat = 0.5 (2 + 8 * 0.25) = 2
    const auto at = [sign](double t, double slip)
    { return upright<D>(2, sign * t, -0.25, sign * slip, 0.5).status(); };
    EXPECT_EQ(at(2, 0), stick);
    EXPECT_EQ(at(std::nextafter(2, 3), 0), slip);
    EXPECT_EQ(at(0, 0.25), stick);
    EXPECT_EQ(at(0, std::nextafter(0.25, 1)), slip);
    EXPECT_EQ(at(1, -0.125), stick);
    EXPECT_EQ(at(1, -0.125 * (1 + 1e-14)), slip);
    EXPECT_EQ(at(1, 0.375), stick);
    EXPECT_EQ(at(0.04, 0.5), slip);
  }
}

TYPED_TEST(CoulombStatus, SticksBeforeSlipTurnsBack)
{
  constexpr int D = TypeParam::value;
  // mu p_hat = 1; t_hat = t - 8 ds
  for (double sign : {1.0, -1.0})
  {
    const auto at = [sign](double t, double slip)
    { return upright<D>(2, sign * t, 0, sign * slip, 0.5).status(); };
    EXPECT_EQ(at(1, -1), slip);
    EXPECT_EQ(at(0, 1), slip);
    EXPECT_EQ(at(0.04, 1), slip);
    EXPECT_EQ(at(0.06, 1), stick);
    EXPECT_EQ(at(1, 1), stick);
  }
}

TYPED_TEST(CoulombStatus, SlipsOnWhereFrictionCannotHaveThrownIt)
{
  constexpr int D = TypeParam::value;
  // mu p_hat = 1; |t_hat| = 7 and far more
  auto node = upright<D>(2, 1, 0, 1, 0.5);
  EXPECT_EQ(node.status(), stick);
  node.reach = 6.9;
  EXPECT_EQ(node.status(), slip);
  auto far = upright<D>(2, 1, 0, 1e6, 0.5);
  EXPECT_EQ(far.status(), slip);
  far.reach = 1e9;
  EXPECT_EQ(far.status(), stick);
}

TYPED_TEST(CoulombStatus, SlipsAnyWayWithoutFriction)
{
  constexpr int D = TypeParam::value;
  for (double friction : {0.0, 1e-12})
    for (double rounding : {0.0, 1e-17, -1e-17})
      EXPECT_EQ((upright<D>(2, rounding, 0, 0.25, friction).status()), slip);
}

TYPED_TEST(CoulombStatus, WithoutFrictionNothingSticks)
{
  constexpr int D = TypeParam::value;
  EXPECT_EQ((upright<D>(1, 0, 0, 0, 0).status()), slip);
  EXPECT_EQ((upright<D>(1, 1e-150, 0, 0, 0).status()), slip);
  EXPECT_EQ((upright<D>(1, 0, 0, -1e-150, 0).status()), slip);
  EXPECT_EQ((upright<D>(0, 1, 0, 1, 0).status()), open);
}

TYPED_TEST(CoulombStatus, CountsTheNodesThatChange)
{
  constexpr int D = TypeParam::value;
  // open, stick, slip
  const std::array nodes{upright<D>(-1, 0, 0, 0, 0.5),
                         upright<D>(1, 0.25, 0, 0, 0.5),
                         upright<D>(1, 1, 0, 0, 0.5)};
  std::vector<double> traction, gap, normal, slips, c, friction;
  for (const auto& node : nodes)
  {
    traction.insert(traction.end(), node.traction.begin(), node.traction.end());
    normal.insert(normal.end(), node.normal.begin(), node.normal.end());
    slips.insert(slips.end(), node.slip.begin(), node.slip.end());
    gap.push_back(node.gap);
    c.push_back(node.c);
    friction.push_back(node.friction);
  }
  const FrictionalState state{D, traction, gap, normal, slips, c, friction};
  std::array<std::int8_t, 3> status{stick, stick, stick};
  EXPECT_EQ(frictional_status(state, 10, status), 2);
  EXPECT_EQ(status, (std::array<std::int8_t, 3>{open, stick, slip}));
  EXPECT_EQ(frictional_status(state, 10, status), 0);
}
} // namespace
