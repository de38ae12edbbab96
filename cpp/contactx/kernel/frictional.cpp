// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#include "frictional.h"
#include "node_state.h"
#include "relative.h"

using namespace contactx;
using namespace contactx::kernel;

namespace
{
template <class Kinematics>
void gap(double* b, const double* w, const double*, const double*, const int*,
         const std::uint8_t*, void*)
{
  b[0] += Kinematics(w).point.gap;
}

template <class Kinematics>
void normal(double* b, const double* w, const double*, const double*,
            const int*, const std::uint8_t*, void*)
{
  const auto n = Kinematics(w).point.normal;
  for (std::size_t k = 0; k < n.size(); ++k)
    b[k] += n[k];
}

/// Part of `w` across the normal.
template <std::size_t D>
std::array<double, D> tangential_part(const std::array<double, D>& w,
                                      const std::array<double, D>& n)
{
  return w - dot(n, w) * n;
}

template <class Kinematics>
void slip(double* b, const double* w, const double*, const double*, const int*,
          const std::uint8_t*, void*)
{
  const Kinematics kinematics(w);
  const auto s
      = tangential_part(Relative(kinematics, w).value, kinematics.point.normal);
  for (std::size_t k = 0; k < s.size(); ++k)
    b[k] += s[k];
}

/// Forces -A lambda weight on the nodes of the pair.
template <class Kinematics>
void residual(double* b, const double* w, const double*, const double*,
              const int*, const std::uint8_t*, void*)
{
  using F = typename Kinematics::F;
  const auto weight = Kinematics(w).point.weight;
  const NodeState<F> node(w);
  for (int a = 0; a <= F::nodes; ++a)
    for (int k = 0; k < F::gdim; ++k)
      b[F::gdim * a + k] -= node.area * node.multiplier[k] * weight[a];
}

/// Derivative of the residual with respect to the multiplier.
template <class Kinematics>
void traction(double* A, const double* w, const double*, const double*,
              const int*, const std::uint8_t*, void*)
{
  using F = typename Kinematics::F;
  const auto weight = Kinematics(w).point.weight;
  const NodeState<F> node(w);
  for (int a = 0; a <= F::nodes; ++a)
    for (int k = 0; k < F::gdim; ++k)
      A[F::gdim * (F::gdim * a + k) + k] -= node.area * weight[a];
}

/// Derivative of the residual with respect to the displacement: the projection
/// moves.
template <class F>
void stiffness(double* A, const double* w, const double*, const double*,
               const int*, const std::uint8_t*, void*)
{
  constexpr int n = Pair<F>::num_dofs;
  const NodeState<F> node(w);
  if (std::all_of(node.multiplier, node.multiplier + F::gdim,
                  [](double t) { return t == 0; }))
    return;
  const Finite<F> kinematics(w);
  const Variation<F> d = kinematics.variation();
  const auto dN = F::derivative(kinematics.point.xi);
  for (int l = 0; l < F::nodes; ++l)
  {
    Vector<n> dweight{};
    for (int b = 0; b < F::tdim; ++b)
      dweight = dweight - dN[b][l] * d.xi[b];
    for (int k = 0; k < F::gdim; ++k)
    {
      double* row = A + n * (F::gdim * (l + 1) + k);
      const double force = node.area * node.multiplier[k];
      for (int col = 0; col < n; ++col)
        row[col] -= force * dweight[col];
    }
  }
}

/// Derivative of the complementarity function with respect to the
/// displacement, through gap, slip and normal.
template <class Kinematics>
void constraint(double* A, const double* w, const double*, const double*,
                const int*, const std::uint8_t*, void*)
{
  using F = typename Kinematics::F;
  constexpr int n = Pair<F>::num_dofs;
  constexpr int gdim = F::gdim;
  const NodeState<F> node(w);
  if (std::all_of(node.slip_derivative, node.slip_derivative + gdim * gdim,
                  [](double d) { return d == 0; })
      and std::all_of(node.gap_derivative, node.gap_derivative + gdim,
                      [](double d) { return d == 0; }))
    return;
  const Kinematics kinematics(w);
  const Vector<gdim>& normal = kinematics.point.normal;
  const Relative movement(kinematics, w);
  const auto dw = movement.derivative();

  // Of the slip: (I - n n^T) dw, and what the turning normal adds
  std::array<Vector<n>, gdim> ds = dw;
  Vector<n> along{};
  for (int k = 0; k < gdim; ++k)
    along = along + normal[k] * dw[k];
  const auto add
      = [A, &node](const Vector<n>& dg, const std::array<Vector<n>, gdim>& slip,
                   const std::array<Vector<n>, gdim>* turn)
  {
    for (int i = 0; i < gdim; ++i)
    {
      Vector<n> row = node.gap_derivative[i] * dg;
      for (int j = 0; j < gdim; ++j)
      {
        row = row + node.slip_derivative[gdim * i + j] * slip[j];
        if (turn)
          row = row + node.normal_derivative[gdim * i + j] * (*turn)[j];
      }
      for (int col = 0; col < n; ++col)
        A[n * i + col] += row[col];
    }
  };
  if constexpr (Kinematics::turning)
  {
    const Variation<F> d = kinematics.variation();
    for (int k = 0; k < gdim; ++k)
      along = along + movement.value[k] * d.normal[k];
    const double height = dot(normal, movement.value);
    for (int k = 0; k < gdim; ++k)
      ds[k] = ds[k] - normal[k] * along - height * d.normal[k];
    add(d.gap, ds, &d.normal);
  }
  else
  {
    for (int k = 0; k < gdim; ++k)
      ds[k] = ds[k] - normal[k] * along;
    add(kinematics.gap_derivative(), ds, nullptr);
  }
}

template <class Kinematics>
void add(std::vector<Entry>& entries)
{
  using enum Coefficient;
  using F = typename Kinematics::F;
  const auto push = [&entries](std::string_view term, Kernel* function,
                               std::vector<Coefficient> active)
  {
    entries.push_back({Law::frictional, Kinematics::name, term, F::nodes,
                       F::gdim, function, std::move(active)});
  };
  push("gap", &gap<Kinematics>, {displacement, position, pair});
  push("normal", &normal<Kinematics>, {displacement, position, pair});
  push("slip", &::slip<Kinematics>,
       {displacement, position, pair, Coefficient::slip});
  push("residual", &residual<Kinematics>,
       {displacement, position, pair, multiplier, area});
  push("traction", &traction<Kinematics>, {displacement, position, pair, area});
  push("constraint", &constraint<Kinematics>,
       {displacement, position, pair, Coefficient::slip, gap_derivative,
        slip_derivative, normal_derivative});
  if constexpr (Kinematics::turning)
    push("stiffness", &stiffness<F>,
         {displacement, position, pair, multiplier, area});
}
} // namespace

std::vector<Entry> contactx::kernel::frictional()
{
  std::vector<Entry> entries;
  for_all_kinematics([&entries]<class K>(std::type_identity<K>)
                     { add<K>(entries); });
  return entries;
}
