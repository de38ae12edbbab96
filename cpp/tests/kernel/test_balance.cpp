// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#include "kernel_samples.h"

using namespace contactx;
using namespace contactx::tests;

namespace
{
using Values = std::vector<double>;

/// Sums over the nodes of each component of each column are zero.
void expect_balance(const Values& tensor, int gdim, int rows, double relative)
{
  const int columns = static_cast<int>(tensor.size()) / rows;
  const double tolerance = relative * largest(tensor);
  for (int j = 0; j < columns; ++j)
    for (int k = 0; k < gdim; ++k)
    {
      double sum = 0;
      for (int i = k; i < rows; i += gdim)
        sum += tensor[columns * i + j];
      EXPECT_NEAR(sum, 0, tolerance) << "column " << j;
    }
}

/// Moments of forces about the origin sum to zero, relative to the largest.
void expect_no_moment(const Sample& s, double relative)
{
  const int gdim = s.kind.gdim;
  const Values x = s.positions(), forces = s("finite", "residual");
  Vector<3> sum{};
  double size = 0;
  for (std::size_t i = 0; i < x.size(); i += gdim)
  {
    Vector<3> arm{}, force{};
    std::copy_n(&x[i], gdim, arm.begin());
    std::copy_n(&forces[i], gdim, force.begin());
    sum = sum + cross(arm, force);
    size = std::max(size, norm(cross(arm, force)));
  }
  EXPECT_GT(size, 0);
  EXPECT_LE(norm(sum), relative * size);
}

/// Take a term's value at the slave node off its displacement, along a vector.
void move_slave(Sample& s, double factor, const Values& way)
{
  for (int k = 0; k < s.kind.gdim; ++k)
    s.at(Coefficient::displacement)[k] += factor * way[k];
}

TEST(KernelForces, SumToZeroAndSoDoTheirDerivatives)
{
  for_all_samples(
      [](const Sample& s)
      {
        if (s.kind.is_rigid())
          return;
        const double relative = s.kind.is_mortar() ? 1e-12 : 1e-13;
        for (const std::string_view sliding : {"finite", "small"})
          for (const std::string_view term :
               {"residual", "traction", "stiffness"})
            if (s.has(sliding, term))
              expect_balance(s(sliding, term), s.kind.gdim, s.kind.num_dofs(),
                             10 * relative);
      });
}

TEST(KernelForces, OnASlaveNodeAreItsTractionTimesItsArea)
{
  for_all_samples(
      [](const Sample& s)
      {
        if (s.kind.is_mortar())
          return;
        const int gdim = s.kind.gdim;
        const double area = *s.at(Coefficient::area);
        const double* lambda = s.at(Coefficient::multiplier);
        for (const std::string_view sliding : {"finite", "small"})
        {
          Values forces = s(sliding, "residual");
          forces.resize(gdim);
          if (s.kind.law == Law::frictionless)
          {
            const double length = std::sqrt(std::inner_product(
                forces.begin(), forces.end(), forces.begin(), 0.));
            EXPECT_NEAR(length, area * std::abs(*lambda), 1e-13);
          }
          else
            for (int k = 0; k < gdim; ++k)
              EXPECT_NEAR(forces[k], -area * lambda[k], 1e-13);
        }
      });
}

TEST(KernelForces, OfAPressureHaveNoMomentWhereTheProjectionIsInterior)
{
  for_all_samples(
      [](const Sample& s)
      {
        if (s.kind.law == Law::frictionless and !s.kind.is_rigid()
            and s.feature == 0)
          expect_no_moment(s, s.kind.is_mortar() ? 1e-9 : 1e-12);
      });
}

TEST(KernelForces, OfFrictionHaveNoMomentWhereTheBodiesTouch)
{
  for_all_samples(
      [](Sample s)
      {
        if (s.kind.law != Law::frictional or s.kind.is_rigid()
            or s.kind.is_mortar() or s.feature != 0)
          return;
        move_slave(s, -s("finite", "gap")[0], s("finite", "normal"));
        EXPECT_NEAR(s("finite", "gap")[0], 0, 1e-14);
        expect_no_moment(s, 1e-12);
      });
}

TEST(KernelForces, OfATieHaveNoMomentOverAnOpenGap)
{
  // They balance where the constraint holds: each slave node at its place
  for_all_samples(
      [](Sample s)
      {
        if (s.kind.law != Law::tied or s.kind.is_rigid())
          return;
        if (!s.kind.is_mortar())
          move_slave(s, -1, s("finite", "slip"));
        EXPECT_LE(largest(s("finite", "slip")),
                  s.kind.is_mortar() ? 1e-9 : 1e-14);
        expect_no_moment(s, s.kind.is_mortar() ? 1e-9 : 1e-12);
      });
}
} // namespace
