// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#pragma once

#include "../geometry/trace.h"
#include "layout.h"
#include <algorithm>

namespace contactx::kernel
{
/// @brief A pair of a slave and a master facet, or of a part of each, as the
/// kernels see it.
///
/// Positions are those relative to the first slave node's in the reference
/// configuration, so that rounding errors do not grow with its distance from
/// the origin.
template <class S, class M>
struct MortarPair
{
  using SlavePart = geometry::Part<S>;
  using MasterPart = geometry::Part<M>;
  static constexpr int gdim = S::gdim;
  static constexpr int num_dofs = gdim * (S::nodes + M::nodes);
  static constexpr MortarLayout layout{S::nodes, M::nodes};

  geometry::Nodes<S> slave;     ///< positions of the slave facet's nodes
  geometry::Nodes<S> reference; ///< in the reference configuration
  geometry::Nodes<M> master;    ///< positions of the master facet's nodes
  geometry::Places<S> slave_places = geometry::all_places<S>();
  geometry::Places<M> master_places = geometry::all_places<M>();
  const double* data; ///< values of the pair

  /// @brief Read a pair from the coefficients.
  /// @param[in] w Coefficients.
  explicit MortarPair(const double* w)
      : data(at(w, Law::frictionless, Coefficient::pair))
  {
    // The first coefficients are those of every law
    const double* u = at(w, Law::frictionless, Coefficient::displacement);
    const double* x = at(w, Law::frictionless, Coefficient::position);
    for (int s = 0; s < S::nodes; ++s)
      for (int k = 0; k < gdim; ++k)
      {
        const int i = gdim * s + k;
        reference[s][k] = x[i] - x[k];
        slave[s][k] = reference[s][k] + u[i];
      }
    for (int l = 0; l < M::nodes; ++l)
      for (int k = 0; k < gdim; ++k)
      {
        const int i = gdim * (S::nodes + l) + k;
        master[l][k] = (x[i] - x[k]) + u[i];
      }
    if constexpr (!geometry::is_linear<S>)
      for (int j = 0; j < SlavePart::nodes; ++j)
        slave_places[j] = static_cast<int>(data[layout.slave_places + j]);
    if constexpr (!geometry::is_linear<M>)
      for (int j = 0; j < MasterPart::nodes; ++j)
        master_places[j] = static_cast<int>(data[layout.master_places + j]);
  }

  /// @brief Positions of the nodes of the slave facet's part.
  geometry::Nodes<SlavePart> slave_part() const
  {
    return geometry::part_of<S>(slave, slave_places);
  }

  /// @brief Values of a coefficient.
  static const double* at(const double* w, Law law, Coefficient c)
  {
    return w + offset(law, c, M::nodes, gdim, S::nodes);
  }

  /// @brief int Phi_s N_l.
  double weight(int s, int l) const
  {
    return data[layout.weight + M::nodes * s + l];
  }

  /// @brief int Phi_s.
  double area(int s) const
  {
    double sum = 0;
    for (int l = 0; l < M::nodes; ++l)
      sum += weight(s, l);
    return sum;
  }

  /// @brief Coefficient of M_t in Phi_s.
  double dual(int s, int t) const
  {
    return data[layout.dual + S::nodes * s + t];
  }

  /// @brief Weight of the integrals, at the nodes of the slave facet's part.
  Vector<SlavePart::nodes> factor() const
  {
    Vector<SlavePart::nodes> f;
    std::copy_n(data + layout.factor, SlavePart::nodes, f.begin());
    return f;
  }

  /// @brief int Phi_s gap when the integrals were taken.
  double gap(int s) const { return data[layout.gap + s]; }

  /// @brief What stays as the search found it.
  Keeps keeps() const { return static_cast<Keeps>(data[layout.keeps]); }

  /// @brief Whether the normal does.
  bool keeps_normal() const { return keeps() != Keeps::nothing; }

  /// @brief Unit normal of the master, against the slave facet's: now, or that
  /// the search found.
  template <bool Turning>
  Vector<gdim> normal() const
  {
    Vector<gdim> n;
    if (Turning and not keeps_normal())
      n = -1. * geometry::frame<S>(slave, geometry::normal_place<S>()).n;
    else
      std::copy_n(data + layout.normal, gdim, n.begin());
    return n;
  }

  /// @brief Unit normals of the master at the slave nodes.
  template <bool Turning>
  std::array<Vector<gdim>, S::nodes> normals() const
  {
    std::array<Vector<gdim>, S::nodes> n;
    n.fill(normal<Turning>());
    if (keeps() == Keeps::all)
      for (int s = 0; s < S::nodes; ++s)
        std::copy_n(data + layout.normals + 3 * s, gdim, n[s].begin());
    return n;
  }

  /// @brief int Phi_s (x_slave - x_master).
  Vector<gdim> distance(int s) const
  {
    Vector<gdim> d
        = area(s)
          * geometry::Basis<S>::template coefficient<Vector<gdim>>(s, slave);
    for (int l = 0; l < M::nodes; ++l)
      d = d - weight(s, l) * master[l];
    return d;
  }

  /// @brief Call f(node of the pair, slave node, weight) for the parts of the
  /// virtual displacements that the slave nodes' multipliers work on.
  template <class Function>
  void for_each_weight(Function&& f) const
  {
    for (int s = 0; s < S::nodes; ++s)
    {
      const double own = area(s);
      geometry::Basis<S>::for_each_part(s, [&](int node, double part)
                                        { f(node, s, part * own); });
      for (int l = 0; l < M::nodes; ++l)
        f(S::nodes + l, s, -weight(s, l));
    }
  }
};
} // namespace contactx::kernel
