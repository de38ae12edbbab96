// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#include "generator.h"
#include "thread_ranks.h"
#include <cmath>
#include <contactx/math/matrix.h>
#include <contactx/solve/rigid_modes.h>
#include <contactx/solve/springs.h>
#include <gtest/gtest.h>
#include <stdexcept>

using namespace contactx;
using solve::independent_springs;

namespace
{
/// Rigid modes at random points, combined by some columns.
struct Points
{
  Points(int gdim, int count, unsigned seed) : gdim(gdim), random(seed)
  {
    const int m = solve::num_modes(gdim);
    field.resize(m, count * gdim);
    for (int i = 0; i < count; ++i)
    {
      const Vector<3> at = random.vector<3>(-1, 1);
      solve::rigid_modes(at.data(), &field(0, i * gdim), gdim);
      original.push_back((i * 7 + 3) % count);
    }
    for (int i = 0; i < count * gdim; ++i)
      diagonal.push_back(random(-2, -1));
    prescribed.resize(count * gdim);
  }

  std::vector<double> springs() const
  {
    mesh::OneRank ranks;
    return independent_springs(ranks, field, prescribed, diagonal, original,
                               gdim);
  }

  int gdim;
  tests::Generator random;
  Eigen::MatrixXd field;
  std::vector<std::int8_t> prescribed;
  std::vector<double> diagonal;
  std::vector<std::int64_t> original;
};

TEST(Springs, AreStaticallyDeterminate)
{
  for (unsigned seed = 0; seed < 10; ++seed)
    for (const int g : {2, 3})
    {
      Points points(g, 20, seed);
      points.prescribed[5] = points.prescribed[8] = 1;
      const std::vector<double> springs = points.springs();
      std::vector<std::size_t> dofs;
      for (std::size_t i = 0; i < springs.size(); ++i)
        if (springs[i] != 0)
        {
          dofs.push_back(i);
          EXPECT_EQ(springs[i], -points.diagonal[i]);
          EXPECT_EQ(points.prescribed[i], 0);
        }
      // As many as modes, and any forces along these have their springs
      const std::size_t m = points.field.rows();
      ASSERT_EQ(dofs.size(), m);
      const Eigen::MatrixXd columns = points.field(Eigen::all, dofs);
      const Eigen::MatrixXd gram = columns * columns.transpose();
      EXPECT_GT(math::symmetric_eigen(gram).eigenvalues()[0], 0.01);
    }
}

TEST(Springs, DoNotDependOnTheBasis)
{
  for (unsigned seed = 0; seed < 10; ++seed)
    for (const int g : {2, 3})
    {
      Points points(g, 15, seed);
      const std::vector<double> springs = points.springs();
      const auto m = points.field.rows();
      // Eigenvectors of any symmetric matrix are as good a basis
      const Eigen::MatrixXd any = Eigen::MatrixXd::NullaryExpr(
          m, m, [&points] { return points.random(-1, 1); });
      points.field = math::symmetric_eigen(any).eigenvectors().transpose()
                     * points.field;
      EXPECT_EQ(points.springs(), springs);
    }
}

TEST(Springs, OfEqualOnesTheFirstInTheMeshAsItWasMade)
{
  Points points(2, 6, 0);
  // One translation
  points.field.setZero(1, 12);
  for (int i = 0; i < 6; ++i)
    points.field(0, 2 * i + 1) = 1 + (i % 2) * 1e-12;
  const std::vector<double> springs = points.springs();
  const auto first = std::ranges::find(points.original, 0);
  const auto dof = 2 * (first - points.original.begin()) + 1;
  for (std::ptrdiff_t i = 0; i < 12; ++i)
    EXPECT_EQ(springs[i] != 0, i == dof);
}

TEST(Springs, OnSeveralRanksTheyAreThoseOfOne)
{
  for (const int g : {2, 3})
  {
    const Points points(g, 20, 3);
    const std::vector<double> expected = points.springs();
    for (const int size : {2, 3, 4})
      tests::on_ranks(size,
                      [&](mesh::Ranks& ranks)
                      {
                        // The last rank has no node
                        std::vector<Eigen::Index> dofs;
                        std::vector<double> diagonal, mine;
                        std::vector<std::int8_t> prescribed;
                        std::vector<std::int64_t> original;
                        for (int i = 0; i < 20; ++i)
                        {
                          if (i % (size - 1) != ranks.rank())
                            continue;
                          original.push_back(points.original[i]);
                          for (int dof = i * g; dof < (i + 1) * g; ++dof)
                          {
                            dofs.push_back(dof);
                            diagonal.push_back(points.diagonal[dof]);
                            prescribed.push_back(0);
                            mine.push_back(expected[dof]);
                          }
                        }
                        const Eigen::MatrixXd field
                            = points.field(Eigen::all, dofs);
                        EXPECT_EQ(independent_springs(ranks, field, prescribed,
                                                      diagonal, original, g),
                                  mine);
                      });
  }
}

TEST(Springs, WhatDoesNotFitIsRefused)
{
  Points points(2, 4, 0);
  points.diagonal.pop_back();
  EXPECT_THROW(points.springs(), std::invalid_argument);
}
} // namespace
