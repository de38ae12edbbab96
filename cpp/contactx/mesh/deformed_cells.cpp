// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#include "deformed_cells.h"
#include "../math/vec.h"
#include "triquadratic.h"
#include <algorithm>
#include <cmath>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

using namespace contactx;
using namespace contactx::mesh;

namespace
{
constexpr int max_halvings = 8;
constexpr std::size_t max_parts = 512;

double determinant(const Vector<2>& a, const Vector<2>& b)
{
  return a[0] * b[1] - a[1] * b[0];
}

double determinant(const Vector<3>& a, const Vector<3>& b, const Vector<3>& c)
{
  return dot(a, cross(b, c));
}

// Cells. Their determinants are those of the derivatives of the positions at
// the cell's points, from edge(i, j), the vector from node i to node j.

struct Triangle
{
  static constexpr int gdim = 2, nodes = 3, points = 1;

  template <class Edge>
  static Vector<points> determinants(Edge&& edge)
  {
    return {determinant(edge(0, 1), edge(0, 2))};
  }
};

struct Quadrilateral
{
  static constexpr int gdim = 2, nodes = 4, points = 4;

  template <class Edge>
  static Vector<points> determinants(Edge&& edge)
  {
    const auto bottom = edge(0, 1), top = edge(2, 3);
    const auto left = edge(0, 2), right = edge(1, 3);
    return {determinant(bottom, left), determinant(bottom, right),
            determinant(top, left), determinant(top, right)};
  }
};

struct Tetrahedron
{
  static constexpr int gdim = 3, nodes = 4, points = 1;

  template <class Edge>
  static Vector<points> determinants(Edge&& edge)
  {
    return {determinant(edge(0, 1), edge(0, 2), edge(0, 3))};
  }
};

struct Hexahedron
{
  static constexpr int gdim = 3, nodes = 8, points = 27;

  /// Derivative along an axis at [i + 3 * j], the 9 places of the two other
  /// axes in their order.
  template <class Edge>
  static std::array<Vector<3>, 9> derivative(int axis, Edge&& edge)
  {
    const int along = 1 << axis;
    const int first = axis == 0 ? 2 : 1, second = axis == 2 ? 2 : 4;
    std::array<Vector<3>, 9> t;
    for (const int j : {0, 1})
    {
      const int node = j * second;
      t[6 * j] = edge(node, node + along);
      t[6 * j + 2] = edge(node + first, node + first + along);
      t[6 * j + 1] = 0.5 * (t[6 * j] + t[6 * j + 2]);
    }
    for (const int i : {0, 1, 2})
      t[3 + i] = 0.5 * (t[i] + t[6 + i]);
    return t;
  }

