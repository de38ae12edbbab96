// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#pragma once

#include <gtest/gtest.h>
#include <source_location>
#include <span>
#include <stdexcept>
#include <string>
#include <vector>
/// @brief Expect that what a call is given is refused.
#define EXPECT_REFUSED(...) EXPECT_THROW(__VA_ARGS__, std::invalid_argument)

/// @brief A test that runs in the plane and in space.
#define TEST_2D_3D(suite, name, dim)                                           \
  static void suite##_##name(int dim);                                         \
  TEST(suite, name)                                                            \
  {                                                                            \
    suite##_##name(2);                                                         \
    suite##_##name(3);                                                         \
  }                                                                            \
  void suite##_##name(const int dim)

/// @brief A test of a typed suite whose type has a name.
#define TYPED_TEST_OF(suite, name, type)                                       \
  template <class type>                                                        \
  static void suite##_##name();                                                \
  TYPED_TEST(suite, name) { suite##_##name<TypeParam>(); }                     \
  template <class type>                                                        \
  void suite##_##name()

/// @brief A test of a typed suite that runs in the plane and in space.
#define TYPED_TEST_2D_3D(suite, name, dim)                                     \
  template <class TypeParam>                                                   \
  static void suite##_##name(int dim);                                         \
  TYPED_TEST(suite, name)                                                      \
  {                                                                            \
    suite##_##name<TypeParam>(2);                                              \
    suite##_##name<TypeParam>(3);                                              \
  }                                                                            \
  template <class TypeParam>                                                   \
  void suite##_##name(const int dim)

namespace contactx::tests
{
/// @brief What a call says that throws; empty if it does not.
template <class Error = std::invalid_argument, class Call>
std::string refusal(Call call)
{
  try
  {
    call();
  }
  catch (const Error& error)
  {
    return error.what();
  }
  return "";
}

/// @brief Expect some words in a text.
inline void expect_says(const std::string& text, const std::string& words,
                        std::source_location at
                        = std::source_location::current())
{
  const testing::ScopedTrace trace(at.file_name(), static_cast<int>(at.line()),
                                   words);
  EXPECT_NE(text.find(words), std::string::npos) << text;
}

/// @brief Expect that a call is refused by some words.
template <class Error = std::invalid_argument, class Call>
void expect_refusal(Call call, const std::string& words,
                    std::source_location at = std::source_location::current())
{
  expect_says(refusal<Error>(call), words, at);
}

/// @brief Expect as many numbers as others, each near its other.
inline void expect_near(std::span<const double> found,
                        std::span<const double> expected, double tolerance,
                        std::source_location at
                        = std::source_location::current())
{
  const testing::ScopedTrace trace(at.file_name(), static_cast<int>(at.line()),
                                   "");
  ASSERT_EQ(found.size(), expected.size());
  for (std::size_t i = 0; i < found.size(); ++i)
    EXPECT_NEAR(found[i], expected[i], tolerance) << "entry " << i;
}

inline void
expect_near(std::span<const double> found,
            std::initializer_list<double> expected, double tolerance,
            std::source_location at = std::source_location::current())
{
  expect_near(found, std::vector<double>(expected), tolerance, at);
}
} // namespace contactx::tests
