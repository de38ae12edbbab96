// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#include "tied.h"
#include "node_state.h"
#include "normal_hessian.h"
#include "relative.h"

using namespace contactx;
using namespace contactx::kernel;

namespace
{
/// A tie's pair: it is never projected.
template <class Base>
struct Tie
{
  using F = typename Base::F;
  static constexpr std::string_view name = Base::name;
  static constexpr bool turning = Base::turning;

  explicit Tie(const double* w) : pair(w) {}

  Pair<F> pair;
};

template <class K>
Vector<K::F::gdim> normal_of(const K& tie, const Relative<K>& movement)
{
  if constexpr (K::turning)
    return movement.frame.n;
  else
    return tie.pair.normal;
}

template <class K>
void gap(double* b, const double* w, const double*, const double*, const int*,
         const std::uint8_t*, void*)
{
  using F = typename K::F;
  const K tie(w);
  const Relative movement(tie, w);
  const auto d = tie.pair.slave
                 - geometry::combine<F>(F::shape(movement.xi), tie.pair.master);
  b[0] += dot(normal_of(tie, movement), d);
}

template <class K>
void normal(double* b, const double* w, const double*, const double*,
            const int*, const std::uint8_t*, void*)
{
  const K tie(w);
  const auto n = normal_of(tie, Relative(tie, w));
  for (std::size_t k = 0; k < n.size(); ++k)
    b[k] += n[k];
}

template <class K>
void slip(double* b, const double* w, const double*, const double*, const int*,
          const std::uint8_t*, void*)
{
  const K tie(w);
  const auto movement = Relative(tie, w).value;
  for (std::size_t k = 0; k < movement.size(); ++k)
    b[k] += movement[k];
}

template <class K>
void residual(double* b, const double* w, const double*, const double*,
              const int*, const std::uint8_t*, void*)
{
  using F = typename K::F;
  const K tie(w);
  const auto dw = Relative(tie, w).derivative();
  const NodeState<F> node(w);
  for (int i = 0; i < F::gdim; ++i)
    for (int col = 0; col < Pair<F>::num_dofs; ++col)
      b[col] -= node.area * node.multiplier[i] * dw[i][col];
}

template <class K>
void traction(double* A, const double* w, const double*, const double*,
              const int*, const std::uint8_t*, void*)
{
  using F = typename K::F;
  const K tie(w);
  const auto dw = Relative(tie, w).derivative();
  const double area = NodeState<F>(w).area;
  for (int i = 0; i < F::gdim; ++i)
    for (int col = 0; col < Pair<F>::num_dofs; ++col)
      A[F::gdim * col + i] -= area * dw[i][col];
}

template <class K>
void constraint(double* A, const double* w, const double*, const double*,
                const int*, const std::uint8_t*, void*)
{
  using F = typename K::F;
  constexpr int n = Pair<F>::num_dofs;
  const K tie(w);
  const auto dw = Relative(tie, w).derivative();
  const NodeState<F> node(w);
  for (int i = 0; i < F::gdim; ++i)
    for (int j = 0; j < F::gdim; ++j)
      for (int col = 0; col < n; ++col)
        A[n * i + col] += node.slip_derivative[F::gdim * i + j] * dw[j][col];
}

/// Derivative of the forces: -A lambda . d^2 w = A g_0 d^2 (lambda . n).
template <class F>
void stiffness(double* A, const double* w, const double*, const double*,
               const int*, const std::uint8_t*, void*)
{
  using K = Tie<Finite<F>>;
  constexpr int gdim = F::gdim;
  constexpr int n = Pair<F>::num_dofs;
  const K tie(w);
  const Relative movement(tie, w);
  if (movement.gap == 0)
    return;
  const NodeState<F> node(w);
  Vector<gdim> lambda;
  std::copy_n(node.multiplier, gdim, lambda.begin());
  const double factor = node.area * movement.gap;
  for_each_normal_hessian<F>(
      movement.frame, movement.xi, lambda,
      [A, factor](int i, int j, double value)
      { A[n * (gdim + i) + gdim + j] += factor * value; });
}

template <class Kinematics>
void add(std::vector<Entry>& entries)
{
  using enum Coefficient;
  using F = typename Kinematics::F;
  using K = Tie<Kinematics>;
  const auto push = [&entries](std::string_view term, Kernel* function,
                               std::vector<Coefficient> extra)
  {
    std::vector<Coefficient> active{displacement, position, pair,
                                    Coefficient::slip};
    active.insert(active.end(), extra.begin(), extra.end());
    entries.push_back({Law::tied, K::name, term, F::nodes, F::gdim, function,
                       std::move(active)});
  };
  push("gap", &gap<K>, {});
  push("normal", &normal<K>, {});
  push("slip", &::slip<K>, {});
  push("residual", &residual<K>, {multiplier, area});
  push("traction", &traction<K>, {area});
  push("constraint", &constraint<K>, {slip_derivative});
  if constexpr (K::turning)
    push("stiffness", &stiffness<F>, {multiplier, area});
}
} // namespace

std::vector<Entry> contactx::kernel::tied()
{
  std::vector<Entry> entries;
  for_all_kinematics([&entries]<class K>(std::type_identity<K>)
                     { add<K>(entries); });
  return entries;
}
