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
constexpr double least_part = 0.2;

template <class>
using LongestWay = testing::Test;
using CellTypes = testing::Types<Simplex<2>, Cube<2>, Simplex<3>, Cube<3>>;
TYPED_TEST_SUITE(LongestWay, CellTypes);

/// A cell that is somewhat out of shape, numbered either way round.
template <class C>
SampledCells<C> some_cell(Generator& random, double strain, double side)
{
  SampledCells<C> cells;
  cells.add(
      [&](Vector<C::gdim> v)
      {
        v[0] *= side;
        return v + random.vector<C::gdim>(-0.1, 0.1);
      },
      [&](const auto&, int)
      { return random.vector<C::gdim>(-strain, strain); });
  return cells;
}

/// Points at which det F is looked at.
template <class C>
std::vector<Vector<C::gdim>> points()
{
  constexpr int D = C::gdim;
  if (C::nodes == D + 1)
    return {Vector<D>{}};
  // Corners in the plane, in space also the middles
  const int n = D == 2 ? 2 : 3;
  std::vector<Vector<D>> all;
  for (int i = 0; i < std::pow(n, D); ++i)
  {
    Vector<D> xi;
    for (int k = 0, j = i; k < D; ++k, j /= n)
      xi[k] = (j % n) / double(n - 1);
    all.push_back(xi);
  }
  return all;
}

/// Least of det F(t) less its bound, over the points of all cells.
template <class C>
double least(const SampledCells<C>& cells, const std::vector<double>& way,
             double t)
{
  SampledCells<C> moved = cells;
  for (std::size_t i = 0; i < way.size(); ++i)
    moved.u[i] += t * way[i];
  double least = infinity;
  for (int c = 0; c < static_cast<int>(cells.X.size()) / C::gdim / C::nodes;
       ++c)
    for (const auto& xi : points<C>())
    {
      const double begin = cells.det_F(c, xi);
      if (begin > 0)
        least = std::min(least, moved.det_F(c, xi)
                                    - least_part * std::min(begin, 1.0));
    }
  return least;
}

template <class C>
double longest(const SampledCells<C>& cells, const std::vector<double>& way)
{
  return mesh::max_step_without_inversion(cells.nodes(), C::nodes, cells.X,
                                          cells.u, way, C::gdim, least_part);
}

TYPED_TEST_OF(LongestWay, EndsWhereACellIsSqueezedTooMuch, C)
{
  Generator random(1);
  int limited = 0;
  for (int i = 0; i < 300; ++i)
  {
    const auto cells = some_cell<C>(random, 0.1, i % 2 ? 1 : -1);
    std::vector<double> way(cells.u.size());
    const double size = random(0.1, 2);
    for (double& w : way)
      w = random(-size, size);
    const double t = longest(cells, way);
    ASSERT_GT(t, 0);
    ASSERT_LE(t, 1);
    for (int k = 0; k <= 100; ++k)
      EXPECT_GE(least(cells, way, k * t / 100), -1e-12);
    if (t < 1)
    {
      ++limited;
      double beyond = 1;
      for (int k = 0; k <= 100; ++k)
        beyond = std::min(beyond, least(cells, way, t * (1 + k / 100. / 1023)));
      // It may come as close as that and turn back
      EXPECT_LT(beyond, 1e-5);
    }
  }
  EXPECT_GT(limited, 50);
  EXPECT_LT(limited, 290);
}

TYPED_TEST_OF(LongestWay, IsWholeWhereNothingIsSqueezed, C)
{
  Generator random(2);
  const auto cells = some_cell<C>(random, 0.1, 1);
  std::vector<double> way(cells.u.size());
  EXPECT_EQ(longest(cells, way), 1);
  // A translation, however long
  for (std::size_t i = 0; i < way.size(); ++i)
    way[i] = 1e3 * (1 + i % C::gdim);
  EXPECT_EQ(longest(cells, way), 1);
  // It grows
  for (std::size_t i = 0; i < way.size(); ++i)
    way[i] = 10 * (cells.X[i] + cells.u[i]);
  EXPECT_EQ(longest(cells, way), 1);
}

TYPED_TEST_OF(LongestWay, IsThatOfTheWorstCell, C)
{
  Generator random(3);
  SampledCells<C> both = some_cell<C>(random, 0.1, 1);
  const SampledCells<C> other = some_cell<C>(random, 0.1, 1);
  std::vector<double> shrunk(both.u.size()), more(both.u.size());
  for (std::size_t i = 0; i < shrunk.size(); ++i)
  {
    shrunk[i] = -0.9 * (both.X[i] + both.u[i]);
    more[i] = -1.8 * (other.X[i] + other.u[i]);
  }
  const double one = longest(both, shrunk), two = longest(other, more);
  both.X.insert(both.X.end(), other.X.begin(), other.X.end());
  both.u.insert(both.u.end(), other.u.begin(), other.u.end());
  shrunk.insert(shrunk.end(), more.begin(), more.end());
  EXPECT_LT(two, one);
  EXPECT_NEAR(longest(both, shrunk), two, 1e-3);
}

TYPED_TEST_OF(LongestWay, LeavesOutWhatIsInsideOut, C)
{
  Generator random(4);
  SampledCells<C> cells = some_cell<C>(random, 0, 1);
  std::vector<double> way(cells.u.size());
  for (std::size_t i = 0; i < way.size(); i += C::gdim)
  {
    cells.u[i] = -2 * cells.X[i];
    way[i] = -1;
    way[i + 1] = cells.X[i];
  }
  EXPECT_EQ(longest(cells, way), 1);
}

TYPED_TEST_OF(LongestWay, IsPositiveHoweverFarTheWayGoes, C)
{
  Generator random(5);
  for (const double size : {1e3, 1e6, 1e9})
  {
    const auto cells = some_cell<C>(random, 0.05, 1);
    std::vector<double> way = random.numbers(cells.u.size(), -size, size);
    const double t = longest(cells, way);
    EXPECT_GT(t, 1e-3 / size);
    EXPECT_GE(least(cells, way, t), -1e-9);
  }
}

TEST(LongestWayInput, RefusesWhatMakesNoSense)
{
  const std::vector<double> X{0, 0, 1, 0, 0, 1}, u(6), short_way(4);
  const std::vector<std::int32_t> cell{0, 1, 2};
  EXPECT_EQ(mesh::max_step_without_inversion(cell, 3, X, u, u, 2, 0), 1);
  EXPECT_REFUSED(mesh::max_step_without_inversion(cell, 3, X, u, short_way, 2,
                                                  least_part));
  for (const double bad : {-0.1, 1.0, std::nan("")})
    EXPECT_REFUSED(mesh::max_step_without_inversion(cell, 3, X, u, u, 2, bad));
  EXPECT_REFUSED(
      mesh::max_step_without_inversion(cell, 5, X, u, u, 2, least_part));
}
} // namespace
