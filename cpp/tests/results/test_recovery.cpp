// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#include "slave_sheet.h"
#include <contactx/results/recovery.h>

using namespace contactx;
using namespace contactx::contact;
using namespace contactx::tests;

namespace
{
using Values = std::vector<double>;

/// A random slave surface and the state of its nodes, which are all of the
/// nodes.
struct State
{
  Scene scene;
  Values normal, area;
  std::vector<std::int8_t> closed;

  State(Facets facets, Generator& random, int n = 8, bool curved = true,
        double part = 0.7, double uneven = 0.25)
      : scene(slave_sheet(facets, n, random, curved, uneven)),
        normal(sheet_normals(scene, curved)),
        area(geometry::nodal_areas(scene.facets(), scene.x, scene.gdim))
  {
    for (double& a : area)
    {
      closed.push_back(random(0, 1) < part);
      // A third of the nodes are covered in part
      if (random(0, 1) < 0.3)
        a *= random(0.05, 1);
    }
  }

  int gdim() const { return scene.gdim; }
  std::size_t size() const { return area.size(); }

  results::Recovery recovery() const
  {
    return results::Recovery(slave_nodes(scene), scene.x, scene.gdim);
  }

  /// Random pressures on closed nodes.
  Values pressures(Generator& random, int power = 1) const
  {
    Values p;
    for (std::int8_t c : closed)
      p.push_back(c ? std::pow(random(0, 1), power) : 0);
    return p;
  }

  /// Random vectors along the surface, of these sizes.
  Values along(const Values& sizes, Generator& random) const
  {
    Values t;
    for (std::size_t i = 0; i < size(); ++i)
    {
      const Vector<3> n = vector(normal, i);
      Vector<3> v;
      do
      {
        v = random.vector<3>(-1, 1);
        for (int k = gdim(); k < 3; ++k)
          v[k] = 0;
        v = v - dot(v, n) * n;
      } while (norm(v) < 0.1);
      v = (sizes[i] / norm(v)) * v;
      t.insert(t.end(), v.begin(), v.begin() + gdim());
    }
    return t;
  }

  Vector<3> vector(const Values& values, std::size_t i) const
  {
    return vector_at(values, i, gdim());
  }

  /// Tractions of pressures and of what is along the surface.
  Values pressed(const Values& p, Values t) const
  {
    for (std::size_t i = 0; i < t.size(); ++i)
      t[i] += p[i / gdim()] * normal[i];
    return t;
  }

  results::Recovered recovered(const Values& lambda) const
  {
    return recovery().tractions(lambda, normal, area, closed);
  }
};

double product(const Values& a, const Values& b)
{
  return std::inner_product(a.begin(), a.end(), b.begin(), 0.0);
}

/// Tractions along the surface as recovered under a pressure that is uniform.
Values shear(const State& s, const Values& t)
{
  Values lambda = t;
  for (std::size_t i = 0; i < t.size(); ++i)
    if (s.closed[i / s.gdim()])
      lambda[i] += s.normal[i];
  const results::Recovered found = s.recovered(lambda);
  Values result = found.traction;
  for (std::size_t i = 0; i < t.size(); ++i)
    result[i] -= found.pressure[i / s.gdim()] * s.normal[i];
  return result;
}

/// Values of the multipliers for a pressure that is linear between nodes: its
/// forces over the areas.
Values multipliers(const State& s, const Values& p)
{
  const auto facets = s.scene.facets();
  Values forces(s.size(), 0);
  for (std::int32_t f = 0; f < facets.size(); ++f)
  {
    const auto nodes = facets[f];
    const std::vector<std::int32_t> ends{
        0, static_cast<std::int32_t>(nodes.size())};
    const Values parts
        = geometry::nodal_areas({ends, nodes}, s.scene.x, s.gdim());
    const double area = std::accumulate(parts.begin(), parts.end(), 0.0);
    for (std::size_t i = 0; i < nodes.size(); ++i)
      for (std::size_t j = 0; j < nodes.size(); ++j)
      {
        // Simplices, and the squares whose corners are in rows
        double product = nodes.size() == 2   ? 1. / 6
                         : nodes.size() == 3 ? 1. / 12
                         : i + j == 3        ? 1. / 36
                                             : 1. / 18;
        if (i == j)
          product = nodes.size() == 4 ? 1. / 9 : 2 * product;
        forces[nodes[i]] += area * product * p[nodes[j]];
      }
  }
  for (std::size_t i = 0; i < s.size(); ++i)
    forces[i] /= s.area[i];
  return forces;
}

/// Two passes as dense matrices, from the formulas of recovery.h without a
/// slope.
Values dense(const State& s, Values p)
{
  const std::size_t n = s.size();
  const auto facets = s.scene.facets();
  std::vector<Values> m(n, Values(n, 0));
  Values whole(n, 0), open(n, 0);
  for (std::int32_t f = 0; f < facets.size(); ++f)
  {
    const std::vector<std::int32_t> ends{
        0, static_cast<std::int32_t>(facets[f].size())};
    const Values parts
        = geometry::nodal_areas({ends, facets[f]}, s.scene.x, s.gdim());
    const double area = std::accumulate(parts.begin(), parts.end(), 0.0);
    for (std::int32_t i : facets[f])
    {
      whole[i] += parts[i];
      for (std::int32_t j : facets[f])
        if (i != j)
        {
          m[i][j] += parts[i] * parts[j] / area;
          open[i] += s.closed[j] ? 0 : parts[i] * parts[j] / area;
        }
    }
  }
  for (int pass = 0; pass < 2; ++pass)
  {
    Values next = p;
    for (std::size_t i = 0; i < n; ++i)
      for (std::size_t j = 0; j < n; ++j)
        if (s.closed[i] and s.closed[j] and m[i][j] > 0)
        {
          const double a = 1 - open[i] / whole[i], b = 1 - open[j] / whole[j];
          const double r = std::min(a / b, b / a);
          const double covered
              = std::min(s.area[i] / whole[i], s.area[j] / whole[j]);
          next[i] += m[i][j] * r * r * covered / s.area[i] * (p[j] - p[i]);
        }
    p = next;
  }
  return p;
}
} // namespace

