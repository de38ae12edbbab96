// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#include "generator.h"
#include "thread_ranks.h"
#include <contactx/math/matrix.h>
#include <contactx/solve/held_motions.h>
#include <contactx/solve/motion_fields.h>
#include <gtest/gtest.h>

using namespace contactx;
using namespace contactx::solve;
using Eigen::MatrixXd;
using Eigen::VectorXd;

namespace
{
/// Motions of two groups of bodies, whose numbers and dofs alternate.
struct Motions
{
  explicit Motions(unsigned seed) : random(seed)
  {
    all = MatrixXd::Zero(5, 24);
    for (Eigen::Index k = 0; k < all.rows(); ++k)
      for (Eigen::Index i = 0; i < all.cols(); ++i)
        if (k % 2 == i % 2)
          all(k, i) = random(-1, 1);
  }

  /// The dofs of a rank: every so many of them.
  std::vector<Eigen::Index> dofs(mesh::Ranks& ranks) const
  {
    std::vector<Eigen::Index> mine;
    for (Eigen::Index i = 0; i < all.cols(); ++i)
      if ((i / 2) % ranks.size() == ranks.rank())
        mine.push_back(i);
    return mine;
  }

  MotionFields fields(mesh::Ranks& ranks) const
  {
    std::vector<MotionFields::Part> parts{{{0, 2, 4}, {}, {}},
                                          {{1, 3}, {}, {}}};
    const std::vector<Eigen::Index> mine = dofs(ranks);
    for (Eigen::Index k = 0; k < 2; ++k)
    {
      std::vector<Eigen::Index> global;
      for (std::size_t i = 0; i < mine.size(); ++i)
        if (mine[i] % 2 == k)
        {
          parts[k].dofs.push_back(i);
          global.push_back(mine[i]);
        }
      parts[k].by = all(parts[k].motions, global);
    }
    return {ranks, std::move(parts)};
  }

  tests::Generator random;
  MatrixXd all;
};

VectorXd of_rank(const VectorXd& values, const std::vector<Eigen::Index>& dofs)
{
  return values(dofs);
}

TEST(MotionFields, AreThoseOfOneMatrix)
{
  Motions motions(1);
  const std::vector<double> numbers = motions.random.numbers(24, -1, 1);
  const VectorXd u = math::column(numbers);
  const VectorXd work = motions.all * u;
  const VectorXd part
      = (motions.all * motions.all.transpose()).ldlt().solve(work);
  for (const int size : {1, 2, 3})
    tests::on_ranks(size,
                    [&](mesh::Ranks& ranks)
                    {
                      MotionFields fields = motions.fields(ranks);
                      EXPECT_EQ(fields.size(), 5);
                      const auto dofs = motions.dofs(ranks);
                      const VectorXd mine = of_rank(u, dofs);
                      const std::span span(mine.data(), mine.size());
                      EXPECT_LT((fields.work(span) - work).norm(), 1e-14);
                      EXPECT_LT((fields.part_of(span) - part).norm(), 1e-12);
                      const std::vector<double> by
                          = fields.displacements(part, dofs.size());
                      const VectorXd expected
                          = of_rank(motions.all.transpose() * part, dofs);
                      EXPECT_LT((math::column(by) - expected).norm(), 1e-14);
                      std::vector<std::int8_t> markers(dofs.size());
                      markers[3] = 1;
                      fields.fix(markers);
                      EXPECT_EQ(fields.displacements(part, dofs.size())[3], 0);
                    });
}

TEST(MotionFields, DependentOnesAreRefused)
{
  Motions motions(2);
  motions.all.row(2) = motions.all.row(0);
  mesh::OneRank ranks;
  EXPECT_THROW(motions.fields(ranks).part_of(std::vector<double>(24, 1.0)),
               std::domain_error);
}

TEST(HeldMotions, LeaveForcesThatDoNoWork)
{
  Motions motions(3);
  const std::vector<double> numbers = motions.random.numbers(24, -1, 1);
  for (const int size : {1, 2})
    tests::on_ranks(size,
                    [&](mesh::Ranks& ranks)
                    {
                      const auto dofs = motions.dofs(ranks);
                      VectorXd force = of_rank(math::column(numbers), dofs);
                      const VectorXd before = force;
                      std::vector<double> supports(dofs.size());
                      for (std::size_t i = 0; i < dofs.size(); ++i)
                        supports[i] = dofs[i] < 5 ? 2.0 : 0.0;
                      HeldMotions held(ranks, motions.fields(ranks), supports);
                      held.take_off({force.data(), std::size_t(force.size())});
                      const std::vector<double> left(force.begin(),
                                                     force.end());
                      EXPECT_LT(motions.fields(ranks).work(left).norm(), 1e-12);
                      double taken = 0;
                      for (std::size_t i = 0; i < dofs.size(); ++i)
                      {
                        const double off = before[i] - force[i];
                        taken += off * off;
                        EXPECT_EQ(off != 0, supports[i] != 0);
                      }
                      EXPECT_NEAR(held.force(),
                                  std::sqrt(mesh::total(ranks, taken)), 1e-12);
                    });
}
} // namespace
