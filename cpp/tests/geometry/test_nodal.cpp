// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#include "expect.h"
#include "scene.h"
#include <contactx/geometry/facing.h>

using namespace contactx;
using namespace contactx::geometry;
using namespace contactx::tests;

namespace
{
double sum(const std::vector<double>& v)
{
  return std::accumulate(v.begin(), v.end(), 0.0);
}

std::vector<double> areas(const Scene& scene)
{
  return nodal_areas(scene.facets(), scene.x, scene.gdim);
}

Vector<3> normal(const Scene& scene, std::int32_t node)
{
  return vector_at(nodal_normals(scene.facets(), scene.x, scene.gdim), node,
                   scene.gdim);
}

/// Patch of the unit sphere around (1, 1, 1), outward.
Scene sphere_patch(int n, Cells cells)
{
  return grid(n, cells,
              [](double s, double t)
              {
                const Vector<3> p{s, t, 1};
                return (1 / norm(p)) * p;
              });
}

TEST(NodalAreas, WithAWeightAreItsIntegrals)
{
  Generator random(8);
  for (const Cells cells : {Cells::triangles, Cells::quadrilaterals})
  {
    const Scene square = flat_grid(3, cells);
    const std::size_t n = square.x.size() / 3;
    const auto with = [&](const std::vector<double>& weight)
    { return nodal_areas(square.facets(), square.x, 3, weight); };
    expect_near(with(std::vector<double>(n, 1)), areas(square), 1e-15);
    // The shape functions' mass matrix is symmetric, and exact
    std::vector<double> x(n);
    for (std::size_t i = 0; i < n; ++i)
      x[i] = square.x[3 * i];
    const std::vector<double> w = random.numbers(n, 0, 1);
    const auto by_x = with(x), by_w = with(w);
    EXPECT_NEAR(std::inner_product(x.begin(), x.end(), by_w.begin(), 0.0),
                std::inner_product(w.begin(), w.end(), by_x.begin(), 0.0),
                1e-15);
    EXPECT_NEAR(std::inner_product(x.begin(), x.end(), by_x.begin(), 0.0),
                1. / 3, 1e-15);
  }
}

TEST(NodalAreas, OfAFlatSquareAddUpToItsArea)
{
  for (Cells cells : {Cells::triangles, Cells::quadrilaterals, Cells::mixed})
    for (int n : {1, 2, 5})
      EXPECT_NEAR(sum(areas(flat_grid(n, cells))), 1, 1e-14);
}

TEST(NodalAreas, AreTheIntegralsOfTheShapeFunctions)
{
  const auto a = areas(flat_grid(2, Cells::quadrilaterals));
  EXPECT_DOUBLE_EQ(a[0], 1. / 16); // corner
  EXPECT_DOUBLE_EQ(a[1], 2. / 16); // edge
  EXPECT_DOUBLE_EQ(a[4], 4. / 16); // middle
  const Scene skew(3, {{0, 0, 0}, {3, 0, 0}, {0, 1, 0}, {1, 1, 0}},
                   {{0, 1, 2, 3}});
  // Integrals of the bilinear functions over the trapezoid, by hand
  const auto b = areas(skew);
  EXPECT_DOUBLE_EQ(b[0], 7. / 12);
  EXPECT_DOUBLE_EQ(b[1], 7. / 12);
  EXPECT_DOUBLE_EQ(b[2], 5. / 12);
  EXPECT_DOUBLE_EQ(b[3], 5. / 12);
}

TEST(NodalAreas, OfSegmentsAreLengths)
{
  const Scene scene(2, {{0, 0}, {3, 4}, {3, 5}, {9, 9}}, {{0, 1}, {1, 2}});
  // The last is not on it
  EXPECT_EQ(areas(scene), (std::vector<double>{2.5, 3, 0.5, 0}));
}

TEST(NodalAreas, OfASphereConverge)
{
  // The patch seen through a square of a cube from its centre
  const double exact = std::asin(0.5); // one of the corners' quarters: pi/6
  for (Cells cells : {Cells::triangles, Cells::quadrilaterals, Cells::mixed})
  {
    const double coarse = std::abs(sum(areas(sphere_patch(8, cells))) - exact);
    const double fine = std::abs(sum(areas(sphere_patch(16, cells))) - exact);
    EXPECT_LT(fine, 2e-3);
    EXPECT_NEAR(coarse / fine, 4, 0.1);
  }
}

TEST(NodalAreas, ScaleWithTheSurface)
{
  Scene scene = sphere_patch(4, Cells::mixed);
  const double area = sum(areas(scene));
  for (double& c : scene.x)
    c *= 0x1p-40;
  EXPECT_DOUBLE_EQ(sum(areas(scene)), 0x1p-80 * area);
}

TEST(NodalAreas, OfFacetsWithoutAreaAreZero)
{
  const Scene scene(3, {{0, 0, 0}, {1, 1, 0}, {2, 2, 0}, {3, 3, 0}},
                    {{0, 1, 2}, {0, 1, 2, 3}});
  EXPECT_EQ(areas(scene), std::vector<double>(4, 0));
  EXPECT_EQ(normal(scene, 1), Vector<3>{});
}

TEST(NodalNormals, PointOutOfASphere)
{
  double last = 1;
  for (int n : {4, 8, 16})
  {
    const Scene scene = sphere_patch(n, Cells::mixed);
    const int middle = n / 2 * (n + 1) + n / 2;
    const double error = norm(normal(scene, middle) - scene.point(middle));
    EXPECT_LT(error, 0.6 * last);
    last = error;
  }
  EXPECT_LT(last, 0.02);
}

TEST(NodalNormals, AreWeightedByArea)
{
  // A corner of segments of length 3 and 4
  const Scene scene(2, {{0, 0}, {3, 0}, {3, 4}, {7, 7}}, {{0, 1}, {1, 2}});
  EXPECT_LT(norm(normal(scene, 1) - Vector<3>{0.8, -0.6}), 1e-15);
  EXPECT_EQ(normal(scene, 3), Vector<3>{}); // not on it
}

TEST(NodalNormals, PassOverFacetsWithoutArea)
{
  Scene scene = flat_grid(1, Cells::triangles);
  scene.facet({0, 1, 1});
  scene.facet({0, 2, 0, 2});
  for (int i = 0; i < 4; ++i)
    EXPECT_LT(norm(normal(scene, i) - Vector<3>{0, 0, 1}), 1e-15);
}

TEST(NodalNormals, OfATinySurfaceAreUnitVectors)
{
  Scene scene = sphere_patch(4, Cells::mixed);
  for (double& c : scene.x)
    c *= 1e-12;
  for (int i = 0; i < 25; ++i)
    EXPECT_NEAR(norm(normal(scene, i)), 1, 1e-14);
}

TEST(NodalNormals, ThatCancelAreZero)
{
  // Both sides of a sheet that is turned somehow
  Scene scene(3, {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 0}},
              {{0, 1, 2}, {1, 3, 2}, {2, 1, 0}, {3, 1, 2}});
  Generator random(1);
  scene.move(Motion<3>(random, 1));
  EXPECT_EQ(normal(scene, 0), Vector<3>{});
  EXPECT_EQ(normal(scene, 3), Vector<3>{});
}

