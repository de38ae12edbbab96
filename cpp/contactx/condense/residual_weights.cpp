// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#include "residual_weights.h"
#include "../check.h"
#include <algorithm>
#include <cmath>
#include <vector>

double contactx::condense::residual_weight(const mesh::Bodies& bodies,
                                           std::span<const double> diagonal,
                                           std::span<const double> residual,
                                           int gdim)
{
  const mesh::NodeMap& nodes = bodies.map();
  nodes.ranks().agree(
      [&]
      {
        check::rows(diagonal.size(), nodes.num_owned(), gdim, "diagonal",
                    "owned node");
        check::rows(residual.size(), nodes.num_owned(), gdim, "residual",
                    "owned node");
      });
  // Diagonal, its entries and squared residual of each body
  std::vector<double> sums(3 * bodies.size(), 0);
  for (std::int32_t i = 0; i < nodes.num_owned(); ++i)
  {
    double* of_body = sums.data() + std::size_t(3) * bodies.number()[i];
    for (int k = 0; k < gdim; ++k)
    {
      const double d = std::abs(diagonal[i * gdim + k]);
      const double r = residual[i * gdim + k];
      of_body[0] += d;
      of_body[1] += d > 0;
      of_body[2] += r * r;
    }
  }
  nodes.ranks().reduce(std::span<double>(sums), mesh::Reduction::sum);

  double softest = INFINITY;
  for (std::size_t b = 0; b < sums.size(); b += 3)
    if (sums[b] > 0)
      softest = std::min(softest, sums[b] / sums[b + 1]);
  double all = 0, counted = 0;
  for (std::size_t b = 0; b < sums.size(); b += 3)
  {
    // Of a body that is prescribed as a whole nothing is to be found
    const double part = sums[b] > 0 ? softest * sums[b + 1] / sums[b] : 1.0;
    const double w = alike_stiffness_ratio * part < 1 ? part : 1.0;
    all += sums[b + 2];
    counted += w * w * sums[b + 2];
  }
  return all > 0 ? std::sqrt(counted / all) : 1.0;
}