  template <class Edge>
  static Triquadratic determinants(Edge&& edge)
  {
    const auto a = derivative(0, edge);
    const auto b = derivative(1, edge);
    const auto c = derivative(2, edge);
    Triquadratic d;
    for (int k = 0; k < 3; ++k)
      for (int j = 0; j < 3; ++j)
        for (int i = 0; i < 3; ++i)
          d[i + 3 * j + 9 * k]
              = determinant(a[j + 3 * k], b[i + 3 * k], c[i + 3 * j]);
    return d;
  }
};

/// det F where the reference cell has a volume.
double ratio(double current, double reference)
{
  return std::isfinite(current) ? current / reference : -infinity;
}

/// Whether numbers are all positive or all negative.
bool one_sign(const Triquadratic& b)
{
  bool positive = true, negative = true;
  for (const double c : b)
  {
    positive &= c > 0;
    negative &= c < 0;
  }
  return positive or negative;
}

/// Whether det F is positive and at least a bound at all points, without
/// division; false where that needs more evaluations.
template <std::size_t N>
bool above(double bound, const std::array<double, N>& current,
           const std::array<double, N>& reference)
{
  bool found = true;
  for (std::size_t p = 0; p < N; ++p)
  {
    const double sign = std::copysign(1, reference[p]);
    const double now = sign * current[p], then = sign * reference[p];
    found &= (now > 0) & (now >= bound * then) & (now < infinity);
  }
  return found;
}

/// Smallest det F at the points.
template <std::size_t N>
double smallest(const std::array<double, N>& current,
                const std::array<double, N>& reference)
{
  double least = infinity;
  for (std::size_t p = 0; p < N; ++p)
    if (reference[p] != 0)
      least = std::min(least, ratio(current[p], reference[p]));
  return least;
}

/// Bound det F between the points of a hexahedron.
/// @param[in] current Coefficients of det(dx/dxi), not of one sign.
/// @param[in] reference Coefficients of det(dX/dxi).
/// @return Smallest det F at the corners of the parts that were visited, which
/// are all of them where it is positive.
double smallest_between(const Triquadratic& current,
                        const Triquadratic& reference)
{
  struct Part
  {
    Triquadratic current, reference;
    int halvings;
  };
  const double sign = std::copysign(1, reference[0]);
  double least = infinity;
  std::vector<Part> open{{current, reference, 0}};
  // Breadth first: the whole cell is visited before one part is refined
  for (std::size_t p = 0; p < open.size(); ++p)
  {
    const Part part = open[p];
    for (const int corner : {0, 2, 6, 8, 18, 20, 24, 26})
    {
      if (!(sign * part.reference[corner] > 0))
        return least;
      least = std::min(least,
                       ratio(part.current[corner], part.reference[corner]));
    }
    if (!(least > 0))
      return least;
    if (part.halvings == max_halvings or one_sign(part.current))
      continue;
    for (int piece = 0; piece < 8 and open.size() < max_parts; ++piece)
    {
      Part next{part.current, part.reference, part.halvings + 1};
      for (int k = 0; k < 3; ++k)
      {
        const bool upper = piece >> k & 1;
        next.current = half(next.current, k, upper);
        next.reference = half(next.reference, k, upper);
      }
      open.push_back(next);
    }
  }
  return least;
}

/// Smallest det F of a cell; none if it is positive and at least a bound.
template <class C>
std::optional<double> look(double bound, const Vector<C::points>& current,
                           const Vector<C::points>& reference)
{
  if constexpr (C::points == 27)
  {
    const Triquadratic b = coefficients(current);
    if (!one_sign(b))
    {
      const double least = smallest(current, reference);
      return least > 0
                 ? std::min(least, smallest_between(b, coefficients(reference)))
                 : least;
    }
  }
  if (above(bound, current, reference))
    return std::nullopt;
  return smallest(current, reference);
}

template <class C>
DeformedCells find(std::span<const std::int32_t> cells,
                   std::span<const double> X, std::span<const double> u)
{
  constexpr int gdim = C::gdim;
  DeformedCells found;
  const std::ptrdiff_t count = std::ssize(cells) / C::nodes;
  for (std::ptrdiff_t c = 0; c < count; ++c)
  {
    std::array<Vector<gdim>, C::nodes> Xc, uc;
    for (int i = 0; i < C::nodes; ++i)
      for (int k = 0; k < gdim; ++k)
      {
        const std::size_t at = std::size_t(cells[c * C::nodes + i]) * gdim + k;
        Xc[i][k] = X[at];
        uc[i][k] = u[at];
      }
    const auto reference
        = C::determinants([&Xc](int i, int j) { return Xc[j] - Xc[i]; });
    // Differences of u by themselves: X + u would round small ones
    const auto current = C::determinants(
        [&Xc, &uc](int i, int j) { return (Xc[j] - Xc[i]) + (uc[j] - uc[i]); });
    const auto least = look<C>(found.smallest, current, reference);
    if (!least)
      continue;
    found.inverted += *least <= 0;
    if (found.cell < 0 or *least < found.smallest)
    {
      found.smallest = *least;
      found.cell = static_cast<std::int32_t>(c);
    }
  }
  return found;
}

/// Coefficients of det(dx/dxi) at one point along the increment, by powers of
/// t.
/// @param[in] a,b,c,d The determinants at t = 0, t = 1, t = -1 and of du alone.
template <int D>
std::array<double, D + 1> powers(double a, double b, double c, double d)
{
  if constexpr (D == 2)
    return {a, b - a - d, d};
  else
    return {a, (b - c) / 2 - d, (b + c) / 2 - a, d};
}

/// Coefficients by the Bernstein polynomials of [0, end], from those by powers.
template <std::size_t N>
std::array<double, N> bernstein(std::array<double, N> p, double end)
{
  // C(i, k) / C(n, k), and powers of the end
  std::array<double, N> b;
  for (std::size_t i = 0; i < N; ++i)
  {
    double weight = 1;
    b[i] = 0;
    for (std::size_t k = 0; k <= i; ++k)
    {
      b[i] += weight * p[k];
      weight *= end * (i - k) / static_cast<double>(N - 1 - k);
    }
  }
  return b;
}

/// Largest t of [begin, begin + width] up to which a polynomial that begins
/// with a positive value is proven to stay positive; too small by 1/1024 of it.
/// @param[in] b Its coefficients by the Bernstein polynomials of the interval.
template <std::size_t N>
double first_root(const std::array<double, N>& b, double begin, double width)
{
  if (std::ranges::all_of(b, [](double c) { return c > 0; }))
    return begin + width;
  if (1024 * width <= begin or !(width > std::numeric_limits<double>::min()))
    return begin;
  // De Casteljau's halves
  auto left = b, right = b;
  for (std::size_t k = 1; k < N; ++k)
  {
    for (std::size_t i = 0; i + k < N; ++i)
      right[i] = (right[i] + right[i + 1]) / 2;
    left[k] = right[0];
  }
  const double half = width / 2, middle = begin + half;
  const double t = first_root(left, begin, half);
  return t < middle or !(right[0] > 0) ? t : first_root(right, middle, half);
}

template <class C>
double shortest(std::span<const std::int32_t> cells, std::span<const double> X,
                std::span<const double> u, std::span<const double> du,
                double part)
{
  constexpr int gdim = C::gdim;
  double t = 1;
  const std::ptrdiff_t count = std::ssize(cells) / C::nodes;
  for (std::ptrdiff_t c = 0; c < count; ++c)
  {
    std::array<Vector<gdim>, C::nodes> Xc, uc, dc;
    for (int i = 0; i < C::nodes; ++i)
      for (int k = 0; k < gdim; ++k)
      {
        const std::size_t at = std::size_t(cells[c * C::nodes + i]) * gdim + k;
        Xc[i][k] = X[at];
        uc[i][k] = u[at];
        dc[i][k] = du[at];
      }
    const auto now = [&](int i, int j) -> Vector<gdim>
    { return (Xc[j] - Xc[i]) + (uc[j] - uc[i]); };
    // Fraction of the increment that changes the cell by about its own size:
    // from farther places differences would be round-off
    double size = 0, by = 0;
    for (int i = 1; i < C::nodes; ++i)
    {
      size = std::max(size, norm(now(0, i)));
      by = std::max(by, norm(dc[i] - dc[0]));
    }
    const double unit = by > size ? size / by : 1;
    const auto at = [&](double s)
    {
      return C::determinants([&, s](int i, int j)
                             { return now(i, j) + s * (dc[j] - dc[i]); });
    };
    const auto reference
        = C::determinants([&Xc](int i, int j) { return Xc[j] - Xc[i]; });
    const auto begin = at(0), end = at(unit), back = at(-unit);
    const auto alone
        = C::determinants([&](int i, int j) { return unit * (dc[j] - dc[i]); });
    for (int p = 0; p < C::points; ++p)
    {
      const double sign = std::copysign(1, reference[p]);
      auto polynomial = powers<gdim>(sign * begin[p], sign * end[p],
                                     sign * back[p], sign * alone[p]);
      // NaN of an overflow is left to the audit
      if (!(polynomial[0] > 0))
        continue;
      polynomial[0] -= part * std::min(polynomial[0], sign * reference[p]);
      const double whole = t / unit;
      const double found = first_root(bernstein(polynomial, whole), 0, whole);
      if (found < whole)
        t = unit * found;
    }
  }
  return t;
}

[[noreturn]] void fail(const std::string& message)
{
  throw std::invalid_argument(message);
}

void check_cells(std::span<const std::int32_t> cells, int nodes_per_cell,
                 std::span<const double> X, std::span<const double> u, int gdim)
{
  const auto text = [](auto number) { return std::to_string(number); };
  if (gdim != 2 and gdim != 3)
    fail("gdim must be 2 or 3, not " + text(gdim));
  if (nodes_per_cell != 4 and nodes_per_cell != (gdim == 2 ? 3 : 8))
    fail("cells must have 3 or 4 nodes in 2D, and 4 or 8 in 3D, not "
         + text(nodes_per_cell) + " in " + text(gdim) + "D");
  if (cells.size() % nodes_per_cell != 0)
    fail("cells must have " + text(nodes_per_cell) + " nodes each: there are "
         + text(cells.size()) + " in all");
  if (X.size() % gdim != 0)
    fail("X must have " + text(gdim) + " coordinates for each node: it has "
         + text(X.size()) + " values");
  const std::size_t num_nodes = X.size() / gdim;
  if (u.size() < X.size() or u.size() % gdim != 0)
    fail("u must have " + text(gdim) + " components for each of "
         + text(num_nodes) + " nodes or more: it has " + text(u.size())
         + " values");
  // Without a sign, negative numbers are large ones
  const auto bad = std::ranges::find_if(
      cells, [num_nodes](std::int32_t node)
      { return static_cast<std::uint32_t>(node) >= num_nodes; });
  if (bad != cells.end())
    fail("cells must be numbers of nodes, of which there are " + text(num_nodes)
         + ": there is " + text(*bad));
}
} // namespace

