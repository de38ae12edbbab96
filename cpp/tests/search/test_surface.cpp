// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#include "expect.h"
#include "facing.h"
#include <contactx/geometry/shape.h>
#include <contactx/search/projections.h>

using namespace contactx;
using namespace contactx::search;
using namespace contactx::tests;

namespace
{
using Facets = std::vector<std::int32_t>;

/// Number of a vertex as a feature.
int vertex(int num_nodes, int local)
{
  return 1 + (num_nodes == 2 ? 0 : num_nodes) + local;
}

TEST(Surface, StarsOfAGrid)
{
  const Surface s = flat_grid(2, Cells::quadrilaterals).surface();
  EXPECT_EQ(s.star(3, geometry::interior), Facets{3});
  EXPECT_EQ(s.star(0, vertex(4, 0)), Facets{0});
  EXPECT_EQ(s.star(0, vertex(4, 1)), (Facets{0, 1}));
  EXPECT_EQ(s.star(0, vertex(4, 3)), (Facets{0, 1, 2, 3}));
  EXPECT_EQ(s.star(0, 1), Facets{0});      // outer edge
  EXPECT_EQ(s.star(0, 2), (Facets{0, 1})); // edge to the right
  EXPECT_EQ(s.star(1, 3), (Facets{1, 3})); // edge above
}

TEST(Surface, StarsOfMixedFacets)
{
  // Cells (0, 0) and (1, 1) are triangles: facets 0 1, 2, 3, 4 5
  const Surface s = flat_grid(2, Cells::mixed).surface();
  EXPECT_EQ(s.star(0, 2), (Facets{0, 1})); // the diagonal
  EXPECT_EQ(s.star(1, 1), (Facets{1, 2})); // triangle and quadrilateral
  EXPECT_EQ(s.star(2, 4), (Facets{1, 2}));
  EXPECT_EQ(s.star(1, vertex(3, 1)), (Facets{1, 2, 3, 4}));
}

TEST(Surface, StarsOfSegments)
{
  const Surface s({0, 2, 4}, {7, 5, 5, 3}, 2);
  EXPECT_EQ(s.star(0, vertex(2, 0)), Facets{0});
  EXPECT_EQ(s.star(0, vertex(2, 1)), (Facets{0, 1}));
  EXPECT_EQ(s.star(1, vertex(2, 0)), (Facets{0, 1}));
}

TEST(Surface, KnowsItsOuterEdge)
{
  for (Cells cells : {Cells::triangles, Cells::quadrilaterals, Cells::mixed})
  {
    const Scene scene = flat_grid(3, cells);
    const Surface s = scene.surface();
    for (std::int32_t f = 0; f < s.facets().size(); ++f)
    {
      const auto nodes = s.facets()[f];
      const int n = nodes.size();
      EXPECT_FALSE(s.on_boundary(f, geometry::interior));
      for (int l = 0; l < n; ++l)
      {
        const Vector<3> p = scene.point(nodes[l]);
        const bool outer = p[0] == 0 or p[0] == 1 or p[1] == 0 or p[1] == 1;
        EXPECT_EQ(s.on_boundary(f, vertex(n, l)), outer);
      }
      for (int e = 1; e <= n; ++e)
        EXPECT_EQ(s.on_boundary(f, e), s.star(f, e).size() == 1);
    }
  }
}

TEST(Surface, ClosedOneHasNoOuterEdge)
{
  const Surface tetrahedron({0, 3, 6, 9, 12},
                            {0, 2, 1, 0, 1, 3, 1, 2, 3, 0, 3, 2}, 3);
  const Surface ring({0, 2, 4, 6}, {0, 1, 1, 2, 2, 0}, 2);
  for (int feature = 0; feature <= 6; ++feature)
    EXPECT_FALSE(tetrahedron.on_boundary(0, feature));
  for (int feature = 0; feature <= 2; ++feature)
    EXPECT_FALSE(ring.on_boundary(0, feature));
  const Surface segment({0, 2}, {0, 1}, 2);
  EXPECT_TRUE(segment.on_boundary(0, 1));
  EXPECT_TRUE(segment.on_boundary(0, 2));
}

TEST(Surface, RefusesWhatIsNoSurface)
{
  EXPECT_REFUSED(Surface({}, {}, 3));
  EXPECT_REFUSED(Surface({0, 3}, {0, 1, 2, 3}, 3));
  EXPECT_REFUSED(Surface({0, 2}, {0, 1}, 3));
  EXPECT_REFUSED(Surface({0, 3}, {0, 1, 2}, 2));
  EXPECT_REFUSED(Surface({0, 5}, {0, 1, 2, 3, 4}, 3));
  EXPECT_NO_THROW(Surface({0}, {}, 3));
}

TEST(Surface, BoxesHoldTheFacets)
{
  const Scene scene = grid(4, Cells::mixed, [](double s, double t)
                           { return Vector<3>{s, t - 2, s * t - 3}; });
  const auto boxes = scene.surface().boxes(scene.x);
  ASSERT_EQ(boxes.size(), scene.offsets.size() - 1);
  for (std::size_t f = 0; f < boxes.size(); ++f)
    for (std::int32_t i = scene.offsets[f]; i < scene.offsets[f + 1]; ++i)
      EXPECT_EQ(boxes[f].distance2(scene.point(scene.nodes[i])), 0);
  Scene plane(2);
  plane.facet({plane.node({3, 1}), plane.node({2, 5})});
  const Box b = plane.surface().boxes(plane.x)[0];
  EXPECT_EQ(b.distance2({2.5, 3, 0}), 0);
  EXPECT_NEAR(b.distance2({0, 7, 0}), 8, 1e-12);
}

TEST(Surface, FacetWithoutAreaHasNoProjection)
{
  Scene scene(3);
  for (int i = 0; i < 4; ++i)
    scene.node({double(i), double(i), 0});
  scene.facet({0, 1, 2});
  scene.facet({0, 1, 2, 3});
  for (std::int32_t f : {0, 1})
  {
    EXPECT_FALSE(closest(scene.surface(), f, scene.x, {0, 0, 1}));
    EXPECT_FALSE(extended(scene.surface(), f, scene.x, {0, 0, 1}));
  }
}

TEST(Surface, ProjectionKnowsItsGapAndExcess)
{
  const Scene scene = flat_grid(1, Cells::quadrilaterals);
  const auto c = closest(scene.surface(), 0, scene.x, {1.25, 0.5, -0.5});
  ASSERT_TRUE(c);
  EXPECT_EQ(c->feature, 2);
  EXPECT_EQ(c->d, (Vector<3>{0.25, 0, -0.5}));
  EXPECT_EQ(c->normal, (Vector<3>{0, 0, 1}));
  EXPECT_DOUBLE_EQ(c->gap, -0.5);
  EXPECT_DOUBLE_EQ(c->size, std::sqrt(2));
  const auto e = extended(scene.surface(), 0, scene.x, {1.25, 0.5, -0.5});
  ASSERT_TRUE(e);
  EXPECT_EQ(e->feature, geometry::interior);
  EXPECT_DOUBLE_EQ(e->excess, 0.25);
  EXPECT_DOUBLE_EQ(e->xi[0], 1.25);
}

TEST(OuterMargin, IsTheDistanceFromTheOuterEdgeInLocalCoordinates)
{
  for (Cells cells : {Cells::triangles, Cells::quadrilaterals})
  {
    const Scene scene = flat_grid(3, cells);
    const Surface surface = scene.surface();
    for (std::int32_t f = 0; f < surface.facets().size(); ++f)
    {
      const Vector<2> xi{0.3, 0.1};
      const Vector<3> at = point_at(surface, f, scene.x, xi).x;
      const double d = std::min({at[0], at[1], 1 - at[0], 1 - at[1]});
      const double margin = outer_margin(surface, f, xi);
      // Cells are a third wide; those within have no outer edge
      if (cells == Cells::quadrilaterals)
        EXPECT_NEAR(margin, d < 1. / 3 ? 3 * d : 1, 1e-14);
      else
        EXPECT_TRUE(margin == 1 or margin >= 0.1 - 1e-14);
    }
  }
  Scene line(2);
  for (int i = 0; i < 3; ++i)
    line.node({double(i), 0});
  line.facet({0, 1});
  line.facet({1, 2});
  EXPECT_NEAR(outer_margin(line.surface(), 0, {0.2, 0}), 0.2, 1e-14);
  EXPECT_NEAR(outer_margin(line.surface(), 1, {0.2, 0}), 0.8, 1e-14);
  EXPECT_NEAR(outer_margin(line.surface(), 0, {-0.1, 0}), -0.1, 1e-14);
}

template <class F>
struct Feet
{
  static constexpr int D = F::gdim;