TEST(Recovery, IsWhatItsFormulasSay)
{
  Generator random(1);
  for (Facets kind : all_facets)
  {
    const State s(kind, random);
    Values p = s.pressures(random);
    // Tension, as of ties, has no edges that it rises to
    for (double& value : p)
      value *= -1;
    expect_near(s.recovery().pressure(p, s.area, s.closed), dense(s, p), 1e-14);
    // A uniform pressure stays
    for (std::size_t i = 0; i < p.size(); ++i)
      p[i] = s.closed[i] ? 2.5 : 0;
    expect_near(s.recovery().pressure(p, s.area, s.closed), p, 1e-13);
  }
}

TEST(Recovery, AUniformTractionStays)
{
  Generator random(3);
  for (Facets kind : all_facets)
  {
    const State s(kind, random, 8, false);
    const Vector<3> traction = random.vector<3>(-1, 1);
    Values lambda;
    for (std::int8_t c : s.closed)
      for (int k = 0; k < s.gdim(); ++k)
        lambda.push_back(c ? traction[k] : 0);
    expect_near(s.recovered(lambda).traction, lambda, 1e-14);
  }
}

TEST(Recovery, ForceSignsAndOpenNodesStay)
{
  Generator random(4);
  for (Facets kind : all_facets)
    for (int again = 0; again < 5; ++again)
    {
      const State s(kind, random);
      const Values p = s.pressures(random, 4);
      const Values q = s.recovery().pressure(p, s.area, s.closed);
      EXPECT_NEAR(product(s.area, q), product(s.area, p),
                  1e-13 * product(s.area, p));
      double change = 0;
      for (std::size_t i = 0; i < q.size(); ++i)
      {
        EXPECT_TRUE(s.closed[i] ? q[i] > 0 : q[i] == 0);
        change = std::max(change, std::abs(q[i] - p[i]));
      }
      // Least where the largest one is at an edge
      EXPECT_GT(change, 0.01 * std::ranges::max(p));
    }
}

TEST(Recovery, TheFrictionConeIsKept)
{
  Generator random(5);
  const double mu = 0.3;
  for (Facets kind : all_facets)
  {
    const State s(kind, random);
    const Values p = s.pressures(random);
    Values sizes;
    // Nodes slip and stick by turns
    for (double q : p)
      sizes.push_back(mu * q * (random(0, 1) < 0.5 ? 1 : random(0, 1)));
    const results::Recovered found
        = s.recovered(s.pressed(p, s.along(sizes, random)));
    for (std::size_t i = 0; i < s.size(); ++i)
    {
      const Vector<3> n = s.vector(s.normal, i);
      const Vector<3> v = s.vector(found.traction, i) - found.pressure[i] * n;
      EXPECT_LE(norm(v), mu * found.pressure[i] * (1 + 1e-12));
      EXPECT_NEAR(dot(v, n), 0, 1e-15);
      if (not s.closed[i])
      {
        EXPECT_EQ(norm(v), 0);
      }
    }
  }
}

