// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#include "bodies.h"
#include "../check.h"
#include <algorithm>
#include <array>
#include <limits>
#include <stdexcept>
#include <string>

using namespace contactx;
using namespace contactx::mesh;

namespace
{
template <class T>
void make_unique(std::vector<T>& values)
{
  std::ranges::sort(values);
  values.erase(std::unique(values.begin(), values.end()), values.end());
}

/// Place of a value in an ascending list that has it.
template <class T>
std::size_t place(const std::vector<T>& values, T value)
{
  return std::ranges::lower_bound(values, value) - values.begin();
}
} // namespace

std::vector<std::int32_t>
mesh::connected_parts(std::span<const std::int32_t> cells, int width,
                      std::int32_t count)
{
  if (width < 1 or cells.size() % width != 0)
    throw std::invalid_argument("cells must have " + std::to_string(width)
                                + " nodes each, at least one");
  check::numbers(cells, count, "cells", "nodes");
  std::vector<std::int32_t> part(count);
  for (std::int32_t i = 0; i < count; ++i)
    part[i] = i;
  const auto root = [&part](std::int32_t i)
  {
    while (part[i] != i)
      i = part[i] = part[part[i]];
    return i;
  };
  for (std::size_t c = 0; c < cells.size(); c += width)
  {
    std::int32_t least = root(cells[c]);
    for (int k = 1; k < width; ++k)
    {
      const std::int32_t other = root(cells[c + k]);
      part[std::max(least, other)] = std::min(least, other);
      least = std::min(least, other);
    }
  }
  // Names lead to smaller ones, which are final by then
  for (std::int32_t i = 0; i < count; ++i)
    part[i] = part[part[i]];
  return part;
}

Bodies::Bodies(std::span<const std::int32_t> cells, int width,
               std::int32_t num_owned_cells,
               std::span<const std::int64_t> original,
               std::shared_ptr<const NodeMap> nodes)
    : _map(std::move(nodes)), _num_owned_cells(num_owned_cells)
{
  const auto num_bulk = static_cast<std::int32_t>(original.size());
  std::vector<std::int64_t> here;
  _map->ranks().agree(
      [&]
      {
        if (num_bulk < _map->num_owned() or num_bulk > _map->num_nodes())
          throw std::invalid_argument(
              "original must have a number for each node of the bulk, which "
              "are those of this rank or less, not "
              + std::to_string(num_bulk));
        const std::vector<std::int32_t> part
            = connected_parts(cells, width, num_bulk);
        if (num_owned_cells < 0 or num_owned_cells > std::ssize(cells) / width)
          throw std::invalid_argument("num_owned_cells must be at most the "
                                      "number of cells, not "
                                      + std::to_string(num_owned_cells));
        std::vector<std::int64_t> least(original.begin(), original.end());
        for (std::int32_t i = 0; i < num_bulk; ++i)
          least[part[i]] = std::min(least[part[i]], original[i]);
        _of_node.resize(_map->num_nodes());
        for (std::int32_t i = 0; i < num_bulk; ++i)
        {
          _of_node[i] = least[part[i]];
          if (part[i] == i)
            here.push_back(least[i]);
        }
        std::ranges::sort(here);
      });
  _names = here;
  if (_map->ranks().size() > 1)
  {
    const std::vector<std::int64_t> known = across_ranks(here, num_bulk);
    for (std::int32_t i = 0; i < num_bulk; ++i)
      _of_node[i] = known[place(here, _of_node[i])];
  }
  _of_cell.reserve(cells.size() / width);
  for (std::size_t c = 0; c < cells.size(); c += width)
    _of_cell.push_back(_of_node[cells[c]]);
  nodes_changed();
  _observer = _map->on_change([this] { nodes_changed(); });
}

