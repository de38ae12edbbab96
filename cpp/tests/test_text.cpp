// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#include "generator.h"
#include <contactx/text.h>
#include <cstdio>
#include <gtest/gtest.h>

using contactx::number_text;
using contactx::point_text;

TEST(Text, NumbersAreThoseOfPrintf)
{
  contactx::tests::Generator random(1);
  for (int i = 0; i < 2000; ++i)
    for (int digits : {1, 3, 6, 17})
    {
      const double value
          = random(-1, 1) * std::pow(10.0, std::floor(random(-20, 20)));
      std::array<char, 64> expected;
      std::snprintf(expected.data(), expected.size(), "%.*g", digits, value);
      EXPECT_EQ(number_text(value, digits), expected.data());
    }
  EXPECT_EQ(number_text(0.27, 3), "0.27");
  EXPECT_EQ(number_text(1e-5, 6), "1e-05");
  EXPECT_EQ(number_text(infinity, 3), "inf");
  EXPECT_EQ(number_text(std::nan(""), 3), "nan");
  EXPECT_EQ(number_text(-std::nan(""), 3), "nan");
}

TEST(Text, APointHasSixDigitsAndNoRounding)
{
  using Point = std::array<double, 3>;
  EXPECT_EQ(point_text(Point{1, -2.5, 1e6}, 1), "(1, -2.5, 1e+06)");
  EXPECT_EQ(point_text(Point{1.23456789, 2e-10, -2e-10}, 1), "(1.23457, 0, 0)");
  EXPECT_EQ(point_text(Point{-0.0, 2e-9, 0}, 1), "(0, 2e-09, 0)");
  // By the size of the scene
  EXPECT_EQ(point_text(std::array{2e-10, 1.0}, 1e-3), "(2e-10, 1)");
}