TEST(Recovery, ShearKeepsItsSizeWhereTheSurfaceIsCurved)
{
  // In a plane of bending it turns with the normal: its size along the arc is
  // that of a line
  Generator random(6);
  for (Facets kind : {Facets(), Facets(Cells::triangles)})
  {
    State s(kind, random);
    const int last = s.gdim() - 1;
    Values along(s.normal.size(), 0), sizes, t(s.normal.size());
    for (std::size_t i = 0; i < s.size(); ++i)
    {
      Vector<3> n = s.vector(s.normal, i);
      if (s.gdim() == 3)
        n[1] = 0;
      n = (1 / norm(n)) * n;
      std::copy_n(n.begin(), s.gdim(), s.normal.begin() + i * s.gdim());
      along[i * s.gdim()] = -n[last];
      along[i * s.gdim() + last] = n[0];
      sizes.push_back(s.closed[i] ? random(-1, 0) : 0);
    }
    const auto times = [&](const Values& factors)
    {
      Values v = along;
      for (std::size_t i = 0; i < v.size(); ++i)
        v[i] *= factors[i / s.gdim()];
      return v;
    };
    expect_near(shear(s, times(sizes)),
                times(s.recovery().pressure(sizes, s.area, s.closed)), 1e-14);
  }
}

namespace
{
template <int D>
void expect_no_change_by_a_motion(Facets kind, Generator& random)
{
  const State s(kind, random);
  const Motion<D> motion(random, 1);
  const auto moved = [&motion](const Values& values, bool is_place)
  {
    Values result;
    for (std::size_t i = 0; i < values.size(); i += D)
    {
      auto v = row<D>(values, i / D);
      v = is_place ? motion(v) : motion.rotate(v);
      result.insert(result.end(), v.begin(), v.end());
    }
    return result;
  };
  const Values p = s.pressures(random);
  const Values lambda = s.pressed(p, s.along(p, random));
  const results::Recovered found = s.recovered(lambda);
  const results::Recovery there(slave_nodes(s.scene), moved(s.scene.x, true),
                                D);
  const results::Recovered turned = there.tractions(
      moved(lambda, false), moved(s.normal, false), s.area, s.closed);
  expect_near(turned.pressure, found.pressure, 1e-11);
  expect_near(turned.traction, moved(found.traction, false), 1e-11);
}
} // namespace

TEST(Recovery, RigidMotionsChangeNothing)
{
  Generator random(7);
  expect_no_change_by_a_motion<2>(std::nullopt, random);
  expect_no_change_by_a_motion<3>(Cells::mixed, random);
  expect_no_change_by_a_motion<3>(Cells::triangles, random);
}

TEST(Recovery, AlternatingScatterGoesAndALinearPressureStays)
{
  Generator random(8);
  const int n = 11;
  for (Facets kind : {Facets(), Facets(Cells::quadrilaterals)})
  {
    const State s(kind, random, n, false, 1.1, 0);
    const Values whole
        = geometry::nodal_areas(s.scene.facets(), s.scene.x, s.gdim());
    Values linear, p;
    std::vector<bool> inside;
    for (std::size_t i = 0; i < s.size(); ++i)
    {
      Vector<3> x = n * s.scene.point(static_cast<std::int32_t>(i));
      const int sum = static_cast<int>(std::lround(x[0] + x[1]));
      linear.push_back(3 + 0.2 * x[0] - 0.1 * x[1]);
      p.push_back(linear.back() + (sum % 2 ? 1 : -1));
      const auto is_inside = [](double c) { return c > 2.5 and c < 8.5; };
      inside.push_back(is_inside(x[0]) and (s.gdim() == 2 or is_inside(x[1])));
    }
    const Values q = s.recovery().pressure(p, whole, s.closed);
    for (std::size_t i = 0; i < s.size(); ++i)
      if (inside[i])
      {
        EXPECT_NEAR(q[i], linear[i], 1e-12);
      }
  }
}

