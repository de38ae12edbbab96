// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#include <contactx/geometry/facets.h>
#include <contactx/geometry/gather.h>
#include <contactx/geometry/smooth.h>
#include <gtest/gtest.h>
#include <numbers>

using namespace contactx;
using namespace contactx::geometry;

namespace
{
/// A polygon about the origin, or an open part of it.
struct Arc
{
  Arc(int chords, double angle)
  {
    const bool is_closed = angle == 2 * std::numbers::pi;
    for (int i = 0; i < chords + not is_closed; ++i)
    {
      x.push_back(std::cos(angle * i / chords));
      x.push_back(std::sin(angle * i / chords));
    }
    const auto n = static_cast<std::int32_t>(x.size() / 2);
    // With the body, the disc, on the left
    for (std::int32_t i = 0; i < chords; ++i)
    {
      facets.nodes.insert(facets.nodes.end(), {i, (i + 1) % n});
      facets.offsets.push_back(static_cast<std::int32_t>(facets.nodes.size()));
    }
  }

  Facets facets;
  std::vector<double> x;
};

/// A part of the mantle of a cylinder about the z axis, of triangles whose
/// diagonals go one way or the other in turn, or of quadrilaterals.
struct Mantle
{
  Mantle(int around, int along, bool is_triangular, double angle)
  {
    for (int j = 0; j <= along; ++j)
      for (int i = 0; i <= around; ++i)
      {
        const double a = angle * i / around;
        x.insert(x.end(), {std::cos(a), std::sin(a), 0.3 * j});
      }
    const auto at = [around](int i, int j)
    { return static_cast<std::int32_t>(j * (around + 1) + i); };
    const auto add = [this](std::vector<std::int32_t> nodes)
    {
      facets.nodes.insert(facets.nodes.end(), nodes.begin(), nodes.end());
      facets.offsets.push_back(static_cast<std::int32_t>(facets.nodes.size()));
    };
    for (int j = 0; j < along; ++j)
      for (int i = 0; i < around; ++i)
      {
        const auto a = at(i, j), b = at(i + 1, j), c = at(i, j + 1),
                   d = at(i + 1, j + 1);
        if (not is_triangular)
          add({a, b, c, d});
        else if ((i + j) % 2)
        {
          add({a, b, d});
          add({a, d, c});
        }
        else
        {
          add({a, b, c});
          add({b, d, c});
        }
      }
  }

  Facets facets;
  std::vector<double> x;
};

double error_of(const Vector<3>& normal, const double* x, int gdim)
{
  return std::hypot(normal[0] - x[0], normal[1] - x[1],
                    gdim == 3 ? normal[2] : 0.0);
}
} // namespace

TEST(SmoothFacets, OfAPolygonAreThoseOfTheCircle)
{
  for (const double angle : {2 * std::numbers::pi, 1.5})
  {
    const Arc arc(angle > 2 ? 24 : 6, angle);
    const auto smooth = smooth_facets(arc.facets.list(), arc.x, 2);
    for (std::int32_t f = 0; f < arc.facets.list().size(); ++f)
    {
      const auto nodes = arc.facets.list()[f];
      for (int l = 0; l < 2; ++l)
        EXPECT_LT(error_of(smooth[f].normal[l], &arc.x[2 * nodes[l]], 2), 3e-3);
      const auto x = gather<Segment>(nodes, arc.x);
      for (const double xi : {0.1, 0.5, 0.8})
      {
        const double chord = norm(combine<Segment>(Segment::shape({xi}), x));
        EXPECT_NEAR(chord + rise<Segment>(x, smooth[f], {xi}), 1,
                    0.03 * (1 - chord) + 1e-12);
      }
      // Open ends are sharp, all else is not
      const bool first = angle < 2 and f == 0,
                 last = angle < 2 and f == arc.facets.list().size() - 1;
      EXPECT_EQ(smooth[f].sharp, (first ? 1 : 0) + (last ? 2 : 0));
    }
  }
}

