// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#include "derivative_check.h"
#include "../math/scales.h"
#include "not_finite.h"
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

using namespace contactx;
using namespace contactx::solve;

namespace
{
/// Round-off of a force, over the terms of its sum
constexpr double force_round_off = 4 * math::sum_round_off;
/// Displacements of the quotients over the size of the scene
constexpr std::array increment_sizes{1e-4, 1e-6, 1e-8};
} // namespace

double contactx::solve::derivative_error(System& system,
                                         std::span<const double> direction,
                                         double size, double ahead)
{
  Bulk& bulk = *system.bulk();
  mesh::Ranks& ranks = system.halo()->ranks();
  const std::size_t n = system.num_displacements();
  const std::span<const std::int8_t> marks = bulk.markers();
  const std::vector<std::int8_t> markers(marks.begin(), marks.end());
  std::vector<double> direction_of(direction.begin(), direction.begin() + n);
  double most = 0;
  bool is_known = true;
  for (std::size_t i = 0; i < n; ++i)
  {
    if (markers[i] == 1)
      direction_of[i] = 0;
    most = std::max(most, std::abs(direction_of[i]));
    is_known = is_known and std::isfinite(direction_of[i]);
  }
  most = mesh::largest(ranks, most);
  if (not mesh::everywhere(ranks, is_known) or not(most > 0))
    return 0;
  for (double& w : direction_of)
    w /= most;

  const std::span<const double> now = bulk.displacements();
  const std::vector<double> u(now.begin(), now.end());
  const auto place = [&](double part)
  {
    std::vector<double> there(n);
    for (std::size_t i = 0; i < n; ++i)
      there[i] = u[i] + part * direction_of[i];
    bulk.set_displacements(there);
  };
  // Squares of the difference, of round-off, of both products and of what is
  // left of rigid motions
  std::array<double, 5> squares{};
  try
  {
    place(ahead);
    const std::span<const double> products = bulk.products(direction_of, 1);
    const std::vector<double> product(products.begin(), products.end());
    const std::span<const double> entries = bulk.diagonal();
    const std::vector<double> diagonal(entries.begin(), entries.end());
    std::vector<double> quotient(n);
    for (const int sign : {1, -1})
    {
      place(ahead + sign * size);
      const std::span<const double> forces = bulk.residual();
      for (std::size_t i = 0; i < n; ++i)
        quotient[i] += sign * forces[i] / (2 * size);
    }
    for (std::size_t i = 0; i < n; ++i)
      if (markers[i] != 1)
      {
        const std::array terms{
            product[i] - quotient[i],
            force_round_off * std::abs(u[i]) * diagonal[i] / size, product[i],
            quotient[i], math::negligible_part * direction_of[i] * diagonal[i]};
        for (std::size_t k = 0; k < terms.size(); ++k)
          squares[k] += terms[k] * terms[k];
      }
    bulk.set_displacements(u);
  }
  catch (const NotFinite&)
  {
    bulk.set_displacements(u);
    return 0;
  }
  catch (...)
  {
    bulk.set_displacements(u);
    throw;
  }
  ranks.reduce(std::span<double>(squares), mesh::Reduction::sum);
  const double largest
      = std::sqrt(std::max({squares[2], squares[3], squares[4]}));
  if (not std::ranges::all_of(squares,
                              [](double s) { return std::isfinite(s); })
      or largest == 0)
    return 0;
  return std::max(std::sqrt(squares[0]) - std::sqrt(squares[1]), 0.) / largest;
}

double contactx::solve::least_derivative_error(
    System& system, std::span<const double> direction, double extent)
{
  double error = std::numeric_limits<double>::infinity();
  const auto look = [&](double size, double ahead)
  {
    if (error > wrong_derivative)
      error = std::min(error, derivative_error(system, direction, size * extent,
                                               ahead * extent));
  };
  for (const double size : increment_sizes)
    look(size, 0);
  look(increment_sizes[1], increment_sizes[0]);
  look(increment_sizes[2], increment_sizes[0]);
  return error;
}
