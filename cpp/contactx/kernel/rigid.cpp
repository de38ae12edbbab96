// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#include "rigid.h"

using namespace contactx::kernel;

namespace
{
template <Law L, int D>
const double* at(const double* w, Coefficient c)
{
  return w + offset(L, c, 0, D);
}

template <Law L, int D>
ObstaclePair pair(const double* w)
{
  return read<ObstaclePair>(at<L, D>(w, Coefficient::pair));
}

template <Law L, int D>
ObstacleSlip slip_of(const double* w)
{
  return read<ObstacleSlip>(at<L, D>(w, Coefficient::slip));
}

template <Law L, int D>
double area(const double* w)
{
  return *at<L, D>(w, Coefficient::area);
}

template <Law L, int D>
void gap(double* b, const double* w, const double*, const double*, const int*,
         const std::uint8_t*, void*)
{
  b[0] += pair<L, D>(w).gap;
}

template <Law L, int D>
void normal(double* b, const double* w, const double*, const double*,
            const int*, const std::uint8_t*, void*)
{
  const auto normal = pair<L, D>(w).normal;
  for (int k = 0; k < D; ++k)
    b[k] += normal[k];
}

template <Law L, int D>
void slip(double* b, const double* w, const double*, const double*, const int*,
          const std::uint8_t*, void*)
{
  const auto slip = slip_of<L, D>(w).slip;
  for (int k = 0; k < D; ++k)
    b[k] += slip[k];
}

template <Law L, int D>
void residual(double* b, const double* w, const double*, const double*,
              const int*, const std::uint8_t*, void*)
{
  const double* multiplier = at<L, D>(w, Coefficient::multiplier);
  [[maybe_unused]] const auto normal = pair<L, D>(w).normal;
  for (int k = 0; k < D; ++k)
  {
    const double lambda
        = L == Law::frictionless ? *multiplier * normal[k] : multiplier[k];
    b[k] -= area<L, D>(w) * lambda;
  }
}

template <Law L, int D>
void traction(double* A, const double* w, const double*, const double*,
              const int*, const std::uint8_t*, void*)
{
  [[maybe_unused]] const auto normal = pair<L, D>(w).normal;
  for (int k = 0; k < D; ++k)
    if constexpr (L == Law::frictionless)
      A[k] -= area<L, D>(w) * normal[k];
    else
      A[D * k + k] -= area<L, D>(w);
}

template <Law L, int D>
void constraint(double* A, const double* w, const double*, const double*,
                const int*, const std::uint8_t*, void*)
{
  const double* by_gap = at<L, D>(w, Coefficient::gap_derivative);
  const ObstaclePair at_node = pair<L, D>(w);
  constexpr int rows = L == Law::frictionless ? 1 : D;
  for (int i = 0; i < rows; ++i)
    for (int k = 0; k < D; ++k)
      A[D * i + k] += by_gap[i] * at_node.gradient[k];
  if constexpr (L != Law::frictionless)
  {
    const double* by_slip = at<L, D>(w, Coefficient::slip_derivative);
    const double* by_normal = at<L, D>(w, Coefficient::normal_derivative);
    const auto ds = slip_of<L, D>(w).derivative;
    const auto& dn = at_node.curvature;
    for (int i = 0; i < D; ++i)
      for (int k = 0; k < D; ++k)
        for (int j = 0; j < D; ++j)
          A[D * i + k] += by_slip[D * i + j] * ds[D * j + k]
                          + by_normal[D * i + j] * dn[D * j + k];
  }
}

/// Derivative of the residual with respect to the displacement: the normal
/// that a scalar multiplier acts along turns.
template <int D>
void stiffness(double* A, const double* w, const double*, const double*,
               const int*, const std::uint8_t*, void*)
{
  constexpr Law L = Law::frictionless;
  const double force = area<L, D>(w) * *at<L, D>(w, Coefficient::multiplier);
  const auto turn = pair<L, D>(w).curvature;
  for (int k = 0; k < D * D; ++k)
    A[k] -= force * turn[k];
}

template <Law L, int D>
void add(std::vector<Entry>& entries)
{
  using C = Coefficient;
  for (std::string_view s : {"finite", "small"})
  {
    const auto push = [&entries, s](std::string_view term, Kernel* function,
                                    std::vector<Coefficient> active)
    { entries.push_back({L, s, term, 0, D, function, std::move(active)}); };
    push("gap", &gap<L, D>, {C::pair});
    push("residual", &residual<L, D>, {C::pair, C::multiplier, C::area});
    push("traction", &traction<L, D>, {C::pair, C::area});
    if constexpr (L == Law::frictionless)
    {
      push("constraint", &constraint<L, D>, {C::pair, C::gap_derivative});
      if (s == "finite")
        push("stiffness", &stiffness<D>, {C::pair, C::multiplier, C::area});
    }
    else
    {
      push("constraint", &constraint<L, D>,
           {C::pair, C::slip, C::gap_derivative, C::slip_derivative,
            C::normal_derivative});
      push("normal", &normal<L, D>, {C::pair});
      push("slip", &slip<L, D>, {C::slip});
    }
  }
}
} // namespace

std::vector<Entry> contactx::kernel::rigid()
{
  std::vector<Entry> entries;
  add<Law::frictionless, 2>(entries);
  add<Law::frictionless, 3>(entries);
  add<Law::frictional, 2>(entries);
  add<Law::frictional, 3>(entries);
  add<Law::tied, 2>(entries);
  add<Law::tied, 3>(entries);
  return entries;
}
