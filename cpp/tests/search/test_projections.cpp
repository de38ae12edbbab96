// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#include "facets.h"
#include "scene.h"
#include <contactx/search/projections.h>

using namespace contactx;
using namespace contactx::search;
using namespace contactx::tests;

namespace
{
template <class F>
class Foot : public ::testing::Test
{
protected:
  static constexpr int D = F::gdim;

  /// Random facets that share no node.
  Foot() : scene(D)
  {
    for (int i = 0; i < num; ++i)
    {
      facets.push_back(random_facet<F>(random));
      std::vector<std::int32_t> nodes;
      for (const auto& p : facets.back())
      {
        Vector<3> q{};
        std::copy(p.begin(), p.end(), q.begin());
        nodes.push_back(scene.node(q));
      }
      scene.facet(nodes);
    }
  }

  /// Local coordinates up to half a facet beyond the edges; heights.
  void draw(double height)
  {
    for (int i = 0; i < num; ++i)
    {
      which.push_back((7 * i + 3) % num);
      const auto at = random.vector<F::tdim>(-0.5, 1.5);
      xi.push_back(at[0]);
      xi.push_back(F::tdim == 2 ? at[F::tdim - 1] : 0);
      gap.push_back(random(-height, height));
    }
  }

  Vector<D> point(std::span<const double> x, int i) const
  {
    Vector<D> p;
    std::copy_n(x.begin() + D * i, D, p.begin());
    return p;
  }

  static constexpr int num = 200;
  Generator random{1};
  Scene scene;
  std::vector<geometry::Nodes<F>> facets;
  std::vector<std::int32_t> which;
  std::vector<double> xi, gap;
};
TYPED_TEST_SUITE(Foot, FacetTypes);

TYPED_TEST(Foot, PlacesAreOnTheSurfaceWithItsNormal)
{
  using F = TypeParam;
  this->draw(0);
  const FacetPoints q = facet_points(this->scene.surface(), this->which,
                                     this->scene.x, this->xi);
  for (int i = 0; i < this->num; ++i)
  {
    geometry::Local<F> at;
    std::copy_n(this->xi.begin() + 2 * i, F::tdim, at.begin());
    const auto& x = this->facets[this->which[i]];
    EXPECT_LT(norm(this->point(q.x, i) - position<F>(x, at)), 1e-14);
    EXPECT_LT(norm(this->point(q.normal, i) - geometry::frame<F>(x, at).n),
              1e-14);
  }
}

TYPED_TEST(Foot, FeetAndPlacesAreInverse)
{
  using F = TypeParam;
  // Below the radius of curvature of the warped ones
  this->draw(0.3);
  const Surface surface = this->scene.surface();
  const FacetPoints q
      = facet_points(surface, this->which, this->scene.x, this->xi);
  std::vector<double> points(q.x);
  for (int i = 0; i < this->num; ++i)
    for (int k = 0; k < F::gdim; ++k)
      points[F::gdim * i + k] += this->gap[i] * q.normal[F::gdim * i + k];
  const std::vector<double> nowhere(2 * this->num, -9);
  const Projections found
      = projections(surface, this->which, this->scene.x, points, nowhere);
  for (int i = 0; i < this->num; ++i)
  {
    for (int a = 0; a < F::tdim; ++a)
      EXPECT_NEAR(found.xi[2 * i + a], this->xi[2 * i + a], 1e-12) << i;
    EXPECT_NEAR(found.gap[i], this->gap[i], 1e-12) << i;
  }
}

TYPED_TEST(Foot, AreThoseOfTheMaterialWhenTheFacetsHaveMoved)
{
  using F = TypeParam;
  this->draw(0.3);
  const Surface surface = this->scene.surface();
  const Motion<F::gdim> motion(this->random, 5);
  auto moved = this->scene.x;
  for (std::size_t i = 0; i < moved.size() / F::gdim; ++i)
  {
    const auto p = motion(this->point(moved, i));
    std::copy(p.begin(), p.end(), moved.begin() + F::gdim * i);
  }
  const FacetPoints before
      = facet_points(surface, this->which, this->scene.x, this->xi);
  const FacetPoints after = facet_points(surface, this->which, moved, this->xi);
  for (int i = 0; i < this->num; ++i)
  {
    EXPECT_LT(norm(this->point(after.x, i) - motion(this->point(before.x, i))),
              1e-13);
    EXPECT_LT(norm(this->point(after.normal, i)
                   - motion.rotate(this->point(before.normal, i))),
              1e-13);
  }
}

TYPED_TEST(Foot, WithoutAFacetIsWhatWasGiven)
{
  using F = TypeParam;
  const Surface surface = this->scene.surface();
  const std::vector<std::int32_t> which{-1, 0, -1};
  const std::vector<double> given{0.25, 0.5, 7, 7, -3, 4};
  const std::vector<double> points(3 * F::gdim, 0.3);
  const Projections found
      = projections(surface, which, this->scene.x, points, given);
  EXPECT_EQ(found.xi[0], 0.25);
  EXPECT_EQ(found.xi[1], 0.5);
  EXPECT_NE(found.xi[2], 7);
  EXPECT_EQ(found.xi[4], -3);
  EXPECT_EQ(found.xi[5], 4);
  EXPECT_EQ(found.gap[0], 0);
  EXPECT_EQ(found.gap[2], 0);
  const FacetPoints q = facet_points(surface, which, this->scene.x, given);
  for (int i : {0, 2})
  {
    EXPECT_EQ(norm(this->point(q.x, i)), 0);
    EXPECT_EQ(norm(this->point(q.normal, i)), 0);
  }
  EXPECT_NEAR(norm(this->point(q.normal, 1)), 1, 1e-14);
}

TEST(FootOfADegenerateFacet, IsWhatWasGiven)
{
  Scene scene(3);
  scene.facet(
      {scene.node({0, 0, 0}), scene.node({1, 0, 0}), scene.node({2, 0, 0})});
  const std::vector<std::int32_t> which{0};
  const std::vector<double> point{0.5, 1, 1}, given{0.25, 0.125};
  const Projections found
      = projections(scene.surface(), which, scene.x, point, given);
  EXPECT_EQ(found.xi, given);
  EXPECT_EQ(found.gap[0], 0);
}
} // namespace
