// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#include "generator.h"
#include <contactx/mesh/triquadratic.h>
#include <gtest/gtest.h>

using namespace contactx;
using namespace contactx::mesh;
using namespace contactx::tests;

namespace
{
/// A polynomial by its coefficients of powers.
double value(const mesh::Triquadratic& a, const Vector<3>& x)
{
  double sum = 0;
  for (int p = 0; p < 27; ++p)
    sum += a[p] * std::pow(x[0], p % 3) * std::pow(x[1], p / 3 % 3)
           * std::pow(x[2], p / 9);
  return sum;
}

/// A polynomial by its coefficients in Bernstein's basis.
double bernstein(const mesh::Triquadratic& b, const Vector<3>& x)
{
  const auto basis = [](double s) -> Vector<3>
  { return {(1 - s) * (1 - s), 2 * s * (1 - s), s * s}; };
  double sum = 0;
  for (int p = 0; p < 27; ++p)
    sum += b[p] * basis(x[0])[p % 3] * basis(x[1])[p / 3 % 3]
           * basis(x[2])[p / 9];
  return sum;
}

mesh::Triquadratic random_polynomial(Generator& random)
{
  mesh::Triquadratic a;
  for (double& c : a)
    c = random(-1, 1);
  return a;
}

mesh::Triquadratic coefficients_of(const mesh::Triquadratic& a)
{
  mesh::Triquadratic values;
  for (int p = 0; p < 27; ++p)
    values[p] = value(a, {0.5 * (p % 3), 0.5 * (p / 3 % 3), 0.5 * (p / 9)});
  return mesh::coefficients(values);
}

TEST(Triquadratic, CoefficientsGiveThePolynomial)
{
  Generator random(1);
  for (int i = 0; i < 100; ++i)
  {
    const auto a = random_polynomial(random);
    const auto b = coefficients_of(a);
    const auto x = random.vector<3>(0, 1);
    EXPECT_NEAR(bernstein(b, x), value(a, x), 1e-13);
  }
}

TEST(Triquadratic, HalvesAreTheSamePolynomial)
{
  Generator random(2);
  for (int i = 0; i < 100; ++i)
  {
    const auto a = random_polynomial(random);
    for (int variable = 0; variable < 3; ++variable)
      for (const bool upper : {false, true})
      {
        const auto b = mesh::half(coefficients_of(a), variable, upper);
        const auto x = random.vector<3>(0, 1);
        auto whole = x;
        whole[variable] = 0.5 * (x[variable] + upper);
        EXPECT_NEAR(bernstein(b, x), value(a, whole), 1e-13);
      }
  }
}
} // namespace
