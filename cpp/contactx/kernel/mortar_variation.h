// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#pragma once

#include "../geometry/segment.h"
#include "mortar_pair.h"

namespace contactx::kernel
{
/// @brief First variation of what a pair of facets is integrated with, by the
/// positions of all nodes.
///
/// At a point of the slave facet the master point moves by v = sum_j N_j dr_j
/// - b dc in the slave facet's plane, with the plane's coordinates r_j of the
/// master's nodes and the distortion c of a quadrilateral, b = s_1 s_2 from
/// its centre. Shape functions of the master change by -grad N_l . v. As they
/// are continuous from facet to facet, the ends of the parts add nothing;
/// only where the master ends they do, and there they are left out.
///
/// Points of parts of quadratic facets move as those of the linear facets that
/// the parts are; shape functions are those of the whole facets.
template <class S, class M>
class MortarVariation
{
public:
  using P = geometry::Part<S>; ///< part of the slave facet
  using Q = geometry::Part<M>; ///< part of the master facet
  static constexpr int gdim = S::gdim;
  static constexpr int tdim = S::tdim;
  static constexpr int num_dofs = MortarPair<S, M>::num_dofs;
  using Row = Vector<num_dofs>;
  using Local = geometry::Local<S>;

  /// @brief Factors of the variations of r_j, of the nodes of the master
  /// facet's part, and c.
  struct Factors
  {
    std::array<Local, Q::nodes> r{};
    Local c{};
  };

  /// @brief Project the facets.
  /// @param[in] pair Pair.
  explicit MortarVariation(const MortarPair<S, M>& pair)
      : _pair(pair), _normal(pair.slave),
        _master(geometry::part_of<M>(pair.master, pair.master_places)),
        _slave(plane_of(pair, _normal.frame.n), pair.slave_part(),
               geometry::part_of<S>(pair.reference, pair.slave_places),
               pair.factor()),
        _r(geometry::project<Q>(_slave.plane, _master)),
        _slope(P::derivative(geometry::plane_origin<P>()))
  {
    const auto& plane = _slave.plane;
    for (int l = 0; l < M::nodes; ++l)
      _along[l] = dot(plane.n, pair.master[l] - plane.origin);
    for (int j = 0; j < Q::nodes; ++j)
      _height[j] = plane.height(_master[j]);
    for (int a = 0; a < tdim; ++a)
      for (int b = 0; b < tdim; ++b)
        _metric[a][b] = dot(plane.dual[a], plane.dual[b]);
    if constexpr (!P::flat)
    {
      const auto part = pair.slave_part();
      Vector<gdim> w{};
      for (int t = 0; t < P::nodes; ++t)
        w = w + P::mixed_derivative[t] * part[t];
      for (int a = 0; a < tdim; ++a)
        _twist[a] = dot(plane.dual[a], w);
      _warp = dot(plane.conormal, w);
    }
  }

  /// @brief Derivatives of the pair's normal, [gdim][num_dofs].
  std::array<Row, gdim> normal() const
  {
    std::array<Row, gdim> dn{};
    if (_pair.keeps_normal())
      return dn;
    for (int i = 0; i < gdim; ++i)
      for (int t = 0; t < S::nodes; ++t)
        for (int k = 0; k < gdim; ++k)
          dn[i][gdim * t + k] = -_normal.derivative(i, t, k);
    return dn;
  }

  /// @brief Factors of int Phi_s n . dx_master, the displacement of the
  /// master's surface along the normal under each slave node.
  std::array<Factors, S::nodes> gap() const
  {
    std::array<Factors, S::nodes> all{};
    moments(
        [&](const Vector<S::nodes>& weight, const Local& slope_of,
            int j) // of one node of the master
        {
          for (int s = 0; s < S::nodes; ++s)
            at(all[s], j) = at(all[s], j) + weight[s] * slope_of;
        },
        [this](const auto& slope)
        {
          Local d{};
          for (int a = 0; a < tdim; ++a)
            d[a] = -dot(slope[a], _along);
          return d;
        });
    return all;
  }

  /// @brief Factors of sum_s q_s int Phi_s dN_l of each node of the master, for
  /// several q at once.
  /// @param[in] q Factors of the slave nodes.
  template <std::size_t K>
  std::array<std::array<Factors, M::nodes>, K>
  weights(const std::array<Vector<S::nodes>, K>& q) const
  {
    std::array<std::array<Factors, M::nodes>, K> all{};
    moments(
        [&](const Vector<S::nodes>& weight, const auto& slope, int j)
        {
          for (std::size_t i = 0; i < K; ++i)
          {
            const double force = dot(q[i], weight);
            for (int l = 0; l < M::nodes; ++l)
              for (int a = 0; a < tdim; ++a)
                at(all[i][l], j)[a] -= force * slope[a][l];
          }
        },
        [](const auto& slope) { return slope; });
    return all;
  }

