// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#include "generator.h"
#include <contactx/law/coulomb.h>
#include <gtest/gtest.h>

using namespace contactx;
using namespace contactx::law;
using namespace contactx::tests;

namespace
{
template <int D>
using Matrix = std::array<Vector<D>, D>;

/// @brief What Coulomb's law says of one slave node.
template <int D>
struct CoulombTerms
{
  Vector<D> value, by_gap;
  Matrix<D> by_traction, by_slip, by_normal;
};

template <int D>
struct CoulombNode
{
  Vector<D> traction, normal, slip;
  double gap, c, friction;
  double area = 1;
  double reach = 10; ///< of trial friction, over the bound
  Vector<D> mobile = ones();

  static Vector<D> ones()
  {
    Vector<D> v;
    v.fill(1);
    return v;
  }

  law::FrictionalState state() const
  {
    return {D, traction, {&gap, 1}, normal, slip, {&c, 1}, {&friction, 1}};
  }

  std::int8_t status(std::int8_t before = law::open) const
  {
    std::array<std::int8_t, 1> status{before};
    law::frictional_status(state(), reach, status);
    return status[0];
  }

  CoulombTerms<D> terms(std::int8_t status) const
  {
    Vector<D> value, by_gap;
    std::array<double, D * D> by_traction, by_slip, by_normal;
    const std::array s{status};
    law::frictional_complementarity(
        state(), {&area, 1}, s, mobile,
        {value, by_traction, by_gap, by_slip, by_normal});
    return {value, by_gap, matrix(by_traction), matrix(by_slip),
            matrix(by_normal)};
  }

