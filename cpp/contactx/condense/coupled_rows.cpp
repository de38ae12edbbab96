// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#include "coupled_rows.h"
#include "../check.h"
#include <algorithm>
#include <stdexcept>

using namespace contactx;
using namespace contactx::condense;

CoupledRows contactx::condense::coupled(std::span<const std::int64_t> offsets,
                                        std::span<const std::int64_t> columns,
                                        std::span<const double> values,
                                        const ContactBlock& contact,
                                        std::span<const std::int64_t> places,
                                        std::size_t num_owned,
                                        std::size_t num_local)
{
  const CompressedRows c = contact.entries();
  check::require(not offsets.empty() and offsets.front() == 0
                     and std::ranges::is_sorted(offsets),
                 "offsets must be where rows begin");
  const std::size_t num_bulk = offsets.size() - 1;
  check::require(columns.size() == values.size()
                     and offsets.back() == std::ssize(columns),
                 "columns and values must have what offsets say");
  check::require(
      num_owned <= num_bulk and num_owned <= num_local
          and num_local <= contact.size(),
      "num_owned must be at most the number of rows, and num_local from it to "
      "the number of unknowns");
  check::require(places.size() == contact.size(),
                 "places must have a number for each unknown");

  CoupledRows result;
  using Entry = std::pair<std::int64_t, double>;
  std::vector<Entry> entries;
  const auto take = [&](std::size_t row)
  {
    entries.clear();
    for (auto e = c.offsets[row]; e < c.offsets[row + 1]; ++e)
      entries.emplace_back(places[c.columns[e]], c.values[e]);
    std::ranges::sort(entries, {}, &Entry::first);
  };
  Rows& own = result.own;
  const std::size_t most = values.size() + c.values.size();
  own.columns.reserve(most);
  own.values.reserve(most);
  own.offsets.reserve(num_bulk + contact.size() - num_local + 1);
  own.offsets.push_back(0);
  const auto end
      = [](Rows& rows) { rows.offsets.push_back(std::ssize(rows.columns)); };
  for (std::size_t row = 0; row < num_bulk; ++row)
  {
    // Contact has nothing in rows of other fields
    entries.clear();
    if (row < num_owned)
      take(row);
    auto at = entries.begin();
    for (auto e = offsets[row]; e < offsets[row + 1]; ++e)
    {
      for (; at != entries.end() and at->first < columns[e]; ++at)
      {
        own.columns.push_back(at->first);
        own.values.push_back(at->second);
      }
      own.columns.push_back(columns[e]);
      own.values.push_back(values[e]);
      if (at != entries.end() and at->first == columns[e])
        own.values.back() += (at++)->second;
    }
    for (; at != entries.end(); ++at)
    {
      own.columns.push_back(at->first);
      own.values.push_back(at->second);
    }
    end(own);
  }
  const auto add = [&](std::size_t row, Rows& rows)
  {
    take(row);
    for (const auto& [column, value] : entries)
    {
      rows.columns.push_back(column);
      rows.values.push_back(value);
    }
    end(rows);
  };
  for (std::size_t row = num_local; row < contact.size(); ++row)
    add(row, own);
  result.added.offsets.push_back(0);
  for (std::size_t row = num_owned; row < num_local; ++row)
    if (c.offsets[row] < c.offsets[row + 1])
    {
      result.others.push_back(places[row]);
      add(row, result.added);
    }
  return result;
}
