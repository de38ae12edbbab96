// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#pragma once

#include "../math/vec.h"
#include <algorithm>
#include <utility>

/// @brief Geometry of one facet: pure functions on points.
namespace contactx::geometry
{
/// @brief How far a facet is extended beyond its edges, in its local
/// coordinates: 5 % of its width.
inline constexpr double facet_margin = 0.05;

/// @brief Features of a facet are numbered: 0 its interior, then its edges
/// (3D only), then its vertices.
inline constexpr int interior = 0;

/// @brief Beside those: the interior, at local coordinates and with a normal,
/// by its components, that a pair keeps.
inline constexpr int kept = -1;

/// @brief Two-node segment, the facet of a plane problem.
///
/// Local coordinate in [0, 1]. Traversed with the body on its left, so that
/// the outward normal is the tangent turned clockwise.
struct Segment
{
  static constexpr int gdim = 2;
  static constexpr int tdim = 1;
  static constexpr int nodes = 2;
  static constexpr int num_edges = 0;
  static constexpr bool flat = true;
  static constexpr std::array<Vector<1>, 2> vertices{{{0}, {1}}};
  static constexpr std::array<std::pair<int, int>, 2> edges{{{0, 1}, {1, 0}}};

  /// @brief Shape functions N_l at `xi`.
  static constexpr Vector<2> shape(const Vector<1>& xi)
  {
    return {1 - xi[0], xi[0]};
  }

  /// @brief First derivatives of the shape functions, [tdim][nodes].
  static constexpr std::array<Vector<2>, 1> derivative(const Vector<1>&)
  {
    return {{{-1, 1}}};
  }

  /// @brief Distance of `xi` outside the facet; not positive inside.
  static constexpr double excess(const Vector<1>& xi)
  {
    return std::max(-xi[0], xi[0] - 1);
  }
};

/// @brief Three-node triangle, outward normal t_1 x t_2.
struct Triangle
{
  static constexpr int gdim = 3;
  static constexpr int tdim = 2;
  static constexpr int nodes = 3;
  static constexpr int num_edges = 3;
  static constexpr bool flat = true;
  static constexpr std::array<Vector<2>, 3> vertices{{{0, 0}, {1, 0}, {0, 1}}};
  static constexpr std::array<std::pair<int, int>, 3> edges{
      {{0, 1}, {1, 2}, {2, 0}}};

  /// @copydoc Segment::shape
  static constexpr Vector<3> shape(const Vector<2>& xi)
  {
    return {1 - xi[0] - xi[1], xi[0], xi[1]};
  }

  /// @copydoc Segment::derivative
  static constexpr std::array<Vector<3>, 2> derivative(const Vector<2>&)
  {
    return {{{-1, 1, 0}, {-1, 0, 1}}};
  }

  /// @copydoc Segment::excess
  static constexpr double excess(const Vector<2>& xi)
  {
    return std::max({-xi[0], -xi[1], xi[0] + xi[1] - 1});
  }
};

/// @brief Four-node bilinear quadrilateral, outward normal t_1 x t_2.
///
/// Local coordinates in [0, 1]^2 and tensor-product node order (0, 0),
/// (1, 0), (0, 1), (1, 1), as in Basix.
struct Quadrilateral
{
  static constexpr int gdim = 3;
  static constexpr int tdim = 2;
  static constexpr int nodes = 4;
  static constexpr int num_edges = 4;
  static constexpr bool flat = false;
  static constexpr std::array<Vector<2>, 4> vertices{
      {{0, 0}, {1, 0}, {0, 1}, {1, 1}}};
  static constexpr std::array<std::pair<int, int>, 4> edges{
      {{0, 1}, {1, 3}, {3, 2}, {2, 0}}};
  /// The only second derivative that does not vanish, d^2 N / dxi_1 dxi_2.
  static constexpr Vector<4> mixed_derivative{1, -1, -1, 1};

  /// @copydoc Segment::shape
  static constexpr Vector<4> shape(const Vector<2>& xi)
  {
    const double s = xi[0], t = xi[1];
    return {(1 - s) * (1 - t), s * (1 - t), (1 - s) * t, s * t};
  }

  /// @copydoc Segment::derivative
  static constexpr std::array<Vector<4>, 2> derivative(const Vector<2>& xi)
  {
    const double s = xi[0], t = xi[1];
    return {{{t - 1, 1 - t, -t, t}, {s - 1, -s, 1 - s, s}}};
  }

  /// @copydoc Segment::excess
  static constexpr double excess(const Vector<2>& xi)
  {
    return std::max({-xi[0], xi[0] - 1, -xi[1], xi[1] - 1});
  }
};

/// @brief Node coordinates of a facet.
template <class F>
using Nodes = std::array<Vector<F::gdim>, F::nodes>;

/// @brief Local coordinates on a facet.
template <class F>
using Local = Vector<F::tdim>;

/// @brief Weighted sum of node coordinates, sum_l w_l x_l.
template <class F>
constexpr Vector<F::gdim> combine(const Vector<F::nodes>& w, const Nodes<F>& x)
{
  Vector<F::gdim> y{};
  for (int l = 0; l < F::nodes; ++l)
    for (int k = 0; k < F::gdim; ++k)
      y[k] += w[l] * x[l][k];
  return y;
}

/// @brief Call `f` with the facet type that has `num_nodes` nodes.
template <class Function>
constexpr decltype(auto) visit(int num_nodes, Function&& f)
{
  switch (num_nodes)
  {
  case 2:
    return f(Segment{});
  case 3:
    return f(Triangle{});
  default:
    return f(Quadrilateral{});
  }
}
} // namespace contactx::geometry
