// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#include "kernel_samples.h"

using namespace contactx;
using namespace contactx::tests;

namespace
{
using Values = std::vector<double>;

/// Derivative of f(step) at zero by four steps, of fourth order.
template <class Function>
Values derivative(Function&& f, double h)
{
  const Values a = f(h), b = f(-h), c = f(2 * h), d = f(-2 * h);
  Values result(a.size());
  for (std::size_t i = 0; i < a.size(); ++i)
    result[i] = (8 * (a[i] - b[i]) - (c[i] - d[i])) / (12 * h);
  return result;
}

/// Derivative of f(sample) by one coefficient, [rows][columns].
template <class Function>
Values derivative_by(const Sample& sample, Coefficient by, int columns,
                     bool follow, Function&& f)
{
  Values result;
  for (int j = 0; j < columns; ++j)
  {
    const Values column = derivative(
        [&](double step)
        {
          Sample moved = sample;
          moved.at(by)[j] += step;
          if (follow and moved.renew)
            moved.renew(moved);
          return f(moved);
        },
        2e-4);
    result.resize(column.size() * columns);
    for (std::size_t i = 0; i < column.size(); ++i)
      result[columns * i + j] = column[i];
  }
  return result;
}

/// Derivative of a term by the displacement. In finite sliding the pair's data
/// follow it.
Values by_displacement(const Sample& sample, std::string_view sliding,
                       std::string_view term)
{
  return derivative_by(sample, Coefficient::displacement,
                       sample.kind.num_dofs(), sliding == "finite",
                       [=](const Sample& s) { return s(sliding, term); });
}

/// Derivative of the complementarity function through gap, slip and normal.
Values expected_constraint(const Sample& sample, std::string_view sliding)
{
  const Kind& kind = sample.kind;
  const int size = kind.size(), dofs = kind.num_dofs(), gdim = kind.gdim;
  Values result(kind.num_slaves * size * dofs);
  // A tie to facets measures movement alone
  const bool moves_alone = kind.law == Law::tied and !kind.is_rigid();
  if (!moves_alone)
  {
    const Values dg = by_displacement(sample, sliding, "gap");
    for (int row = 0; row < kind.num_slaves * size; ++row)
      for (int j = 0; j < dofs; ++j)
        result[dofs * row + j] += sample.at(Coefficient::gap_derivative)[row]
                                  * dg[dofs * (row / size) + j];
  }
  const auto add = [&](Coefficient by, std::string_view term)
  {
    if (!sample.has(sliding, term))
      return;
    const Values d = by_displacement(sample, sliding, term);
    for (int row = 0; row < kind.num_slaves * gdim; ++row)
      for (int k = 0; k < gdim; ++k)
        for (int j = 0; j < dofs; ++j)
          result[dofs * row + j] += sample.at(by)[gdim * row + k]
                                    * d[dofs * (row - row % gdim + k) + j];
  };
  if (kind.law != Law::frictionless)
  {
    add(Coefficient::slip_derivative, "slip");
    if (!moves_alone)
      add(Coefficient::normal_derivative, "normal");
  }
  return result;
}

/// A facet's share in a slave facet that lies in front of several is consistent
/// together with theirs alone: what moves from one to the next is left out.
bool is_share(const Sample& s)
{
  return s.kind.is_mortar() and !s.kind.is_rigid() and !s.covers
         and s.kind.law != Law::tied;
}

TEST(KernelDerivatives, StiffnessIsThatOfTheForces)
{
  for_all_samples(
      [](const Sample& s)
      {
        if (is_share(s))
          return;
        const Values expected = by_displacement(s, "finite", "residual");
        Values computed(expected.size());
        if (s.has("finite", "stiffness"))
          computed = s("finite", "stiffness");
        const int size = s.kind.num_slaves * s.kind.size();
        const double* p = s.at(Coefficient::multiplier);
        // A tie has none without a gap
        const double unit = s.kind.law == Law::tied or !largest(computed)
                                ? largest(Values(p, p + size))
                                : 0;
        expect_close(computed, expected, 1e-7, unit);
      });
}

TEST(KernelDerivatives, SmallSlidingHasNoStiffness)
{
  for_all_samples(
      [](Sample s)
      {
        EXPECT_FALSE(s.has("small", "stiffness"));
        const Values before = s("small", "residual");
        for (int i = 0; i < s.kind.num_dofs(); ++i)
          s.at(Coefficient::displacement)[i] += 0.1 * (i + 1);
        EXPECT_EQ(s("small", "residual"), before);
      });
}

TEST(KernelDerivatives, TractionIsThatOfTheForcesByTheMultiplier)
{
  for_all_samples(
      [](const Sample& s)
      {
        for (const std::string_view sliding : {"finite", "small"})
        {
          const Values expected = derivative_by(
              s, Coefficient::multiplier, s.kind.num_slaves * s.kind.size(),
              false,
              [=](const Sample& moved) { return moved(sliding, "residual"); });
          expect_close(s(sliding, "traction"), expected, 1e-10);
        }
      });
}

TEST(KernelDerivatives, ConstraintIsThatThroughGapSlipAndNormal)
{
  for_all_samples(
      [](const Sample& s)
      {
        if (!is_share(s))
        {
          const Values expected = expected_constraint(s, "finite");
          expect_close(s("finite", "constraint"), expected, 1e-7);
        }
        if (s.kind.is_rigid())
        {
          // An obstacle's data stay, and the kernels are those of finite
          // sliding
          EXPECT_EQ(s("small", "constraint"), s("finite", "constraint"));
        }
        else
        {
          const Values expected = expected_constraint(s, "small");
          expect_close(s("small", "constraint"), expected, 1e-7);
        }
      });
}

TEST(KernelDerivatives, AreZeroWhereTheComplementaritySeesNothing)
{
  for_all_samples(
      [](Sample s)
      {
        std::fill(s.w.begin()
                      + (s.at(Coefficient::gap_derivative) - s.w.data()),
                  s.w.end(), 0.0);
        for (const std::string_view sliding : {"finite", "small"})
          EXPECT_EQ(largest(s(sliding, "constraint")), 0);
      });
}

TEST(KernelDerivatives, ForcesAndStiffnessAreZeroWithoutMultiplier)
{
  for_all_samples(
      [](Sample s)
      {
        std::fill_n(s.at(Coefficient::multiplier),
                    s.kind.num_slaves * s.kind.size(), 0.0);
        for (const std::string_view sliding : {"finite", "small"})
          EXPECT_EQ(largest(s(sliding, "residual")), 0);
        if (s.has("finite", "stiffness"))
        {
          EXPECT_EQ(largest(s("finite", "stiffness")), 0);
        }
      });
}
} // namespace
