// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#include "mobility.h"
#include "../geometry/shape.h"
#include <algorithm>
#include <numeric>

using namespace contactx;
using namespace contactx::contact;

bool contactx::contact::all_free(std::span<const std::int32_t> nodes,
                                 std::span<const std::int8_t> free, int gdim)
{
  const auto is_free = [free, gdim](std::int32_t node)
  {
    const auto row = free.subspan(std::size_t(node) * gdim, gdim);
    return std::ranges::all_of(row, [](std::int8_t f) { return f != 0; });
  };
  return std::ranges::all_of(nodes, is_free);
}

void contactx::contact::pair_weights(int num_nodes, const double* xi,
                                     double* weight)
{
  weight[0] = 1;
  geometry::visit(num_nodes,
                  [xi, weight]<class F>(F)
                  {
                    geometry::Local<F> at;
                    std::copy_n(xi, F::tdim, at.begin());
                    const auto N = F::shape(at);
                    for (int l = 0; l < F::nodes; ++l)
                      weight[1 + l] = -N[l];
                  });
}

std::vector<double>
contactx::contact::free_squares(const kernel::Weights& weights,
                                std::span<const std::int8_t> free,
                                std::span<const std::int8_t> paired, int gdim)
{
  const std::size_t n = paired.size();
  std::vector<double> squares(n * gdim, 1);
  std::vector<std::int8_t> constrained(n, 0);
  for (std::size_t k = 0; k < weights.slaves.size(); ++k)
    if (paired[weights.slaves[k]]
        and not all_free({&weights.nodes[k], 1}, free, gdim))
      constrained[weights.slaves[k]] = 1;
  std::vector<std::size_t> some;
  for (std::size_t k = 0; k < weights.slaves.size(); ++k)
    if (constrained[weights.slaves[k]])
      some.push_back(k);
  const auto key = [&weights](std::size_t k)
  { return std::pair{weights.slaves[k], weights.nodes[k]}; };
  std::ranges::stable_sort(some, {}, key);
  for (std::size_t i = 0; i < n; ++i)
    if (constrained[i])
      std::fill_n(squares.begin() + gdim * i, gdim, 0.0);
  for (std::size_t first = 0; first < some.size();)
  {
    const auto [slave, node] = key(some[first]);
    double sum = 0;
    std::size_t k = first;
    for (; k < some.size() and key(some[k]) == std::pair{slave, node}; ++k)
      sum += weights.values[some[k]];
    for (int i = 0; i < gdim; ++i)
      if (free[std::size_t(node) * gdim + i])
        squares[std::size_t(slave) * gdim + i] += sum * sum;
    first = k;
  }
  return squares;
}