TEST(Recovery, ALinearPressureStaysAtTheEdgeThatItRisesTo)
{
  Generator random(14);
  const int n = 12;
  for (Facets kind : all_facets)
  {
    // Segments of any length, but affine quadrilaterals
    State s(kind, random, n, false, 1.1, kind ? 0 : 0.25);
    s.area = geometry::nodal_areas(s.scene.facets(), s.scene.x, s.gdim());
    Values p;
    for (std::size_t i = 0; i < s.size(); ++i)
      p.push_back(1 + s.scene.point(static_cast<std::int32_t>(i))[0]);
    const Values raw = multipliers(s, p);
    const Values q = s.recovery().pressure(raw, s.area, s.closed);
    EXPECT_NEAR(product(s.area, q), product(s.area, raw), 1e-14);
    const double width = 1. / n;
    int at_edge = 0;
    for (std::size_t i = 0; i < s.size(); ++i)
    {
      const auto x = s.scene.point(static_cast<std::int32_t>(i));
      if (x[0] > 1 - 2.5 * width)
      {
        EXPECT_NEAR(q[i], p[i], 1e-12);
      }
      if (x[0] > 1 - 0.5 * width)
      {
        ++at_edge;
        EXPECT_GT(p[i] - raw[i], 0.15 * width);
      }
    }
    EXPECT_EQ(at_edge, kind ? n + 1 : 1);
  }
}

TEST(Recovery, APressureRisesToWhereTheContactEndsOnTheSurface)
{
  // Pressed by what ends with facets, in the middle of a line
  Generator random(15);
  const int n = 20, first = 4, last = 12;
  State s(std::nullopt, random, n, false, 1.1, 0);
  Values exact(n + 1, 0), raw(n + 1, 0);
  for (int i = 0; i <= n; ++i)
  {
    s.closed[i] = first <= i and i <= last;
    exact[i] = 1 + s.scene.point(i)[0];
    if (s.closed[i])
      raw[i] = exact[i];
    s.area[i] = 1. / n;
  }
  // Half of the facets around the last nodes is covered
  for (int i : {first, last})
  {
    raw[i] += (i == first ? 1. : -1.) / (3 * n);
    s.area[i] /= 2;
  }
  const Values q = s.recovery().pressure(raw, s.area, s.closed);
  EXPECT_NEAR(product(s.area, q), product(s.area, raw), 1e-14);
  EXPECT_GT(q[last], raw[last]);
  EXPECT_NEAR(q[last], exact[last], 0.3 / n);
}

TEST(Recovery, APeakAtAnEdgeIsNotBelowItsMultipliers)
{
  // As at the corner of a punch, and as in a joint of which few rows are closed
  for (int rows : {2, 3, 8})
  {
    Generator random(16);
    State s(std::nullopt, random, 10, false, 1.1, 0);
    Values raw(s.size(), 0);
    for (int i = 0; i < std::ssize(raw); ++i)
    {
      s.closed[i] = 10 - i < rows;
      if (s.closed[i])
        raw[i] = 1 / std::sqrt(10 - i + 1. / 3);
    }
    s.area = geometry::nodal_areas(s.scene.facets(), s.scene.x, 2);
    const Values q = s.recovery().pressure(raw, s.area, s.closed);
    EXPECT_GE(q[10], raw[10]);
    EXPECT_LE(q[10], 1.5 * raw[10]);
    EXPECT_GT(q[11 - rows], 0);
    EXPECT_NEAR(product(s.area, q), product(s.area, raw), 1e-14);
  }
}

TEST(Recovery, APlaneOfSymmetryIsNoEdge)
{
  // A half of a pressure that is even: its mirror image gives the same
  Generator random(17);
  const State whole(std::nullopt, random, 16, false, 1.1, 0);
  const State half(std::nullopt, random, 8, false, 1.1, 0);
  const auto recovered = [](const State& s, double middle, double size)
  {
    Values p;
    for (std::size_t i = 0; i < s.size(); ++i)
    {
      const double x
          = size * (s.scene.point(static_cast<std::int32_t>(i))[0] - middle);
      p.push_back(2 - x * x);
    }
    const Values area
        = geometry::nodal_areas(s.scene.facets(), s.scene.x, s.gdim());
    State exact = s;
    exact.area = area;
    return s.recovery().pressure(multipliers(exact, p), area, s.closed);
  };
  const Values all = recovered(whole, 0.5, 2), part = recovered(half, 0, 1);
  // A line from the two rows at the plane would be 0.03 higher
  for (int i = 0; i < 4; ++i)
    EXPECT_NEAR(part[i], all[8 + i], 0.012);
  EXPECT_LT(std::abs(part[0] - 2), std::abs(all[8] - 2));
}

