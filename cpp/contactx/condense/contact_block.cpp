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

/// Sums of blocks by the nodes of their rows and columns. Pairs come one by
/// one, and all of them at once would be many times as large.
class Sums
{
public:
  /// Entries of a node's unknowns by those of another, row by row
  using Block = std::array<double, 9>;

  /// The blocks of a node's rows.
  struct Row
  {
    std::vector<std::int32_t> columns; // nodes, in the order of the first pairs
    std::vector<Block> blocks;
  };

  /// The block at a place, zero at first.
  Block& at(std::int32_t row, std::int32_t column)
  {
    if (std::size_t(row) >= _places.size())
      _places.resize(row + 1, -1);
    if (_places[row] < 0)
    {
      _places[row] = static_cast<std::int32_t>(_rows.size());
      _rows.emplace_back();
    }
    auto& [columns, blocks] = _rows[_places[row]];
    const auto i = std::ranges::find(columns, column) - columns.begin();
    if (std::size_t(i) == columns.size())
    {
      columns.push_back(column);
      blocks.push_back({});
    }
    return blocks[i];
  }

  /// The blocks of a row, null where it has none.
  const Row* row(std::size_t i) const
  {
    return i < _places.size() and _places[i] >= 0 ? &_rows[_places[i]]
                                                  : nullptr;
  }

private:
  std::vector<std::int32_t> _places; // of rows
  std::vector<Row> _rows;
};
} // namespace

Nodes contactx::condense::nodes_of(const contact::Contact& contact)
{
  const law::NodeState& nodes = *contact.nodes();
  return {contact.slaves().owned(),
          nodes.size(),
          nodes.status,
          nodes.area,
          nodes.normal,
          nodes.by_multiplier};
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
  Sums sums;
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
            const double* value = block.data();
            const std::size_t stride = width * columns.size();
            for (const std::int32_t row : rows)
            {
              for (std::size_t j = 0; j < columns.size(); ++j)
              {
                // Multipliers of other ranks' nodes come after those of this
                // one
                if ((row_is and std::size_t(row) >= n)
                    or (column_is and std::size_t(columns[j]) >= n))
                  continue;
                Sums::Block& sum
                    = sums.at(row_is ? start + row : row,
                              column_is ? start + columns[j] : columns[j]);
                for (std::size_t k = 0; k < height; ++k)
                  for (std::size_t l = 0; l < width; ++l)
                    sum[k * width + l] += value[k * stride + j * width + l];
              }
              value += height * stride;
            }
          });
    }
    for (std::size_t s = 0; s < n; ++s)
    {
      const auto node = static_cast<std::int32_t>(start + s);
      std::copy_n(nodes.by_multiplier.begin() + s * size * size, size * size,
                  sums.at(node, node).begin());
    }
    widths.insert(widths.end(), n, static_cast<std::int32_t>(size));
    first += n * size;
  }

  std::vector<std::int32_t> firsts(widths.size() + 1, 0), order;
  std::partial_sum(widths.begin(), widths.end(), firsts.begin() + 1);
  const auto is_left_out = [prescribed](std::size_t i)
  { return i < prescribed.size() and prescribed[i] != 0; };
  _offsets.assign(1, 0);
  _offsets.reserve(firsts.back() + 1);
  for (std::size_t i = 0; i < widths.size(); ++i)
  {
    const Sums::Row* row = sums.row(i);
    order.resize(row ? row->columns.size() : 0);
    std::iota(order.begin(), order.end(), 0);
    std::ranges::sort(order, {}, [row](int j) { return row->columns[j]; });
    for (int k = 0; k < widths[i]; ++k)
    {
      for (const std::int32_t j : order)
      {
        const std::int32_t column = row->columns[j];
        for (int l = 0; l < widths[column]; ++l)
        {
          const double value = row->blocks[j][k * widths[column] + l];
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
  }
}

Entries ContactBlock::entries(std::span<const std::int64_t> places) const
{
  check::require(places.size() == size(),
                 "places must have a number for each unknown");
  Entries all;
  for (std::size_t row = 0; row < size(); ++row)
    for (auto e = _offsets[row]; e < _offsets[row + 1]; ++e)
    {
      all.rows.push_back(places[row]);
      all.columns.push_back(places[_columns[e]]);
    }
  all.values = _values;
  return all;
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
