// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#include "contact_block.h"
#include "../check.h"
#include <algorithm>
#include <array>
#include <numeric>
#include <stdexcept>

using namespace contactx;
using namespace contactx::condense;

namespace
{
/// 1 at slave nodes that are closed, or whose multiplier is not known to be
/// zero.
std::vector<std::int8_t> needed(const law::NodeState& nodes,
                                std::span<const double> d)
{
  std::vector<std::int8_t> which(nodes.num_nodes());
  for (std::size_t i = 0; i < which.size(); ++i)
  {
    const auto row = d.subspan(i * nodes.size(), nodes.size());
    which[i] = nodes.closed(i)
               or std::ranges::any_of(row, [](double v) { return v != 0; });
  }
  return which;
}
} // namespace

Nodes contactx::condense::nodes_of(const contact::Contact& contact)
{
  const law::NodeState& nodes = *contact.nodes();
  return {contact.slaves().owned(),
          nodes.size(),
          nodes.status,
          nodes.area,
          nodes.normal,
          nodes.by_multiplier,
          nodes.layer_compliance};
}

ContactBlock::ContactBlock(const Contacts& contacts,
                           std::span<const std::int8_t> prescribed,
                           bool keeps_zeros, std::span<const double> d)
{
  check::require(not contacts.empty(), "contacts must not be empty");
  const mesh::Halo& halo = contacts.front()->halo();
  const std::size_t num_local = std::size_t(halo.num_nodes()) * halo.gdim();
  std::size_t num_multipliers = 0;
  for (const auto& c : contacts)
    num_multipliers += c->nodes()->multiplier.size();
  check::require(prescribed.empty() or prescribed.size() == num_local,
                 "prescribed must have a value for each displacement");
  check::require(d.empty() or d.size() == num_multipliers,
                 "d must have a value for each multiplier");

  // Nodes have their displacements for unknowns, slave nodes of a contact their
  // multipliers: those of one are neighbours
  const std::int32_t num_nodes = halo.num_nodes(), gdim = halo.gdim();
  std::vector<std::int32_t> widths(num_nodes, gdim);
  std::vector<Tile> tiles;
  std::vector<double> values;
  std::size_t first = 0;
  for (const auto& c : contacts)
  {
    const law::NodeState& nodes = *c->nodes();
    const std::size_t n = nodes.num_nodes(), size = nodes.size();
    const auto start = static_cast<std::int32_t>(widths.size());
    std::vector<std::int8_t> which;
    if (not d.empty())
      which = needed(nodes, d.subspan(first, n * size));
    for (const char* term : {"stiffness", "traction", "constraint"})
    {
      const bool row_is = term == std::string_view("constraint");
      const bool column_is = term == std::string_view("traction");
      const std::size_t height = row_is ? size : gdim,
                        width = column_is ? size : gdim;
      c->for_each_pair(
          term, which,
          [&](std::span<const std::int32_t> rows,
              std::span<const std::int32_t> columns,
              std::span<const double> block)
          {
            std::size_t at = values.size();
            values.insert(values.end(), block.begin(), block.end());
            const std::size_t stride = width * columns.size();
            for (const std::int32_t row : rows)
            {
              for (std::size_t j = 0; j < columns.size(); ++j)
              {
                // Multipliers of other ranks' nodes come after those of this
                // one
                const bool is_here
                    = (not row_is or std::size_t(row) < n)
                      and (not column_is or std::size_t(columns[j]) < n);
                if (is_here)
                  tiles.push_back({row_is ? start + row : row,
                                   column_is ? start + columns[j] : columns[j],
                                   at + j * width, stride});
              }
              at += height * stride;
            }
          });
    }
    for (std::size_t s = 0; s < n; ++s)
    {
      const auto node = static_cast<std::int32_t>(start + s);
      tiles.push_back({node, node, values.size() + s * size * size, size});
    }
    values.insert(values.end(), nodes.by_multiplier.begin(),
                  nodes.by_multiplier.end());
    widths.insert(widths.end(), n, static_cast<std::int32_t>(size));
    first += n * size;
  }
  add_up(tiles, values, widths, prescribed, keeps_zeros);
}

void ContactBlock::add_up(std::span<const Tile> tiles,
                          std::span<const double> values,
                          std::span<const std::int32_t> widths,
                          std::span<const std::int8_t> prescribed,
                          bool keeps_zeros)
{
  const std::size_t num_groups = widths.size();
  std::vector<std::int32_t> firsts(num_groups + 1, 0), rows(tiles.size());
  std::partial_sum(widths.begin(), widths.end(), firsts.begin() + 1);
  std::ranges::transform(tiles, rows.begin(), &Tile::row);
  const Groups by_row = grouped(rows, num_groups);

  const auto is_left_out = [prescribed](std::size_t i)
  { return i < prescribed.size() and prescribed[i] != 0; };
  // Sums of the tiles of one place
  using Sum = std::array<double, 9>;
  std::vector<Sum> sums;
  std::vector<std::int32_t> slots(num_groups, -1), found;
  _offsets.assign(1, 0);
  _offsets.reserve(firsts.back() + 1);
  for (std::size_t i = 0; i < num_groups; ++i)
  {
    found.clear();
    sums.clear();
    const int height = widths[i];
    for (const std::int32_t t : by_row[i])
    {
      const Tile& tile = tiles[t];
      std::int32_t& slot = slots[tile.column];
      if (slot < 0)
      {
        slot = static_cast<std::int32_t>(sums.size());
        sums.push_back({});
        found.push_back(tile.column);
      }
      const int width = widths[tile.column];
      Sum& sum = sums[slot];
      for (int k = 0; k < height; ++k)
        for (int l = 0; l < width; ++l)
          sum[k * width + l] += values[tile.at + k * tile.stride + l];
    }
    std::ranges::sort(found);
    for (int k = 0; k < height; ++k)
    {
      for (const std::int32_t column : found)
      {
        const int width = widths[column];
        for (int l = 0; l < width; ++l)
        {
          const double value = sums[slots[column]][k * width + l];
          if ((keeps_zeros or value != 0) and not is_left_out(firsts[i] + k)
              and not is_left_out(firsts[column] + l))
          {
            _columns.push_back(firsts[column] + l);
            _values.push_back(value);
          }
        }
      }
      _offsets.push_back(static_cast<std::int32_t>(_columns.size()));
    }
    for (const std::int32_t column : found)
      slots[column] = -1;
  }
}

std::vector<double> ContactBlock::multiply(std::span<const double> x) const
{
  check::require(x.size() == size(), "x must have a value for each unknown");
  std::vector<double> y(size(), 0);
  for (std::size_t i = 0; i < size(); ++i)
    for (std::int32_t e = _offsets[i]; e < _offsets[i + 1]; ++e)
      y[i] += _values[e] * x[_columns[e]];
  return y;
}
