// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#include "multigrid.h"
#include "../check.h"
#include <cmath>
#include <stdexcept>

using namespace contactx;
using namespace contactx::condense;

std::vector<double> contactx::condense::bound(const Elimination& elimination,
                                              const mesh::NodeMap& nodes,
                                              std::span<const double> diagonal)
{
  const int gdim = elimination.gdim();
  check::rows(diagonal.size(), nodes.num_owned(), gdim, "diagonal",
              "owned node");
  const Triplets& R = elimination.right();
  std::vector<double> own(diagonal.size(), 1);
  for (std::size_t e = 0; e < R.size(); ++e)
    if (R.rows[e] == R.columns[e])
      own[R.rows[e]] += R.values[e];
  std::vector<double> sums(own.size());
  for (std::size_t i = 0; i < own.size(); ++i)
    sums[i] = std::abs(own[i]);
  for (std::size_t e = 0; e < R.size(); ++e)
    if (R.rows[e] != R.columns[e])
      sums[R.rows[e]] += std::abs(R.values[e]);
  std::vector<double> D(static_cast<std::size_t>(nodes.num_nodes()) * gdim, 0);
  for (std::size_t i = 0; i < own.size(); ++i)
    D[i] = diagonal[i] * sums[i] * std::abs(own[i]);
  for (std::size_t e = 0; e < R.size(); ++e)
    if (const std::int32_t s = R.rows[e]; s != R.columns[e])
      D[R.columns[e]] += diagonal[s] * sums[s] * std::abs(R.values[e]);
  nodes.reverse(D, gdim);
  D.resize(diagonal.size());
  return D;
}

Triplets contactx::condense::elastic(const Elimination& elimination,
                                     const mesh::NodeMap& nodes,
                                     const Triplets& soft,
                                     std::span<const double> diagonal)
{
  const int gdim = elimination.gdim();
  if (not diagonal.empty())
    check::rows(diagonal.size(), nodes.num_owned(), gdim, "diagonal",
                "owned node");
  const auto taken = marks(nodes, elimination.eliminated(), gdim);
  Triplets left
      = soft.select([&](std::int32_t row, std::int32_t column, double)
                    { return taken[row] == 0 and taken[column] == 0; });
  for (std::size_t i = 0; i < diagonal.size(); ++i)
    if (diagonal[i] != 0 and taken[i] == 0)
      left.add(static_cast<std::int32_t>(i), static_cast<std::int32_t>(i),
               diagonal[i]);
  return left;
}
