// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#include "chains.h"
#include <algorithm>
#include <cmath>
#include <utility>

using namespace contactx;
using namespace contactx::condense;

namespace
{
/// Largest difference of entries that are the same but for rounding
constexpr double tolerance = 1e-8;

using Line = std::vector<std::pair<std::int32_t, double>>;

/// Entries of one row, or column, in order
void read(Line& line, std::span<const std::int32_t> entries,
          const std::vector<std::int32_t>& places,
          const std::vector<double>& values)
{
  line.clear();
  for (const std::int32_t e : entries)
    line.emplace_back(places[e], values[e]);
  std::ranges::stable_sort(line, {}, &Line::value_type::first);
}

bool is_transpose(const Triplets& left, const Triplets& right,
                  std::size_t num_local)
{
  if (left.size() != right.size())
    return false;
  const Groups of_left = grouped(left.columns, num_local);
  const Groups of_right = grouped(right.rows, num_local);
  if (of_left.offsets != of_right.offsets)
    return false;
  Line a, b;
  for (std::size_t dof = 0; dof < num_local; ++dof)
  {
    read(a, of_left[dof], left.rows, left.values);
    read(b, of_right[dof], right.columns, right.values);
    for (std::size_t i = 0; i < a.size(); ++i)
      if (a[i].first != b[i].first
          or not(std::abs(a[i].second - b[i].second) <= tolerance))
        return false;
  }
  return true;
}
} // namespace

std::vector<std::int8_t>
contactx::condense::marks(const parallel::NodeMap& nodes,
                          std::span<const std::int32_t> dofs, int gdim)
{
  std::vector<std::int64_t> marks(
      static_cast<std::size_t>(nodes.num_nodes()) * gdim, 0);
  for (const std::int32_t dof : dofs)
    marks[dof] = 1;
  nodes.forward(marks, gdim);
  return {marks.begin(), marks.end()};
}

std::vector<std::int8_t>
contactx::condense::slave_marks(const parallel::NodeMap& nodes,
                                std::span<const Nodes> contacts)
{
  const std::size_t width = contacts.size();
  std::vector<std::int64_t> marks(nodes.num_nodes() * width, 0);
  for (std::size_t k = 0; k < width; ++k)
    for (const std::int32_t node : contacts[k].slaves)
      marks[node * width + k] = 1;
  nodes.forward(marks, static_cast<int>(width));
  return {marks.begin(), marks.end()};
}

void contactx::condense::check_chains(const Elimination& elimination,
                                      const parallel::NodeMap& nodes)
{
  const int gdim = elimination.gdim();
  const Triplets &left = elimination.left(), &right = elimination.right();
  const auto given = marks(nodes, elimination.recovered(), gdim);
  const auto taken = marks(nodes, elimination.eliminated(), gdim);
  // A row that is taken over must not get one, nor a displacement follow from
  // another
  bool is_chain = false;
  for (std::size_t e = 0; e < left.size() and not is_chain; ++e)
    is_chain = given[left.rows[e]] != 0 and given[left.columns[e]] != 0
               and left.rows[e] / gdim != left.columns[e] / gdim;
  for (std::size_t e = 0; e < right.size() and not is_chain; ++e)
    is_chain
        = taken[right.columns[e]] != 0 and right.rows[e] != right.columns[e];
  if (parallel::anywhere(nodes.ranks(), is_chain))
    throw NotCondensable(
        "a node is slave in one contact and master in another");
}

bool contactx::condense::is_symmetric(const Elimination& elimination,
                                      const parallel::NodeMap& nodes)
{
  const auto taken = marks(nodes, elimination.eliminated(), elimination.gdim());
  // Where friction sticks its traction moves over a master with what presses it
  // on, and contact's part of the stiffness is not symmetric
  bool is_same = not elimination.slips() and not elimination.sticks();
  if (is_same)
  {
    // Both entries of a slave node are on its own rank
    const Triplets left
        = elimination.left().select([&](std::int32_t row, std::int32_t, double)
                                    { return taken[row] == 0; });
    const Triplets right
        = elimination.right().select([](std::int32_t row, std::int32_t column,
                                        double) { return row != column; });
    is_same = is_transpose(left, right, taken.size());
  }
  return parallel::everywhere(nodes.ranks(), is_same);
}
