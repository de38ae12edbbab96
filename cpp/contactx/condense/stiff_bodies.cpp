// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#include "stiff_bodies.h"
#include "../check.h"
#include "residual_weights.h"
#include <algorithm>
#include <cmath>

using namespace contactx;
using namespace contactx::condense;

namespace
{
/// Stiffness from which on a body is stiff, by the widest gap; infinite where
/// it is too narrow
double limit(std::vector<double> known)
{
  std::ranges::sort(known);
  double ratio = alike_stiffness_ratio, found = INFINITY;
  for (std::size_t i = 1; i < known.size(); ++i)
    if (known[i] >= ratio * known[i - 1])
    {
      ratio = known[i] / known[i - 1];
      found = known[i];
    }
  return found;
}
} // namespace

std::vector<std::int8_t>
contactx::condense::stiff_bodies(const Condensation& condensation,
                                 const mesh::Bodies& bodies,
                                 std::span<const double> diagonal)
{
  const mesh::NodeMap& nodes = bodies.map();
  const Elimination& elimination = condensation.elimination();
  const int gdim = elimination.gdim();
  const std::size_t count = bodies.size();
  const auto num_nodes = static_cast<std::size_t>(nodes.num_nodes());
  std::vector<double> area(num_nodes, 0);
  nodes.ranks().agree(
      [&]
      {
        check::rows(diagonal.size(), nodes.num_owned(), gdim, "diagonal",
                    "owned node");
        const Triplets& T = condensation.traction();
        for (std::size_t e = 0; e < T.size(); ++e)
          area.at(T.rows[e] / gdim) += std::abs(T.values[e]);
      });
  nodes.reverse(area, 1);

  // Stiffnesses, then areas
  std::vector<double> sums(2 * count, 0);
  for (std::int32_t i = 0; i < nodes.num_owned(); ++i)
    if (area[i] > 0)
    {
      const std::int32_t body = bodies.number()[i];
      for (int k = 0; k < gdim; ++k)
        sums[body] += diagonal[i * gdim + k];
      sums[count + body] += area[i];
    }
  nodes.ranks().reduce(std::span<double>(sums), mesh::Reduction::sum);
  std::vector<double> known;
  for (std::size_t b = 0; b < count; ++b)
    if (sums[b] > 0)
      known.push_back(sums[b] / sums[count + b]);
  const double from = limit(known);
  std::vector<std::int8_t> stiff(count, 0);
  if (not std::isfinite(from))
    return stiff;
  for (std::size_t b = 0; b < count; ++b)
    stiff[b] = not(sums[b] > 0) or sums[b] / sums[count + b] >= from;

  const Triplets& right = elimination.right();
  bool is_folded = false;
  for (std::size_t e = 0; e < right.size(); ++e)
    is_folded = is_folded
                or (stiff[bodies.number()[right.rows[e] / gdim]]
                    and not stiff[bodies.number()[right.columns[e] / gdim]]);
  if (mesh::anywhere(nodes.ranks(), is_folded))
    std::ranges::fill(stiff, 0);
  return stiff;
}
