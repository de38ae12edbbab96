// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#include "self_order.h"
#include "../../math/scales.h"
#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numeric>
#include <queue>

using namespace contactx;
using namespace contactx::search;

namespace
{
/// Ratio of facets' sizes up to which parts are equally fine
constexpr double equal_size_ratio = 2;

/// First of the nodes with the largest value, but for round-off.
std::int32_t farthest(std::span<const std::int32_t> nodes,
                      std::span<const double> value)
{
  double most = 0;
  for (const std::int32_t node : nodes)
    if (value[node] < infinity)
      most = std::max(most, value[node]);
  for (const std::int32_t node : nodes)
    if (value[node] < infinity
        and value[node] >= (1 - math::negligible_part) * most)
      return node;
  return nodes.front();
}

/// Distances from the mean of the nodes.
void set_distances(std::span<const std::int32_t> nodes,
                   std::span<const double> x, int gdim,
                   std::span<double> distance)
{
  Vector<3> middle{};
  for (const std::int32_t node : nodes)
    middle = middle + (1.0 / double(nodes.size())) * vector_at(x, node, gdim);
  for (const std::int32_t node : nodes)
    distance[node] = norm(vector_at(x, node, gdim) - middle);
}
} // namespace

EdgePaths::EdgePaths(const geometry::FacetList& facets,
                     std::span<const double> x, int gdim)
    : _edges(x.size() / gdim)
{
  const auto add = [&](std::int32_t a, std::int32_t b)
  {
    const double length = norm(vector_at(x, a, gdim) - vector_at(x, b, gdim));
    _edges[a].emplace_back(length, b);
    _edges[b].emplace_back(length, a);
  };
  for (std::int32_t f = 0; f < facets.size(); ++f)
  {
    // Diagonals of quadrilaterals are edges, too
    const auto nodes = facets[f];
    for (std::size_t i = 0; i < nodes.size(); ++i)
      for (std::size_t j = 0; j < i; ++j)
        add(nodes[i], nodes[j]);
  }
}

std::vector<std::pair<double, std::int32_t>>
EdgePaths::from(std::int32_t from, double within) const
{
  std::map<std::int32_t, double> distance{{from, 0.0}};
  using Entry = std::pair<double, std::int32_t>;
  std::priority_queue<Entry, std::vector<Entry>, std::greater<>> next;
  next.emplace(0.0, from);
  std::vector<Entry> found;
  while (not next.empty())
  {
    const auto [d, node] = next.top();
    next.pop();
    if (d > distance.at(node))
      continue;
    found.emplace_back(d, node);
    for (const auto& [length, other] : _edges[node])
    {
      const double sum = d + length;
      if (sum > within)
        continue;
      const auto [at, is_new] = distance.emplace(other, sum);
      if (is_new or sum < at->second)
      {
        at->second = sum;
        next.emplace(sum, other);
      }
    }
  }
  return found;
}

