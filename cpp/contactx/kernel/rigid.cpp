// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#include "rigid.h"

using namespace contactx::kernel;

namespace
{
template <int D>
const double* pair(const double* w)
{
  return w + offset(Coefficient::pair, 0, D);
}

template <int D>
double value(const double* w, Coefficient c)
{
  return w[offset(c, 0, D)];
}

template <int D>
double force(const double* w)
{
  return value<D>(w, Coefficient::area) * value<D>(w, Coefficient::multiplier);
}

template <int D>
void gap(double* b, const double* w, const double*, const double*, const int*,
         const std::uint8_t*, void*)
{
  b[0] += pair<D>(w)[rigid_gap];
}

template <int D>
void residual(double* b, const double* w, const double*, const double*,
              const int*, const std::uint8_t*, void*)
{
  for (int k = 0; k < D; ++k)
    b[k] -= force<D>(w) * pair<D>(w)[rigid_normal + k];
}

template <int D>
void traction(double* A, const double* w, const double*, const double*,
              const int*, const std::uint8_t*, void*)
{
  for (int k = 0; k < D; ++k)
    A[k] -= value<D>(w, Coefficient::area) * pair<D>(w)[rigid_normal + k];
}

template <int D>
void constraint(double* A, const double* w, const double*, const double*,
                const int*, const std::uint8_t*, void*)
{
  for (int k = 0; k < D; ++k)
    A[k] += value<D>(w, Coefficient::gap_derivative)
            * pair<D>(w)[rigid_gradient + k];
}

template <int D>
void stiffness(double* A, const double* w, const double*, const double*,
               const int*, const std::uint8_t*, void*)
{
  for (int k = 0; k < D * D; ++k)
    A[k] -= force<D>(w) * pair<D>(w)[rigid_curvature + k];
}

template <int D>
void add(std::vector<Entry>& entries)
{
  using enum Coefficient;
  for (std::string_view s : {"finite", "small"})
  {
    entries.push_back({s, "gap", 0, D, &gap<D>, {Coefficient::pair}});
    entries.push_back({s,
                       "residual",
                       0,
                       D,
                       &residual<D>,
                       {Coefficient::pair, multiplier, area}});
    entries.push_back(
        {s, "traction", 0, D, &traction<D>, {Coefficient::pair, area}});
    entries.push_back({s,
                       "constraint",
                       0,
                       D,
                       &constraint<D>,
                       {Coefficient::pair, gap_derivative}});
  }
  entries.push_back({"finite",
                     "stiffness",
                     0,
                     D,
                     &stiffness<D>,
                     {Coefficient::pair, multiplier, area}});
}
} // namespace

std::vector<Entry> contactx::kernel::rigid_frictionless()
{
  std::vector<Entry> entries;
  add<2>(entries);
  add<3>(entries);
  return entries;
}
