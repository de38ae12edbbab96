// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#include "../input.h"
#include "../require.h"
#include <algorithm>
#include <contactx/search/box_tree.h>

using namespace contactx;
using namespace contactx::fuzz;
using search::Box;
using search::BoxTree;

namespace
{
std::vector<Box> boxes(Input& in, int count)
{
  std::vector<Box> all(count, Box::empty());
  for (Box& box : all)
    for (int k = in.below(4); k > 0; --k)
      box.add(in.vector<3>());
  return all;
}

void check(const BoxTree& tree, const std::vector<Box>& boxes, Input& in)
{
  const auto p = in.vector<3>();
  const double size = in.positive();
  double bound2 = size * size;
  std::vector<int> seen(boxes.size(), 0);
  tree.nearest(p, bound2,
               [&](std::int32_t i)
               {
                 ++seen[i];
                 // As a search does that has found something in the box
                 const double d2 = boxes[i].distance2(p);
                 bound2 = std::min(bound2, 4 * d2);
               });
  for (std::size_t i = 0; i < boxes.size(); ++i)
  {
    require(seen[i] <= 1, "an item is visited once");
    if (in.finite() and boxes[i].distance2(p) <= bound2)
      require(seen[i] == 1, "what may be near is visited");
  }

  const auto low = in.vector<3>();
  const auto matters = [&low](const Box& box)
  { return box.upper[0] >= low[0] and box.upper[1] >= low[1]; };
  std::ranges::fill(seen, 0);
  tree.for_each(matters, [&seen](std::int32_t i) { ++seen[i]; });
  for (std::size_t i = 0; i < boxes.size(); ++i)
    require(seen[i] == matters(boxes[i]), "what matters is visited once");
}
} // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data,
                                      std::size_t size)
{
  Input in(data, size);
  const int count = in.below(40);
  std::vector<Box> all = boxes(in, count);
  BoxTree tree(all);
  check(tree, all, in);
  all = boxes(in, count);
  tree.refit(all);
  check(tree, all, in);
  return 0;
}
