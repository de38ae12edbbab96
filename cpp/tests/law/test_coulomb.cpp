// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#include "coulomb_node.h"
#include <cmath>
#include <gtest/gtest.h>

using namespace contactx;
using namespace contactx::law;
using namespace contactx::tests;

namespace
{
template <class Dimension>
class Coulomb : public ::testing::Test
{
};
using Dimensions = ::testing::Types<std::integral_constant<int, 2>,
                                    std::integral_constant<int, 3>>;
TYPED_TEST_SUITE(Coulomb, Dimensions);

TYPED_TEST(Coulomb, HasTheValuesOfItsStatus)
{
  constexpr int D = TypeParam::value;
  Generator random(1);
  for (int i = 0; i < 200; ++i)
  {
    const auto node = random_node<D>(random);
    const Vector<D> bound
        = (node.friction * node.trial_pressure() / norm(node.trial()))
          * node.trial();
    const Vector<D> normal_part = (node.c * node.gap) * node.normal;
    const std::array<Vector<D>, 3> expected{
        node.traction, normal_part + node.c * node.slip,
        normal_part + node.tangential() - bound};
    for (std::int8_t status : {open, stick, slip})
      EXPECT_LT(
          largest(node.terms(status).value - node.area * expected[status]),
          1e-14 * node.area * (10 + largest(expected[status])));
  }
}

TYPED_TEST(Coulomb, VanishesWhereTheConditionsHold)
{
  constexpr int D = TypeParam::value;
  for (const auto& node :
       {upright<D>(0, 0, 0.5, 0.3, 0.5), upright<D>(2, 0.5, 0, 0, 0.5),
        upright<D>(2, 1, 0, -0.25, 0.5), upright<D>(2, -1, 0, 0.25, 0.5),
        upright<D>(2, 0, 0, 0.25, 0)})
    EXPECT_EQ(node.terms(node.status()).value, Vector<D>{});
  // Friction along the slip
  const auto wrong = upright<D>(2, 1, 0, 0.25, 0.5);
  EXPECT_NE(wrong.terms(wrong.status()).value, Vector<D>{});
}

/// Central differences of the value by what `change` moves.
template <int D, class Change>
void expect_derivative(const CoulombNode<D>& node, std::int8_t status,
                       const Matrix<D>& derivative, double size, Change change)
{
  const double h = 1e-5;
  for (int j = 0; j < D; ++j)
  {
    auto plus = node, minus = node;
    change(plus, j, h);
    change(minus, j, -h);
    const Vector<D> difference
        = (0.5 / h) * (plus.terms(status).value - minus.terms(status).value);
    for (int i = 0; i < D; ++i)
      EXPECT_NEAR(derivative[i][j], difference[i], 1e-7 * size)
          << "status " << int(status) << ", row " << i << ", column " << j;
  }
}

TYPED_TEST(Coulomb, HasItsDifferenceQuotientsAsDerivatives)
{
  constexpr int D = TypeParam::value;
  Generator random(2);
  for (int i = 0; i < 400; ++i)
  {
    auto node = random_node<D>(random);
    if (i % 2 == 1)
      for (double& m : node.mobile)
        m = random(0, 1) < 0.5;
    for (std::int8_t status : {open, stick, slip})
    {
      const auto r = node.terms(status);
      double size = node.area;
      for (int k = 0; k < D; ++k)
        size = std::max({size, largest(r.by_traction[k]), largest(r.by_slip[k]),
                         largest(r.by_normal[k]), std::abs(r.by_gap[k])});
      using Node = CoulombNode<D>;
      expect_derivative<D>(node, status, r.by_traction, size,
                           [](Node& n, int j, double h)
                           { n.traction[j] += h; });
      expect_derivative<D>(node, status, r.by_slip, size,
                           [](Node& n, int j, double h) { n.slip[j] += h; });
      // As the normal moves through space: not only on the unit sphere
      expect_derivative<D>(node, status, r.by_normal, size,
                           [](Node& n, int j, double h) { n.normal[j] += h; });
      Matrix<D> by_gap{};
      for (int k = 0; k < D; ++k)
        by_gap[k][0] = r.by_gap[k];
      expect_derivative<D>(node, status, by_gap, size,
                           [](Node& n, int j, double h)
                           { n.gap += j == 0 ? h : 0; });
    }
  }
}

TYPED_TEST(Coulomb, StickAndSlipMeetAtTheBound)
{
  constexpr int D = TypeParam::value;
  Generator random(3);
  for (int i = 0; i < 200; ++i)
  {
    auto node = random_node<D>(random);
    node.gap = -std::abs(node.gap);
    // Without a normal part, so that the bound can be met exactly
    node.traction = node.tangential() + random(0.5, 2) * node.normal;
    node.slip = node.slip - dot(node.slip, node.normal) * node.normal;
    node.friction = norm(node.trial()) / node.trial_pressure();
    EXPECT_LT(largest(node.terms(stick).value - node.terms(slip).value),
              1e-14 * node.area * 20);
  }
}

TYPED_TEST(Coulomb, SlipsWithoutADirection)
{
  constexpr int D = TypeParam::value;
  const auto r = upright<D>(2, 0, 0.125, 0, 0.5).terms(slip);
  Vector<D> expected{};
  expected[D - 1] = 1;
  EXPECT_EQ(r.value, expected);
  for (const auto* m : {&r.by_traction, &r.by_slip, &r.by_normal})
    for (const auto& row : *m)
      for (double a : row)
        EXPECT_TRUE(std::isfinite(a));
  EXPECT_EQ(r.by_traction[0][0], 1);
}

TYPED_TEST(Coulomb, DoesNotReadTheGapOfAnOpenNode)
{
  constexpr int D = TypeParam::value;
  const auto r = upright<D>(1, 2, NAN, 0.5, 0.5).terms(open);
  EXPECT_EQ(r.value, (upright<D>(1, 2, 0, 0, 0).traction));
  EXPECT_EQ(r.by_gap, Vector<D>{});
  for (int i = 0; i < D; ++i)
    for (int j = 0; j < D; ++j)
    {
      EXPECT_EQ(r.by_traction[i][j], i == j);
      EXPECT_EQ(r.by_slip[i][j], 0);
      EXPECT_EQ(r.by_normal[i][j], 0);
    }
}

TYPED_TEST(Coulomb, CarriesNoFrictionAlongImmobileDirections)
{
  constexpr int D = TypeParam::value;
  Generator random(4);
  for (int i = 0; i < 100; ++i)
    for (int fixed = 0; fixed < D; ++fixed)
      for (std::int8_t status : {stick, slip})
      {
        auto node = random_node<D>(random);
        node.mobile[fixed] = 0;
        const Vector<D> value = node.terms(status).value;
        // The normal part is the gap, whatever moves
        EXPECT_NEAR(dot(node.normal, value), node.area * node.c * node.gap,
                    1e-13);
        auto q = node.c * node.slip;
        if (status == slip)
          q = node.tangential()
              - (node.friction * node.trial_pressure() / norm(node.trial()))
                    * node.trial();
        q[fixed] = node.tangential()[fixed];
        const Vector<D> along = q - dot(node.normal, q) * node.normal;
        const Vector<D> expected
            = node.area * (along + (node.c * node.gap) * node.normal);
        EXPECT_LT(largest(value - expected), 1e-13 * (1 + largest(expected)));
      }
}

TYPED_TEST(Coulomb, IsFrictionlessWhereNothingMovesAlongTheSurface)
{
  constexpr int D = TypeParam::value;
  Generator random(6);
  for (std::int8_t status : {stick, slip})
  {
    auto node = random_node<D>(random);
    node.mobile = {};
    const Vector<D> expected
        = node.area * ((node.c * node.gap) * node.normal + node.tangential());
    EXPECT_LT(largest(node.terms(status).value - expected), 1e-14 * 20);
    // An open one has no traction at all
    EXPECT_EQ(node.terms(open).value, node.area * node.traction);
  }
}

TYPED_TEST(Coulomb, TurnsWithTheAxes)
{
  constexpr int D = TypeParam::value;
  Generator random(5);
  for (int i = 0; i < 200; ++i)
  {
    const auto node = random_node<D>(random);
    const Motion<D> turn(random, 0);
    auto turned = node;
    turned.traction = turn.rotate(node.traction);
    turned.normal = turn.rotate(node.normal);
    turned.slip = turn.rotate(node.slip);
    for (std::int8_t status : {open, stick, slip})
    {
      const auto a = node.terms(status), b = turned.terms(status);
      const double size = node.area * (10 + norm(a.value));
      EXPECT_LT(largest(b.value - turn.rotate(a.value)), 1e-13 * size);
      EXPECT_LT(largest(b.by_gap - turn.rotate(a.by_gap)), 1e-13 * size);
      // B Q = Q A
      for (int j = 0; j < D; ++j)
      {
        Vector<D> e{};
        e[j] = 1;
        const Vector<D> qe = turn.rotate(e);
        for (auto m : {&CoulombTerms<D>::by_traction, &CoulombTerms<D>::by_slip,
                       &CoulombTerms<D>::by_normal})
        {
          Vector<D> before, after;
          for (int k = 0; k < D; ++k)
          {
            before[k] = (a.*m)[k][j];
            after[k] = dot((b.*m)[k], qe);
          }
          EXPECT_LT(largest(after - turn.rotate(before)), 1e-13 * size);
        }
      }
    }
  }
}
} // namespace
