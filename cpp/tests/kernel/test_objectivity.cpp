// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#include "kernel_samples.h"

using namespace contactx;
using namespace contactx::tests;

namespace
{
using Values = std::vector<double>;

/// Turn vectors of gdim components, or move points.
Values turned(const Motion<3>& motion, const Values& x, int gdim, bool points)
{
  Values y(x.size());
  for (std::size_t i = 0; i < x.size(); i += gdim)
  {
    Vector<3> v{};
    std::copy_n(&x[i], gdim, v.begin());
    v = points ? motion(v) : motion.rotate(v);
    std::copy_n(v.begin(), gdim, &y[i]);
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
          for (std::size_t i = 0; i < x.size(); i += gdim)
          {
            Vector<3> p{};
            std::copy_n(&x[i], gdim, p.begin());
            const auto r = way + cross(spin, p);
            std::copy_n(r.begin(), gdim, &v[i]);
          }
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

TEST(KernelsUnderRigidMotion, ATranslationChangesNothingInSmallSliding)
{
  for_all_samples(
      [](const Sample& s)
      {
        if (s.kind.is_rigid())
          return;
        Values x = s.positions();
        for (std::size_t i = 0; i < x.size(); ++i)
          x[i] += 0.3 * (1 + i % s.kind.gdim);
        Sample moved = s;
        moved.move_to(x, false);
        for (const std::string_view term :
             {"gap", "normal", "slip", "residual"})
          if (s.has("small", term))
            expect_close(moved("small", term), s("small", term), 1e-12, 1);
      });
}

TEST(KernelsUnderRigidMotion, DigitsDoNotDependOnTheDistanceFromTheOrigin)
{
  for_all_samples(
      [](const Sample& s)
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
      });
}
} // namespace
