// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#include "mortar_tied.h"
#include "../geometry/segment.h"
#include "mortar_terms.h"
#include "normal_hessian.h"

using namespace contactx;
using namespace contactx::kernel;

namespace
{
constexpr Law law = Law::tied;

template <class S, class M, bool Turning>
struct Tie
{
  static constexpr int gdim = S::gdim;
  static constexpr int slaves = S::nodes;
  static constexpr int width = gdim * slaves; ///< multipliers
  static constexpr int num_dofs = MortarPair<S, M>::num_dofs;
  static constexpr bool turning = Turning;
  using Slave = S;
  using Master = M;

  explicit Tie(const double* w)
      : pair(w), normals(pair.template normals<Turning>()),
        multiplier(at(w, Coefficient::multiplier)),
        area(at(w, Coefficient::area))
  {
  }

  static const double* at(const double* w, Coefficient c)
  {
    return MortarPair<S, M>::at(w, law, c);
  }

  /// Derivatives of area_s times the pair's share of the movement, by the
  /// positions: call f(s, component, dof, value).
  template <class Function>
  void derivative(Function&& f) const
  {
    pair.for_each_weight(
        [&](int a, int s, double weight)
        {
          for (int i = 0; i < gdim; ++i)
            f(s, i, gdim * a + i, weight);
        });
    if constexpr (Turning)
    {
      const contactx::geometry::FacetNormal<S> own(pair.slave);
      for (int t = 0; t < slaves; ++t)
        for (int k = 0; k < gdim; ++k)
        {
          Vector<gdim> dn; // of the pair's normal
          for (int i = 0; i < gdim; ++i)
            dn[i] = -own.derivative(i, t, k);
          for (int s = 0; s < slaves; ++s)
            if (pair.gap(s) != 0)
              for (int i = 0; i < gdim; ++i)
                f(s, i, gdim * t + k, -pair.gap(s) * dn[i]);
        }
    }
  }

  MortarPair<S, M> pair;
  std::array<Vector<gdim>, slaves> normals;
  const double *multiplier, *area;
};

template <class K>
void slip(double* b, const double* w, const double*, const double*, const int*,
          const std::uint8_t*, void*)
{
  const K k(w);
  for (int s = 0; s < K::slaves; ++s)
  {
    const auto d = k.pair.distance(s) - k.pair.gap(s) * k.normals[s];
    for (int i = 0; i < K::gdim; ++i)
      b[K::gdim * s + i] += d[i] / k.area[s];
  }
}

template <class K>
void residual(double* b, const double* w, const double*, const double*,
              const int*, const std::uint8_t*, void*)
{
  const K k(w);
  k.derivative([&](int s, int i, int dof, double value)
               { b[dof] -= k.multiplier[K::gdim * s + i] * value; });
}

template <class K>
void traction(double* A, const double* w, const double*, const double*,
              const int*, const std::uint8_t*, void*)
{
  const K k(w);
  k.derivative(
      [&](int s, int i, int dof, double value)
      {
        if (not is_elsewhere(k.area[s]))
          A[K::width * dof + K::gdim * s + i] -= value;
      });
}

template <class K>
void constraint(double* A, const double* w, const double*, const double*,
                const int*, const std::uint8_t*, void*)
{
  const K k(w);
  constexpr int gdim = K::gdim, n = K::num_dofs;
  const double* by_slip = K::at(w, Coefficient::slip_derivative);
  if (std::all_of(by_slip, by_slip + gdim * K::width,
                  [](double d) { return d == 0; }))
    return;
  k.derivative(
      [&](int s, int j, int dof, double value)
      {
        for (int i = 0; i < gdim; ++i)
          A[n * (gdim * s + i) + dof]
              += by_slip[gdim * (gdim * s + i) + j] * value / k.area[s];
      });
}

/// Derivative of the forces over an open gap: sum_s gap_s d^2 (lambda_s . n).
template <class K>
void stiffness(double* A, const double* w, const double*, const double*,
               const int*, const std::uint8_t*, void*)
{
  using S = typename K::Slave;
  const K k(w);
  Vector<K::gdim> sum{};
  for (int s = 0; s < K::slaves; ++s)
    for (int i = 0; i < K::gdim; ++i)
      sum[i] += k.pair.gap(s) * k.multiplier[K::gdim * s + i];
  if (dot(sum, sum) == 0)
    return;
  const auto xi = contactx::geometry::normal_place<S>();
  // The pair's normal is against that of the slave facet
  for_each_normal_hessian<S>(geometry::frame<S>(k.pair.slave, xi), xi, sum,
                             [A](int i, int j, double value)
                             { A[K::num_dofs * i + j] -= value; });
}

template <class K>
void add(std::vector<Entry>& entries)
{
  using enum Coefficient;
  const auto push = [&entries](std::string_view term, Kernel* function,
                               std::vector<Coefficient> extra)
  {
    std::vector<Coefficient> active{displacement, position, pair};
    active.insert(active.end(), extra.begin(), extra.end());
    entries.push_back({law, K::turning ? "finite" : "small", term,
                       K::Master::nodes, K::gdim, function, std::move(active),
                       K::slaves});
  };
  push("gap", &mortar_gap<K>, {area});
  push("normal", &mortar_normal<K>, {area});
  push("slip", &::slip<K>, {area});
  push("residual", &residual<K>, {multiplier});
  push("traction", &traction<K>, {area});
  push("constraint", &constraint<K>, {area, slip_derivative});
  if constexpr (K::turning)
    push("stiffness", &stiffness<K>, {multiplier});
}
} // namespace

std::vector<Entry> contactx::kernel::mortar_tied()
{
  std::vector<Entry> entries;
  contactx::geometry::for_all_wholes(
      [&entries]<class S, class M>(S, M)
      {
        add<Tie<S, M, false>>(entries);
        add<Tie<S, M, true>>(entries);
      });
  return entries;
}
