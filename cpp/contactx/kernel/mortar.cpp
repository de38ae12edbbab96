// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#include "mortar.h"
#include "mortar_terms.h"
#include "mortar_variation.h"

using namespace contactx;
using namespace contactx::kernel;

namespace
{
/// What the kernels read: a pair of facets S and M, contact law L, whether
/// everything is current.
template <class S, class M, Law L, bool Turning>
struct Mortar
{
  static constexpr int gdim = S::gdim;
  static constexpr int slaves = S::nodes;
  static constexpr int size = L == Law::frictionless ? 1 : gdim;
  static constexpr int num_dofs = MortarPair<S, M>::num_dofs;
  static constexpr int width = size * slaves; ///< multipliers

  explicit Mortar(const double* w)
      : pair(w), normals(pair.template normals<Turning>()),
        multiplier(at(w, Coefficient::multiplier)),
        area(at(w, Coefficient::area)),
        gap_derivative(at(w, Coefficient::gap_derivative))
  {
  }

  static const double* at(const double* w, Coefficient c)
  {
    return MortarPair<S, M>::at(w, L, c);
  }

  /// Direction of a component of a slave node's multiplier.
  Vector<gdim> direction(int s, int i) const
  {
    if constexpr (L == Law::frictionless)
      return normals[s];
    Vector<gdim> e{};
    e[i] = 1;
    return e;
  }