TEST(Recovery, NormalsThatOpposeEachOtherDoNoHarm)
{
  Generator random(9);
  State s(std::nullopt, random, 2, false, 1.1);
  s.normal[3] *= -1;
  const Values t{1, 0, 0.5, 0, -1, 0};
  const Values u = shear(s, t);
  for (std::size_t i = 0; i < 3; ++i)
  {
    EXPECT_LE(std::abs(u[2 * i]), 1);
    EXPECT_EQ(u[2 * i + 1], 0);
  }
}

TEST(Recovery, TractionsArePressureAndShear)
{
  Generator random(10);
  for (Facets kind : all_facets)
  {
    const State s(kind, random, 8, false);
    const Values p = s.pressures(random), t = s.along(p, random);
    const results::Recovered found = s.recovered(s.pressed(p, t));
    const Values q = s.recovery().pressure(p, s.area, s.closed);
    expect_near(found.pressure, q, 1e-14);
    // The sum of the forces along a plane stays
    const Values along = s.pressed(q, Values(t.size(), 0));
    for (int k = 0; k < s.gdim(); ++k)
    {
      double before = 0, after = 0;
      for (std::size_t i = 0; i < s.size(); ++i)
      {
        const std::size_t at = i * s.gdim() + k;
        before += s.area[i] * t[at];
        after += s.area[i] * (found.traction[at] - along[at]);
      }
      EXPECT_NEAR(after, before, 1e-14);
    }
  }
}

TEST(Recovery, OtherNodesOfTheBulkChangeNothing)
{
  Generator random(11);
  const State s(Cells::mixed, random);
  const Values p = s.pressures(random);
  const Scene bulk = in_bulk(s.scene, random).first;
  const results::Recovery there(slave_nodes(bulk), bulk.x, 3);
  EXPECT_EQ(there.pressure(p, s.area, s.closed),
            s.recovery().pressure(p, s.area, s.closed));
}

TEST(Recovery, IsTheSameOnRanks)
{
  Generator random(12);
  for (Facets kind : all_facets)
    for (int size : {2, 3})
    {
      const State s(kind, random);
      const int gdim = s.gdim();
      const Values p = s.pressures(random);
      const Values lambda = s.pressed(p, s.along(p, random));
      const results::Recovered found = s.recovered(lambda);
      mesh::OneRank alone;
      const double change
          = results::recovery_change(alone, lambda, found.traction, gdim);
      std::vector<int> owner(s.size());
      for (int& r : owner)
        r = static_cast<int>(random(0, size));
      on_ranks(
          size,
          [&](mesh::Ranks& rank)
          {
            const Part part = part_of(s.scene, owner, rank);
            const results::Recovery recovery(part.slaves, part.scene.x, gdim);
            const results::Recovered mine = recovery.tractions(
                part.take(lambda, gdim), part.take(s.normal, gdim),
                part.take(s.area), part.take(s.closed));
            expect_near(mine.pressure, part.take(found.pressure), 1e-14);
            expect_near(mine.traction, part.take(found.traction, gdim), 1e-14);
            EXPECT_NEAR(results::recovery_change(rank, part.take(lambda, gdim),
                                                 mine.traction, gdim),
                        change, 1e-14);
          });
    }
}

TEST(RecoveryChange, IsThatOfTheForceOverTheSumOfTheNodes)
{
  mesh::OneRank alone;
  // Sizes 5 and 10; the sum changes by (3, 4)
  const Values before{3, 4, -6, -8}, after{4, 4, -4, -4};
  EXPECT_NEAR(results::recovery_change(alone, before, after, 2), 5. / 15,
              1e-15);
  EXPECT_EQ(results::recovery_change(alone, before, before, 2), 0);
  const Values none(4, 0);
  EXPECT_EQ(results::recovery_change(alone, none, none, 2), 0);
  EXPECT_REFUSED(results::recovery_change(alone, before, Values(2), 2));
}

TEST(Recovery, RefusesWhatDoesNotFit)
{
  Generator random(13);
  const State s(Cells::triangles, random, 2);
  const results::Recovery recovery = s.recovery();
  const Values few(2);
  EXPECT_REFUSED(recovery.pressure(few, s.area, s.closed));
  EXPECT_REFUSED(recovery.pressure(s.area, few, s.closed));
  EXPECT_REFUSED(recovery.tractions(s.normal, few, s.area, s.closed));
  EXPECT_REFUSED(results::Recovery(slave_nodes(s.scene), few, 3));
  EXPECT_REFUSED(results::Recovery(slave_nodes(s.scene), s.scene.x, 4));
  EXPECT_REFUSED(results::Recovery(nullptr, s.scene.x, 3));
}
