// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#include "blocks.h"
#include "../check.h"
#include "../law/normal.h"
#include <algorithm>
#include <array>
#include <cmath>
#include <string>

using namespace contactx;
using namespace contactx::condense;

bool Nodes::is_closed(std::size_t node) const
{
  return status[node] != law::open;
}

std::size_t contactx::condense::num_multipliers(std::span<const Nodes> contacts)
{
  std::size_t count = 0;
  for (const Nodes& nodes : contacts)
    count += nodes.count() * nodes.size;
  return count;
}

void contactx::condense::check(std::span<const Nodes> contacts,
                               std::size_t num_nodes, int gdim)
{
  check::dimension(gdim);
  for (const Nodes& nodes : contacts)
  {
    if (nodes.size != 1 and nodes.size != gdim)
      throw std::invalid_argument("size must be 1 or gdim, not "
                                  + std::to_string(nodes.size));
    const std::size_t n = nodes.count();
    check::rows(nodes.status.size(), n, 1, "status", "slave node");
    check::rows(nodes.area.size(), n, 1, "area", "slave node");
    if (nodes.size > 1)
      check::rows(nodes.normal.size(), n, gdim, "normal", "slave node");
    check::rows(nodes.by_multiplier.size(), n, nodes.size * nodes.size,
                "by_multiplier", "slave node");
    check::numbers(nodes.slaves, num_nodes, "slaves", "nodes");
  }
}

Pivot contactx::condense::pivot(const Triplets& constraint,
                                std::span<const std::int32_t> entries,
                                std::int32_t first,
                                std::span<const std::int8_t> free, int gdim)
{
  std::array<double, 3> own{};
  for (const std::int32_t e : entries)
    if (const std::int32_t i = constraint.columns[e] - first;
        i >= 0 and i < gdim)
      own[i] += constraint.values[e];
  Pivot found;
  for (int i = 0; i < gdim; ++i)
    if (free[first + i] != 0 and std::abs(own[i]) > std::abs(found.coefficient))
      found = {first + i, own[i]};
  return found;
}

Blocks contactx::condense::sorted(const CompressedRows& contact,
                                  std::size_t num_local)
{
  const auto& [offsets, columns, values] = contact;
  if (offsets.empty() or offsets.front() != 0
      or not std::ranges::is_sorted(offsets)
      or static_cast<std::size_t>(offsets.back()) != columns.size())
    throw std::invalid_argument(
        "offsets must rise from 0 to the number of columns");
  check::rows(values.size(), columns.size(), 1, "values", "column");
  const std::size_t n = offsets.size() - 1;
  if (num_local > n)
    throw std::invalid_argument("num_local must be at most the number of rows");
  check::numbers(columns, n, "columns", "unknowns");

  const auto first = static_cast<std::int32_t>(num_local);
  // Entries of the stiffness, the constraint and the traction block
  std::array<std::size_t, 4> counts{};
  for (std::size_t i = 0; i < n; ++i)
    for (std::int32_t e = offsets[i]; e < offsets[i + 1]; ++e)
      if (values[e] != 0)
        ++counts[(i >= num_local ? 1 : 0) + (columns[e] >= first ? 2 : 0)];
  Blocks blocks;
  blocks.stiffness.reserve(counts[0]);
  blocks.constraint.reserve(counts[1]);
  blocks.traction.reserve(counts[2]);
  for (std::size_t i = 0; i < n; ++i)
  {
    const auto row = static_cast<std::int32_t>(i);
    for (std::int32_t e = offsets[i]; e < offsets[i + 1]; ++e)
    {
      if (values[e] == 0)
        continue;
      if (row >= first and columns[e] < first)
        blocks.constraint.add(row - first, columns[e], values[e]);
      else if (row < first and columns[e] >= first)
        blocks.traction.add(row, columns[e] - first, values[e]);
      else if (row < first)
        blocks.stiffness.add(row, columns[e], values[e]);
    }
  }
  return blocks;
}