  /// Random facets that share no node.
  Feet() : scene(D)
  {
    for (int i = 0; i < num; ++i)
    {
      facets.push_back(random_facet<F>(random));
      scene.join(single<F>(facets.back()));
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
    auto p = row<D>(x, i);
    return p;
  }

  static constexpr int num = 200;
  Generator random{1};
  Scene scene;
  std::vector<geometry::Nodes<F>> facets;
  std::vector<std::int32_t> which;
  std::vector<double> xi, gap;
};
template <class>
using Foot = testing::Test;
TYPED_TEST_SUITE(Foot, FacetTypes);

TYPED_TEST_OF(Foot, PlacesAreOnTheSurfaceWithItsNormal, F)
{
  Feet<F> s;
  s.draw(0);
  const FacetPoints q
      = facet_points(s.scene.surface(), s.which, s.scene.x, s.xi);
  for (int i = 0; i < s.num; ++i)
  {
    geometry::Local<F> at;
    std::copy_n(s.xi.begin() + 2 * i, F::tdim, at.begin());
    const auto& x = s.facets[s.which[i]];
    EXPECT_LT(norm(s.point(q.x, i) - position<F>(x, at)), 1e-14);
    EXPECT_LT(norm(s.point(q.normal, i) - geometry::frame<F>(x, at).n), 1e-14);
  }
}

TYPED_TEST_OF(Foot, FeetAndPlacesAreInverse, F)
{
  Feet<F> s;
  // Below the radius of curvature of the warped ones
  s.draw(0.3);
  const Surface surface = s.scene.surface();
  const FacetPoints q = facet_points(surface, s.which, s.scene.x, s.xi);
  std::vector<double> points(q.x);
  for (int i = 0; i < s.num; ++i)
    for (int k = 0; k < F::gdim; ++k)
      points[F::gdim * i + k] += s.gap[i] * q.normal[F::gdim * i + k];
  const std::vector<double> nowhere(2 * s.num, -9);
  const Projections found
      = projections(surface, s.which, s.scene.x, points, nowhere);
  for (int i = 0; i < s.num; ++i)
  {
    for (int a = 0; a < F::tdim; ++a)
      EXPECT_NEAR(found.xi[2 * i + a], s.xi[2 * i + a], 1e-12) << i;
    EXPECT_NEAR(found.gap[i], s.gap[i], 1e-12) << i;
  }
}

TYPED_TEST_OF(Foot, AreThoseOfTheMaterialWhenTheFacetsHaveMoved, F)
{
  Feet<F> s;
  s.draw(0.3);
  const Surface surface = s.scene.surface();
  const Motion<F::gdim> motion(s.random, 5);
  auto moved = s.scene.x;
  for (std::size_t i = 0; i < moved.size() / F::gdim; ++i)
  {
    const auto p = motion(s.point(moved, i));
    std::copy(p.begin(), p.end(), moved.begin() + F::gdim * i);
  }
  const FacetPoints before = facet_points(surface, s.which, s.scene.x, s.xi);
  const FacetPoints after = facet_points(surface, s.which, moved, s.xi);
  for (int i = 0; i < s.num; ++i)
  {
    EXPECT_LT(norm(s.point(after.x, i) - motion(s.point(before.x, i))), 1e-13);
    EXPECT_LT(norm(s.point(after.normal, i)
                   - motion.rotate(s.point(before.normal, i))),
              1e-13);
  }
}

TYPED_TEST_OF(Foot, WithoutAFacetIsWhatWasGiven, F)
{
  Feet<F> s;
  const Surface surface = s.scene.surface();
  const std::vector<std::int32_t> which{-1, 0, -1};
  const std::vector<double> given{0.25, 0.5, 7, 7, -3, 4};
  const std::vector<double> points(3 * F::gdim, 0.3);
  const Projections found
      = projections(surface, which, s.scene.x, points, given);
  EXPECT_EQ(found.xi[0], 0.25);
  EXPECT_EQ(found.xi[1], 0.5);
  EXPECT_NE(found.xi[2], 7);
  EXPECT_EQ(found.xi[4], -3);
  EXPECT_EQ(found.xi[5], 4);
  EXPECT_EQ(found.gap[0], 0);
  EXPECT_EQ(found.gap[2], 0);
  const FacetPoints q = facet_points(surface, which, s.scene.x, given);
  for (int i : {0, 2})
  {
    EXPECT_EQ(norm(s.point(q.x, i)), 0);
    EXPECT_EQ(norm(s.point(q.normal, i)), 0);
  }
  EXPECT_NEAR(norm(s.point(q.normal, 1)), 1, 1e-14);
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
