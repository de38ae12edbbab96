// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#include "expect.h"
#include "facing.h"
#include "mortar_reference.h"
#include <contactx/geometry/segment.h>

using namespace contactx;
using namespace contactx::geometry;
using namespace contactx::tests;

namespace
{
/// A pair of facets that face one another, tilted and warped a little.
template <class S, class M>
struct RandomPair
{
  Nodes<S> slave, reference;
  Nodes<M> master;

  explicit RandomPair(Generator& random)
      : slave(turned<S>(flat_facet<S>(random))), master(flat_facet<M>(random))
  {
    for (auto& p : slave)
      p = p + random.vector<S::gdim>(-0.05, 0.05);
    for (auto& p : master)
      p = p + random.vector<S::gdim>(-0.05, 0.05);
    const Motion<S::gdim> motion(random, 1);
    slave = motion(slave);
    master = motion(master);
    reference = slave;
    for (auto& p : reference)
      p = p + random.vector<S::gdim>(-0.05, 0.05);
  }
};

template <class F>
std::vector<double> flattened(const Nodes<F>& x)
{
  std::vector<double> all;
  for (const auto& p : x)
    all.insert(all.end(), p.begin(), p.end());
  return all;
}

/// Compare with a quadrature of the facets in space.
/// @return Whether they share enough for the coefficients to be compared.
template <class S, class M>
bool expect_integrals(const geometry::Integrals& found,
                      const PairMoments<S, M>& expected)
{
  if (expected.total < 0.01)
    return false;
  constexpr int n = most_nodes;
  for (int s = 0; s < S::nodes; ++s)
  {
    EXPECT_NEAR(found.area[s], expected.area[s], 1e-10);
    Vector<S::nodes> product{};
    Vector<M::nodes> row{};
    double gap = 0;
    for (int t = 0; t < S::nodes; ++t)
    {
      const double a = found.dual[n * s + t];
      product = product + a * expected.mass[t];
      row = row + a * expected.mixed[t];
      gap += a * expected.gap[t];
    }
    for (int t = 0; t < S::nodes; ++t)
      EXPECT_NEAR(product[t], s == t ? expected.area[s] : 0, 1e-8);
    for (int l = 0; l < M::nodes; ++l)
      EXPECT_NEAR(weight(found, 0, s, l), row[l], 1e-8);
    EXPECT_NEAR(found.gap[s], gap, 1e-8);
  }
  return true;
}

template <class>
using IntegralsOf = testing::Test;
TYPED_TEST_SUITE(IntegralsOf, FacetPairTypes);

TYPED_TEST(IntegralsOf, DualFunctionsAreBiorthogonalOverWhatIsCovered)
{
  using S = typename TypeParam::S;
  using M = typename TypeParam::M;
  // Along the facet's normal, and along one that is given
  for (const bool is_given : {false, true})
  {
    SCOPED_TRACE(is_given);
    Generator random(1 + is_given);
    int compared = 0;
    for (int i = 0; i < 20; ++i)
    {
      const RandomPair<S, M> p(random);
      const Facing scene(single<S>(p.slave), single<M>(p.master));
      std::vector<double> X = flattened<S>(p.reference), along;
      X.resize(scene.x.size());
      auto n = frame<S>(p.slave, geometry::plane_origin<S>()).n;
      if (is_given)
      {
        // Up to 25 degrees off
        n = n + 0.45 * random.unit<S::gdim>();
        n = (1 / norm(n)) * n;
        for (int k = 0; k < 3; ++k)
          along.push_back(k < S::gdim ? -n[k] : 0);
      }
      const auto found = scene.integrals(scene.all_pairs(), X, along);
      compared
          += expect_integrals<S, M>(found, {p.slave, p.reference, p.master, n});
      for (int k = 0; k < S::gdim; ++k)
        EXPECT_EQ(found.normal[k], -n[k]);
    }
    EXPECT_GT(compared, 15);
  }
}

TYPED_TEST(IntegralsOf, UnusedPlacesAreZero)
{
  using S = typename TypeParam::S;
  using M = typename TypeParam::M;
  Generator random(4);
  const RandomPair<S, M> p(random);
  const Facing scene(single<S>(p.slave), single<M>(p.master));
  const auto found = scene.integrals(scene.all_pairs());
  for (int s = 0; s < most_nodes; ++s)
  {
    for (int l = 0; l < most_nodes; ++l)
    {
      EXPECT_EQ(weight(found, 0, s, l) != 0, s < S::nodes and l < M::nodes);
      EXPECT_EQ(found.dual[most_nodes * s + l] != 0,
                s < S::nodes and l < S::nodes);
    }
    EXPECT_EQ(found.area[s] != 0, s < S::nodes);
    EXPECT_EQ(found.gap[s] != 0, s < S::nodes);
  }
}

template <class>
using FacetBeforeItsLike = testing::Test;
TYPED_TEST_SUITE(FacetBeforeItsLike, FacetTypes);

TYPED_TEST_OF(FacetBeforeItsLike, IsDiagonal, F)
{
  Generator random(3);
  for (int i = 0; i < 20; ++i)
  {
    const auto x = flat_facet<F>(random);
    const Facing scene(single<F>(x), single<F>(turned<F>(x)));
    const auto found = scene.integrals(scene.all_pairs());
    for (int s = 0; s < F::nodes; ++s)
      for (int l = 0; l < F::nodes; ++l)
      {
        const bool same = norm(scene.point(F::nodes + l) - scene.point(s)) == 0;
        EXPECT_NEAR(weight(found, 0, s, l), same ? found.area[s] : 0, 1e-12);
      }
  }
}

TEST(Integrals, WithoutPairsAreZero)
{
  const Facing scene(sheet(3, 2, Cells::mixed, false, 0, 1, level(3, 0)),
                     sheet(3, 2, Cells::mixed, true, 0, 1, level(3, 1)));
  const auto found = scene.integrals({});
  EXPECT_TRUE(found.weight.empty());
  EXPECT_TRUE(found.gap.empty());
  const std::size_t n = scene.slave.facets().size();
  EXPECT_EQ(found.area, std::vector<double>(4 * n));
  EXPECT_EQ(found.dual, std::vector<double>(16 * n));
  EXPECT_EQ(found.normal, std::vector<double>(3 * n));
}

TEST_2D_3D(Integrals, HaveTheGapOfParallelSurfaces, gdim)
{
  for (const Cells cells : {Cells::triangles, Cells::mixed})
  {
    const double gap = 0.3;
    const Facing scene(sheet(gdim, 3, cells, false, 0, 1, level(gdim, gap)),
                       sheet(gdim, 4, cells, true, -0.5, 1.5, level(gdim, 0)));
    const auto pairs = scene.find();
    // Upright, and along a direction with the cosine 0.8
    for (const double cosine : {1., 0.8})
    {
      Vector<3> n{0, 0, 0};
      n[gdim - 1] = cosine;
      n[0] = std::sqrt(1 - cosine * cosine);
      std::vector<double> normal;
      for (std::int32_t f = 0; f < scene.slave.facets().size(); ++f)
        normal.insert(normal.end(), n.begin(), n.end());
      const auto found = scene.integrals(pairs, scene.x, normal);
      std::vector<double> sum(found.area.size());
      for (std::size_t i = 0; i < pairs.size(); ++i)
        for (int s = 0; s < most_nodes; ++s)
          sum[most_nodes * pairs.slave[i] + s] += found.gap[most_nodes * i + s];
      for (std::size_t i = 0; i < sum.size(); ++i)
        EXPECT_NEAR(sum[i], gap / cosine * found.area[i], 1e-13);
    }
  }
}

TEST(Integrals, AreNegativeGapsWherePenetrated)
{
  const Facing scene(
      sheet(3, 1, Cells::quadrilaterals, false, 0, 1, level(3, 0)),
      sheet(3, 1, Cells::quadrilaterals, true, 0, 1, level(3, 0.2)));
  const auto found = scene.integrals(scene.find());
  for (int s = 0; s < 4; ++s)
    EXPECT_NEAR(found.gap[s], -0.2 / 4, 1e-14);
}

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

/// Compare with a quadrature of the facets in space.
template <class S, class M>
void expect_sums(const Sums<S, M>& found, const PairMoments<S, M>& expected,
                 double tolerance)
{
  for (int t = 0; t < S::nodes; ++t)
  {
    EXPECT_LT(norm(found.mixed[t] - expected.mixed[t]), tolerance);
    EXPECT_LT(norm(found.mass[t] - expected.mass[t]), tolerance);
  }
}
template <class>
using SegmentOf = testing::Test;
TYPED_TEST_SUITE(SegmentOf, FacetPairTypes);

TYPED_TEST(SegmentOf, IsIntegratedByReferenceArea)
{
  using S = typename TypeParam::S;
  using M = typename TypeParam::M;
  Generator random(1);
  int together = 0;
  for (int i = 0; i < 20; ++i)
  {
    const RandomPair<S, M> p(random);
    const SlaveFacet<S> slave(p.slave, p.reference);
    const Sums<S, M> sums(slave, p.master);
    const PairMoments<S, M> expected(p.slave, p.reference, p.master,
                                     slave.plane.n);
    EXPECT_NEAR(sums.total, expected.total, 1e-10);
    expect_sums<S, M>(sums, expected, 1e-10);
    together += sums.total > 0;
  }
  EXPECT_GT(together, 15);
}

template <class>
using SegmentOfTheSame = testing::Test;
TYPED_TEST_SUITE(SegmentOfTheSame, FacetTypes);

TYPED_TEST_OF(SegmentOfTheSame, HasTheFacetsArea, F)
{
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
      expect_sums<Q, Q>(Sums<Q, Q>(slave, xm), {xs, xs, xm, slave.plane.n},
                        1e-12);
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