  /// @brief Add the variation that factors stand for.
  /// @param[in] f Factors.
  /// @param[in,out] row Derivatives by the positions of all nodes.
  void add(const Factors& f, double* row) const
  {
    const auto& plane = _slave.plane;
    constexpr Local o = geometry::plane_origin<P>();
    const auto N = P::shape(o);
    Vector<P::nodes> along{}; // of the height over a turning plane, by slope
    std::array<Vector<P::nodes>, tdim> across{};
    Local turn{};
    for (int j = 0; j < Q::nodes; ++j)
      for (int a = 0; a < tdim; ++a)
      {
        const double q = f.r[j][a];
        const int node = S::nodes + _pair.master_places[j];
        for (int k = 0; k < gdim; ++k)
          row[gdim * node + k] += q * plane.dual[a][k];
        Vector<P::nodes> affine = N;
        for (int b = 0; b < tdim; ++b)
        {
          affine = affine + _r[j][b] * _slope[b];
          turn[b] += q * _height[j] * _metric[a][b];
        }
        across[a] = across[a] - q * affine;
      }
    if constexpr (!P::flat)
      for (int a = 0; a < tdim; ++a)
      {
        Vector<P::nodes> d = P::mixed_derivative;
        for (int b = 0; b < tdim; ++b)
        {
          d = d - _twist[b] * _slope[b];
          turn[b] -= f.c[a] * _warp * _metric[a][b];
        }
        across[a] = across[a] - f.c[a] * d;
      }
    for (int b = 0; b < tdim; ++b)
      along = along + turn[b] * _slope[b];
    for (int t = 0; t < P::nodes; ++t)
      for (int k = 0; k < gdim; ++k)
      {
        // A part turns with the facet, a facet itself as its plane does
        double d = turns_with_plane() ? along[t] * plane.n[k] : 0;
        for (int a = 0; a < tdim; ++a)
          d += across[a][t] * plane.dual[a][k];
        row[slave_dof(t) + k] += d;
      }
    if (not turns_with_plane() and not _pair.keeps_normal())
    {
      Vector<gdim> by_normal{};
      for (int a = 0; a < tdim; ++a)
      {
        double q = 0;
        for (int j = 0; j < Q::nodes; ++j)
          q -= f.r[j][a] * _height[j];
        if constexpr (!P::flat)
          q += f.c[a] * _warp;
        by_normal = by_normal + q * plane.dual[a];
      }
      for (int t = 0; t < S::nodes; ++t)
        for (int k = 0; k < gdim; ++k)
          for (int i = 0; i < gdim; ++i)
            row[gdim * t + k] += by_normal[i] * _normal.derivative(i, t, k);
    }
  }

private:
  // Number of the distortion among what the factors multiply
  static constexpr int distortion = -1;

  static Local& at(Factors& f, int j) { return j < 0 ? f.c : f.r[j]; }

  static geometry::ProjectionPlane<P> plane_of(const MortarPair<S, M>& pair,
                                               const Vector<gdim>& normal)
  {
    if (pair.keeps_normal())
      return {pair.slave_part(), -1. * pair.template normal<false>()};
    return geometry::part_plane<S>(pair.slave_part(), normal);
  }

  // Whether the direction of the projection is the normal of the facet's plane
  bool turns_with_plane() const
  {
    return geometry::is_linear<S> and not _pair.keeps_normal();
  }

  // First displacement of a node of the slave facet's part
  int slave_dof(int t) const { return gdim * _pair.slave_places[t]; }

  // Call add(int Phi_s n_j, reduce(grad N), j) in parts, once on flat facets;
  // n_j are the shape functions of the master facet's part
  template <class Add, class Reduce>
  void moments(Add&& add, Reduce&& reduce) const
  {
    if constexpr (geometry::is_linear<S> and P::flat and Q::flat)
    {
      const auto slope = reduce(geometry::InverseMap<M>(_r).at({}).slope);
      for (int j = 0; j < M::nodes; ++j)
      {
        Vector<S::nodes> weight;
        for (int s = 0; s < S::nodes; ++s)
          weight[s] = _pair.weight(s, j);
        add(weight, slope, j);
      }
    }
    else
      geometry::integrate<S, M>(
          _slave, _master,
          [&](const geometry::Shape<P>& s, const geometry::Shape<Q>& m,
              double w)
          {
            const auto basis = geometry::Basis<S>::functions(
                geometry::trace<S>(s, _pair.slave_places));
            Vector<S::nodes> phi{};
            for (int i = 0; i < S::nodes; ++i)
              for (int t = 0; t < S::nodes; ++t)
                phi[i] += w * _pair.dual(i, t) * basis[t];
            const auto slope
                = reduce(geometry::trace_slope<M>(m, _pair.master_places));
            for (int j = 0; j < Q::nodes; ++j)
              add(m.N[j] * phi, slope, j);
            if constexpr (!P::flat)
            {
              const Local y = s.xi - geometry::plane_origin<P>();
              add((y[0] * y[1]) * phi, slope, distortion);
            }
          });
  }

  const MortarPair<S, M>& _pair;
  geometry::FacetNormal<S> _normal;
  geometry::Nodes<Q> _master;
  geometry::SlaveFacet<P> _slave;
  geometry::Flat<Q> _r;
  Vector<M::nodes> _along;  // of the master's nodes, along the normal
  Vector<Q::nodes> _height; // of its part's, over the plane
  std::array<Vector<P::nodes>, tdim> _slope; // of the slave part's centre
  std::array<Local, tdim> _metric{};
  Local _twist{};
  double _warp = 0;
};
} // namespace contactx::kernel
