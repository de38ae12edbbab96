// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#include "../input.h"
#include "../require.h"
#include <algorithm>
#include <contactx/search/order.h>
#include <vector>

using namespace contactx;
using namespace contactx::fuzz;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data,
                                      std::size_t size)
{
  Input in(data, size);
  const int gdim = 2 + in.below(2), num_nodes = 1 + in.below(30);
  std::vector<std::int32_t> nodes(in.below(40));
  for (auto& node : nodes)
    node = in.below(num_nodes);
  std::vector<double> x(gdim * num_nodes);
  for (double& c : x)
    c = in.number();
  auto order = search::spatial_order(nodes, x, gdim);
  require(order.size() == nodes.size(), "there is a place for each node");
  std::ranges::sort(order);
  for (std::size_t i = 0; i < order.size(); ++i)
    require(order[i] == static_cast<std::int32_t>(i), "each place comes once");
  return 0;
}
