// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#include "found_nodes.h"
#include <algorithm>
#include <limits>

using namespace contactx::mesh;

FoundNodes contactx::mesh::found_nodes(const Halo& halo,
                                       std::span<const std::int32_t> nodes,
                                       std::span<const double> x)
{
  Ranks& ranks = halo.ranks();
  FoundNodes found;
  found.count = total(ranks, std::ssize(nodes));
  if (found.count == 0)
    return found;
  const auto original = halo.original();
  std::int64_t mine = std::numeric_limits<std::int64_t>::max();
  std::int32_t which = -1;
  for (const std::int32_t node : nodes)
    if (original[node] < mine)
    {
      mine = original[node];
      which = node;
    }
  found.first = least(ranks, mine);
  // One rank owns it
  found.at.assign(halo.gdim(), 0);
  if (which >= 0 and mine == found.first)
    std::ranges::copy(x.subspan(std::size_t(which) * halo.gdim(), halo.gdim()),
                      found.at.begin());
  ranks.reduce(std::span(found.at), Reduction::sum);
  return found;
}
