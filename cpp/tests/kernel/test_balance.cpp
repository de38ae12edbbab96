// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#include "expect.h"
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
  for (std::size_t i = 0; i < x.size() / gdim; ++i)
  {
    const auto moment
        = cross(vector_at(x, i, gdim), vector_at(forces, i, gdim));
    sum = sum + moment;
    size = std::max(size, norm(moment));
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

TEST_SAMPLES(KernelForces, SumToZeroAndSoDoTheirDerivatives)
{
  if (s.kind.is_rigid())
    return;
  const double relative = s.kind.is_mortar() ? 1e-12 : 1e-13;
  for (const std::string_view sliding : {"finite", "small"})
    for (const std::string_view term : {"residual", "traction", "stiffness"})
      if (s.has(sliding, term))
        expect_balance(s(sliding, term), s.kind.gdim, s.kind.num_dofs(),
                       10 * relative);
}

TEST_SAMPLES(KernelForces, OnASlaveNodeAreItsTractionTimesItsArea)
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
      const double length = std::sqrt(
          std::inner_product(forces.begin(), forces.end(), forces.begin(), 0.));
      EXPECT_NEAR(length, area * std::abs(*lambda), 1e-13);
    }
    else
      for (int k = 0; k < gdim; ++k)
        EXPECT_NEAR(forces[k], -area * lambda[k], 1e-13);
  }
}

TEST_SAMPLES(KernelForces, HaveNoMomentWhereTheirConditionsHold)
{
  const double rounding = s.kind.is_mortar() ? 1e-9 : 1e-12;
  if (s.kind.is_rigid())
    return;
  // A pressure's where the projection is interior
  if (s.kind.law == Law::frictionless and s.feature == 0)
    expect_no_moment(s, rounding);
  // Friction's where the bodies touch
  if (s.kind.law == Law::frictional and !s.kind.is_mortar() and s.feature == 0)
  {
    move_slave(s, -s("finite", "gap")[0], s("finite", "normal"));
    EXPECT_NEAR(s("finite", "gap")[0], 0, 1e-14);
    expect_no_moment(s, rounding);
  }
  // A tie's over an open gap: each slave node at its place
  if (s.kind.law == Law::tied)
  {
    if (!s.kind.is_mortar())
      move_slave(s, -1, s("finite", "slip"));
    EXPECT_LE(largest(s("finite", "slip")), s.kind.is_mortar() ? 1e-9 : 1e-14);
    expect_no_moment(s, rounding);
  }
}

/// Turn vectors of gdim components, or move points.
Values turned(const Motion<3>& motion, const Values& x, int gdim, bool points)
{
  Values y(x.size());
  for (std::size_t i = 0; i < x.size() / gdim; ++i)
  {
    const Vector<3> v = vector_at(x, i, gdim);
    std::copy_n((points ? motion(v) : motion.rotate(v)).begin(), gdim,
                &y[gdim * i]);
  }
  return y;
}

/// A motion of space, or of its first plane.
Motion<3> motion_of(int gdim, Generator& random)
{
  Motion<3> motion(random, 2);
  if (gdim == 3)
    return motion;
  const Motion<2> plane(random, 2);
  motion.shift = {plane.shift[0], plane.shift[1], 0};
  motion.rows = {{{plane.rows[0][0], plane.rows[0][1], 0},
                  {plane.rows[1][0], plane.rows[1][1], 0},
                  {0, 0, 1}}};
  return motion;
}

TEST(KernelsUnderRigidMotion, TurnEverythingAndChangeNothing)
{
  Generator random(1);
  for_all_samples(
      [&random](const Sample& s)
      {
        if (s.kind.is_rigid())
          return;
        const int gdim = s.kind.gdim;
        const auto motion = motion_of(gdim, random);
        Sample moved = s;
        if (s.keeps_normal())
        {
          double* n
              = moved.at(Coefficient::pair)
                + kernel::MortarLayout(s.kind.num_slaves, s.kind.num_nodes)
                      .normal;
          const Values before(n, n + gdim);
          std::ranges::copy(turned(motion, before, gdim, false), n);
        }
        moved.move_to(turned(motion, s.positions(), gdim, true), true);
        if (s.kind.law != Law::frictionless)
        {
          double* lambda = moved.at(Coefficient::multiplier);
          const Values before(lambda, lambda + s.kind.num_slaves * gdim);
          std::ranges::copy(turned(motion, before, gdim, false), lambda);
        }
        const double tolerance = s.kind.is_mortar() ? 1e-10 : 1e-12;
        expect_close(moved("finite", "gap"), s("finite", "gap"), tolerance, 1);
        for (const std::string_view term : {"normal", "slip", "residual"})
          if (s.has("finite", term))
            expect_close(moved("finite", term),
                         turned(motion, s("finite", term), gdim, false),
                         tolerance, 1);
      });
}

