// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#include "master_springs.h"
#include "../check.h"
#include <cmath>
#include <map>
#include <utility>

using namespace contactx;
using namespace contactx::condense;

std::vector<double>
contactx::condense::master_springs(const Condensation& condensation,
                                   std::span<const double> stiffness)
{
  const Elimination& elimination = condensation.elimination();
  const int gdim = elimination.gdim();
  check::rows(stiffness.size(), condensation.num_local(), 1, "stiffness",
              "displacement");
  std::vector<double> area(stiffness.size(), 0);
  const Triplets& T = condensation.traction();
  for (std::size_t e = 0; e < T.size(); ++e)
    area[T.rows[e]] += std::abs(T.values[e]);

  // Squares of what slave nodes follow of each master. One displacement of a
  // node that slips follows several of a master, along an oblique normal
  const Triplets& right = elimination.right();
  std::map<std::pair<std::int32_t, std::int32_t>, double> followed;
  for (std::size_t e = 0; e < right.size(); ++e)
  {
    const std::int32_t slave = right.rows[e] / gdim;
    const std::int32_t master = right.columns[e] / gdim;
    if (slave != master)
      followed[{slave, master}] += right.values[e] * right.values[e];
  }
  std::vector<double> sums(stiffness.size() / gdim, 0);
  for (const auto& [nodes, square] : followed)
    sums[nodes.first] += std::sqrt(square);

  std::vector<double> springs(stiffness.size(), 0);
  for (const auto& [nodes, square] : followed)
  {
    const auto [slave, master] = nodes;
    if (not(sums[slave] > 0))
      continue;
    const double part = std::sqrt(square) / sums[slave];
    for (int k = 0; k < gdim; ++k)
      springs[master * gdim + k]
          += part * stiffness[slave * gdim + k] * area[slave * gdim + k];
  }
  return springs;
}
