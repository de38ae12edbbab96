// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#include "../input.h"
#include "../require.h"
#include <algorithm>
#include <contactx/solve/shared_nodes.h>
#include <vector>

using namespace contactx;
using namespace contactx::fuzz;
using solve::Closing;
using solve::SharedNodes;

namespace
{
struct Arrays
{
  bool is_tied;
  std::vector<std::int32_t> slaves;
  std::vector<std::int8_t> closes;
  std::vector<double> gap, normal;
};
} // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data,
                                      std::size_t size)
{
  Input in(data, size);
  constexpr int num_nodes = 6;
  std::vector<Arrays> contacts(1 + in.below(4));
  std::vector<std::span<const std::int32_t>> slaves;
  for (Arrays& c : contacts)
  {
    c.is_tied = in.below(6) == 0;
    for (int node = 0; node < num_nodes; ++node)
      if (in.below(3) > 0)
        c.slaves.push_back(node);
  }
  for (const Arrays& c : contacts)
    slaves.push_back(c.slaves);
  SharedNodes junctions(slaves);
  for (int iterate = 0; iterate < 1 + in.below(8); ++iterate)
  {
    std::vector<Closing> closing;
    for (Arrays& c : contacts)
    {
      c.closes.clear();
      c.gap.clear();
      c.normal.clear();
      for (std::size_t i = 0; i < c.slaves.size(); ++i)
      {
        c.closes.push_back(in.flag());
        c.gap.push_back(in.number());
        const auto n = in.unit<3>();
        c.normal.insert(c.normal.end(), n.begin(), n.end());
      }
    }
    for (const Arrays& c : contacts)
      closing.push_back({c.is_tied, c.closes, c.gap, c.normal});
    const auto shared = junctions.update(closing, iterate == 0);
    require(shared.size() == contacts.size(), "each contact has an answer");
    for (int node = 0; node < num_nodes; ++node)
    {
      int closed = 0, kept = 0, tied = 0, left = 0;
      for (std::size_t k = 0; k < contacts.size(); ++k)
      {
        const Arrays& c = contacts[k];
        const auto at = std::ranges::find(c.slaves, node) - c.slaves.begin();
        if (at == std::ssize(c.slaves))
          continue;
        if (not c.closes[at])
        {
          require(not c.is_tied or not shared[k].smooth[at],
                  "a tie that does not hold has no friction to leave out");
          continue;
        }
        ++closed;
        kept += not shared[k].redundant[at];
        tied += c.is_tied;
        left += c.is_tied and shared[k].redundant[at];
      }
      require(closed == 0 or kept > 0, "a node that is closed is held");
      require(tied == 0 or left == tied - 1, "of several ties one holds");
      require(tied == 0 or kept == 1, "it holds in every direction");
    }
  }
  return 0;
}
