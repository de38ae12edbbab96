// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#include "frictionless.h"
#include "kinematics.h"

using namespace contactx;
using namespace contactx::kernel;

namespace
{
template <class F>
double value(const double* w, Coefficient c)
{
  return w[offset(Law::frictionless, c, F::nodes, F::gdim)];
}

/// Gap of the slave node.
template <class Kinematics>
void gap(double* b, const double* w, const double*, const double*, const int*,
         const std::uint8_t*, void*)
{
  b[0] += Kinematics(w).point.gap;
}

/// Forces -A p n weight on the nodes of the pair.
template <class Kinematics>
void residual(double* b, const double* w, const double*, const double*,
              const int*, const std::uint8_t*, void*)
{
  using F = typename Kinematics::F;
  const auto c = Kinematics(w).point;
  const double force
      = value<F>(w, Coefficient::area) * value<F>(w, Coefficient::multiplier);
  for (int a = 0; a <= F::nodes; ++a)
    for (int k = 0; k < F::gdim; ++k)
      b[F::gdim * a + k] -= force * c.normal[k] * c.weight[a];
}

/// Derivative of the residual with respect to the multiplier.
template <class Kinematics>
void traction(double* A, const double* w, const double*, const double*,
              const int*, const std::uint8_t*, void*)
{
  using F = typename Kinematics::F;
  const auto c = Kinematics(w).point;
  const double area = value<F>(w, Coefficient::area);
  for (int a = 0; a <= F::nodes; ++a)
    for (int k = 0; k < F::gdim; ++k)
      A[F::gdim * a + k] -= area * c.normal[k] * c.weight[a];
}

/// Derivative of the complementarity function with respect to the
/// displacement, through the gap.
template <class Kinematics>
void constraint(double* A, const double* w, const double*, const double*,
                const int*, const std::uint8_t*, void*)
{
  using F = typename Kinematics::F;
  const double factor = value<F>(w, Coefficient::gap_derivative);
  if (factor == 0)
    return;
  const auto dg = Kinematics(w).gap_derivative();
  for (std::size_t i = 0; i < dg.size(); ++i)
    A[i] += factor * dg[i];
}

/// Derivative of the residual with respect to the displacement: the normal
/// turns and the projection moves.
template <class F>
void stiffness(double* A, const double* w, const double*, const double*,
               const int*, const std::uint8_t*, void*)
{
  constexpr int n = Pair<F>::num_dofs;
  const double force
      = value<F>(w, Coefficient::area) * value<F>(w, Coefficient::multiplier);
  if (force == 0)
    return;
  const Finite<F> kinematics(w);
  const ContactPoint<F>& c = kinematics.point;
  const Variation<F> d(kinematics.pair, c);
  const auto dN = F::derivative(c.xi);
  for (int a = 0; a <= F::nodes; ++a)
  {
    Vector<n> dweight{};
    if (a > 0)
      for (int b = 0; b < F::tdim; ++b)
        dweight = dweight - dN[b][a - 1] * d.xi[b];
    for (int k = 0; k < F::gdim; ++k)
    {
      double* row = A + n * (F::gdim * a + k);
      for (int col = 0; col < n; ++col)
        row[col]
            -= force
               * (d.normal[k][col] * c.weight[a] + c.normal[k] * dweight[col]);
    }
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
    entries.push_back({Law::frictionless, Kinematics::name, term, F::nodes,
                       F::gdim, function, std::move(active)});
  };
  push("gap", &gap<Kinematics>, {displacement, position, pair});
  push("residual", &residual<Kinematics>,
       {displacement, position, pair, multiplier, area});
  push("traction", &traction<Kinematics>, {displacement, position, pair, area});
  push("constraint", &constraint<Kinematics>,
       {displacement, position, pair, gap_derivative});
  if constexpr (Kinematics::turning)
    push("stiffness", &stiffness<F>,
         {displacement, position, pair, multiplier, area});
}
} // namespace

std::vector<Entry> contactx::kernel::frictionless()
{
  std::vector<Entry> entries;
  for_all_kinematics([&entries]<class K>(std::type_identity<K>)
                     { add<K>(entries); });
  return entries;
}