TEST(KernelsUnderRigidMotion, AnInfinitesimalOneTurnsForcesAndKeepsGaps)
{
  Generator random(2);
  for_all_samples(
      [&random](const Sample& s)
      {
        const bool is_share = s.kind.is_mortar() and !s.covers;
        if (s.kind.is_rigid() or s.kind.law != Law::frictionless or is_share
            or s.keeps_normal())
          return;
        const int gdim = s.kind.gdim, dofs = s.kind.num_dofs();
        const Vector<3> spin = gdim == 3 ? random.vector<3>(-1, 1)
                                         : Vector<3>{0, 0, random(-1, 1)};
        const Vector<3> shift = random.vector<3>(-1, 1);
        const auto rate = [&](const Values& x, const Vector<3>& way)
        {
          Values v(x.size());
          for (std::size_t i = 0; i < x.size() / gdim; ++i)
            std::copy_n((way + cross(spin, vector_at(x, i, gdim))).begin(),
                        gdim, &v[gdim * i]);
          return v;
        };
        const auto times = [dofs](const Values& A, const Values& v)
        {
          Values y(A.size() / dofs);
          for (std::size_t i = 0; i < A.size(); ++i)
            y[i / dofs] += A[i] * v[i % dofs];
          return y;
        };
        const Values v = rate(s.positions(), shift);
        const double tolerance = s.kind.is_mortar() ? 1e-8 : 1e-11;
        const Values change = times(s("finite", "constraint"), v);
        expect_close(change, Values(change.size()), tolerance, 1);
        expect_close(times(s("finite", "stiffness"), v),
                     rate(s("finite", "residual"), {}), tolerance, 1);
      });
}

TEST_SAMPLES(KernelsUnderRigidMotion, ATranslationChangesNothingInSmallSliding)
{
  if (s.kind.is_rigid())
    return;
  Values x = s.positions();
  for (std::size_t i = 0; i < x.size(); ++i)
    x[i] += 0.3 * (1 + i % s.kind.gdim);
  Sample moved = s;
  moved.move_to(x, false);
  for (const std::string_view term : {"gap", "normal", "slip", "residual"})
    if (s.has("small", term))
      expect_close(moved("small", term), s("small", term), 1e-12, 1);
}

TEST_SAMPLES(KernelsUnderRigidMotion,
             DigitsDoNotDependOnTheDistanceFromTheOrigin)
{
  if (s.kind.is_rigid())
    return;
  constexpr double far = 1 << 20;
  Sample near = s, moved = s;
  for (std::size_t i = 0; i < s.positions().size(); ++i)
  {
    double& x = moved.at(Coefficient::position)[i];
    x += far;
    near.at(Coefficient::position)[i] = x - far;
  }
  for (const std::string_view sliding : {"small", "finite"})
    for (const std::string_view term :
         {"gap", "normal", "slip", "residual", "stiffness"})
      if (s.has(sliding, term))
      {
        EXPECT_EQ(moved(sliding, term), near(sliding, term));
      }
}

TEST(KernelNodal, AddsItsCoefficient)
{
  for (const int n : {1, 2, 3, 4, 9})
  {
    std::vector<double> w(n), tensor(n, 1);
    std::iota(w.begin(), w.end(), 1);
    kernel::nodal(n)(tensor.data(), w.data(), nullptr, nullptr, nullptr,
                     nullptr, nullptr);
    for (int i = 0; i < n; ++i)
      EXPECT_EQ(tensor[i], i + 2);
  }
  EXPECT_REFUSED(kernel::nodal(5));
}

TEST(KernelNodal, SlaveNodesOfOtherRanksHaveNoForcesHere)
{
  int count = 0;
  for_all_samples(
      [&count](Sample s)
      {
        if (not s.kind.is_mortar())
          return;
        for (const char* sliding : {"finite", "small"})
        {
          const std::vector<double> all = s(sliding, "traction");
          double& area = s.at(Coefficient::area)[0];
          const double own = std::exchange(area, kernel::area_elsewhere);
          const std::vector<double> left = s(sliding, "traction");
          area = own;
          const int size = s.kind.size(), width = size * s.kind.num_slaves;
          for (std::size_t i = 0; i < all.size(); ++i)
            EXPECT_EQ(left[i], int(i) % width < size ? 0 : all[i]);
          ++count;
        }
      });
  EXPECT_GT(count, 0);
}
} // namespace
