// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#include "expect.h"
#include "generator.h"
#include <contactx/mesh/hull.h>

using namespace contactx;
using contactx::mesh::Hull;
using contactx::tests::Generator;

namespace
{
using Points = std::vector<Vector<3>>;

std::vector<double> flat(const Points& points, int gdim)
{
  std::vector<double> x;
  for (const Vector<3>& p : points)
    x.insert(x.end(), p.begin(), p.begin() + gdim);
  return x;
}

bool contains(const Points& cell, const Vector<3>& point, int gdim)
{
  std::vector<std::int32_t> nodes(cell.size());
  std::iota(nodes.begin(), nodes.end(), 0);
  const std::vector<double> x = flat(cell, gdim);
  Hull hull(static_cast<int>(cell.size()), gdim);
  return hull.contains(std::span(point).first(gdim), nodes, x, 1e-8);
}

/// Corners of the unit square or cube, of the simplex, or of the prism.
Points box(int gdim)
{
  Points corners;
  for (int i = 0; i < 1 << gdim; ++i)
    corners.push_back({double(i & 1), double(i >> 1 & 1), double(i >> 2)});
  return corners;
}

Points simplex(int gdim)
{
  Points corners(gdim + 1, Vector<3>{});
  for (int k = 0; k < gdim; ++k)
    corners[k + 1][k] = 1;
  return corners;
}

Points prism()
{
  const Points b = box(3);
  return {b[0], b[1], b[2], b[4], b[5], b[6]};
}

/// By half-spaces: whether no plane through vertices has all of them on one
/// side and the point on the other; the distance that decides, too.
std::pair<bool, double> by_planes(const Points& cell, const Vector<3>& p,
                                  int gdim)
{
  bool is_in = true;
  double least = INFINITY;
  const int n = static_cast<int>(cell.size());
  for (int a = 0; a < n; ++a)
    for (int b = a + 1; b < n; ++b)
      for (int c = gdim == 3 ? b + 1 : b; c < (gdim == 3 ? n : b + 1); ++c)
      {
        const Vector<3> t = cell[b] - cell[a];
        Vector<3> m = gdim == 3 ? cross(t, cell[c] - cell[a])
                                : Vector<3>{t[1], -t[0], 0};
        m = (1 / norm(m)) * m;
        double low = 0, high = 0;
        for (const Vector<3>& q : cell)
        {
          low = std::min(low, dot(m, q - cell[a]));
          high = std::max(high, dot(m, q - cell[a]));
        }
        const double at = dot(m, p - cell[a]);
        if (high < 1e-12)
        {
          is_in = is_in and at <= 0;
          least = std::min(least, std::abs(at));
        }
        if (low > -1e-12)
        {
          is_in = is_in and at >= 0;
          least = std::min(least, std::abs(at));
        }
      }
  return {is_in, least};
}
} // namespace

TEST(Hull, AffineCells)
{
  // Flat and tiny cells in any direction; points on corners, edges and faces
  // are inside
  for (int gdim : {2, 3})
    for (bool is_simplex : {false, true})
      for (double thinnest : {0.0, -3.0, -6.0})
      {
        Generator random(1);
        const Points cell = is_simplex ? simplex(gdim) : box(gdim);
        int outside = 0;
        for (int i = 0; i < 400; ++i)
        {
          const double size = std::pow(10.0, random(-12, 6));
          std::array<Vector<3>, 3> axes{};
          for (int k = 0; k < gdim; ++k)
          {
            const double thin = size * std::pow(10.0, random(thinnest, 0));
            for (int j = 0; j < gdim; ++j)
              axes[k][j] = thin * random(-1, 1);
          }
          Vector<3> xi = random.vector<3>(-0.5, 1.5);
          if (i < 100)
            xi = cell[i % cell.size()];
          else if (i < 200)
            xi = 0.5 * (cell[0] + cell[1]);
          const auto map = [&](const Vector<3>& at)
          {
            Vector<3> p{};
            for (int k = 0; k < gdim; ++k)
              p = p + at[k] * axes[k] + 1.7 * axes[k];
            return p;
          };
          double excess = -INFINITY, sum = 0;
          for (int k = 0; k < gdim; ++k)
          {
            excess = std::max({excess, -xi[k], is_simplex ? -1 : xi[k] - 1});
            sum += xi[k];
          }
          if (is_simplex)
            excess = std::max(excess, sum - 1);
          Points moved;
          for (const Vector<3>& corner : cell)
            moved.push_back(map(corner));
          const bool found = contains(moved, map(xi), gdim);
          if (std::abs(excess) > 1e-6 or excess <= 0)
          {
            EXPECT_EQ(found, excess <= 0) << gdim << " " << i;
          }
          outside += not found;
        }
        EXPECT_GT(outside, 40);
      }
}

TEST(Hull, WarpedCellsAgainstHalfSpaces)
{
  Generator random(2);
  for (const auto& [cell, gdim] :
       {std::pair(box(2), 2), std::pair(box(3), 3), std::pair(prism(), 3)})
  {
    int inside = 0, outside = 0;
    for (int i = 0; i < 3000; ++i)
    {
      Points corners = cell;
      for (Vector<3>& c : corners)
        for (int k = 0; k < gdim; ++k)
          c[k] += random(-0.3, 0.3);
      Vector<3> point{};
      for (int k = 0; k < gdim; ++k)
        point[k] = random(-0.3, 1.3);
      const auto [expected, distance] = by_planes(corners, point, gdim);
      if (distance < 1e-6)
        continue;
      EXPECT_EQ(contains(corners, point, gdim), expected) << i;
      ++(expected ? inside : outside);
    }
    EXPECT_GT(inside, 300);
    EXPECT_GT(outside, 500);
  }
}

TEST(Hull, WhatIsFlatHoldsNothing)
{
  const Points flat_cell{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 0}};
  EXPECT_FALSE(contains(flat_cell, {0.5, 0.5, 0.1}, 3));
  EXPECT_REFUSED(Hull(3, 3));
  EXPECT_REFUSED(Hull(4, 4));
}
