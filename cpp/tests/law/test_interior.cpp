// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#include "node_states.h"
#include <contactx/law/cone.h>
#include <contactx/math/matrix.h>
#include <gtest/gtest.h>

using namespace contactx;
using namespace contactx::tests;
using law::ConePair;
using law::ConeVector;
using law::Interior;
using law::NodeState;

namespace
{
/// A vector inside the cone, at a part of the way from its axis.
ConeVector inside(Generator& random, int size, double part)
{
  ConeVector v(size);
  for (int k = 1; k < size; ++k)
    v[k] = random(-1, 1);
  v[0] = v.tail(size - 1).norm() / part;
  return v;
}

ConeVector product(const ConeVector& a, const ConeVector& b)
{
  ConeVector c = a[0] * b + b[0] * a;
  c[0] = a.dot(b);
  return c;
}

class Cones : public testing::TestWithParam<int>
{
};

TEST_P(Cones, TheScalingTakesOneVectorToTheOther)
{
  const int size = GetParam();
  Generator random(3);
  for (const double part : {0.1, 0.9, 1 - 1e-6})
  {
    const ConeVector x = inside(random, size, part),
                     y = inside(random, size, 0.7);
    const ConePair pair(x, y);
    EXPECT_LT((pair.scaled(x) - y).norm(), 1e-9 * y.norm());
    Eigen::MatrixXd F(size, size);
    for (int k = 0; k < size; ++k)
      F.col(k) = pair.scaled(ConeVector::Unit(size, k));
    EXPECT_LT((F - F.transpose()).norm(), 1e-12 * F.norm());
    EXPECT_GT(Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(F)
                  .eigenvalues()
                  .minCoeff(),
              0);
    EXPECT_LT((F.col(0) - pair.first_column()).norm(), 1e-12 * F.norm());
    EXPECT_LT((F.bottomRightCorner(size - 1, size - 1) - pair.block()).norm(),
              1e-12 * F.norm());
    EXPECT_LT((product(x, pair.inverse()) - ConeVector::Unit(size, 0)).norm(),
              1e-9);
  }
}

TEST_P(Cones, StepsEndAtTheBoundary)
{
  const int size = GetParam();
  Generator random(4);
  int bounded = 0;
  for (int i = 0; i < 200; ++i)
  {
    const ConeVector x = inside(random, size, 0.6);
    ConeVector d(size);
    for (int k = 0; k < size; ++k)
      d[k] = random(-1, 1);
    const double t = law::step_to_boundary(x, d);
    const auto depth = [&](double s)
    {
      const ConeVector v = x + s * d;
      return v[0] - v.tail(size - 1).norm();
    };
    if (not std::isfinite(t))
    {
      EXPECT_GT(depth(1e6), 0);
      continue;
    }
    ++bounded;
    EXPECT_NEAR(depth(t), 0, 1e-9 * (1 + t));
    EXPECT_GT(depth(0.99 * t), 0);
  }
  EXPECT_GT(bounded, 100);
}

INSTANTIATE_TEST_SUITE_P(Dimensions, Cones, testing::Values(2, 3, 4));

TEST(Cones, InTwoDimensionsACorrectionIsThatOfTwoScalars)
{
  Generator random(5);
  const ConeVector x = inside(random, 2, 0.4), y = inside(random, 2, 0.8);
  const ConeVector dx = inside(random, 2, 2), dy = inside(random, 2, 3);
  const ConeVector found = ConePair(x, y).correction(dx, dy);
  for (const double sign : {1.0, -1.0})
  {
    const auto part
        = [sign](const ConeVector& v) { return v[0] + sign * v[1]; };
    EXPECT_NEAR(part(found), -part(dx) * part(dy) / part(x), 1e-12);
  }
}

/// Nodes on the path with random states.
void put_on_path(NodeState& nodes, Generator& random)
{
  const int g = nodes.gdim();
  nodes.interior.emplace(nodes);
  Interior& in = *nodes.interior;
  in.target = 0.02;
  for (std::int32_t i = 0; i < nodes.num_nodes(); ++i)
  {
    in.is_on[i] = i % 5 != 0;
    in.slack[i] = random(0.1, 1);
    in.product[i] = random(-0.1, 0.1);
    in.pressure[i] = random(0.5, 2);
    if (not nodes.is_vector())
    {
      nodes.multiplier[i] = in.pressure[i];
      continue;
    }
    in.has_friction[i] = i % 3 != 0;
    in.by_pressure[i] = 0.4;
    in.bound[i] = 0.4 * in.pressure[i];
    Eigen::VectorXd n = math::column(std::span(nodes.normal).subspan(g * i, g)),
                    t(g), w(g);
    n.normalize();
    for (int k = 0; k < g; ++k)
    {
      t[k] = random(-1, 1);
      w[k] = random(-1, 1);
      in.correction[(1 + g) * i + 1 + k] = random(-0.1, 0.1);
    }
    t -= n.dot(t) * n;
    w -= n.dot(w) * n;
    t *= 0.8 * in.bound[i] / t.norm();
    if (not in.has_friction[i])
      t.setZero();
    in.slip_length[i] = 1.3 * w.norm();
    for (int k = 0; k < g; ++k)
    {
      nodes.normal[g * i + k] = in.normal[g * i + k] = n[k];
      in.traction[g * i + k] = t[k];
      in.slip[g * i + k] = w[k];
      nodes.multiplier[g * i + k] = in.pressure[i] * n[k] + t[k];
    }
  }
}

/// What is linearised at a node: the pairs' compliances are those of the
/// iterate.
Eigen::VectorXd linearised(const NodeState& nodes, std::size_t i,
                           const Eigen::VectorXd& lambda, double gap,
                           const Eigen::VectorXd& slip,
                           const Eigen::VectorXd& n)
{
  const Interior& in = *nodes.interior;
  const int g = nodes.size();
  if (not in.is_on[i])
    return nodes.area[i] * lambda;
  const double c = nodes.c[i], p = in.pressure[i];
  const double height = gap - (in.target - in.product[i]) / p
                        + in.slack[i] / p * (n.dot(lambda) - p);
  if (not nodes.is_vector())
    return Eigen::VectorXd::Constant(1, nodes.area[i] * c * height);
  const Eigen::MatrixXd across
      = Eigen::MatrixXd::Identity(g, g) - n * n.transpose();
  const Eigen::VectorXd t = across * lambda;
  Eigen::VectorXd along = t / c;
  if (in.has_friction[i])
  {
    const ConePair pair = law::pair_of(in, i);
    const Eigen::VectorXd t0
        = math::column(std::span(in.traction).subspan(g * i, g)),
        corrected
        = math::column(std::span(in.correction).subspan((1 + g) * i + 1, g));
    const Eigen::MatrixXd F = pair.block();
    const Eigen::VectorXd friction = pair.first_column().tail(g);
    const Eigen::VectorXd n0
        = math::column(std::span(in.normal).subspan(g * i, g));
    const Eigen::MatrixXd fixed
        = Eigen::MatrixXd::Identity(g, g) - n0 * n0.transpose();
    along = slip - 2 * in.target * pair.inverse().tail(g) - corrected
            + fixed * F * (t - t0)
            + in.by_pressure[i] * (n.dot(lambda) - p) * friction;
  }
  return nodes.area[i] * c * (height * n + along);
}

class InteriorLaw : public testing::TestWithParam<std::tuple<int, bool>>
{
};

class InteriorFriction : public testing::TestWithParam<int>
{
};

TEST_P(InteriorLaw, ItsDerivativesAreThoseOfALayerAtEachNode)
{
  const auto [gdim, is_vector] = GetParam();
  constexpr int n = 30;
  Generator random(9);
  NodeState nodes(n, gdim, is_vector);
  randomise(nodes, random);
  std::ranges::fill(nodes.mobile, 1);
  put_on_path(nodes, random);
  law::interior_complementarity(nodes);
  const int size = nodes.size();
  for (std::size_t i = 0; i < n; ++i)
  {
    const auto column = [i](const std::vector<double>& v, int width)
    {
      return Eigen::VectorXd(
          math::column(std::span(v).subspan(width * i, width)));
    };
    const Eigen::VectorXd lambda = column(nodes.multiplier, size);
    const Eigen::VectorXd slip
        = is_vector ? column(nodes.slip, size) : Eigen::VectorXd();
    const Eigen::VectorXd normal
        = is_vector ? column(nodes.normal, size) : Eigen::VectorXd::Ones(1);
    const double gap = nodes.gap[i], h = 1e-6;
    EXPECT_LT((linearised(nodes, i, lambda, gap, slip, normal)
               - column(nodes.value, size))
                  .norm(),
              1e-12 * (1 + column(nodes.value, size).norm()));
    const auto expect = [&](const std::vector<double>& derivative, int width,
                            int k, const Eigen::VectorXd& plus,
                            const Eigen::VectorXd& minus, const char* name)
    {
      const Eigen::VectorXd difference = (plus - minus) / (2 * h);
      for (int r = 0; r < size; ++r)
        EXPECT_NEAR(derivative[width * (size * i + r) + k], difference[r],
                    1e-7 * (10 + std::abs(difference[r])))
            << name << ", node " << i;
    };
    expect(nodes.by_gap, 1, 0,
           linearised(nodes, i, lambda, gap + h, slip, normal),
           linearised(nodes, i, lambda, gap - h, slip, normal), "gap");
    for (int k = 0; k < size; ++k)
    {
      const Eigen::VectorXd e = h * Eigen::VectorXd::Unit(size, k);
      expect(nodes.by_multiplier, size, k,
             linearised(nodes, i, lambda + e, gap, slip, normal),
             linearised(nodes, i, lambda - e, gap, slip, normal), "multiplier");
      if (not is_vector)
        continue;
      expect(nodes.by_slip, size, k,
             linearised(nodes, i, lambda, gap, slip + e, normal),
             linearised(nodes, i, lambda, gap, slip - e, normal), "slip");
      expect(nodes.by_normal, size, k,
             linearised(nodes, i, lambda, gap, slip, normal + e),
             linearised(nodes, i, lambda, gap, slip, normal - e), "normal");
    }
  }
}

TEST_P(InteriorFriction, WhatCannotMoveHasNoTraction)
{
  const int gdim = GetParam();
  Generator random(10);
  NodeState nodes(2, gdim, true);
  randomise(nodes, random);
  std::ranges::fill(nodes.normal, 0);
  nodes.normal[gdim - 1] = nodes.normal[2 * gdim - 1] = 1;
  std::ranges::fill(nodes.mobile, 1);
  put_on_path(nodes, random);
  nodes.mobile[gdim] = 0;
  law::interior_complementarity(nodes);
  const Interior& in = *nodes.interior;
  ASSERT_TRUE(in.is_on[1] and in.has_friction[1]);
  const std::size_t row = gdim;
  EXPECT_NEAR(nodes.value[row], nodes.area[1] * in.traction[gdim], 1e-12);
  for (int k = 0; k < gdim; ++k)
  {
    EXPECT_NEAR(nodes.by_multiplier[gdim * row + k], k == 0 ? nodes.area[1] : 0,
                1e-12);
    EXPECT_EQ(nodes.by_slip[gdim * row + k], 0);
  }
}

INSTANTIATE_TEST_SUITE_P(Dimensions, InteriorFriction, testing::Values(2, 3));

INSTANTIATE_TEST_SUITE_P(Dimensions, InteriorLaw,
                         testing::Combine(testing::Values(2, 3),
                                          testing::Bool()));

} // namespace
