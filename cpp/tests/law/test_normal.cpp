// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#include <array>
#include <cmath>
#include <contactx/law/normal.h>
#include <gtest/gtest.h>

using namespace contactx::law;

namespace
{
std::int8_t status_of(double pressure, double gap, double c,
                      std::int8_t before = open)
{
  const std::array p{pressure}, g{gap}, cs{c};
  std::array<std::int8_t, 1> status{before};
  normal_status({p, g, cs}, status);
  return status[0];
}

/// Complementarity function of one node: value and its two derivatives.
std::array<double, 3> function_of(double pressure, double gap, double c,
                                  double area, std::int8_t status)
{
  const std::array p{pressure}, g{gap}, cs{c}, a{area};
  const std::array s{status};
  std::array<double, 1> value, d_pressure, d_gap;
  normal_complementarity({p, g, cs}, a, s, value, d_pressure, d_gap);
  return {value[0], d_pressure[0], d_gap[0]};
}

TEST(NormalStatus, IsClosedWhereThePressureExceedsTheGap)
{
  EXPECT_EQ(status_of(1, 0, 10), slip);
  EXPECT_EQ(status_of(0, -0.1, 10), slip);
  EXPECT_EQ(status_of(2, 0.1, 10), slip);
  EXPECT_EQ(status_of(-0.5, -0.1, 10), slip);
  EXPECT_EQ(status_of(-1, 0, 10), open);
  EXPECT_EQ(status_of(0, 0.1, 10), open);
  EXPECT_EQ(status_of(0.5, 0.1, 10), open);
  EXPECT_EQ(status_of(-2, -0.1, 10), open);
  // On the boundary
  EXPECT_EQ(status_of(0, 0, 10), open);
  EXPECT_EQ(status_of(2, 0.25, 8), open);
  EXPECT_EQ(status_of(std::nextafter(2, 3), 0.25, 8), slip);
  // Without a pair
  const double nan = std::nan("");
  EXPECT_EQ(status_of(1, nan, 10), open);
  EXPECT_EQ(status_of(nan, -1, 10), open);
  EXPECT_EQ(status_of(nan, nan, 10), open);
}

TEST(NormalStatus, AClosedNodeOpensOnlyWithoutPressure)
{
  for (std::int8_t closed : {stick, slip})
  {
    EXPECT_EQ(status_of(1e-9, 1e3, 10, closed), slip);
    EXPECT_EQ(status_of(0, 0.1, 10, closed), open);
    EXPECT_EQ(status_of(-1, 0.1, 10, closed), open);
    EXPECT_EQ(status_of(-0.5, -0.1, 10, closed), slip);
    EXPECT_EQ(status_of(-2, -0.1, 10, closed), open);
    EXPECT_EQ(status_of(1, std::nan(""), 10, closed), open);
  }
}

TEST(NormalComplementarity, IsTheGapOnClosedNodesAndThePressureOnOpenOnes)
{
  using Values = std::array<double, 3>;
  for (std::int8_t status : {stick, slip})
    EXPECT_EQ(function_of(3, -0.5, 10, 2, status), (Values{-10, 0, 20}));
  EXPECT_EQ(function_of(3, 0.5, 10, 2, open), (Values{6, 2, 0}));
  // The gap is not read without a pair
  EXPECT_EQ(function_of(3, std::nan(""), 10, 2, open), (Values{6, 2, 0}));
  // Zero where the conditions hold
  for (double gap : {0.0, 0.5})
  {
    const double pressure = gap > 0 ? 0 : 2;
    const std::int8_t status = status_of(pressure, gap, 10);
    EXPECT_EQ(function_of(pressure, gap, 10, 2, status)[0], 0);
  }
}

TEST(NormalComplementarity, TreatsEachNodeOnItsOwn)
{
  const std::array p{3.0, 4.0}, g{-1.0, 2.0}, c{10.0, 20.0}, a{0.5, 0.25};
  const std::array<std::int8_t, 2> status{slip, open};
  std::array<double, 2> value, d_pressure, d_gap;
  normal_complementarity({p, g, c}, a, status, value, d_pressure, d_gap);
  EXPECT_EQ(value, (std::array{-5.0, 1.0}));
  EXPECT_EQ(d_pressure, (std::array{0.0, 0.25}));
  EXPECT_EQ(d_gap, (std::array{5.0, 0.0}));
}

} // namespace