TEST(NodalAreaVectors, OfPartsAddUpToThoseOfTheWhole)
{
  const Scene scene = sphere_patch(4, Cells::mixed);
  const auto facets = scene.facets();
  const std::int32_t half = facets.size() / 2, cut = facets.offsets[half];
  std::vector<std::int32_t> offsets(facets.offsets.begin() + half,
                                    facets.offsets.end());
  for (auto& offset : offsets)
    offset -= cut;
  const FacetList low{facets.offsets.first(half + 1), facets.nodes.first(cut)};
  const FacetList high{offsets, facets.nodes.subspan(cut)};
  auto vector = nodal_area_vectors(low, scene.x, 3);
  auto area = nodal_areas(low, scene.x, 3);
  const auto more = nodal_area_vectors(high, scene.x, 3);
  const auto larger = nodal_areas(high, scene.x, 3);
  for (std::size_t i = 0; i < vector.size(); ++i)
    vector[i] += more[i];
  for (std::size_t i = 0; i < area.size(); ++i)
    area[i] += larger[i];
  expect_near(unit_normals(vector, area, 3), nodal_normals(facets, scene.x, 3),
              1e-14);
  // Of a flat square all vectors are along its normal, and as long as the areas
  const Scene square = flat_grid(2, Cells::mixed);
  const auto flat = nodal_area_vectors(square.facets(), square.x, 3);
  const auto sizes = areas(square);
  for (std::size_t i = 0; i < sizes.size(); ++i)
  {
    EXPECT_EQ(flat[3 * i], 0);
    EXPECT_NEAR(flat[3 * i + 2], sizes[i], 1e-15);
  }
}

/// Normals at all nodes that are the same.
std::vector<double> everywhere(const Scene& scene, const Vector<3>& n)
{
  std::vector<double> normal;
  for (std::int32_t i = 0; i < scene.num_nodes(); ++i)
    normal.insert(normal.end(), n.begin(), n.begin() + scene.gdim);
  return normal;
}

