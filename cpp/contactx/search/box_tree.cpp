// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#include "box_tree.h"
#include <numeric>
#include <stdexcept>

using namespace contactx;
using namespace contactx::search;

BoxTree::BoxTree(std::span<const Box> boxes)
    : _items(boxes.size()), _boxes(boxes.size())
{
  std::iota(_items.begin(), _items.end(), 0);
  if (!boxes.empty())
  {
    _nodes.reserve(boxes.size());
    build(boxes, 0, static_cast<std::int32_t>(boxes.size()));
  }
}

void BoxTree::build(std::span<const Box> boxes, std::int32_t begin,
                    std::int32_t end)
{
  const std::size_t self = _nodes.size();
  _nodes.push_back({Box::empty(), begin, end, -1});
  Box centres = Box::empty();
  for (std::int32_t i = begin; i < end; ++i)
  {
    const Box& b = boxes[_items[i]];
    _nodes[self].box.add(b);
    centres.add(b.lower + b.upper);
  }
  if (end - begin <= leaf_size)
  {
    for (std::int32_t i = begin; i < end; ++i)
      _boxes[i] = boxes[_items[i]];
    return;
  }

  const Vector<3> extent = centres.upper - centres.lower;
  const int axis
      = std::max_element(extent.begin(), extent.end()) - extent.begin();
  const std::int32_t middle = begin + (end - begin) / 2;
  std::nth_element(_items.begin() + begin, _items.begin() + middle,
                   _items.begin() + end,
                   [&boxes, axis](std::int32_t i, std::int32_t j)
                   {
                     return boxes[i].lower[axis] + boxes[i].upper[axis]
                            < boxes[j].lower[axis] + boxes[j].upper[axis];
                   });
  build(boxes, begin, middle);
  _nodes[self].right = static_cast<std::int32_t>(_nodes.size());
  build(boxes, middle, end);
}

void BoxTree::refit(std::span<const Box> boxes)
{
  if (boxes.size() != _items.size())
    throw std::invalid_argument("refit needs as many boxes as the tree has");
  refit([boxes](std::int32_t i) -> const Box& { return boxes[i]; });
}
