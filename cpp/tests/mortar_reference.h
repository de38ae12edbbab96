// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#pragma once

#include "polygons.h"

namespace contactx::tests
{
/// @brief Cartesian coordinates across a direction.
template <int D>
struct Across
{
  Vector<D> n;                    ///< the direction, a unit vector
  std::array<Vector<D>, D - 1> e; ///< orthonormal

  explicit Across(const Vector<D>& direction) : n(direction)
  {
    if constexpr (D == 2)
      e[0] = {-n[1], n[0]};
    else
    {
      Vector<3> a{};
      a[std::abs(n[0]) > 0.6] = 1;
      e[0] = cross(n, a);
      e[0] = (1 / norm(e[0])) * e[0];
      e[1] = cross(n, e[0]);
    }
  }

  Vector<D - 1> operator()(const Vector<D>& x) const
  {
    Vector<D - 1> p;
    for (int a = 0; a < D - 1; ++a)
      p[a] = dot(e[a], x);
    return p;
  }

  /// @brief Outline of a facet, counterclockwise where it is a polygon.
  template <class F>
  Polygon<D - 1> outline(const geometry::Nodes<F>& x) const
  {
    Polygon<D - 1> p;
    for (const auto& edge : F::edges)
      p.push_back((*this)(x[edge.first]));
    if constexpr (D == 3)
      if (turn(p[0], p[1], p[2]) + turn(p[0], p[2], p.back()) < 0)
        std::ranges::reverse(p);
    return p;
  }
};

/// @brief Point of a facet on a line along the direction.
template <class F>
struct Foot
{
  geometry::Local<F> xi;
  Vector<F::nodes> N;
  double height;   ///< along the direction
  double jacobian; ///< area across the direction by that of local coordinates
};

/// @brief Find the point of a facet over a point, by Newton's method in space.
template <class F>
Foot<F> foot(const geometry::Nodes<F>& x, const Across<F::gdim>& across,
             const geometry::Local<F>& p)
{
  geometry::Local<F> xi;
  xi.fill(F::nodes == 3 ? 1. / 3 : 0.5);
  double det = 0;
  for (int it = 0; it < 50; ++it)
  {
    const auto t = geometry::tangents<F>(x, xi);
    const auto r = p - across(position<F>(x, xi));
    if constexpr (F::tdim == 1)
    {
      det = dot(across.e[0], t[0]);
      xi[0] += r[0] / det;
    }
    else
    {
      const auto a = across(t[0]), b = across(t[1]);
      det = a[0] * b[1] - a[1] * b[0];
      xi = xi
           + Vector<2>{(r[0] * b[1] - r[1] * b[0]) / det,
                       (a[0] * r[1] - a[1] * r[0]) / det};
    }
  }
  return {xi, F::shape(xi), dot(across.n, position<F>(x, xi)), std::abs(det)};
}

/// @brief Integrals of a pair of facets over the part that they share, by the
/// slave facet's reference area.
template <class S, class M>
struct PairMoments
{
  std::array<Vector<S::nodes>, S::nodes> mass{};  ///< int N_s N_t
  std::array<Vector<M::nodes>, S::nodes> mixed{}; ///< int N_s N_l
  Vector<S::nodes> area{}, gap{};                 ///< int N_s, int N_s gap
  double total = 0;                               ///< area

  /// @brief Integrate.
  /// @param[in] xs Nodes of the slave facet.
  /// @param[in] reference Its nodes in the reference configuration.
  /// @param[in] xm Nodes of the master facet.
  /// @param[in] direction Unit vector that is projected along.
  PairMoments(const geometry::Nodes<S>& xs, const geometry::Nodes<S>& reference,
              const geometry::Nodes<M>& xm, const Vector<S::gdim>& direction)
  {
    const Across<S::gdim> across(direction);
    const auto part = shared(across.template outline<S>(xs),
                             across.template outline<M>(xm));
    sample(part,
           [&](const geometry::Local<S>& p, double w)
           {
             const auto s = foot<S>(xs, across, p);
             const auto m = foot<M>(xm, across, p);
             const double weight
                 = w * geometry::frame<S>(reference, s.xi).jacobian
                   / s.jacobian;
             total += weight;
             area = area + weight * s.N;
             gap = gap + (weight * (m.height - s.height)) * s.N;
             for (int t = 0; t < S::nodes; ++t)
             {
               mass[t] = mass[t] + (weight * s.N[t]) * s.N;
               mixed[t] = mixed[t] + (weight * s.N[t]) * m.N;
             }
           });
  }
};

/// @brief The pairs that can meet, for typed tests.
template <class Slave, class Master>
struct Kinds
{
  using S = Slave;
  using M = Master;
};
using FacetPairTypes
    = testing::Types<Kinds<geometry::Segment, geometry::Segment>,
                     Kinds<geometry::Triangle, geometry::Triangle>,
                     Kinds<geometry::Triangle, geometry::Quadrilateral>,
                     Kinds<geometry::Quadrilateral, geometry::Triangle>,
                     Kinds<geometry::Quadrilateral, geometry::Quadrilateral>>;
} // namespace contactx::tests
