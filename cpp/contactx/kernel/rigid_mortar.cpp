// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#include "rigid_mortar.h"
#include <algorithm>
#include <type_traits>

using namespace contactx::kernel;

namespace
{
/// What the kernels read: contact law L, N slave nodes, dimension D.
template <Law L, int N, int D>
struct Facet
{
  static constexpr RigidMortarLayout layout{N, D};
  static constexpr int size = L == Law::frictionless ? 1 : D;
  static constexpr int num_dofs = N * D;

  explicit Facet(const double* w) : w(w), pair(at(Coefficient::pair)) {}

  const double* at(Coefficient c) const { return w + offset(L, c, 0, D, N); }

  /// int Phi_s as a share of the slave node's area.
  double share(int s) const
  {
    return pair[layout.area + s] / at(Coefficient::area)[s];
  }

  /// Derivative of the gap's integral by a node.
  const double* gradient(int s, int t) const
  {
    return pair + layout.gradient + (N * s + t) * D;
  }

  const double* normal(int s) const { return pair + layout.normal + D * s; }

  /// Derivative of the normal's integral by a node.
  const double* curvature(int s, int t) const
  {
    return pair + layout.curvature + (N * s + t) * D * D;
  }

  const double* w;
  const double* pair;
};

template <class F>
struct Sizes;
template <Law L, int N, int D>
struct Sizes<Facet<L, N, D>>
{
  static constexpr int nodes = N, gdim = D;
  static constexpr bool vector = L != Law::frictionless;
};

template <class F>
void gap(double* b, const double* w, const double*, const double*, const int*,
         const std::uint8_t*, void*)
{
  const F f(w);
  for (int s = 0; s < Sizes<F>::nodes; ++s)
    b[s] += f.pair[F::layout.gap + s] / f.at(Coefficient::area)[s];
}

template <class F>
void normal(double* b, const double* w, const double*, const double*,
            const int*, const std::uint8_t*, void*)
{
  const F f(w);
  constexpr int D = Sizes<F>::gdim;
  for (int s = 0; s < Sizes<F>::nodes; ++s)
    for (int k = 0; k < D; ++k)
      b[D * s + k] += f.normal(s)[k] / f.at(Coefficient::area)[s];
}

/// Share in the position of each slave node: all facets together give it.
template <class F>
void slip(double* b, const double* w, const double*, const double*, const int*,
          const std::uint8_t*, void*)
{
  const F f(w);
  constexpr int D = Sizes<F>::gdim;
  const double* u = f.at(Coefficient::displacement);
  const double* x = f.at(Coefficient::position);
  for (int s = 0; s < Sizes<F>::nodes; ++s)
    for (int k = 0; k < D; ++k)
      b[D * s + k] += f.share(s) * (x[D * s + k] + u[D * s + k]);
}

/// Call add(s, component of the displacement, component of the multiplier,
/// force of a unit multiplier).
template <class F, class Add>
void for_each_force(const F& f, Add&& add)
{
  for (int s = 0; s < Sizes<F>::nodes; ++s)
    for (int k = 0; k < Sizes<F>::gdim; ++k)
      if constexpr (Sizes<F>::vector)
        add(s, k, k, f.pair[F::layout.area + s]);
      else
        add(s, k, 0, f.normal(s)[k]);
}

template <class F>
void residual(double* b, const double* w, const double*, const double*,
              const int*, const std::uint8_t*, void*)
{
  const F f(w);
  const double* multiplier = f.at(Coefficient::multiplier);
  for_each_force(
      f, [&](int s, int k, int i, double force)
      { b[Sizes<F>::gdim * s + k] -= force * multiplier[F::size * s + i]; });
}

template <class F>
void traction(double* A, const double* w, const double*, const double*,
              const int*, const std::uint8_t*, void*)
{
  const F f(w);
  constexpr int width = F::size * Sizes<F>::nodes;
  for_each_force(f,
                 [&](int s, int k, int i, double force)
                 {
                   if (not is_elsewhere(f.at(Coefficient::area)[s]))
                     A[width * (Sizes<F>::gdim * s + k) + F::size * s + i]
                         -= force;
                 });
}

template <class F>
void constraint(double* A, const double* w, const double*, const double*,
                const int*, const std::uint8_t*, void*)
{
  const F f(w);
  constexpr int D = Sizes<F>::gdim, N = Sizes<F>::nodes, n = F::num_dofs;
  const double* by_gap = f.at(Coefficient::gap_derivative);
  const double* area = f.at(Coefficient::area);
  for (int s = 0; s < N; ++s)
    for (int i = 0; i < F::size; ++i)
    {
      double* row = A + n * (F::size * s + i);
      const int at = F::size * s + i;
      for (int t = 0; t < N; ++t)
        for (int k = 0; k < D; ++k)
        {
          double d = by_gap[at] * f.gradient(s, t)[k];
          if constexpr (Sizes<F>::vector)
            for (int j = 0; j < D; ++j)
              d += f.at(Coefficient::normal_derivative)[D * at + j]
                   * f.curvature(s, t)[D * j + k];
          row[D * t + k] += d / area[s];
        }
      if constexpr (Sizes<F>::vector)
        for (int k = 0; k < D; ++k)
          row[D * s + k]
              += f.at(Coefficient::slip_derivative)[D * at + k] * f.share(s);
    }
}

/// Derivative of the residual with respect to the displacement: the normal
/// that a scalar multiplier acts along turns.
template <class F>
void stiffness(double* A, const double* w, const double*, const double*,
               const int*, const std::uint8_t*, void*)
{
  const F f(w);
  constexpr int D = Sizes<F>::gdim, N = Sizes<F>::nodes, n = F::num_dofs;
  const double* p = f.at(Coefficient::multiplier);
  for (int s = 0; s < N; ++s)
    for (int t = 0; t < N; ++t)
      for (int k = 0; k < D; ++k)
        for (int q = 0; q < D; ++q)
          A[n * (D * s + k) + D * t + q] -= p[s] * f.curvature(s, t)[D * k + q];
}

template <Law L, int N, int D>
void add(std::vector<Entry>& entries)
{
  using enum Coefficient;
  using F = Facet<L, N, D>;
  for (std::string_view sliding : {"finite", "small"})
  {
    const auto push = [&](std::string_view term, Kernel* function,
                          std::vector<Coefficient> active)
    {
      entries.push_back(
          {L, sliding, term, 0, D, function, std::move(active), N});
    };
    push("gap", &gap<F>, {pair, area});
    push("residual", &residual<F>, {pair, multiplier});
    push("traction", &traction<F>, {pair, area});
    if constexpr (L == Law::frictionless)
    {
      push("constraint", &constraint<F>, {pair, area, gap_derivative});
      if (sliding == "finite")
        push("stiffness", &stiffness<F>, {pair, multiplier});
    }
    else
    {
      push("constraint", &constraint<F>,
           {pair, area, gap_derivative, slip_derivative, normal_derivative});
      push("normal", &normal<F>, {pair, area});
      push("slip", &::slip<F>, {displacement, position, pair, area});
    }
  }
}
} // namespace

std::vector<Entry> contactx::kernel::rigid_mortar()
{
  std::vector<Entry> entries;
  add<Law::frictionless, 2, 2>(entries);
  add<Law::frictionless, 3, 3>(entries);
  add<Law::frictionless, 4, 3>(entries);
  add<Law::frictional, 2, 2>(entries);
  add<Law::frictional, 3, 3>(entries);
  add<Law::frictional, 4, 3>(entries);
  return entries;
}
