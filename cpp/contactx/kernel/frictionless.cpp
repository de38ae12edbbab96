// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#include "frictionless.h"
#include "variation.h"

using namespace contactx;
using namespace contactx::kernel;

namespace
{
/// Kinematics of finite sliding: everything is current.
template <class Facet>
struct Finite
{
  using F = Facet;
  static constexpr std::string_view name = "finite";

  explicit Finite(const double* w) : pair(w), point(project(pair)) {}

  Vec<Pair<F>::num_dofs> gap_derivative() const
  {
    return Variation<F>(pair, point).gap;
  }

  Pair<F> pair;
  ContactPoint<F> point;
};

/// Kinematics of small sliding: projection and normal are those of the search,
/// the gap is linear in the displacement.
template <class Facet>
struct Small
{
  using F = Facet;
  static constexpr std::string_view name = "small";

  explicit Small(const double* w) : point(held(Pair<F>(w))) {}

  Vec<Pair<F>::num_dofs> gap_derivative() const
  {
    Vec<Pair<F>::num_dofs> dg;
    for (int a = 0; a <= F::nodes; ++a)
      for (int k = 0; k < F::gdim; ++k)
        dg[F::gdim * a + k] = point.normal[k] * point.weight[a];
    return dg;
  }

  ContactPoint<F> point;

private:
  static ContactPoint<F> held(const Pair<F>& pair)
  {
    return contact_point(pair, pair.xi, pair.normal);
  }
};

template <class F>
double value(const double* w, Coefficient c)
{
  return w[offset(c, F::nodes, F::gdim)];
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
    Vec<n> dweight{};
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
void add_common(std::vector<Entry>& entries)
{
  using enum Coefficient;
  constexpr auto s = Kinematics::name;
  constexpr int n = Kinematics::F::nodes;
  constexpr int gdim = Kinematics::F::gdim;
  entries.push_back(
      {s, "gap", n, gdim, &gap<Kinematics>, {displacement, position, pair}});
  entries.push_back({s,
                     "residual",
                     n,
                     gdim,
                     &residual<Kinematics>,
                     {displacement, position, pair, multiplier, area}});
  entries.push_back({s,
                     "traction",
                     n,
                     gdim,
                     &traction<Kinematics>,
                     {displacement, position, pair, area}});
  entries.push_back({s,
                     "constraint",
                     n,
                     gdim,
                     &constraint<Kinematics>,
                     {displacement, position, pair, gap_derivative}});
}

template <class F>
void add(std::vector<Entry>& entries)
{
  using enum Coefficient;
  add_common<Small<F>>(entries);
  add_common<Finite<F>>(entries);
  entries.push_back({Finite<F>::name,
                     "stiffness",
                     F::nodes,
                     F::gdim,
                     &stiffness<F>,
                     {displacement, position, pair, multiplier, area}});
}
} // namespace

std::vector<Entry> contactx::kernel::frictionless()
{
  std::vector<Entry> entries;
  add<facet::Segment>(entries);
  add<facet::Triangle>(entries);
  add<facet::Quadrilateral>(entries);
  return entries;
}