SelfOrder::SelfOrder(const geometry::FacetList& facets,
                     std::span<const double> x, int gdim)
    : _gdim(gdim)
{
  const auto n = static_cast<std::int32_t>(x.size() / gdim);
  // Nodes of the parts, each in ascending order
  _part.assign(n, -1);
  _along.assign(n, 0);
  const EdgePaths paths(facets, x, gdim);
  std::vector<std::vector<std::int32_t>> parts;
  for (std::int32_t first = 0; first < n; ++first)
  {
    if (_part[first] >= 0)
      continue;
    auto& nodes = parts.emplace_back();
    for (const auto& [length, node] : paths.from(first, infinity))
    {
      nodes.push_back(node);
      _part[node] = static_cast<std::int32_t>(parts.size()) - 1;
    }
    std::ranges::sort(nodes);
  }
  _size.assign(parts.size(), 0);
  std::vector<double> count(parts.size(), 0);
  for (std::int32_t f = 0; f < facets.size(); ++f)
  {
    const auto nodes = facets[f];
    double size = 0;
    for (std::size_t i = 0; i < nodes.size(); ++i)
      for (std::size_t j = 0; j < i; ++j)
        size = std::max(size, norm(vector_at(x, nodes[i], gdim)
                                   - vector_at(x, nodes[j], gdim)));
    _size[_part[nodes[0]]] += size;
    ++count[_part[nodes[0]]];
  }
  for (std::size_t k = 0; k < parts.size(); ++k)
    _size[k] /= count[k];

  std::vector<std::int32_t> next(n, -1);
  std::vector<std::int8_t> has_before(n, 0);
  if (gdim == 2)
    for (std::int32_t f = 0; f < facets.size(); ++f)
    {
      next[facets[f][0]] = facets[f][1];
      has_before[facets[f][1]] = 1;
    }
  std::vector<double> value(n, 0);
  for (const auto& nodes : parts)
  {
    set_distances(nodes, x, gdim, value);
    const std::int32_t start = farthest(nodes, value);
    if (gdim == 2)
    {
      const auto open = std::ranges::find_if(nodes, [&](std::int32_t node)
                                             { return not has_before[node]; });
      std::int32_t node = open == nodes.end() ? start : *open;
      double along = 0;
      for (std::size_t i = 0; i < nodes.size() and node >= 0; ++i)
      {
        _along[node] = along;
        if (next[node] >= 0)
          along += norm(vector_at(x, next[node], gdim)
                        - vector_at(x, node, gdim));
        node = next[node];
      }
      continue;
    }
    std::vector<double> beside(n, infinity);
    std::int32_t opposite = start;
    for (const auto& [length, node] : paths.from(start, infinity))
    {
      _along[node] = length;
      beside[node] = length;
      opposite = node;
    }
    for (const auto& [length, node] : paths.from(opposite, infinity))
      beside[node] = std::min(beside[node], length);
    for (const auto& [length, node] :
         paths.from(farthest(nodes, beside), infinity))
      _along[node] += 0.5 * length;
  }
  std::vector<double> score(_size);
  for (double& s : score)
    s = 1 / s;
  set_ranks(score);
}

void SelfOrder::take_compliance(std::span<const double> compliance)
{
  std::vector<double> score(_size.size(), 0), count(_size.size(), 0);
  for (std::size_t i = 0; i < _part.size(); ++i)
  {
    score[_part[i]] += compliance[i];
    ++count[_part[i]];
  }
  // The compliance of a node is 1 / modulus in 2D, and 1 / (modulus times the
  // size of its facets) in 3D
  for (std::size_t k = 0; k < score.size(); ++k)
    score[k] /= count[k] * (_gdim == 2 ? _size[k] : 1.0);
  set_ranks(score);
}

/// Puts parts of larger scores behind those of smaller ones.
void SelfOrder::set_ranks(std::span<const double> score)
{
  double least = infinity;
  for (const double s : score)
    if (s > 0)
      least = std::min(least, s);
  std::vector<int> level(score.size(), 0);
  for (std::size_t k = 0; k < score.size(); ++k)
    if (score[k] > 0)
      // Round-off does not decide between parts that are equally soft or fine
      level[k] = 1
                 + static_cast<int>(std::floor(std::log(score[k] / least)
                                                   / std::log(equal_size_ratio)
                                               + 0.25));
  std::vector<std::int32_t> order(score.size());
  std::iota(order.begin(), order.end(), 0);
  std::ranges::stable_sort(order, {}, [&](std::int32_t k) { return level[k]; });
  _rank.resize(order.size());
  for (std::size_t k = 0; k < order.size(); ++k)
    _rank[order[k]] = static_cast<std::int32_t>(k);
}

bool SelfOrder::is_after(std::int32_t node, std::span<const std::int32_t> facet,
                         std::span<const double> weights) const
{
  const std::int32_t mine = _rank[_part[node]], other = _rank[_part[facet[0]]];
  if (mine != other)
    return mine > other;
  double along = 0;
  for (std::size_t l = 0; l < facet.size(); ++l)
    along += weights[l] * _along[facet[l]];
  if (_along[node] != along)
    return _along[node] > along;
  return node > std::ranges::min(facet);
}
