// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#include "blocks.h"
#include "../law/normal.h"
#include <algorithm>
#include <array>
#include <string>

using namespace contactx;
using namespace contactx::condense;

namespace
{
void check_size(std::size_t size, std::size_t wanted, const char* name)
{
  if (size != wanted)
    throw std::invalid_argument(std::string(name) + " must have "
                                + std::to_string(wanted) + " values, not "
                                + std::to_string(size));
}
} // namespace

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
  if (gdim != 2 and gdim != 3)
    throw std::invalid_argument("gdim must be 2 or 3, not "
                                + std::to_string(gdim));
  for (const Nodes& nodes : contacts)
  {
    if (nodes.size != 1 and nodes.size != gdim)
      throw std::invalid_argument("size must be 1 or gdim, not "
                                  + std::to_string(nodes.size));
    const std::size_t n = nodes.count();
    check_size(nodes.status.size(), n, "status");
    check_size(nodes.area.size(), n, "area");
    if (nodes.size > 1)
      check_size(nodes.normal.size(), n * gdim, "normal");
    check_size(nodes.by_multiplier.size(), n * nodes.size * nodes.size,
               "by_multiplier");
    for (const std::int32_t node : nodes.slaves)
      if (node < 0 or static_cast<std::size_t>(node) >= num_nodes)
        throw std::invalid_argument(
            "slaves must be numbers of nodes, of which there are "
            + std::to_string(num_nodes) + ": there is " + std::to_string(node));
  }
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
  check_size(values.size(), columns.size(), "values");
  const std::size_t n = offsets.size() - 1;
  if (num_local > n)
    throw std::invalid_argument("num_local must be at most the number of rows");
  for (const std::int32_t column : columns)
    if (column < 0 or static_cast<std::size_t>(column) >= n)
      throw std::invalid_argument(
          "columns must be numbers of unknowns, of which there are "
          + std::to_string(n) + ": there is " + std::to_string(column));

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

bool contactx::condense::lump(Blocks& blocks, std::span<const Nodes> contacts,
                              std::span<const std::int8_t> is_slave, int gdim)
{
  // Slave node and contact of each multiplier
  std::vector<std::int32_t> home, contact;
  home.reserve(num_multipliers(contacts));
  contact.reserve(home.capacity());
  for (std::size_t k = 0; k < contacts.size(); ++k)
    for (const std::int32_t node : contacts[k].slaves)
    {
      home.insert(home.end(), contacts[k].size, node);
      contact.insert(contact.end(), contacts[k].size,
                     static_cast<std::int32_t>(k));
    }

  bool is_moved = false;
  auto move = [&](std::vector<std::int32_t>& dofs,
                  const std::vector<std::int32_t>& multipliers)
  {
    for (std::size_t e = 0; e < dofs.size(); ++e)
    {
      const std::int32_t node = dofs[e] / gdim, own = home[multipliers[e]];
      if (node != own
          and is_slave[node * contacts.size() + contact[multipliers[e]]] != 0)
      {
        dofs[e] = own * gdim + dofs[e] % gdim;
        is_moved = true;
      }
    }
  };
  move(blocks.constraint.columns, blocks.constraint.rows);
  move(blocks.traction.rows, blocks.traction.columns);
  return is_moved;
}
