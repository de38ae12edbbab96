// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#include "expect.h"
#include "facets.h"
#include <contactx/geometry/closest_point.h>

using namespace contactx;
using namespace contactx::geometry;
using namespace contactx::tests;

namespace
{
/// @brief Distance from a facet by sampling it, with a finer grid around each
/// of the best samples of the last one. No better than 1e-9 in xi, so that
/// the distance has about nine digits near the facet.
template <class F>
double sampled_distance(const geometry::Nodes<F>& x, const Vector<F::gdim>& p)
{
  constexpr int n = 24;
  double best = infinity;
  // The coarse grid's cells are searched on their own, for a warped facet may
  // have several points of least distance
  for (int i = 0; i <= n; i += 4)
    for (int j = 0; j <= n; j += 4)
    {
      geometry::Local<F> centre{double(i) / n, double(j) / n};
      for (double h = 1. / 8; h > 1e-10; h *= 0.6)
      {
        double least = infinity;
        const geometry::Local<F> around = centre;
        for (double a : {-h, 0.0, h})
          for (double b : {-h, 0.0, h})
          {
            geometry::Local<F> xi{std::clamp(around[0] + a, 0.0, 1.0),
                                  std::clamp(around[1] + b, 0.0, 1.0)};
            if (F::nodes == 3 and xi[0] + xi[1] > 1)
              xi = (1 / (xi[0] + xi[1])) * xi;
            const double d = norm(p - position<F>(x, xi));
            if (d < least)
            {
              least = d;
              centre = xi;
            }
          }
        best = std::min(best, least);
      }
    }
  return best;
}

/// @brief Distance from a triangle in extended precision, for slivers.
inline double long_distance(const geometry::Nodes<geometry::Triangle>& x,
                            const Vector<3>& p)
{
  using Real = long double;
  using Long = std::array<Real, 3>;
  const auto minus = [](const auto& a, const auto& b)
  { return Long{Real(a[0]) - b[0], Real(a[1]) - b[1], Real(a[2]) - b[2]}; };
  const auto product = [](const Long& a, const Long& b)
  { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; };
  const auto combined = [](const Long& d, Real s, const Long& a)
  { return Long{d[0] - s * a[0], d[1] - s * a[1], d[2] - s * a[2]}; };

  Real best = std::numeric_limits<Real>::infinity();
  for (const auto& [i, j] : geometry::Triangle::edges)
  {
    const Long e = minus(x[j], x[i]), d = minus(p, x[i]);
    const Real s = std::clamp(product(d, e) / product(e, e), Real(0), Real(1));
    const Long r = combined(d, s, e);
    best = std::min(best, product(r, r));
  }
  const Long a = minus(x[1], x[0]), d = minus(p, x[0]);
  Long b = minus(x[2], x[0]);
  const Real shear = product(a, b) / product(a, a);
  b = combined(b, shear, a);
  const Real t = product(d, b) / product(b, b);
  const Real s = product(d, a) / product(a, a) - shear * t;
  if (s >= 0 and t >= 0 and s + t <= 1)
  {
    const Long r = combined(combined(d, s + shear * t, a), t, b);
    best = std::min(best, product(r, r));
  }
  return std::sqrt(best);
}

template <class>
using ClosestPointOn = testing::Test;
TYPED_TEST_SUITE(ClosestPointOn, FacetTypes);

constexpr std::array offsets{0.0, 1e-12, 1e-4, 1.0, 1000.0};

template <class F>
constexpr int num_features = 1 + F::num_edges + F::nodes;

/// Direction in the plane of a flat facet in which its edge faces.
template <class F>
Vector<F::gdim> edge_normal(const Nodes<F>& x, std::pair<int, int> edge)
{
  const auto e = x[edge.second] - x[edge.first];
  if constexpr (F::gdim == 2)
    return (-1 / norm(e)) * e; // away from the vertex that it starts at
  else
    return (1 / norm(e)) * cross(e, flat_normal<F>());
}

/// A point of a feature and a direction in the plane of the facet in which
/// the feature stays the closest one.
template <class F>
std::pair<Vector<F::gdim>, Vector<F::gdim>> away(const Nodes<F>& x, int feature,
                                                 Generator& random)
{
  if (feature == interior)
    return {position<F>(x, inner_point<F>(random)), {}};
  if (F::num_edges > 0 and feature <= F::num_edges)
  {
    const auto [i, j] = F::edges[feature - 1];
    const double s = random(0.05, 0.95);
    return {(1 - s) * x[i] + s * x[j], edge_normal<F>(x, {i, j})};
  }
  const int vertex = feature - 1 - F::num_edges;
  Vector<F::gdim> direction{};
  for (const auto& edge : F::edges)
    if (edge.first == vertex or (F::gdim == 3 and edge.second == vertex))
      direction = direction + random(0.2, 1) * edge_normal<F>(x, edge);
  return {x[vertex], (1 / norm(direction)) * direction};
}

TYPED_TEST_OF(ClosestPointOn, EachVoronoiRegion, F)
{
  Generator random(1);
  for (int i = 0; i < 40; ++i)
    for (int feature = 0; feature < num_features<F>; ++feature)
      for (double beside : offsets)
        for (double height : offsets)
        {
          const auto x = flat_facet<F>(random);
          const Motion<F::gdim> motion(random, 10);
          const auto [foot, direction] = away<F>(x, feature, random);
          const double side = i % 2 ? height : -height;
          const auto p
              = motion(foot + beside * direction + side * flat_normal<F>());
          const double distance
              = std::hypot(feature == interior ? 0 : beside, height);

          const auto c = closest_point<F>(motion(x), p);
          // The interior reaches 1e-12 beyond the edges
          const double tolerance = 2e-12 + 1e-13 * distance;
          EXPECT_NEAR(std::sqrt(c.distance2), distance, tolerance);
          EXPECT_LT(norm(position<F>(motion(x), c.xi) - motion(foot)),
                    tolerance);
          if (feature == interior or beside > 1e-6)
          {
            EXPECT_EQ(c.feature, feature);
          }
        }
}

TYPED_TEST_OF(ClosestPointOn, ItsVerticesAndEdges, F)
{
  Generator random(2);
  for (int i = 0; i < 200; ++i)
  {
    const auto x = random_facet<F>(random);
    for (const auto& [a, b] : F::edges)
      for (double s : {0.0, 1e-15, 0.25, 0.5, 1.0})
      {
        const auto p = (1 - s) * x[a] + s * x[b];
        const auto c = closest_point<F>(x, p);
        EXPECT_LT(std::sqrt(c.distance2), 2e-15);
        EXPECT_LT(norm(position<F>(x, c.xi) - p), 4e-15);
        EXPECT_LE(F::excess(c.xi), 1e-12);
      }
  }
}

TYPED_TEST_OF(ClosestPointOn, AScaledFacetIsTheScaledOne, F)
{
  Generator random(3);
  for (double scale : {0x1p-40, 0x1p40}) // exact, so that nothing may differ
    for (int i = 0; i < 200; ++i)
    {
      auto x = random_facet<F>(random);
      auto p = position<F>(x, random.vector<F::tdim>(-0.5, 1.5))
               + random.vector<F::gdim>(-1, 1);
      const auto c = closest_point<F>(x, p);
      for (auto& node : x)
        node = scale * node;
      const auto scaled = closest_point<F>(x, scale * p);
      EXPECT_EQ(scaled.xi, c.xi);
      EXPECT_EQ(scaled.feature, c.feature);
      EXPECT_EQ(scaled.distance2, scale * scale * c.distance2);
    }
}

/// Rounding must not decide between the facets at an edge: their distances
/// are equal to the last bit.
template <class F>
void expect_tie(const Nodes<F>& x, const Nodes<Triangle>& y, const Vector<3>& p)
{
  EXPECT_EQ(closest_point<F>(x, p).distance2,
            closest_point<Triangle>(y, p).distance2);
}

TEST(ClosestPoint, OnASharedEdgeIsTheSameForBothFacets)
{
  Generator random(4);
  for (int i = 0; i < 500; ++i)
  {
    // A roof with its ridge from a to b
    const Motion<3> motion(random, 3);
    const Vector<3> a = motion({0, 0, 0}), b = motion({0, random(0.5, 2), 0});
    const Vector<3> left = motion({-1, 0, -1}), right = motion({1, 0, -1});
    const Vector<3> back = motion({-1, 0.5, -1});
    const Vector<3> p
        = motion({random(-0.1, 0.1), random(-1, 2), random(0.2, 2)});
    expect_tie<Triangle>({a, left, b}, {right, a, b}, p);
    expect_tie<Triangle>({b, a, left}, {a, b, right}, p);
    expect_tie<Quadrilateral>({a, b, left, back}, {b, right, a}, p);
  }
}

template <class>
using Project = testing::Test;
TYPED_TEST_SUITE(Project, FacetTypes);

/// Largest cosine between the tangents and the way to the point, measured
/// with the way from the facet's first node.
template <class F>
double obliqueness(const Nodes<F>& x, const Vector<F::gdim>& p,
                   const Local<F>& xi)
{
  const auto d = p - position<F>(x, xi);
  double largest = 0;
  for (const auto& t : tangents<F>(x, xi))
    largest = std::max(largest,
                       std::abs(dot(d, t)) / (norm(t) * (1 + norm(p - x[0]))));
  return largest;
}

TYPED_TEST_OF(Project, IsOrthogonalBeyondTheEdgesAndFarAway, F)
{
  Generator random(1);
  for (double height : {0.0, 1e-12, 1e-4, 0.5, -0.5, 1e3, 1e6})
    for (int i = 0; i < 500; ++i)
    {
      // From afar one of several points of a warped facet would be found
      const auto x = random_facet<F>(random, height > 1 ? 0 : 0.1);
      const Local<F> foot = random.vector<F::tdim>(-0.5, 1.5);
      const auto p = position<F>(x, foot) + height * frame<F>(x, foot).n;
      Local<F> xi = projection_start<F>(x, p);
      ASSERT_TRUE(project<F>(x, p, xi)) << height;
      EXPECT_LT(obliqueness<F>(x, p, xi), 1e-13) << height;
    }
}

TYPED_TEST_OF(Project, ForgetsItsStart, F)
{
  Generator random(3);
  for (int i = 0; i < 500; ++i)
  {
    const auto x = random_facet<F>(random, 0.1);
    const Local<F> foot = random.vector<F::tdim>(-0.05, 1.05);
    const auto p
        = position<F>(x, foot) + random(-0.3, 0.3) * frame<F>(x, foot).n;
    Local<F> xi = foot + random.vector<F::tdim>(-0.2, 0.2);
    ASSERT_TRUE(project<F>(x, p, xi));
    EXPECT_LT(norm(xi - foot), 1e-12);
  }
}

TYPED_TEST_OF(Project, KeepsItsDigitsFarFromTheOrigin, F)
{
  Generator random(4);
  for (double distance : {1e3, 1e6, 1e9, 1e12})
    for (int i = 0; i < 200; ++i)
    {
      // Coordinates that the translation does not round
      auto x = flat_facet<F>(random);
      for (auto& node : x)
        for (double& c : node)
          c = std::round(64 * c) / 64;
      auto p = position<F>(x, inner_point<F>(random));
      for (double& c : p)
        c = std::round(64 * c) / 64;
      Local<F> near = projection_start<F>(x, p);
      ASSERT_TRUE(project<F>(x, p, near));
      Vector<F::gdim> shift;
      shift.fill(distance);
      for (auto& node : x)
        node = node + shift;
      Local<F> xi = projection_start<F>(x, p + shift);
      ASSERT_TRUE(project<F>(x, p + shift, xi));
      EXPECT_LT(norm(xi - near), 1e-13);
    }
}

TYPED_TEST_OF(Project, TellsThatThereIsNone, F)
{
  Nodes<F> x; // no area
  for (auto& node : x)
    node.fill(1);
  Local<F> xi{};
  EXPECT_FALSE(project<F>(x, {}, xi));
  Generator random(5);
  Vector<F::gdim> p{};
  p[0] = std::nan("");
  xi = {};
  EXPECT_FALSE(project<F>(flat_facet<F>(random), p, xi));
}

template <class>
using Degenerate = testing::Test;
TYPED_TEST_SUITE(Degenerate, FacetTypes);

TYPED_TEST_OF(Degenerate, FacetThatIsAPoint, F)
{
  Generator random(1);
  Nodes<F> x;
  x.fill(random.vector<F::gdim>(-1, 1));
  const auto p = random.vector<F::gdim>(-1, 1);
  const auto c = closest_point<F>(x, p);
  EXPECT_NEAR(std::sqrt(c.distance2), norm(p - x[0]), 1e-15);
  EXPECT_LE(F::excess(c.xi), 0);
}

TYPED_TEST_OF(Degenerate, FacetThatIsALine, F)
{
  Generator random(2);
  for (int i = 0; i < 200; ++i)
  {
    const auto a = random.vector<F::gdim>(-1, 1);
    const auto b = random.vector<F::gdim>(-1, 1);
    Nodes<F> x;
    for (auto& node : x)
      node = a + random(0, 0.9) * (b - a);
    x.front() = a;
    x.back() = b;
    const auto p = random.vector<F::gdim>(-2, 2);
    const auto e = b - a;
    const double s = std::clamp(dot(p - a, e) / dot(e, e), 0.0, 1.0);
    const auto c = closest_point<F>(x, p);
    EXPECT_NEAR(std::sqrt(c.distance2), norm(p - a - s * e), 1e-13);
    EXPECT_LE(F::excess(c.xi), 1e-12);
  }
}

TEST(DegenerateQuadrilateral, WithAnEdgeWithoutLengthIsATriangle)
{
  Generator random(3);
  for (int i = 0; i < 500; ++i)
  {
    const auto t = random_facet<Triangle>(random);
    const Nodes<Quadrilateral> x{t[0], t[1], t[2], t[2]};
    const auto p = t[0] + random.vector<3>(-2, 2);
    const auto c = closest_point<Quadrilateral>(x, p);
    EXPECT_NEAR(std::sqrt(c.distance2), long_distance(t, p), 1e-13);
    EXPECT_LE(Quadrilateral::excess(c.xi), 1e-12);
  }
}

/// Random slivers of an aspect ratio, long in any of the three directions.
void compare_slivers(double aspect, unsigned seed)
{
  SCOPED_TRACE(aspect);
  Generator random(seed);
  // The interior reaches 1e-12 beyond the edges; the tangents are as close to
  // parallel as the aspect says
  const double tolerance = 3e-12 + 1e-15 * aspect;
  for (int i = 0; i < 3000; ++i)
  {
    Nodes<Triangle> x{
        {{0, 0, 0}, {1, 0, 0}, {random(-0.5, 1.5), 1 / aspect, 0}}};
    std::rotate(x.begin(), x.begin() + i % 3, x.end());
    const Motion<3> motion(random, 1);
    const auto xm = motion(x);
    const double height = std::pow(10, random(-9, 1));
    const auto p = motion(position<Triangle>(x, random.vector<2>(-0.5, 1))
                          + Vector<3>{0, 0, height});
    const auto c = closest_point<Triangle>(xm, p);
    const double distance = long_distance(xm, p);
    EXPECT_NEAR(std::sqrt(c.distance2), distance, tolerance);
    EXPECT_NEAR(norm(p - position<Triangle>(xm, c.xi)), distance, tolerance);
  }
}

TEST(Sliver, OfAnyAspectIsMeasuredToRounding)
{
  for (const double aspect : {1e2, 1e4, 1e6})
    compare_slivers(aspect, 4);
}

TEST(Sliver, QuadrilateralIsTwoTriangles)
{
  Generator random(7);
  for (double aspect : {1e2, 1e4, 1e6})
    for (int i = 0; i < 1000; ++i)
    {
      const double w = 1 / aspect, shear = random(-0.3, 0.3);
      const Nodes<Quadrilateral> flat{
          {{0, 0, 0}, {1, 0, 0}, {shear, w, 0}, {1 + shear, w, 0}}};
      const Motion<3> motion(random, 1);
      const auto x = motion(flat);
      const double height = std::pow(10, random(-9, 1));
      const auto p
          = motion(position<Quadrilateral>(flat, random.vector<2>(-0.5, 1.5))
                   + Vector<3>{0, 0, height});
      const double distance = std::min(long_distance({x[0], x[1], x[2]}, p),
                                       long_distance({x[1], x[3], x[2]}, p));
      const auto c = closest_point<Quadrilateral>(x, p);
      EXPECT_NEAR(std::sqrt(c.distance2), distance, 3e-12);
    }
}

TYPED_TEST_OF(Degenerate, PointThatIsNotANumberHasNoDistance, F)
{
  Generator random(8);
  for (int k = 0; k < F::gdim; ++k)
  {
    Vector<F::gdim> p{};
    p[k] = std::nan("");
    const auto c = closest_point<F>(random_facet<F>(random), p);
    EXPECT_TRUE(std::isinf(c.distance2));
  }
}

TEST(Sliver, KeepsItsWidthHoweverLongItIs)
{
  // The second node is one from the third, which is the point itself
  for (const double length : {1e4, 1e6, 2e7, 1e9})
  {
    const Nodes<Triangle> x{{{0.75, 0.75, length}, {0, -1, -1}, {-1, -1, -1}}};
    const auto c = closest_point<Triangle>(x, x[2]);
    EXPECT_LT(std::sqrt(c.distance2), 1e-15 * length);
  }
}

using F = Quadrilateral;

/// Compare with the sampled distance, for random points near warped facets.
void compare(double warp, double height, unsigned seed)
{
  SCOPED_TRACE(testing::Message() << "warp " << warp << ", height " << height);
  Generator random(seed);
  for (int i = 0; i < 300; ++i)
  {
    const auto x = random_facet<F>(random, warp);
    const Local<F> foot = random.vector<2>(-0.5, 1.5);
    const auto p
        = position<F>(x, foot)
          + random(-height, height) * frame<F>(x, random.vector<2>(0, 1)).n;
    const auto c = closest_point<F>(x, p);
    const double distance = std::sqrt(c.distance2);
    EXPECT_NEAR(distance, sampled_distance<F>(x, p), 2e-9 * (1 + distance));
    EXPECT_NEAR(norm(p - position<F>(x, c.xi)), distance, 1e-13);
    EXPECT_LE(F::excess(c.xi), 1e-12);
  }
}

TEST(WarpedQuadrilateral, DistanceIsThatOfSamples)
{
  compare(0.01, 1, 1);
  compare(0.2, 0.5, 2);
  compare(0.2, 20, 3);
  compare(0.7, 1, 4); // twisted by a right angle
}

TEST(WarpedQuadrilateral, FeatureTellsWhereThePointIs)
{
  Generator random(5);
  for (int i = 0; i < 2000; ++i)
  {
    const auto x = random_facet<F>(random, 0.2);
    const auto p
        = position<F>(x, random.vector<2>(-0.5, 1.5)) + random.vector<3>(-1, 1);
    const auto c = closest_point<F>(x, p);
    int edges = 0; // that the point lies on
    for (double s : c.xi)
      edges += std::min(std::abs(s), std::abs(s - 1)) < 1e-12;
    const int expected = c.feature == interior       ? 0
                         : c.feature <= F::num_edges ? 1
                                                     : 2;
    EXPECT_EQ(edges, expected);
  }
}

TEST(WarpedQuadrilateral, NodeOverTheMiddleOfASaddle)
{
  const Nodes<F> x{{{0, 0, 0.1}, {1, 0, -0.1}, {0, 1, -0.1}, {1, 1, 0.1}}};
  for (double h : {-1.0, -1e-9, 0.0, 1e-9, 1.0})
  {
    const auto c = closest_point<F>(x, {0.5, 0.5, h});
    EXPECT_EQ(c.feature, interior);
    EXPECT_NEAR(std::sqrt(c.distance2), std::abs(h), 1e-15);
  }
  // Beyond the centre of curvature the middle is no minimum any more
  const auto c = closest_point<F>(x, {0.5, 0.5, 10});
  EXPECT_NE(c.feature, interior);
  EXPECT_NEAR(c.distance2, 9.9 * 9.9 + 0.5, 1e-12);
}
} // namespace
