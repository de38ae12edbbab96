// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#pragma once

#include "shape.h"

namespace contactx::geometry
{
/// @brief Quadratic facets, whose linear parts between their nodes are what is
/// searched and clipped.

/// @brief Segment of three nodes: its ends and its middle.
struct QuadraticSegment
{
  using Part = Segment;
  static constexpr int gdim = 2;
  static constexpr int tdim = 1;
  static constexpr int nodes = 3;
  static constexpr int degree = 2;
  static constexpr Vector<1> centre{0.5};
  static constexpr std::array<Vector<1>, 3> points{{{0}, {1}, {0.5}}};

  /// @copydoc Segment::shape
  static constexpr Vector<3> shape(const Vector<1>& xi)
  {
    const double s = xi[0];
    return {(1 - s) * (1 - 2 * s), s * (2 * s - 1), 4 * s * (1 - s)};
  }

  /// @copydoc Segment::derivative
  static constexpr std::array<Vector<3>, 1> derivative(const Vector<1>& xi)
  {
    const double s = xi[0];
    return {{{4 * s - 3, 4 * s - 1, 4 - 8 * s}}};
  }
};

/// @brief Triangle of six nodes: its vertices, then the middles of the edges
/// opposite to them.
struct QuadraticTriangle
{
  using Part = Triangle;
  static constexpr int gdim = 3;
  static constexpr int tdim = 2;
  static constexpr int nodes = 6;
  static constexpr int degree = 2;
  static constexpr Vector<2> centre{1. / 3, 1. / 3};
  static constexpr std::array<Vector<2>, 6> points{
      {{0, 0}, {1, 0}, {0, 1}, {0.5, 0.5}, {0, 0.5}, {0.5, 0}}};

  /// @copydoc Segment::shape
  static constexpr Vector<6> shape(const Vector<2>& xi)
  {
    const double r = 1 - xi[0] - xi[1], s = xi[0], t = xi[1];
    return {r * (2 * r - 1), s * (2 * s - 1), t * (2 * t - 1),
            4 * s * t,       4 * r * t,       4 * r * s};
  }

  /// @copydoc Segment::derivative
  static constexpr std::array<Vector<6>, 2> derivative(const Vector<2>& xi)
  {
    const double r = 1 - xi[0] - xi[1], s = xi[0], t = xi[1];
    return {{{1 - 4 * r, 4 * s - 1, 0, 4 * t, -4 * t, 4 * (r - s)},
             {1 - 4 * r, 0, 4 * t - 1, 4 * s, 4 * (r - t), -4 * s}}};
  }
};

/// @brief Quadrilateral of nine nodes: its vertices in tensor-product order,
/// the middles of the edges 01, 02, 13, 23 and its own.
struct BiquadraticQuadrilateral
{
  using Part = Quadrilateral;
  static constexpr int gdim = 3;
  static constexpr int tdim = 2;
  static constexpr int nodes = 9;
  static constexpr int degree = 4;
  static constexpr Vector<2> centre{0.5, 0.5};
  static constexpr std::array<Vector<2>, 9> points{{{0, 0},
                                                    {1, 0},
                                                    {0, 1},
                                                    {1, 1},
                                                    {0.5, 0},
                                                    {0, 0.5},
                                                    {1, 0.5},
                                                    {0.5, 1},
                                                    {0.5, 0.5}}};
  /// Places of the nodes along both axes: 0 and 1 are ends, 2 is the middle
  static constexpr std::array<std::array<int, 2>, 9> axes{
      {{0, 0}, {1, 0}, {0, 1}, {1, 1}, {2, 0}, {0, 2}, {1, 2}, {2, 1}, {2, 2}}};

  /// @copydoc Segment::shape
  static constexpr Vector<9> shape(const Vector<2>& xi)
  {
    const auto a = QuadraticSegment::shape({xi[0]});
    const auto b = QuadraticSegment::shape({xi[1]});
    Vector<9> N{};
    for (int l = 0; l < 9; ++l)
      N[l] = a[axes[l][0]] * b[axes[l][1]];
    return N;
  }

