// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#include "facing.h"
#include "mortar_reference.h"
#include <contactx/geometry/segment.h>

using namespace contactx;
using namespace contactx::geometry;
using namespace contactx::geometry;
using namespace contactx::tests;

namespace
{
/// Sums that integrate() gives of a pair.
template <class S, class M>
struct Sums
{
  std::array<Vector<M::nodes>, S::nodes> mixed{};
  std::array<Vector<S::nodes>, S::nodes> mass{};
  double total = 0;

  Sums(const SlaveFacet<S>& slave, const Nodes<M>& xm)
  {
    integrate<S, M>(slave, xm,
                    [this](const Shape<S>& s, const Shape<M>& m, double w)
                    {
                      total += w;
                      for (int t = 0; t < S::nodes; ++t)
                      {
                        mixed[t] = mixed[t] + (w * s.N[t]) * m.N;
                        mass[t] = mass[t] + (w * s.N[t]) * s.N;
                      }
                    });
  }
};

template <class Pair>
class SegmentOf : public ::testing::Test
{
};
TYPED_TEST_SUITE(SegmentOf, FacetPairTypes);

TYPED_TEST(SegmentOf, IsIntegratedByReferenceArea)
{
  using S = typename TypeParam::S;
  using M = typename TypeParam::M;
  Generator random(1);
  int together = 0;
  for (int i = 0; i < 20; ++i)
  {
    // Warped, tilted, and another reference configuration
    auto xm = flat_facet<M>(random);
    auto xs = turned<S>(flat_facet<S>(random));
    for (auto& p : xm)
      p = p + random.vector<S::gdim>(-0.05, 0.05);
    for (auto& p : xs)
      p = p + random.vector<S::gdim>(-0.05, 0.05);
    const Motion<S::gdim> motion(random, 1);
    xs = motion(xs);
    xm = motion(xm);
    auto reference = xs;
    for (auto& p : reference)
      p = p + random.vector<S::gdim>(-0.05, 0.05);

    const SlaveFacet<S> slave(xs, reference);
    const Sums<S, M> sums(slave, xm);
    const PairMoments<S, M> expected(xs, reference, xm, slave.plane.n);
    EXPECT_NEAR(sums.total, expected.total, 1e-10);
    for (int t = 0; t < S::nodes; ++t)
    {
      EXPECT_LT(norm(sums.mixed[t] - expected.mixed[t]), 1e-10);
      EXPECT_LT(norm(sums.mass[t] - expected.mass[t]), 1e-10);
    }
    together += sums.total > 0;
  }
  EXPECT_GT(together, 15);
}

template <class F>
class SegmentOfTheSame : public ::testing::Test
{
};
TYPED_TEST_SUITE(SegmentOfTheSame, FacetTypes);

TYPED_TEST(SegmentOfTheSame, HasTheFacetsArea)
{
  using F = TypeParam;
  Generator random(2);
  for (int i = 0; i < 20; ++i)
  {
    const auto x = Motion<F::gdim>(random, 1)(flat_facet<F>(random));
    const Sums<F, F> sums(SlaveFacet<F>(x, x), turned<F>(x));
    Polygon<F::tdim> whole;
    for (const auto& xi : F::vertices)
      whole.push_back(xi);
    if constexpr (F::tdim == 2)
      whole = hull(whole);
    double area = 0;
    sample(whole, [&](const Local<F>& xi, double w)
           { area += w * frame<F>(x, xi).jacobian; });
    EXPECT_NEAR(sums.total, area, 1e-12);
  }
}

TEST(DistortedQuadrilaterals, AreIntegratedToRounding)
{
  using Q = Quadrilateral;
  Generator random(3);
  for (const double distortion : {0.003, 0.01, 0.03, 0.1, 0.2})
    for (int i = 0; i < 20; ++i)
    {
      Nodes<Q> xs, xm;
      for (int l = 0; l < 4; ++l)
      {
        const auto& [s, t] = Q::vertices[l];
        xs[l] = {t, s, 0};
        xm[l] = {s, t, 0};
        for (auto* x : {&xs, &xm})
          for (int k = 0; k < 2; ++k)
            (*x)[l][k] += random(-distortion, distortion);
      }
      const SlaveFacet<Q> slave(xs, xs);
      const Sums<Q, Q> sums(slave, xm);
      const PairMoments<Q, Q> expected(xs, xs, xm, slave.plane.n);
      for (int t = 0; t < 4; ++t)
      {
        EXPECT_LT(norm(sums.mixed[t] - expected.mixed[t]), 1e-12);
        EXPECT_LT(norm(sums.mass[t] - expected.mass[t]), 1e-12);
      }
    }
}

TEST(RuleDegree, GrowsWithDistortion)
{
  using Q = Quadrilateral;
  EXPECT_EQ((rule_degree<Segment, Segment>(0)), 2);
  EXPECT_EQ((rule_degree<Triangle, Triangle>(0)), 2);
  EXPECT_EQ((rule_degree<Triangle, Q>(0)), 3);
  EXPECT_EQ((rule_degree<Q, Triangle>(0)), 4);
  EXPECT_EQ((rule_degree<Triangle, Triangle>(0, true)), 3);
  EXPECT_EQ((rule_degree<Q, Q>(0, true)), 6);
  EXPECT_EQ((rule_degree<Q, Q>(1e-16)), 4);
  int before = 4;
  for (const double distortion : {1e-12, 1e-6, 1e-2, 0.1, 0.5, 1., 2.})
  {
    const int degree = rule_degree<Q, Q>(distortion);
    EXPECT_GE(degree, before);
    before = degree;
  }
  EXPECT_EQ((rule_degree<Q, Q>(1)), (rule_degree<Q, Q>(INFINITY)));
  EXPECT_EQ((rule_degree<Q, Q>(NAN)), 4);
}

TEST(RuleDegree, IsThatOfWarpedReferences)
{
  // Flat and square now, but warped before
  Nodes<Quadrilateral> x{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 0}}};
  EXPECT_EQ(SlaveFacet<Quadrilateral>(x, x).bend, 0);
  auto warped = x;
  warped[3][2] = 0.4;
  EXPECT_GT(SlaveFacet<Quadrilateral>(x, warped).bend, 0.2);
  auto kite = x;
  kite[3] = {1.5, 1.5, 0};
  EXPECT_GT(SlaveFacet<Quadrilateral>(x, kite).bend, 0.2);
  EXPECT_GT(SlaveFacet<Quadrilateral>(kite, x).bend, 0.2);
}