std::vector<std::int64_t>
Bodies::across_ranks(std::span<const std::int64_t> here, std::int32_t num_bulk)
{
  // The bodies of a ghost here and on its owner are one
  std::vector<std::int64_t> theirs = _of_node;
  _map->forward(std::span<std::int64_t>(theirs), 1);
  std::vector<std::array<std::int64_t, 2>> links;
  const std::int32_t owned = _map->num_owned();
  for (std::int32_t i = owned; i < num_bulk; ++i)
    links.push_back({_of_node[i], theirs[i]});
  for (const std::int64_t name : here)
    links.push_back({name, name});
  make_unique(links);
  links = mesh::gathered(_map->ranks(),
                         std::span<const std::array<std::int64_t, 2>>(links));
  std::vector<std::int64_t> numbers;
  for (const auto& link : links)
    numbers.insert(numbers.end(), link.begin(), link.end());
  make_unique(numbers);
  std::vector<std::int32_t> ends;
  for (const auto& link : links)
    for (const std::int64_t name : link)
      ends.push_back(static_cast<std::int32_t>(place(numbers, name)));
  const std::vector<std::int32_t> part
      = connected_parts(ends, 2, static_cast<std::int32_t>(numbers.size()));
  _names.clear();
  for (std::size_t i = 0; i < numbers.size(); ++i)
    if (part[i] == static_cast<std::int32_t>(i))
      _names.push_back(numbers[i]);
  std::vector<std::int64_t> known;
  for (const std::int64_t name : here)
    known.push_back(numbers[part[place(numbers, name)]]);
  return known;
}

void Bodies::nodes_changed()
{
  _of_node.resize(_map->num_nodes());
  if (_map->ranks().size() > 1)
    _map->forward(std::span<std::int64_t>(_of_node), 1);
  _number.resize(_of_node.size());
  for (std::size_t i = 0; i < _of_node.size(); ++i)
    _number[i] = static_cast<std::int32_t>(place(_names, _of_node[i]));
}

std::vector<std::int64_t>
Bodies::carrying(std::span<const std::int32_t> nodes) const
{
  std::vector<std::int64_t> here;
  _map->ranks().agree(
      [&]
      {
        check::numbers(nodes, std::ssize(_of_node), "nodes", "nodes");
        for (const std::int32_t node : nodes)
          here.push_back(_of_node[node]);
      });
  make_unique(here);
  here = mesh::gathered(_map->ranks(), std::span<const std::int64_t>(here));
  make_unique(here);
  return here;
}

std::vector<std::int32_t> Bodies::nodes(std::int64_t body) const
{
  std::vector<std::int32_t> nodes;
  const std::int32_t owned = _map->num_owned();
  for (std::int32_t i = 0; i < owned; ++i)
    if (_of_node[i] == body)
      nodes.push_back(i);
  return nodes;
}

std::int64_t Bodies::count(std::int64_t body) const
{
  const auto owned = std::span(_of_node).first(_map->num_owned());
  return mesh::total(_map->ranks(),
                     std::int64_t(std::ranges::count(owned, body)));
}

std::vector<std::int32_t> Bodies::cells(std::int64_t body) const
{
  std::vector<std::int32_t> cells;
  for (std::int32_t c = 0; c < _num_owned_cells; ++c)
    if (_of_cell[c] == body)
      cells.push_back(c);
  return cells;
}

std::vector<double> Bodies::boxes(std::span<const std::int64_t> bodies,
                                  std::span<const double> x, int gdim) const
{
  const std::size_t width = gdim, size = _names.size() * width;
  _map->ranks().agree(
      [&]
      {
        if (gdim < 1 or x.size() != width * _of_node.size())
          throw std::invalid_argument(
              "x must have gdim coordinates for each of "
              + std::to_string(_of_node.size()) + " nodes: it has "
              + std::to_string(x.size()) + " values");
        for (const std::int64_t body : bodies)
          if (not std::ranges::binary_search(_names, body))
            throw std::invalid_argument("bodies must be names of bodies: "
                                        + std::to_string(body) + " is none");
      });
  // The largest of x and of its opposite
  std::vector<double> corners(2 * size,
                              -std::numeric_limits<double>::infinity());
  const std::int32_t owned = _map->num_owned();
  for (std::int32_t i = 0; i < owned; ++i)
    for (std::size_t k = 0; k < width; ++k)
    {
      const double at = x[i * width + k];
      double& low = corners[_number[i] * width + k];
      double& high = corners[size + _number[i] * width + k];
      low = std::max(low, -at);
      high = std::max(high, at);
    }
  if (_map->ranks().size() > 1)
    _map->ranks().reduce(std::span(corners), Reduction::largest);
  std::vector<double> result;
  result.reserve(2 * bodies.size() * width);
  for (const double sign : {-1.0, 1.0})
    for (const std::int64_t body : bodies)
      for (std::size_t k = 0; k < width; ++k)
        result.push_back(
            sign
            * corners[(sign > 0 ? size : 0) + place(_names, body) * width + k]);
  return result;
}
