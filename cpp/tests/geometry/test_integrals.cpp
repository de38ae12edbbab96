// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#include "facing.h"
#include "mortar_reference.h"

using namespace contactx;
using namespace contactx::geometry;
using namespace contactx::tests;
using geometry::most_nodes;

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

template <class Pair>
class IntegralsOf : public ::testing::Test
{
};
TYPED_TEST_SUITE(IntegralsOf, FacetPairTypes);

TYPED_TEST(IntegralsOf, DualFunctionsAreBiorthogonalOverWhatIsCovered)
{
  using S = typename TypeParam::S;
  using M = typename TypeParam::M;
  Generator random(1);
  int compared = 0;
  for (int i = 0; i < 20; ++i)
  {
    const RandomPair<S, M> p(random);
    const Facing scene(single<S>(p.slave), single<M>(p.master));
    std::vector<double> X = flattened<S>(p.reference);
    X.resize(scene.x.size());
    const auto found = scene.integrals(scene.all_pairs(), X);
    const auto n = frame<S>(p.slave, geometry::plane_origin<S>()).n;
    compared
        += expect_integrals<S, M>(found, {p.slave, p.reference, p.master, n});
    for (int k = 0; k < S::gdim; ++k)
      EXPECT_EQ(found.normal[k], -n[k]);
  }
  EXPECT_GT(compared, 15);
}

TYPED_TEST(IntegralsOf, ProjectAlongTheNormalThatIsGiven)
{
  using S = typename TypeParam::S;
  using M = typename TypeParam::M;
  Generator random(2);
  int compared = 0;
  for (int i = 0; i < 20; ++i)
  {
    const RandomPair<S, M> p(random);
    const Facing scene(single<S>(p.slave), single<M>(p.master));
    std::vector<double> X = flattened<S>(p.reference);
    X.resize(scene.x.size());
    // Up to 25 degrees off
    auto n = frame<S>(p.slave, geometry::plane_origin<S>()).n;
    n = n + 0.45 * random.unit<S::gdim>();
    n = (1 / norm(n)) * n;
    Vector<3> given{};
    for (int k = 0; k < S::gdim; ++k)
      given[k] = -n[k];
    const auto found = scene.integrals(scene.all_pairs(), X, given);
    compared
        += expect_integrals<S, M>(found, {p.slave, p.reference, p.master, n});
    for (int k = 0; k < S::gdim; ++k)
      EXPECT_EQ(found.normal[k], given[k]);
  }
  EXPECT_GT(compared, 15);
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

template <class F>
class FacetBeforeItsLike : public ::testing::Test
{
};
TYPED_TEST_SUITE(FacetBeforeItsLike, FacetTypes);

TYPED_TEST(FacetBeforeItsLike, IsDiagonal)
{
  using F = TypeParam;
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

TEST(Integrals, HaveTheGapOfParallelSurfaces)
{
  for (const int gdim : {2, 3})
    for (const Cells cells : {Cells::triangles, Cells::mixed})
    {
      const double gap = 0.3;
      const Facing scene(
          sheet(gdim, 3, cells, false, 0, 1, level(gdim, gap)),
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
            sum[most_nodes * pairs.slave[i] + s]
                += found.gap[most_nodes * i + s];
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
} // namespace
