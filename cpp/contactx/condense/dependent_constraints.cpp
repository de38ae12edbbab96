// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#include "dependent_constraints.h"
#include "../math/scales.h"
#include <algorithm>
#include <cmath>
#include <utility>

using namespace contactx;
using namespace contactx::condense;

namespace
{
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
          or not(std::abs(a[i].second - b[i].second) <= math::equal_rel_tol))
        return false;
  }
  return true;
}
} // namespace

std::vector<std::int8_t>
contactx::condense::marks(const mesh::NodeMap& nodes,
                          std::span<const std::int32_t> dofs, int gdim)
{
  std::vector<std::int64_t> marks(
      static_cast<std::size_t>(nodes.num_nodes()) * gdim, 0);
  for (const std::int32_t dof : dofs)
    marks[dof] = 1;
  nodes.forward(marks, gdim);
  return {marks.begin(), marks.end()};
}

DependentConstraints
contactx::condense::dependent_constraints(const Elimination& elimination,
                                          const mesh::NodeMap& nodes)
{
  const int gdim = elimination.gdim();
  const auto taken = marks(nodes, elimination.constrained(), gdim);
  const auto given = marks(nodes, elimination.recovered(), gdim);
  const auto joins = [](const std::vector<std::int8_t>& marks)
  {
    return [&marks](std::int32_t row, std::int32_t column, double)
    { return row != column and marks[row] != 0 and marks[column] != 0; };
  };
  return {elimination.rigid_right().select(joins(taken)),
          elimination.rigid_left().select(joins(given))};
}

bool contactx::condense::is_symmetric(const Elimination& elimination,
                                      const mesh::NodeMap& nodes)
{
  // Where friction sticks its traction moves over a master with what presses it
  // on, and contact's part of the stiffness is not symmetric
  bool is_same = not elimination.slips() and not elimination.sticks();
  if (is_same)
  {
    // Both entries of a slave node are on its own rank
    const Triplets right = elimination.rigid_right().select(
        [](std::int32_t row, std::int32_t column, double)
        { return row != column; });
    const std::size_t size
        = static_cast<std::size_t>(nodes.num_nodes()) * elimination.gdim();
    is_same = is_transpose(elimination.rigid_left(), right, size);
  }
  return mesh::everywhere(nodes.ranks(), is_same);
}