  /// @copydoc Segment::derivative
  static constexpr std::array<Vector<9>, 2> derivative(const Vector<2>& xi)
  {
    const auto a = QuadraticSegment::shape({xi[0]});
    const auto b = QuadraticSegment::shape({xi[1]});
    const auto da = QuadraticSegment::derivative({xi[0]})[0];
    const auto db = QuadraticSegment::derivative({xi[1]})[0];
    std::array<Vector<9>, 2> dN{};
    for (int l = 0; l < 9; ++l)
    {
      dN[0][l] = da[axes[l][0]] * b[axes[l][1]];
      dN[1][l] = a[axes[l][0]] * db[axes[l][1]];
    }
    return dN;
  }
};

namespace detail
{
template <class F>
struct PartOf
{
  using type = F;
};
template <class F>
  requires requires { typename F::Part; }
struct PartOf<F>
{
  using type = typename F::Part;
};
} // namespace detail

/// @brief Linear facets that a facet has as its parts; a linear one is its own.
template <class F>
using Part = typename detail::PartOf<F>::type;

/// @brief True if a facet is linear.
template <class F>
inline constexpr bool is_linear = std::is_same_v<Part<F>, F>;

/// @brief Places of the nodes of a part among those of the whole facet.
template <class F>
using Places = std::array<int, Part<F>::nodes>;

/// @brief Nodes of a part of a facet.
template <class F>
Nodes<Part<F>> part_of(const Nodes<F>& x, const Places<F>& places)
{
  Nodes<Part<F>> part;
  for (int j = 0; j < Part<F>::nodes; ++j)
    part[j] = x[places[j]];
  return part;
}

/// @brief Values in rows of part nodes, of values at the nodes of the facet.
template <class F>
Vector<Part<F>::nodes> values_of(const Vector<F::nodes>& values,
                                 const Places<F>& places)
{
  Vector<Part<F>::nodes> part;
  for (int j = 0; j < Part<F>::nodes; ++j)
    part[j] = values[places[j]];
  return part;
}

/// @brief Places of the nodes of a linear facet among themselves.
template <class F>
constexpr Places<F> all_places()
{
  Places<F> places;
  for (int j = 0; j < Part<F>::nodes; ++j)
    places[j] = j;
  return places;
}

/// @brief Basis that the dual functions of a facet are biorthogonal to, as rows
/// of what it takes of the positions: of the vertices of a triangle of six
/// nodes, whose shape functions have no integral, 1/5 of those of the edges
/// beside them are added (A. Popp, B. I. Wohlmuth, M. W. Gee and W. A. Wall,
/// SIAM J. Sci. Comput. 34, 2012).
///
/// With M_v = N_v + a sum_e N_e and M_e = (1 - 2 a) N_e the displacement sum_j
/// N_j u_j is sum_s M_s w_s, w_v = u_v and w_e = (u_e - a sum_v u_v) / (1 - 2
/// a), as all other facets have it with M = N and w = u.
template <class F>
struct Basis
{
  static constexpr bool is_own = F::nodes != 6;
  static constexpr double a = 0.2;

  /// @brief Functions M_s of the shape functions N_s.
  static constexpr Vector<F::nodes> functions(const Vector<F::nodes>& N)
  {
    if constexpr (is_own)
      return N;
    else
    {
      Vector<6> M{};
      for (int v = 0; v < 3; ++v)
      {
        M[v] = N[v] + a * (N[3 + (v + 1) % 3] + N[3 + (v + 2) % 3]);
        M[3 + v] = (1 - 2 * a) * N[3 + v];
      }
      return M;
    }
  }

  /// @brief Call f(node, part) for each node that w_s takes a part of.
  template <class Function>
  static constexpr void for_each_part(int s, Function&& f)
  {
    if constexpr (is_own)
      f(s, 1.0);
    else if (s < 3)
      f(s, 1.0);
    else
    {
      f(s, 1 / (1 - 2 * a));
      f((s - 3 + 1) % 3, -a / (1 - 2 * a));
      f((s - 3 + 2) % 3, -a / (1 - 2 * a));
    }
  }

  /// @brief Evaluate w_s of values at the nodes.
  template <class T>
  static constexpr T coefficient(int s, const std::array<T, F::nodes>& u)
  {
    if constexpr (is_own)
      return u[s];
    else
    {
      T w = 0. * u[s];
      for_each_part(s, [&](int j, double part) { w = w + part * u[j]; });
      return w;
    }
  }
};

/// @brief Call `f` with the facet type that has `num_nodes` nodes, linear or
/// not.
/// @param[in] gdim Geometric dimension, 2 or 3.
/// @param[in] num_nodes 2 or 3 in 2D; 3, 4, 6 or 9 in 3D.
/// @param[in] f Function.
template <class Function>
constexpr decltype(auto) visit_whole(int gdim, int num_nodes, Function&& f)
{
  if (num_nodes == 3 and gdim == 2)
    return f(QuadraticSegment{});
  if (num_nodes == 6)
    return f(QuadraticTriangle{});
  if (num_nodes == 9)
    return f(BiquadraticQuadrilateral{});
  return visit(num_nodes, f);
}
} // namespace contactx::geometry
