// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#include "deformed_reference.h"
#include "expect.h"
#include <contactx/mesh/deformed_cells.h>

using namespace contactx;
using namespace contactx::mesh;
using namespace contactx::tests;

namespace
{

template <class>
using DeformedCellsOf = testing::Test;
using CellTypes = testing::Types<Simplex<2>, Cube<2>, Simplex<3>, Cube<3>>;
TYPED_TEST_SUITE(DeformedCellsOf, CellTypes);

template <class C>
mesh::DeformedCells look(const SampledCells<C>& cells)
{
  return mesh::deformed_cells(cells.nodes(), C::nodes, cells.X, cells.u,
                              C::gdim);
}

/// Many cells that are somewhat out of shape and stand anywhere, every other
/// one numbered the other way round.
/// @param[in] displacement Called as displacement(X, node).
template <class C, class Displacement>
SampledCells<C> scattered(Generator& random, int count,
                          Displacement displacement)
{
  SampledCells<C> cells;
  for (int c = 0; c < count; ++c)
  {
    const Motion<C::gdim> motion(random, 3);
    const double side = c % 2 ? 1 : -1;
    cells.add(
        [&](Vector<C::gdim> v)
        {
          v[0] *= side;
          return motion(v + random.vector<C::gdim>(-0.1, 0.1));
        },
        displacement);
  }
  return cells;
}

template <int D>
Matrix<D> random_matrix(Generator& random)
{
  Matrix<D> a;
  for (auto& row : a)
    row = random.vector<D>(-1, 1);
  return a;
}

TYPED_TEST_OF(DeformedCellsOf, RigidMotionsAndNone, C)
{
  const std::vector<double> x(C::gdim, 0);
  const auto empty = mesh::deformed_cells({}, C::nodes, x, x, C::gdim);
  EXPECT_EQ(empty.smallest, infinity);
  EXPECT_EQ(empty.cell, -1);
  EXPECT_EQ(empty.inverted, 0);
  Generator random(2);
  const auto still = look(scattered<C>(random, 20, [](const auto&, int)
                                       { return Vector<C::gdim>{}; }));
  EXPECT_EQ(still.smallest, 1);
  EXPECT_EQ(still.cell, 0);
  EXPECT_EQ(still.inverted, 0);
  for (int i = 0; i < 50; ++i)
  {
    const Motion<C::gdim> motion(random, 5);
    const auto found = look(scattered<C>(
        random, 10, [&motion](const auto& X, int) { return motion(X) - X; }));
    EXPECT_NEAR(found.smallest, 1, 1e-12);
    EXPECT_EQ(found.inverted, 0);
  }
}

TYPED_TEST_OF(DeformedCellsOf, MirrorsAndWhatIsFlatOrAPoint, C)
{
  Generator random(4);
  const auto point = look(
      scattered<C>(random, 10, [](const auto& X, int) { return -1. * X; }));
  EXPECT_EQ(point.smallest, 0);
  EXPECT_EQ(point.inverted, 10);
  for (int axis = 0; axis < C::gdim; ++axis)
    for (const double left : {-1., -0.25, 0.})
    {
      const auto found = look(scattered<C>(random, 10,
                                           [axis, left](const auto& X, int)
                                           {
                                             Vector<C::gdim> u{};
                                             u[axis] = (left - 1) * X[axis];
                                             return u;
                                           }));
      EXPECT_NEAR(found.smallest, left, 1e-13);
      if (left < 0)
      {
        EXPECT_EQ(found.inverted, 10);
      }
    }
}

TYPED_TEST_OF(DeformedCellsOf, HomogeneousGradients, C)
{
  Generator random(6);
  int inverted = 0;
  for (int i = 0; i < 100; ++i)
  {
    const auto F = random_matrix<C::gdim>(random);
    const auto found = look(scattered<C>(random, 5, [&F](const auto& X, int)
                                         { return times<C::gdim>(F, X) - X; }));
    EXPECT_NEAR(found.smallest, det(F), 1e-11);
    EXPECT_EQ(found.inverted, det(F) < 0 ? 5 : 0);
    inverted += det(F) < 0;
  }
  EXPECT_GT(inverted, 30);
  EXPECT_LT(inverted, 70);
}

TYPED_TEST_OF(DeformedCellsOf, AgreesWithDenseSamples, C)
{
  Generator random(7);
  int inverted = 0;
  for (int i = 0; i < 400; ++i)
  {
    const double size = random(0.1, 1);
    const auto cells
        = scattered<C>(random, 1, [&random, size](const auto&, int)
                       { return random.vector<C::gdim>(-size, size); });
    const auto found = look(cells);
    // Among them are the points of the audit
    const double sampled = cells.sampled(0, 17);
    if (C::nodes < 8)
    {
      EXPECT_NEAR(found.smallest, sampled, 1e-12 * (1 + std::abs(sampled)));
    }
    EXPECT_GE(found.inverted, sampled <= 0);
    EXPECT_EQ(found.inverted, found.smallest <= 0);
    if (found.inverted and sampled > 0)
    {
      EXPECT_LT(cells.sampled(0, 65), 0.05);
    }
    inverted += found.inverted;
  }
  EXPECT_GT(inverted, 30);
  EXPECT_LT(inverted, 360);
}

TYPED_TEST_OF(DeformedCellsOf, TheWorstOfSeveral, C)
{
  const std::array stretches{0.9, -0.3, 0.5, -0.7, 0.0, -0.2, 2.0};
  SampledCells<C> cells;
  for (const double s : stretches)
    cells.add([](const auto& v) { return v; },
              [s](const auto& X, int)
              {
                Vector<C::gdim> u{};
                u[0] = (s - 1) * X[0];
                return u;
              });
  // More displacements than positions may be there
  cells.u.resize(cells.u.size() + 5 * C::gdim, std::nan(""));
  const auto found = look(cells);
  EXPECT_NEAR(found.smallest, -0.7, 1e-15);
  EXPECT_EQ(found.cell, 3);
  EXPECT_EQ(found.inverted, 4);
}

TYPED_TEST_OF(DeformedCellsOf, ScalesAndTranslations, C)
{
  Generator random(8);
  for (int i = 0; i < 20; ++i)
  {
    const auto cells
        = scattered<C>(random, 3, [&random](const auto&, int)
                       { return random.vector<C::gdim>(-0.4, 0.4); });
    const auto found = look(cells);
    for (const double scale : {0x1p-27, 0x1p27}) // exact
    {
      auto scaled = cells;
      for (auto* values : {&scaled.X, &scaled.u})
        for (double& v : *values)
          v *= scale;
      const auto same = look(scaled);
      EXPECT_EQ(same.smallest, found.smallest);
      EXPECT_EQ(same.cell, found.cell);
      EXPECT_EQ(same.inverted, found.inverted);
    }
    for (const double scale : {1e-8, 1., 1e8})
    {
      auto moved = cells;
      for (double& v : moved.X)
        v = scale * (v + 10);
      for (double& v : moved.u)
        v = scale * (v - 30);
      const auto same = look(moved);
      EXPECT_NEAR(same.smallest, found.smallest, 1e-11);
      EXPECT_EQ(same.cell, found.cell);
      EXPECT_EQ(same.inverted, found.inverted);
    }
  }
}

TYPED_TEST_OF(DeformedCellsOf, SmallDisplacementsFarFromTheOrigin, C)
{
  // Of u = 1e-9 X, X + u would keep seven digits at X = 1000
  SampledCells<C> cells;
  cells.add(
      [](auto v)
      {
        for (double& c : v)
          c += 1024;
        return v;
      },
      [](const auto&, int i) { return 1e-9 * C::vertex(i); });
  EXPECT_NEAR(look(cells).smallest - 1, C::gdim * 1e-9, 1e-15);
}

TYPED_TEST_OF(DeformedCellsOf, NoNumbers, C)
{
  for (const double bad : {std::nan(""), infinity, -infinity})
    for (int at = 0; at < C::nodes * C::gdim; ++at)
    {
      SampledCells<C> cells;
      for (int c = 0; c < 3; ++c)
        cells.add([](const auto& v) { return v; },
                  [](const auto&, int) { return Vector<C::gdim>{}; });
      cells.u[C::nodes * C::gdim + at] = bad;
      const auto found = look(cells);
      EXPECT_EQ(found.inverted, 1);
      EXPECT_EQ(found.cell, 1);
      EXPECT_EQ(found.smallest, -infinity);
    }
}

TYPED_TEST_OF(DeformedCellsOf, ReferenceWithoutVolume, C)
{
  SampledCells<C> cells;
  const auto add = [&cells](double height)
  {
    cells.add(
        [height](auto v)
        {
          v[1] *= height;
          return v;
        },
        [height](const auto& X, int i)
        {
          // What is flat is turned inside out
          auto mirrored = C::vertex(i);
          mirrored[0] *= -1;
          return height == 0 ? mirrored - X : X;
        });
    return look(cells);
  };
  const auto flat = add(0);
  EXPECT_EQ(flat.smallest, infinity);
  EXPECT_EQ(flat.cell, 0);
  EXPECT_EQ(flat.inverted, 0);
  const auto both = add(1);
  EXPECT_EQ(both.smallest, 1 << C::gdim);
  EXPECT_EQ(both.cell, 1);
  EXPECT_EQ(both.inverted, 0);
}

/// A unit cube with displacements in eighths.
SampledCells<Cube<3>> cube(const std::array<int, 24>& eighths)
{
  SampledCells<Cube<3>> cells;
  cells.add([](const auto& v) { return v; },
            [&eighths](const auto&, int i)
            {
              return Vector<3>{eighths[3 * i] / 8., eighths[3 * i + 1] / 8.,
                               eighths[3 * i + 2] / 8.};
            });
  return cells;
}

// det F is 0.9 and more at the corners and -0.95 within
constexpr std::array<int, 24> only_inside{-6, -5, 5,  -5, 6, -5, 4, 3,
                                          -2, 6,  -5, 3,  5, 1,  5, 2,
                                          -3, -4, 2,  -2, 6, 4,  5, 6};

// det F is 0.23 and more at 27 points and -0.1 between them
constexpr std::array<int, 24> only_between{-5, 1, -6, -4, -5, -3, 6,  2,
                                           4,  6, -4, -2, 6,  -1, 6,  -2,
                                           2,  2, -5, -5, 0,  -5, -2, 0};

// det F is 1 and more, and its lowest coefficient -1.7
constexpr std::array<int, 24> sound{0,  -5, -3, 5,  5,  -5, 0, 0, 1, -4, 5,  -5,
                                    -2, 5,  5,  -5, -2, 4,  6, 5, 6, 5,  -6, 0};

TEST(DeformedHexahedron, InvertedOnlyInside)
{
  const auto cells = cube(only_inside);
  EXPECT_GT(cells.sampled(0, 2), 0.9);
  const auto found = look(cells);
  EXPECT_EQ(found.inverted, 1);
  EXPECT_NEAR(found.smallest, cells.sampled(0, 3), 1e-14);
  EXPECT_LT(found.smallest, -0.95);
}

TEST(DeformedHexahedron, InvertedOnlyBetweenThePoints)
{
  const auto cells = cube(only_between);
  EXPECT_GT(cells.sampled(0, 3), 0.23);
  const auto found = look(cells);
  EXPECT_EQ(found.inverted, 1);
  EXPECT_LE(found.smallest, 0);
  EXPECT_GE(found.smallest, cells.sampled(0, 65));
}

TEST(DeformedHexahedron, SoundWithCoefficientsOfBothSigns)
{
  const auto cells = cube(sound);
  const auto found = look(cells);
  EXPECT_EQ(found.inverted, 0);
  EXPECT_LE(found.smallest, cells.sampled(0, 3));
  EXPECT_GE(found.smallest, cells.sampled(0, 65) - 1e-12);
}

TEST(DeformedHexahedron, TellsASmallNegativeValueFromASmallPositiveOne)
{
  // Between the unit cube and the inverted one lies one whose det F touches 0
  const auto part = [](double t)
  {
    auto cells = cube(only_between);
    for (double& v : cells.u)
      v *= t;
    return cells;
  };
  double low = 0, high = 1;
  while (high - low > 1e-12)
  {
    const double t = 0.5 * (low + high);
    (look(part(t)).inverted ? high : low) = t;
  }
  const auto touching = look(part(low));
  EXPECT_GT(touching.smallest, 0);
  EXPECT_LT(touching.smallest, 1e-4);
  EXPECT_LE(look(part(low + 1e-4)).smallest, 0);
  EXPECT_GT(part(low - 1e-4).sampled(0, 65), 0);
}

TEST(DeformedHexahedron, FoldedReferenceIsNotBlamedOnTheDisplacement)
{
  const std::array<int, 24> corner_pushed_in{12, 12, 12};
  for (const auto& shape : {only_inside, only_between, corner_pushed_in})
  {
    auto cells = cube(shape);
    const auto fold = cells.u;
    for (std::size_t i = 0; i < fold.size(); ++i)
      cells.X[i] += fold[i];
    cells.u = cells.X;
    EXPECT_EQ(look(cells).smallest, 8);
    EXPECT_EQ(look(cells).inverted, 0);

    // With less of the fold
    for (std::size_t i = 0; i < fold.size(); ++i)
      cells.u[i] = -0.02 * fold[i];
    EXPECT_NEAR(look(cells).smallest, cells.sampled(0, 3), 1e-14);
    EXPECT_EQ(look(cells).inverted, 0);
  }
}

TEST(DeformedCells, RefusesWhatDoesNotFit)
{
  const std::vector<double> x(8, 0), odd(9, 0), few(6, 0);
  const std::vector<std::int32_t> cell{0, 1, 2}, two{0, 1, 2, 3};
  const auto expect = [](const char* message, auto... given)
  { expect_refusal([&] { mesh::deformed_cells(given...); }, message); };
  using Nodes = std::vector<std::int32_t>;
  EXPECT_EQ(mesh::deformed_cells(cell, 3, x, x, 2).inverted, 0);
  for (const int gdim : {-1, 0, 1, 4})
    expect("gdim must be 2 or 3", cell, 3, x, x, gdim);
  for (const int nodes : {-3, 0, 2, 5, 8})
    expect("3 or 4 nodes in 2D", cell, nodes, x, x, 2);
  for (const int nodes : {3, 5, 6, 27})
    expect("4 or 8 in 3D", cell, nodes, few, few, 3);
  expect("cells must have 3 nodes each: there are 4", two, 3, x, x, 2);
  expect("X must have 2 coordinates", cell, 3, odd, odd, 2);
  expect("u must have 2 components for each of 4 nodes", cell, 3, x, few, 2);
  expect("u must have 2 components for each of 4 nodes", cell, 3, x, odd, 2);
  expect("of which there are 4: there is 4", Nodes{0, 1, 4}, 3, x, x, 2);
  expect("of which there are 4: there is -1", Nodes{0, -1, 2}, 3, x, x, 2);
  expect("of which there are 0: there is 0", cell, 3, std::vector<double>{}, x,
         2);
}
} // namespace
