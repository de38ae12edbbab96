// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#include "frozen_pairs.h"
#include <algorithm>

using namespace contactx;
using namespace contactx::solve;

namespace
{
/// Penetration, over the length of an edge, that frozen pairs may hide: that of
/// a ridge of 45 degrees within the margin of a facet
constexpr double hidden_depth_max = 0.03;
} // namespace

HiddenPenetration
contactx::solve::hidden_penetration(mesh::Ranks& ranks,
                                    std::span<const contact::HiddenGap> found)
{
  const std::size_t n = found.size();
  std::vector<double> least(2 * n);
  for (std::size_t k = 0; k < n; ++k)
  {
    least[k] = found[k].gap;
    least[n + k] = found[k].part;
  }
  if (ranks.size() > 1)
    ranks.reduce(std::span(least), mesh::Reduction::least);
  return {{least.begin(), least.begin() + n},
          std::any_of(least.begin() + n, least.end(),
                      [](double part) { return part < -hidden_depth_max; })};
}