DeformedCells
contactx::mesh::deformed_cells(std::span<const std::int32_t> cells,
                               int nodes_per_cell, std::span<const double> X,
                               std::span<const double> u, int gdim)
{
  check_cells(cells, nodes_per_cell, X, u, gdim);
  if (gdim == 2)
    return nodes_per_cell == 3 ? find<Triangle>(cells, X, u)
                               : find<Quadrilateral>(cells, X, u);
  return nodes_per_cell == 4 ? find<Tetrahedron>(cells, X, u)
                             : find<Hexahedron>(cells, X, u);
}

double contactx::mesh::max_step_without_inversion(
    std::span<const std::int32_t> cells, int nodes_per_cell,
    std::span<const double> X, std::span<const double> u,
    std::span<const double> du, int gdim, double part)
{
  check_cells(cells, nodes_per_cell, X, u, gdim);
  if (du.size() < u.size())
    fail("du must be as long as u: it has " + std::to_string(du.size())
         + " values for " + std::to_string(u.size()));
  if (!(part >= 0 and part < 1))
    fail("part must be in [0, 1), not " + std::to_string(part));
  if (gdim == 2)
    return nodes_per_cell == 3 ? shortest<Triangle>(cells, X, u, du, part)
                               : shortest<Quadrilateral>(cells, X, u, du, part);
  return nodes_per_cell == 4 ? shortest<Tetrahedron>(cells, X, u, du, part)
                             : shortest<Hexahedron>(cells, X, u, du, part);
}