  /// @brief Pressure, its trial value where the node is closed, and the trial
  /// friction.
  double pressure() const { return dot(normal, traction); }
  double trial_pressure() const { return pressure() - c * std::min(gap, 0.0); }
  Vector<D> tangential() const { return traction - pressure() * normal; }
  Vector<D> trial() const { return tangential() - c * slip; }

private:
  static Matrix<D> matrix(const std::array<double, D * D>& a)
  {
    Matrix<D> m;
    for (int i = 0; i < D; ++i)
      std::copy_n(a.begin() + D * i, D, m[i].begin());
    return m;
  }
};

/// @brief A random node in contact whose trial friction is far from zero.
template <int D>
CoulombNode<D> random_node(Generator& random)
{
  CoulombNode<D> node;
  do
  {
    node.normal = random.unit<D>();
    node.traction = random.vector<D>(-2, 2);
    node.slip = random.vector<D>(-0.5, 0.5);
    node.gap = random(-0.3, 0.3);
    node.c = random(0.5, 4);
    node.friction = random(0, 1.5);
    node.area = random(0.1, 3);
  } while (norm(node.trial()) < 0.5);
  return node;
}

/// @brief A node with its normal along the last axis and c = 8.
template <int D>
CoulombNode<D> upright(double p, double t, double gap, double slip,
                       double friction)
{
  CoulombNode<D> node{{}, {}, {}, gap, 8, friction};
  node.normal[D - 1] = 1;
  node.traction[0] = t;
  node.traction[D - 1] = p;
  node.slip[0] = slip;
  return node;
}

template <std::size_t D>
double largest(const std::array<double, D>& v)
{
  double size = 0;
  for (double c : v)
    size = std::max(size, std::abs(c));
  return size;
}

template <class>
using Coulomb = testing::Test;
using Dimensions = testing::Types<std::integral_constant<int, 2>,
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
        // Without friction where nothing moves, and no traction where it is
        // open
        auto still = node;
        still.mobile = {};
        const auto normal = (node.c * node.gap) * node.normal;
        EXPECT_LT(largest(still.terms(status).value
                          - node.area * (normal + node.tangential())),
                  1e-14 * 20);
        EXPECT_EQ(still.terms(open).value, node.area * node.traction);
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

template <class>
using CoulombStatus = testing::Test;
TYPED_TEST_SUITE(CoulombStatus, Dimensions);

TYPED_TEST(CoulombStatus, IsOpenWhereTheTrialPressureIsNotPositive)
{
  constexpr int D = TypeParam::value;
  EXPECT_EQ((upright<D>(0, 0, 0, 0, 0.5).status()), open);
  EXPECT_EQ((upright<D>(2, 0, 0.25, 0, 0.5).status()), open);
  EXPECT_EQ((upright<D>(std::nextafter(2, 3), 0, 0.25, 0, 0.5).status()),
            stick);
  EXPECT_EQ((upright<D>(0, 0, -0.25, 0, 0.5).status()), stick);
  EXPECT_EQ((upright<D>(-1, 0, 0, 0, 0.5).status()), open);
  EXPECT_EQ((upright<D>(-2, 5, -0.125, 0, 0.5).status()), open);
  // Without a pair
  EXPECT_EQ((upright<D>(1, 0, NAN, 0, 0.5).status()), open);
  EXPECT_EQ((upright<D>(NAN, 0, -1, 0, 0.5).status()), open);
}

TYPED_TEST(CoulombStatus, AClosedNodeOpensOnlyWithoutPressure)
{
  constexpr int D = TypeParam::value;
  for (std::int8_t closed : {stick, slip})
  {
    // mu p_hat = 1, however wide the gap is
    EXPECT_EQ((upright<D>(2, 0.5, 1e3, 0, 0.5).status(closed)), stick);
    EXPECT_EQ((upright<D>(2, 1.5, 1e3, 0, 0.5).status(closed)), slip);
    EXPECT_EQ((upright<D>(0, 0, 0.25, 0, 0.5).status(closed)), open);
    EXPECT_EQ((upright<D>(-1, 0, 0.25, 0, 0.5).status(closed)), open);
    EXPECT_EQ((upright<D>(-1, 0, -0.25, 0, 0.5).status(closed)), stick);
    EXPECT_EQ((upright<D>(-3, 0, -0.25, 0, 0.5).status(closed)), open);
    EXPECT_EQ((upright<D>(1, 0, NAN, 0, 0.5).status(closed)), open);
  }
}

TYPED_TEST(CoulombStatus, SticksUpToTheBound)
{
  constexpr int D = TypeParam::value;
  for (double sign : {1.0, -1.0})
  {
    // mu p_hat = 0.5 (2 + 8 * 0.25) = 2
    const auto at = [sign](double t, double slip)
    { return upright<D>(2, sign * t, -0.25, sign * slip, 0.5).status(); };
    EXPECT_EQ(at(2, 0), stick);
    EXPECT_EQ(at(std::nextafter(2, 3), 0), slip);
    EXPECT_EQ(at(0, 0.25), stick);
    EXPECT_EQ(at(0, std::nextafter(0.25, 1)), slip);
    EXPECT_EQ(at(1, -0.125), stick);
    EXPECT_EQ(at(1, -0.125 * (1 + 1e-14)), slip);
    EXPECT_EQ(at(1, 0.375), stick);
    EXPECT_EQ(at(0.04, 0.5), slip);
  }
}

TYPED_TEST(CoulombStatus, SticksBeforeSlipTurnsBack)
{
  constexpr int D = TypeParam::value;
  // mu p_hat = 1; t_hat = t - 8 ds
  for (double sign : {1.0, -1.0})
  {
    const auto at = [sign](double t, double slip)
    { return upright<D>(2, sign * t, 0, sign * slip, 0.5).status(); };
    EXPECT_EQ(at(1, -1), slip);
    EXPECT_EQ(at(0, 1), slip);
    EXPECT_EQ(at(0.04, 1), slip);
    EXPECT_EQ(at(0.06, 1), stick);
    EXPECT_EQ(at(1, 1), stick);
  }
}

TYPED_TEST(CoulombStatus, SlipsOnWhereFrictionCannotHaveThrownIt)
{
  constexpr int D = TypeParam::value;
  // mu p_hat = 1; |t_hat| = 7 and far more
  auto node = upright<D>(2, 1, 0, 1, 0.5);
  EXPECT_EQ(node.status(), stick);
  node.reach = 6.9;
  EXPECT_EQ(node.status(), slip);
  auto far = upright<D>(2, 1, 0, 1e6, 0.5);
  EXPECT_EQ(far.status(), slip);
  far.reach = 1e9;
  EXPECT_EQ(far.status(), stick);
}

TYPED_TEST(CoulombStatus, SlipsAnyWayWithoutFriction)
{
  constexpr int D = TypeParam::value;
  for (double friction : {0.0, 1e-12})
    for (double rounding : {0.0, 1e-17, -1e-17})
      EXPECT_EQ((upright<D>(2, rounding, 0, 0.25, friction).status()), slip);
  for (const auto& [t, ds] : {std::pair{0., 0.}, {1e-150, 0.}, {0., -1e-150}})
    EXPECT_EQ((upright<D>(1, t, 0, ds, 0).status()), slip);
  EXPECT_EQ((upright<D>(0, 1, 0, 1, 0).status()), open);
}

} // namespace
