// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

// Contact of two surfaces by contactx's core alone: three slave nodes over a
// segment, their gaps, forces and stiffness. Fails where they are not what the
// gap n . (x_s - x_1) and its first two derivatives give.

#include <algorithm>
#include <array>
#include <cmath>
#include <contactx/kernel/assemble.h>
#include <contactx/search/pairing.h>
#include <contactx/version.h>
#include <cstdio>
#include <numbers>
#include <string_view>

using namespace contactx;

// What PETSc declares in its headers: contactx must not hide it
using Vec = struct _p_Vec*;

int main()
{
  [[maybe_unused]] const Vec vector_of_petsc = nullptr;
  if (std::string_view(CONTACTX_EXPECTED) != version)
  {
    std::printf("headers of %s, a package of " CONTACTX_EXPECTED "\n", version);
    return 1;
  }

  // A master segment from x_1 to x_2, its outward normal n on the right, and
  // two slave facets over it, towards it
  constexpr double length = 2, gap = 0.01, pressure = 3;
  const double angle = std::numbers::pi / 5;
  const Vector<2> t{std::cos(angle), std::sin(angle)}, n{t[1], -t[0]};
  const std::vector<std::int32_t> slave_offsets{0, 2, 4},
      slave_nodes{2, 1, 1, 0}, master_offsets{0, 2}, master_nodes{3, 4};
  const std::vector<double> place{0.2, 0.5, 0.8}, area{0.3, 0.6, 0.3};
  std::vector<double> x;
  for (const double xi : place)
    for (int k = 0; k < 2; ++k)
      x.push_back(xi * length * t[k] + gap * n[k]);
  x.insert(x.end(), {0, 0, length * t[0], length * t[1]});

  search::Pairing found(slave_offsets, slave_nodes, master_offsets,
                        master_nodes, 2);
  found.update(x, 1, std::vector<std::int8_t>(3, 0));

  kernel::Pairs pairs;
  pairs.num_nodes = 2;
  pairs.data_size = kernel::num_values<kernel::FacetPair>;
  for (std::int32_t s = 0; s < 3; ++s)
  {
    if (found.facet()[s] != 0)
      return std::puts("a slave node has no pair"), 1;
    pairs.slaves.push_back(s);
    pairs.nodes.insert(pairs.nodes.end(), {s, 3, 4});
    kernel::FacetPair pair{.feature = double(found.feature()[s])};
    std::copy_n(&found.xi()[2 * s], 2, pair.xi.begin());
    std::copy_n(&found.cone()[3 * s], 3, pair.cone.begin());
    std::copy_n(&found.normal()[3 * s], 3, pair.normal.begin());
    pairs.add(pair);
  }

  const std::vector<double> u(x.size(), 0), p(3, pressure);
  kernel::NodalArrays arrays;
  arrays.displacement = u;
  arrays.position = x;
  arrays.multiplier = p;
  arrays.area = area;
  constexpr kernel::Law law = kernel::Law::frictionless;
  std::vector<double> gaps(3), forces(x.size()), K(100), expected_K(100),
      expected_forces(x.size());
  kernel::add_vector(law, "finite", "gap", pairs, arrays, 2, gaps);
  kernel::add_vector(law, "finite", "residual", pairs, arrays, 2, forces);
  const auto entries
      = kernel::assemble_matrix(law, "finite", "stiffness", pairs, arrays, 2);
  for (std::size_t e = 0; e < entries.values.size(); ++e)
    K[10 * entries.rows[e] + entries.columns[e]] += entries.values[e];

  // g = n . (x_s - x_1) with its first and second derivatives
  for (int s = 0; s < 3; ++s)
  {
    const double xi = place[s], force = pressure * area[s];
    const std::array<double, 3> weight{1, xi - 1, -xi}, turn{0, 1, -1};
    const std::array<int, 3> node{s, 3, 4};
    for (int i = 0; i < 6; ++i)
    {
      const auto along = [&](int j) { return weight[j / 2] * t[j % 2]; };
      const auto across = [&](int j) { return turn[j / 2] * n[j % 2]; };
      const int row = 2 * node[i / 2] + i % 2;
      expected_forces[row] -= force * weight[i / 2] * n[i % 2];
      for (int j = 0; j < 6; ++j)
        expected_K[10 * row + 2 * node[j / 2] + j % 2]
            -= force
               * ((across(i) * along(j) + along(i) * across(j)) / length
                  - gap * across(i) * across(j) / (length * length));
    }
  }
  double error = 0;
  for (int s = 0; s < 3; ++s)
  {
    std::printf("gap %g\n", gaps[s]);
    error = std::max(error, std::abs(gaps[s] - gap));
  }
  for (int i = 0; i < 10; i += 2)
    std::printf("force on node %d: (%g, %g)\n", i / 2, forces[i],
                forces[i + 1]);
  for (std::size_t i = 0; i < forces.size(); ++i)
    error = std::max(error, std::abs(forces[i] - expected_forces[i]));
  for (int i = 0; i < 100; ++i)
  {
    std::printf("%8.4f%s", K[i], i % 10 == 9 ? "\n" : "");
    error = std::max(error, std::abs(K[i] - expected_K[i]));
  }
  std::printf("error %g\n", error);
  return error < 1e-13 ? 0 : 1;
}