TEST(FoldedQuadrilateral, SharesNothing)
{
  const Nodes<Quadrilateral> x{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 0}}};
  const SlaveFacet<Quadrilateral> slave(x, x);
  const auto area = [&slave](const Vector<3>& corner)
  {
    const Nodes<Quadrilateral> master{
        {{0, 0, 1}, {0, 1, 1}, {1, 0, 1}, corner}};
    return Sums<Quadrilateral, Quadrilateral>(slave, master).total;
  };
  EXPECT_NEAR(area({1, 1, 1}), 1, 1e-14);
  EXPECT_NEAR(area({0.5, 0.5, 1}), 0.5, 1e-10); // a triangle
  EXPECT_EQ(area({0.4, 0.4, 1}), 0);
  EXPECT_EQ(area({-1, -1, 1}), 0);
  EXPECT_EQ(area({2, -1, 1}), 0); // two edges cross
}

TEST(Kinds, AreVisitedByNumbersOfNodes)
{
  int kinds = 0;
  for_all_kinds(
      [&kinds]<class S, class M>(S, M)
      {
        ++kinds;
        const bool same = geometry::visit(
            S::nodes, M::nodes, []<class A, class B>(A, B)
            { return std::is_same_v<A, S> and std::is_same_v<B, M>; });
        EXPECT_TRUE(same);
      });
  EXPECT_EQ(kinds, 5);
}
} // namespace
