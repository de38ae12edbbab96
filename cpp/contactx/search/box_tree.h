// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#pragma once

#include "box.h"
#include <concepts>
#include <cstdint>
#include <span>
#include <vector>

namespace contactx::search
{
/// @brief Binary tree of boxes, split at the median of the longest axis.
///
/// The order of the leaves is fixed when the tree is built. `refit` moves the
/// boxes and keeps that order, which costs a fraction of a build and stays
/// efficient while the surface deforms smoothly.
class BoxTree
{
public:
  /// @brief Build the tree.
  /// @param[in] boxes One box an item; an empty box is never found.
  explicit BoxTree(std::span<const Box> boxes);

  /// @brief Take over moved boxes in the same order as at the build.
  /// @param[in] boxes One box an item.
  void refit(std::span<const Box> boxes);

  /// @brief Take over moved boxes, each asked for once, in the tree's order.
  /// @param[in] box_of Called as box_of(item), gives the item's box.
  template <class BoxOf>
    requires std::invocable<BoxOf, std::int32_t>
  void refit(BoxOf&& box_of)
  {
    // Children come after their parent
    for (std::size_t i = _nodes.size(); i-- > 0;)
    {
      Node& node = _nodes[i];
      node.box = Box::empty();
      if (node.right < 0)
        for (std::int32_t j = node.begin; j < node.end; ++j)
        {
          _boxes[j] = box_of(_items[j]);
          node.box.add(_boxes[j]);
        }
      else
      {
        node.box.add(_nodes[i + 1].box);
        node.box.add(_nodes[node.right].box);
      }
    }
  }

  /// @brief Visit the items in whose box the distance from a point may be
  /// below a bound, nearest boxes first.
  /// @param[in] p Point.
  /// @param[in,out] bound2 Squared bound. `visit` may lower it.
  /// @param[in] visit Called as visit(item).
  /// @param[in] matters Called as matters(box), of an item or of several that
  /// are passed over where it is false.
  template <class Visitor, class Predicate>
  void nearest(const Vector<3>& p, double& bound2, Visitor&& visit,
               Predicate&& matters) const
  {
    struct Entry
    {
      std::int32_t node;
      double d2;
    };
    // The tree is balanced: its depth is at most 32 - log2(leaf_size)
    std::array<Entry, 64> stack;
    int top = 0;
    if (!_nodes.empty())
      stack[top++] = {0, _nodes[0].box.distance2(p)};
    while (top > 0)
    {
      const Entry e = stack[--top];
      if (e.d2 > bound2)
        continue;
      const Node& node = _nodes[e.node];
      if (node.right < 0)
      {
        for (std::int32_t i = node.begin; i < node.end; ++i)
          if (_boxes[i].distance2(p) <= bound2 and matters(_boxes[i]))
            visit(_items[i]);
        continue;
      }
      Entry a{e.node + 1, _nodes[e.node + 1].box.distance2(p)};
      Entry b{node.right, _nodes[node.right].box.distance2(p)};
      if (a.d2 < b.d2)
        std::swap(a, b);
      for (const Entry& child : {a, b})
        if (child.d2 <= bound2 and matters(_nodes[child.node].box))
          stack[top++] = child;
    }
  }

  /// @brief The same for all boxes.
  template <class Visitor>
  void nearest(const Vector<3>& p, double& bound2, Visitor&& visit) const
  {
    nearest(p, bound2, visit, [](const Box&) { return true; });
  }

  /// @brief Visit the items whose box may matter.
  /// @param[in] matters Called as matters(box), of an item or of several.
  /// @param[in] visit Called as visit(item).
  template <class Predicate, class Visitor>
  void for_each(Predicate&& matters, Visitor&& visit) const
  {
    std::array<std::int32_t, 64> stack;
    int top = 0;
    if (!_nodes.empty())
      stack[top++] = 0;
    while (top > 0)
    {
      const std::int32_t i = stack[--top];
      const Node& node = _nodes[i];
      if (!matters(node.box))
        continue;
      if (node.right >= 0)
      {
        stack[top++] = node.right;
        stack[top++] = i + 1;
        continue;
      }
      for (std::int32_t j = node.begin; j < node.end; ++j)
        if (matters(_boxes[j]))
          visit(_items[j]);
    }
  }

private:
  static constexpr std::int32_t leaf_size = 4;

  // Depth-first order: the left child follows its parent
  struct Node
  {
    Box box;
    std::int32_t begin, end; // items below this node
    std::int32_t right;      // right child, -1 at a leaf
  };

  void build(std::span<const Box> boxes, std::int32_t begin, std::int32_t end);

  std::vector<Node> _nodes;
  std::vector<std::int32_t> _items;
  std::vector<Box> _boxes; // of the items, in their order
};
} // namespace contactx::search
