// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#pragma once

#include "../mortar/plane.h"
#include "layout.h"
#include <algorithm>

namespace contactx::kernel
{
/// @brief A pair of a slave and a master facet as the kernels see it.
template <class S, class M>
struct MortarPair
{
  static constexpr int gdim = S::gdim;
  static constexpr int num_dofs = gdim * (S::nodes + M::nodes);
  static constexpr MortarLayout layout{S::nodes, M::nodes};

  facet::Nodes<S> slave;     ///< positions of the slave facet's nodes
  facet::Nodes<S> reference; ///< in the reference configuration
  facet::Nodes<M> master;    ///< positions of the master facet's nodes
  const double* data;        ///< values of the pair

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
        reference[s][k] = x[i];
        slave[s][k] = x[i] + u[i];
      }
    for (int l = 0; l < M::nodes; ++l)
      for (int k = 0; k < gdim; ++k)
      {
        const int i = gdim * (S::nodes + l) + k;
        master[l][k] = x[i] + u[i];
      }
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

  /// @brief Coefficient of N_t in Phi_s.
  double dual(int s, int t) const
  {
    return data[layout.dual + S::nodes * s + t];
  }

  /// @brief What is integrated with, at the slave nodes.
  Vector<S::nodes> factor() const
  {
    Vector<S::nodes> f;
    std::copy_n(data + layout.factor, S::nodes, f.begin());
    return f;
  }

  /// @brief int Phi_s gap when the integrals were taken.
  double gap(int s) const { return data[layout.gap + s]; }

  /// @brief Unit normal of the master, against the slave facet's: now, or that
  /// the search found.
  template <bool Turning>
  Vector<gdim> normal() const
  {
    Vector<gdim> n;
    if constexpr (Turning)
      n = -1. * facet::frame<S>(slave, mortar::plane_origin<S>()).n;
    else
      std::copy_n(data + layout.normal, gdim, n.begin());
    return n;
  }

  /// @brief int Phi_s (x_slave - x_master).
  Vector<gdim> distance(int s) const
  {
    Vector<gdim> d = area(s) * slave[s];
    for (int l = 0; l < M::nodes; ++l)
      d = d - weight(s, l) * master[l];
    return d;
  }
};
} // namespace contactx::kernel
