// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#include "contact_block.h"
#include "../check.h"
#include <algorithm>
#include <stdexcept>

using namespace contactx;
using namespace contactx::condense;

namespace
{
/// 1 at slave nodes that are closed, or whose multiplier is not known to be
/// zero.
std::vector<std::int8_t> needed(const contact::NodeState& nodes,
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
  const contact::NodeState& nodes = *contact.nodes();
  return {contact.slaves().owned(),
          nodes.size(),
          nodes.status,
          nodes.area,
          nodes.normal,
          nodes.by_multiplier,
          nodes.softness};
}

ContactBlock::ContactBlock(const Contacts& contacts,
                           std::span<const std::int8_t> prescribed,
                           bool keeps_zeros, std::span<const double> d)
{
  check::require(not contacts.empty(), "contacts must not be empty");
  const parallel::Halo& halo = contacts.front()->halo();
  const std::size_t num_local = std::size_t(halo.num_nodes()) * halo.gdim();
  std::size_t num_multipliers = 0;
  for (const auto& c : contacts)
    num_multipliers += c->nodes()->multiplier.size();
  check::require(prescribed.empty() or prescribed.size() == num_local,
                 "prescribed must have a value for each displacement");
  check::require(d.empty() or d.size() == num_multipliers,
                 "d must have a value for each multiplier");

  Triplets all;
  std::size_t first = num_local;
  for (const auto& c : contacts)
  {
    const contact::NodeState& nodes = *c->nodes();
    const std::size_t n = nodes.multiplier.size(), size = nodes.size();
    std::vector<std::int8_t> which;
    if (not d.empty())
      which = needed(nodes, d.subspan(first - num_local, n));
    // Place of a displacement or multiplier, -1 where it is left out
    const auto place = [&](std::int32_t i, bool is_multiplier)
    {
      if (is_multiplier)
        return std::size_t(i) < n ? static_cast<std::int32_t>(first + i) : -1;
      return not prescribed.empty() and prescribed[i] ? -1 : i;
    };
    for (const char* term : {"stiffness", "traction", "constraint"})
    {
      const auto part = c->block(term, which, keeps_zeros);
      const bool row_is = term == std::string_view("constraint");
      const bool column_is = term == std::string_view("traction");
      const std::size_t count = all.size() + part.size();
      if (count > all.values.capacity())
        all.reserve(std::max(count, 2 * all.values.capacity()));
      for (std::size_t e = 0; e < part.values.size(); ++e)
      {
        const std::int32_t row = place(part.rows[e], row_is);
        const std::int32_t column = place(part.columns[e], column_is);
        const bool counts = keeps_zeros or part.values[e] != 0;
        if (row >= 0 and column >= 0 and counts)
          all.add(row, column, part.values[e]);
      }
    }
    for (std::size_t k = 0; k < nodes.by_multiplier.size(); ++k)
      if (keeps_zeros or nodes.by_multiplier[k] != 0)
        all.add(static_cast<std::int32_t>(first + k / size),
                static_cast<std::int32_t>(first + k / (size * size) * size
                                          + k % size),
                nodes.by_multiplier[k]);
    first += n;
  }

  // Entries of one place add up, row by row
  const std::size_t num_rows = num_local + num_multipliers;
  const Groups rows = grouped(all.rows, num_rows);
  std::vector<double> sums(num_rows, 0);
  std::vector<std::int8_t> is_found(num_rows, 0);
  std::vector<std::int32_t> found;
  _offsets.assign(1, 0);
  _offsets.reserve(num_rows + 1);
  for (std::size_t i = 0; i < num_rows; ++i)
  {
    found.clear();
    for (const std::int32_t e : rows[i])
    {
      const std::int32_t column = all.columns[e];
      if (not is_found[column])
        found.push_back(column);
      is_found[column] = 1;
      sums[column] += all.values[e];
    }
    std::ranges::sort(found);
    for (const std::int32_t column : found)
    {
      is_found[column] = 0;
      if (keeps_zeros or sums[column] != 0)
      {
        _columns.push_back(column);
        _values.push_back(sums[column]);
      }
      sums[column] = 0;
    }
    _offsets.push_back(static_cast<std::int32_t>(_columns.size()));
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