  MortarPair<S, M> pair;
  std::array<Vector<gdim>, slaves> normals;
  const double *multiplier, *area, *gap_derivative;
};

template <class K>
void residual(double* b, const double* w, const double*, const double*,
              const int*, const std::uint8_t*, void*)
{
  const K k(w);
  if (std::all_of(k.multiplier, k.multiplier + K::width,
                  [](double t) { return t == 0; }))
    return;
  k.pair.for_each_weight(
      [&](int a, int s, double weight)
      {
        for (int i = 0; i < K::size; ++i)
        {
          const double force = weight * k.multiplier[K::size * s + i];
          const auto d = k.direction(s, i);
          for (int q = 0; q < K::gdim; ++q)
            b[K::gdim * a + q] -= force * d[q];
        }
      });
}

template <class K>
void traction(double* A, const double* w, const double*, const double*,
              const int*, const std::uint8_t*, void*)
{
  const K k(w);
  k.pair.for_each_weight(
      [&](int a, int s, double weight)
      {
        if (is_elsewhere(k.area[s]))
          return;
        for (int i = 0; i < K::size; ++i)
        {
          const auto d = k.direction(s, i);
          for (int q = 0; q < K::gdim; ++q)
            A[K::width * (K::gdim * a + q) + K::size * s + i] -= weight * d[q];
        }
      });
}

template <class S, class M, Law L>
void stiffness(double* A, const double* w, const double*, const double*,
               const int*, const std::uint8_t*, void*)
{
  using K = Mortar<S, M, L, true>;
  constexpr int n = K::num_dofs;
  const K k(w);
  if (std::all_of(k.multiplier, k.multiplier + K::width,
                  [](double t) { return t == 0; }))
    return;
  if (k.pair.keeps() == Keeps::all)
    return;
  const MortarVariation<S, M> d(k.pair);
  std::array<Vector<S::nodes>, K::size> q;
  for (int i = 0; i < K::size; ++i)
    for (int s = 0; s < S::nodes; ++s)
      q[i][s] = k.multiplier[K::size * s + i];
  const auto weights = d.weights(q);
  for (int i = 0; i < K::size; ++i)
  {
    const auto direction = k.direction(0, i);
    for (int l = 0; l < M::nodes; ++l)
    {
      Vector<n> row{};
      d.add(weights[i][l], row.data());
      for (int c = 0; c < K::gdim; ++c)
        if (direction[c] != 0)
          for (int col = 0; col < n; ++col)
            A[n * (K::gdim * (S::nodes + l) + c) + col]
                += direction[c] * row[col];
    }
  }
  if constexpr (L == Law::frictionless)
  {
    const auto dn = d.normal();
    k.pair.for_each_weight(
        [&](int a, int s, double weight)
        {
          const double force = weight * k.multiplier[s];
          if (force != 0)
            for (int c = 0; c < K::gdim; ++c)
              for (int col = 0; col < n; ++col)
                A[n * (K::gdim * a + c) + col] -= force * dn[c][col];
        });
  }
}

/// Derivative of the complementarity function through gap and normal.
template <class S, class M, Law L, bool Turning>
void constraint(double* A, const double* w, const double*, const double*,
                const int*, const std::uint8_t*, void*)
{
  using K = Mortar<S, M, L, Turning>;
  constexpr int n = K::num_dofs, gdim = K::gdim, size = K::size;
  const K k(w);
  const double* by_normal = L == Law::frictionless
                                ? nullptr
                                : K::at(w, Coefficient::normal_derivative);
  const auto zero = [](double d) { return d == 0; };
  if (std::all_of(k.gap_derivative, k.gap_derivative + K::width, zero)
      and (!by_normal
           or std::all_of(by_normal, by_normal + gdim * K::width, zero)))
    return;
  std::array<Vector<n>, S::nodes> dg{};
  k.pair.for_each_weight(
      [&](int a, int s, double weight)
      {
        for (int q = 0; q < gdim; ++q)
          dg[s][gdim * a + q] += weight * k.normals[s][q];
      });
  std::array<Vector<n>, gdim> dn{};
  if (Turning and k.pair.keeps() != Keeps::all)
  {
    const MortarVariation<S, M> d(k.pair);
    const auto factors = d.gap();
    for (int s = 0; s < S::nodes; ++s)
      d.add(factors[s], dg[s].data());
    if constexpr (L != Law::frictionless or not geometry::is_linear<S>)
      dn = d.normal();
    // Points of quadratic facets are beside those of their parts, so that the
    // vector from one to the other is not along the normal alone
    if constexpr (not geometry::is_linear<S>)
      for (int s = 0; s < S::nodes; ++s)
      {
        const auto separation = k.pair.distance(s);
        for (int q = 0; q < gdim; ++q)
          for (int col = 0; col < n; ++col)
            dg[s][col] += separation[q] * dn[q][col];
      }
  }
  for (int s = 0; s < S::nodes; ++s)
    for (int i = 0; i < size; ++i)
    {
      double* row = A + n * (size * s + i);
      const double by_gap = k.gap_derivative[size * s + i] / k.area[s];
      for (int col = 0; col < n; ++col)
        row[col] += by_gap * dg[s][col];
      if constexpr (Turning and L != Law::frictionless)
        for (int j = 0; j < gdim; ++j)
        {
          const double factor = by_normal[gdim * (gdim * s + i) + j]
                                * k.pair.area(s) / k.area[s];
          for (int col = 0; col < n; ++col)
            row[col] += factor * dn[j][col];
        }
    }
}

template <class S, class M, Law L, bool Turning>
void add(std::vector<Entry>& entries)
{
  using enum Coefficient;
  using K = Mortar<S, M, L, Turning>;
  const auto push = [&entries](std::string_view term, Kernel* function,
                               std::vector<Coefficient> extra)
  {
    std::vector<Coefficient> active{displacement, position, pair};
    active.insert(active.end(), extra.begin(), extra.end());
    entries.push_back({L, Turning ? "finite" : "small", term, M::nodes, S::gdim,
                       function, std::move(active), S::nodes});
  };
  push("gap", &mortar_gap<K>, {area});
  push("residual", &residual<K>, {multiplier});
  push("traction", &traction<K>, {area});
  if constexpr (L == Law::frictionless)
    push("constraint", &constraint<S, M, L, Turning>, {area, gap_derivative});
  else
  {
    push("normal", &mortar_normal<K>, {area});
    push("constraint", &constraint<S, M, L, Turning>,
         {area, gap_derivative, normal_derivative});
  }
  if constexpr (Turning)
    push("stiffness", &stiffness<S, M, L>, {multiplier});
}
} // namespace

std::vector<Entry> contactx::kernel::mortar()
{
  std::vector<Entry> entries;
  contactx::geometry::for_all_wholes(
      [&entries]<class S, class M>(S, M)
      {
        add<S, M, Law::frictionless, false>(entries);
        add<S, M, Law::frictionless, true>(entries);
        add<S, M, Law::frictional, false>(entries);
        add<S, M, Law::frictional, true>(entries);
      });
  return entries;
}
