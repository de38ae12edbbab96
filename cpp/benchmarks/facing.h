// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#pragma once

#include <algorithm>
#include <contactx/geometry/segment.h>
#include <contactx/kernel/layout.h>
#include <contactx/search/facet_search.h>
#include <random>

namespace contactx::benchmarks
{
/// @brief A slave facet and a master facet of about its size that share a part,
/// as the kernels' coefficients.
/// @param[out] w Coefficients.
/// @param[in] law Contact law.
/// @param[in] random Random numbers.
template <class S, class M>
void fill_facing(double* w, kernel::Law law, std::mt19937& random)
{
  using kernel::Coefficient;
  constexpr int D = S::gdim, num_nodes = S::nodes + M::nodes;
  std::uniform_real_distribution<double> unit(0, 1);
  const auto at = [w, law](Coefficient c)
  { return w + kernel::offset(law, c, M::nodes, D, S::nodes); };
  double* x = at(Coefficient::position);
  double* u = at(Coefficient::displacement);
  std::vector<std::int32_t> nodes(num_nodes);
  for (int a = 0; a < num_nodes; ++a)
    nodes[a] = a;
  search::FacetSearch search(
      {0, S::nodes}, {nodes.begin(), nodes.begin() + S::nodes}, {0, M::nodes},
      {nodes.begin() + S::nodes, nodes.end()}, D);
  geometry::Integrals found;
  do
  {
    geometry::Local<S> shift;
    for (double& c : shift)
      c = 0.6 * unit(random) - 0.3;
    std::vector<double> current(num_nodes * D);
    for (int a = 0; a < num_nodes; ++a)
    {
      geometry::Local<S> r;
      if (a < S::nodes)
      {
        // The slave facet looks at the master: turned over
        const auto& v = S::vertices[a];
        for (int k = 0; k < S::tdim; ++k)
          r[k] = S::tdim == 1 ? 1 - v[k] : v[1 - k];
      }
      else
        r = M::vertices[a - S::nodes] + shift;
      for (int k = 0; k < D; ++k)
      {
        const int i = D * a + k;
        x[i] = (k < S::tdim ? r[k] : 0) + 0.1 * unit(random);
        u[i] = 1e-3 * unit(random);
        current[i] = x[i] + u[i];
      }
    }
    found = geometry::integrals(search.slave(), search.master(),
                                search.find(current, 1, 0), current,
                                {x, current.size()}, D);
  } while (found.area[0] == 0);
  constexpr kernel::MortarLayout layout(S::nodes, M::nodes);
  double* p = at(Coefficient::pair);
  for (int s = 0; s < S::nodes; ++s)
  {
    for (int l = 0; l < M::nodes; ++l)
      p[layout.weight + M::nodes * s + l]
          = found.weight[geometry::most_nodes * s + l];
    for (int t = 0; t < S::nodes; ++t)
      p[layout.dual + S::nodes * s + t]
          = found.dual[geometry::most_nodes * s + t];
    p[layout.gap + s] = found.gap[s];
  }
  std::copy_n(found.normal.begin(), 3, p + layout.normal);
}
} // namespace contactx::benchmarks