/// Boundary of the unit square, turned by an angle, counterclockwise: nodes 0
/// to 3 at the corners, 4 amid the bottom.
Scene square(double angle = 0)
{
  Scene scene(2, {{0, 0}, {1, 0}, {1, 1}, {0, 1}, {0.5, 0}},
              {{0, 4}, {4, 1}, {1, 2}, {2, 3}, {3, 0}});
  const double c = std::cos(angle), s = std::sin(angle);
  scene.move([c, s](const Vector<3>& p)
             { return Vector<3>{c * p[0] - s * p[1], s * p[0] + c * p[1]}; });
  return scene;
}

std::vector<double> areas(const Scene& scene, const Vector<3>& normal)
{
  const auto corners = geometry::facing_areas(
      scene.facets(), scene.x, scene.x, everywhere(scene, normal), scene.gdim);
  std::vector<double> sums(scene.x.size() / scene.gdim, 0);
  for (std::size_t c = 0; c < corners.size(); ++c)
    sums[scene.nodes[c]] += corners[c];
  return sums;
}

TEST(FacingNodes, OfABoxAreThoseBelow)
{
  const Scene scene = square();
  const auto faces = geometry::facing_nodes(scene.facets(), scene.x,
                                            everywhere(scene, {0, 1}), 2);
  EXPECT_EQ(faces, (std::vector<std::int8_t>{1, 1, 0, 0, 1}));
}

TEST(FacingNodes, NoneFaceWhereTheMasterHasNoNormal)
{
  const Scene scene = flat_grid(2, Cells::mixed);
  const auto faces = geometry::facing_nodes(scene.facets(), scene.x,
                                            everywhere(scene, {0, 0, 0}), 3);
  EXPECT_EQ(faces, std::vector<std::int8_t>(9, 0));
}

TEST(FacingNodes, ASheetPushedBeyondTheMiddleOfABallDoesNotFaceIt)
{
  const Scene scene = flat_grid(2, Cells::triangles);
  const auto at = [&scene](double z)
  {
    // Normals of a ball below the middle of the sheet, or above it
    std::vector<double> normal;
    for (int i = 0; i < 9; ++i)
    {
      const Vector<3> d = scene.point(i) - Vector<3>{0.5, 0.5, z};
      const Vector<3> n = (1 / norm(d)) * d;
      normal.insert(normal.end(), n.begin(), n.end());
    }
    return geometry::facing_nodes(scene.facets(), scene.x, normal, 3);
  };
  EXPECT_EQ(at(0.1), std::vector<std::int8_t>(9, 1));
  EXPECT_EQ(at(-0.1), std::vector<std::int8_t>(9, 0));
}

TEST(FacingAreas, LeaveOutTheSidesOfABox)
{
  for (double angle : {0., 0.3, -0.4})
  {
    const Scene scene = square(angle);
    const auto area = areas(scene, {0, 1});
    EXPECT_NEAR(area[0], 0.25, 1e-14);
    EXPECT_NEAR(area[1], 0.25, 1e-14);
    EXPECT_NEAR(area[4], 0.5, 1e-14);
  }
  // Nothing of those above faces the master: they keep all
  EXPECT_NEAR(areas(square(), {0, 1})[2], 1, 1e-14);
}

TEST(FacingAreas, OfABoxOnItsEdgeAreThoseOfBothSides)
{
  const double quarter = std::numbers::pi / 4;
  const auto area = areas(square(quarter), {0, 1});
  EXPECT_NEAR(area[0], 0.25 + 0.5, 1e-14);
}

TEST(FacingAreas, OfARoundBodyAreWhole)
{
  const Scene scene = regular_polygon(12, 1);
  const auto whole = geometry::nodal_areas(scene.facets(), scene.x, 2);
  const auto area = areas(scene, {0.1, std::sqrt(0.99)});
  for (int i : {8, 9, 10})
    EXPECT_NEAR(area[i], whole[i], 1e-14);
}

TEST(FacingAreas, AreThoseOfTheReference)
{
  const Scene scene = flat_grid(3, Cells::quadrilaterals);
  auto x = scene.x;
  for (double& c : x)
    c *= 3;
  const auto corners = geometry::facing_areas(scene.facets(), scene.x, x,
                                              everywhere(scene, {0, 0, -1}), 3);
  EXPECT_NEAR(sum(corners), 1, 1e-13);
}

TEST(FacingAreas, RefuseNormalsOfOtherNodes)
{
  const Scene scene = flat_grid(1, Cells::quadrilaterals);
  const std::vector<double> few(3);
  EXPECT_REFUSED(
      geometry::facing_areas(scene.facets(), scene.x, scene.x, few, 3));
  EXPECT_REFUSED(
      geometry::facing_areas(scene.facets(), few, scene.x, scene.x, 3));
  EXPECT_REFUSED(geometry::facing_nodes(scene.facets(), scene.x, few, 3));
}
} // namespace
