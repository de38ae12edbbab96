// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#include "triplets.h"
#include <algorithm>
#include <numeric>

using namespace contactx;

void Triplets::reserve(std::size_t count)
{
  rows.reserve(count);
  columns.reserve(count);
  values.reserve(count);
}

void Triplets::join(const Triplets& other, double factor)
{
  const std::size_t first = size();
  rows.insert(rows.end(), other.rows.begin(), other.rows.end());
  columns.insert(columns.end(), other.columns.begin(), other.columns.end());
  values.insert(values.end(), other.values.begin(), other.values.end());
  if (factor != 1)
    for (std::size_t e = first; e < size(); ++e)
      values[e] *= factor;
}

void Triplets::multiply(std::span<const double> x, std::span<double> y,
                        double factor) const
{
  for (std::size_t e = 0; e < size(); ++e)
    y[rows[e]] += factor * values[e] * x[columns[e]];
}

Groups contactx::grouped(std::span<const std::int32_t> places,
                         std::size_t count)
{
  Groups groups;
  groups.offsets.assign(count + 1, 0);
  for (const std::int32_t place : places)
    ++groups.offsets[place + 1];
  std::partial_sum(groups.offsets.begin(), groups.offsets.end(),
                   groups.offsets.begin());
  groups.entries.resize(places.size());
  std::vector<std::int32_t> next(groups.offsets.begin(),
                                 groups.offsets.end() - 1);
  for (std::size_t e = 0; e < places.size(); ++e)
    groups.entries[next[places[e]]++] = static_cast<std::int32_t>(e);
  return groups;
}

Triplets contactx::product(const Triplets& A, const Triplets& B,
                           std::size_t num_rows, std::size_t num_inner,
                           std::size_t num_columns)
{
  const Groups rows = grouped(A.rows, num_rows);
  const Groups inner = grouped(B.rows, num_inner);
  Triplets C;
  // Gustavson's algorithm: the sums of one row at a time
  std::vector<double> sums(num_columns, 0);
  std::vector<bool> is_new(num_columns, true);
  std::vector<std::int32_t> found;
  for (std::size_t i = 0; i < num_rows; ++i)
  {
    found.clear();
    for (const std::int32_t a : rows[i])
      for (const std::int32_t b : inner[A.columns[a]])
      {
        const std::int32_t column = B.columns[b];
        if (is_new[column])
        {
          is_new[column] = false;
          found.push_back(column);
        }
        sums[column] += A.values[a] * B.values[b];
      }
    std::ranges::sort(found);
    for (const std::int32_t column : found)
    {
      if (sums[column] != 0)
        C.add(static_cast<std::int32_t>(i), column, sums[column]);
      sums[column] = 0;
      is_new[column] = true;
    }
  }
  return C;
}

Triplets contactx::merged(const Triplets& A, std::size_t num_rows,
                          std::size_t num_columns)
{
  Triplets one;
  one.reserve(num_columns);
  for (std::size_t i = 0; i < num_columns; ++i)
    one.add(static_cast<std::int32_t>(i), static_cast<std::int32_t>(i), 1);
  return product(A, one, num_rows, num_columns, num_columns);
}