TEST(SmoothFacets, OfAMantleAreThoseOfTheCylinder)
{
  for (const bool is_triangular : {true, false})
  {
    const Mantle mantle(8, 5, is_triangular, 2.0);
    const auto smooth = smooth_facets(mantle.facets.list(), mantle.x, 3);
    for (std::int32_t f = 0; f < mantle.facets.list().size(); ++f)
    {
      const auto nodes = mantle.facets.list()[f];
      for (std::size_t l = 0; l < nodes.size(); ++l)
        // Chords tilt by 0.125
        EXPECT_LT(error_of(smooth[f].normal[l], &mantle.x[3 * nodes[l]], 3),
                  0.012);
      visit(static_cast<int>(nodes.size()),
            [&]<class F>(F)
            {
              if constexpr (F::gdim == 3)
              {
                const auto x = gather<F>(nodes, mantle.x);
                const Local<F> xi{0.3, 0.45};
                const auto p = combine<F>(F::shape(xi), x);
                EXPECT_NEAR(std::hypot(p[0], p[1]) + rise<F>(x, smooth[f], xi),
                            1, 5e-4);
              }
            });
    }
  }
}

TEST(SmoothFacets, OfFlatOnesAreThemselvesAndEdgesStay)
{
  // Two squares that meet at a right angle
  const std::vector<double> x{0, 0, 0, 1, 0, 0,  0, 1, 0,
                              1, 1, 0, 1, 0, -1, 1, 1, -1};
  const Facets facets{{0, 4, 8}, {0, 1, 2, 3, 1, 4, 3, 5}};
  const auto smooth = smooth_facets(facets.list(), x, 3);
  for (int l = 0; l < 4; ++l)
  {
    EXPECT_NEAR(smooth[0].normal[l][2], 1, 1e-12);
    EXPECT_NEAR(smooth[1].normal[l][0], 1, 1e-12);
  }
  // All edges and vertices of both
  EXPECT_EQ(smooth[0].sharp, 0xff);
  EXPECT_EQ(smooth[1].sharp, 0xff);
}

TEST(SmoothFacets, TurnWithTheirFacets)
{
  const Arc arc(20, 2 * std::numbers::pi);
  const auto smooth = smooth_facets(arc.facets.list(), arc.x, 2);
  const auto x = gather<Segment>(arc.facets.list()[3], arc.x);
  const double c = std::cos(0.7), s = std::sin(0.7);
  const auto turn = [c, s](const Vector<2>& p) -> Vector<2>
  { return {c * p[0] - s * p[1], s * p[0] + c * p[1]}; };
  const Nodes<Segment> turned{turn(x[0]), turn(x[1])};
  const auto before = smooth_point<Segment>(x, x, smooth[3], {0.2});
  const auto after = smooth_point<Segment>(x, turned, smooth[3], {0.2});
  EXPECT_LT(norm(after.normal - turn(before.normal)), 1e-14);
  EXPECT_EQ(after.rise, before.rise);
}

TEST(SmoothFacets, AreProjectedOnAlongTheirNormals)
{
  const Arc arc(20, 2 * std::numbers::pi);
  const auto smooth = smooth_facets(arc.facets.list(), arc.x, 2);
  const auto x = gather<Segment>(arc.facets.list()[0], arc.x);
  for (const double angle : {0.02, 0.15, 0.3})
  {
    const Vector<2> way{std::cos(angle), std::sin(angle)};
    const Vector<2> point = 1.1 * way;
    const auto at = smooth_projection<Segment>(x, x, smooth[0], point, {0.5});
    // The patch has the circle's normals, about whose centre all is round
    EXPECT_LT(norm(at.normal - way), 1e-3);
    const auto foot = combine<Segment>(Segment::shape(at.xi), x);
    EXPECT_NEAR(dot(at.normal, point - foot) - at.rise, 0.1, 1e-4);
    const auto d = point - foot;
    EXPECT_NEAR(d[0] * at.normal[1] - d[1] * at.normal[0], 0, 1e-13);
  }
}
