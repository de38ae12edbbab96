// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#pragma once

#include "generator.h"

/// @brief Cells by their shape functions, and det F at any of their points.
namespace contactx::tests
{
/// @brief A square matrix by rows.
template <int D>
using Matrix = std::array<Vector<D>, D>;

template <int D>
Vector<D> times(const Matrix<D>& a, const Vector<D>& v)
{
  Vector<D> y;
  for (int k = 0; k < D; ++k)
    y[k] = dot(a[k], v);
  return y;
}

inline double det(const Matrix<2>& a)
{
  return a[0][0] * a[1][1] - a[0][1] * a[1][0];
}

inline double det(const Matrix<3>& a) { return dot(a[0], cross(a[1], a[2])); }

/// @brief Triangle or tetrahedron.
template <int D>
struct Simplex
{
  static constexpr int gdim = D, nodes = D + 1;

  static Vector<D> vertex(int i)
  {
    Vector<D> v{};
    if (i > 0)
      v[i - 1] = 1;
    return v;
  }

  static Vector<D> gradient(int i, const Vector<D>&)
  {
    Vector<D> g = vertex(i);
    if (i == 0)
      g.fill(-1);
    return g;
  }

  static bool holds(const Vector<D>& xi)
  {
    double sum = 0;
    for (const double c : xi)
      sum += c;
    return sum <= 1;
  }
};

/// @brief Quadrilateral or hexahedron.
template <int D>
struct Cube
{
  static constexpr int gdim = D, nodes = 1 << D;

  static Vector<D> vertex(int i)
  {
    Vector<D> v;
    for (int k = 0; k < D; ++k)
      v[k] = i >> k & 1;
    return v;
  }

  static Vector<D> gradient(int i, const Vector<D>& xi)
  {
    const Vector<D> v = vertex(i);
    Vector<D> g;
    for (int k = 0; k < D; ++k)
    {
      g[k] = 1;
      for (int l = 0; l < D; ++l)
        if (l == k)
          g[k] *= 2 * v[l] - 1;
        else
          g[k] *= v[l] > 0 ? xi[l] : 1 - xi[l];
    }
    return g;
  }

  static bool holds(const Vector<D>&) { return true; }
};

/// @brief Cells, each with nodes of its own, and their displacements.
template <class C>
struct SampledCells
{
  std::vector<double> X, u;

  /// @brief Add a cell.
  /// @param[in] position Called as position(vertex), gives X.
  /// @param[in] displacement Called as displacement(X, node), gives u.
  template <class Position, class Displacement>
  void add(Position position, Displacement displacement)
  {
    for (int i = 0; i < C::nodes; ++i)
    {
      const Vector<C::gdim> at = position(C::vertex(i));
      const Vector<C::gdim> by = displacement(at, i);
      X.insert(X.end(), at.begin(), at.end());
      u.insert(u.end(), by.begin(), by.end());
    }
  }

  std::vector<std::int32_t> nodes() const
  {
    std::vector<std::int32_t> n(X.size() / C::gdim);
    for (std::size_t i = 0; i < n.size(); ++i)
      n[i] = static_cast<std::int32_t>(i);
    return n;
  }

  /// @brief det F of a cell at a point, det(dx/dxi) / det(dX/dxi).
  double det_F(int cell, const Vector<C::gdim>& xi) const
  {
    Matrix<C::gdim> before{}, after{};
    for (int i = 0; i < C::nodes; ++i)
    {
      const auto g = C::gradient(i, xi);
      for (int k = 0; k < C::gdim; ++k)
      {
        const std::size_t at = (cell * C::nodes + i) * C::gdim + k;
        before[k] = before[k] + X[at] * g;
        after[k] = after[k] + (X[at] + u[at]) * g;
      }
    }
    return det(after) / det(before);
  }

  /// @brief Smallest det F of a cell at points n to an edge.
  double sampled(int cell, int n) const
  {
    double least = infinity;
    const int layers = C::gdim == 3 ? n : 1;
    for (int i = 0; i < n; ++i)
      for (int j = 0; j < n; ++j)
        for (int k = 0; k < layers; ++k)
        {
          const double all[]{double(i) / (n - 1), double(j) / (n - 1),
                             double(k) / (n - 1)};
          Vector<C::gdim> xi;
          std::copy_n(all, C::gdim, xi.begin());
          if (C::holds(xi))
            least = std::min(least, det_F(cell, xi));
        }
    return least;
  }
};
} // namespace contactx::tests
