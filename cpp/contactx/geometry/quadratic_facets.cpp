// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#include "quadratic_facets.h"
#include <algorithm>
#include <array>
#include <map>
#include <numeric>
#include <stdexcept>

using namespace contactx::geometry;

namespace
{
using Node = std::int32_t;

/// Parts by the nodes that only those of one whole have: the middle of a
/// segment or of a quadrilateral, the middles of two edges of a triangle.
using Groups = std::map<std::array<Node, 2>, std::vector<std::int32_t>>;

[[noreturn]] void lacks()
{
  throw std::invalid_argument("a quadratic facet lacks one of its parts");
}

std::array<Node, 2> sorted(Node a, Node b)
{
  return {std::min(a, b), std::max(a, b)};
}

/// Nodes of a whole: vertices, middles of edges, middle.
struct Whole
{
  std::vector<Node> nodes;
  std::vector<std::int32_t> parts;
};

Whole segment(const FacetList& facets, const std::vector<std::int32_t>& two,
              Node middle)
{
  if (two.size() != 2)
    lacks();
  Whole w{{-1, -1, middle}, two};
  for (const std::int32_t f : two)
  {
    const bool is_first = facets[f][1] == middle;
    w.nodes[is_first ? 0 : 1] = facets[f][is_first ? 0 : 1];
  }
  return w;
}

Whole quadrilateral(const FacetList& facets,
                    const std::vector<std::int32_t>& four, Node middle)
{
  if (four.size() != 4)
    lacks();
  Whole w{std::vector<Node>(9, middle), four};
  for (const std::int32_t f : four)
  {
    const auto part = facets[f];
    // A part has its vertex opposite to the middle
    const auto at = std::ranges::find(part, middle) - part.begin();
    const std::size_t vertex = 3 - at;
    w.nodes[vertex] = part[vertex];
    if (vertex == 0)
    {
      w.nodes[4] = part[1];
      w.nodes[5] = part[2];
    }
    if (vertex == 3)
    {
      w.nodes[6] = part[1];
      w.nodes[7] = part[2];
    }
  }
  return w;
}

Whole triangle(const FacetList& facets, std::int32_t inner,
               const Groups& corners, std::span<const std::int8_t> level)
{
  // The middles of the edges 01, 12 and 02
  const Node a = facets[inner][0], b = facets[inner][1], c = facets[inner][2];
  Whole w{{-1, -1, -1, b, c, a}, {inner}};
  const std::array around{sorted(a, c), sorted(a, b), sorted(b, c)};
  for (int v = 0; v < 3; ++v)
  {
    const auto found = corners.find(around[v]);
    if (found == corners.end() or found->second.size() != 1)
      lacks();
    const std::int32_t f = found->second[0];
    w.parts.push_back(f);
    for (const Node node : facets[f])
      if (level[node] == 0)
        w.nodes[v] = node;
  }
  return w;
}
} // namespace

QuadraticFacets
contactx::geometry::quadratic_facets(const FacetList& facets,
                                     std::span<const std::int8_t> level)
{
  QuadraticFacets result;
  const std::size_t n = facets.size();
  result.number.resize(n);
  result.sizes.resize(n);
  result.places.assign(4 * n, 0);
  if (level.empty())
  {
    result.nodes.resize(4 * n);
    std::iota(result.number.begin(), result.number.end(), 0);
    result.parts = result.number;
    result.offsets.resize(n + 1);
    std::iota(result.offsets.begin(), result.offsets.end(), 0);
    for (std::size_t f = 0; f < n; ++f)
    {
      const auto nodes = facets[static_cast<std::int32_t>(f)];
      result.sizes[f] = static_cast<int>(nodes.size());
      for (int k = 0; k < 4; ++k)
      {
        const int at = std::min(k, result.sizes[f] - 1);
        result.nodes[4 * f + k] = nodes[at];
        result.places[4 * f + k] = static_cast<std::int8_t>(at);
      }
    }
    return result;
  }

  Groups groups, corners;
  std::vector<std::int32_t> inner;
  for (std::int32_t f = 0; f < facets.size(); ++f)
  {
    const auto nodes = facets[f];
    const auto top = *std::ranges::max_element(nodes, {}, [level](Node node)
                                               { return level[node]; });
    if (nodes.size() != 3)
      groups[{top, -1}].push_back(f);
    else if (const auto vertex = std::ranges::find(nodes, 0, [level](Node node)
                                                   { return level[node]; });
             vertex == nodes.end())
      inner.push_back(f);
    else
    {
      const auto at = vertex - nodes.begin();
      corners[sorted(nodes[(at + 1) % 3], nodes[(at + 2) % 3])].push_back(f);
    }
  }
  if (corners.size() != 3 * inner.size())
    lacks();
  std::vector<Whole> found;
  for (const std::int32_t f : inner)
    found.push_back(triangle(facets, f, corners, level));
  for (const auto& [middle, parts] : groups)
    found.push_back(facets[parts[0]].size() == 2
                        ? segment(facets, parts, middle[0])
                        : quadrilateral(facets, parts, middle[0]));
  for (Whole& w : found)
    std::ranges::sort(w.parts);
  std::ranges::sort(found, {}, [](const Whole& w) { return w.parts[0]; });

  result.width = 9;
  result.nodes.resize(9 * n);
  for (const Whole& w : found)
  {
    const std::int32_t number = result.size();
    for (const std::int32_t f : w.parts)
    {
      result.number[f] = number;
      result.sizes[f] = static_cast<int>(w.nodes.size());
      for (std::size_t k = 0; k < 9; ++k)
        result.nodes[9 * std::size_t(f) + k]
            = w.nodes[std::min(k, w.nodes.size() - 1)];
      const auto nodes = facets[f];
      for (std::size_t k = 0; k < nodes.size(); ++k)
        result.places[4 * std::size_t(f) + k] = static_cast<std::int8_t>(
            std::ranges::find(w.nodes, nodes[k]) - w.nodes.begin());
    }
    result.parts.insert(result.parts.end(), w.parts.begin(), w.parts.end());
    result.offsets.push_back(static_cast<std::int32_t>(result.parts.size()));
  }
  return result;
}
