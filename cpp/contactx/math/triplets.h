// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace contactx
{
/// @brief Entries of a sparse matrix; those of one place add up.
struct Triplets
{
  std::vector<std::int32_t> rows;    ///< rows
  std::vector<std::int32_t> columns; ///< columns
  std::vector<double> values;        ///< values

  /// @brief Number of entries.
  std::size_t size() const { return values.size(); }

  /// @brief Make room for a number of entries.
  void reserve(std::size_t count);

  /// @brief Add an entry.
  void add(std::int32_t row, std::int32_t column, double value)
  {
    rows.push_back(row);
    columns.push_back(column);
    values.push_back(value);
  }

  /// @brief Add all entries of another matrix, times a factor.
  void join(const Triplets& other, double factor = 1);

  /// @brief Some of the entries.
  /// @param[in] keep Whether to take an entry: keep(row, column, value).
  template <class F>
  Triplets select(F&& keep) const
  {
    Triplets part;
    for (std::size_t e = 0; e < size(); ++e)
      if (keep(rows[e], columns[e], values[e]))
        part.add(rows[e], columns[e], values[e]);
    return part;
  }

  /// @brief Add a product, y += factor A x.
  void multiply(std::span<const double> x, std::span<double> y,
                double factor = 1) const;
};

/// @brief Matrix whose entries are stored row by row, as others own it.
struct CompressedRows
{
  std::span<const std::int32_t> offsets; ///< where rows begin, and the end
  std::span<const std::int32_t> columns; ///< columns
  std::span<const double> values;        ///< values
};

/// @brief Entries by the rows or columns that they are in.
struct Groups
{
  std::vector<std::int32_t> offsets; ///< where groups begin, and the end
  std::vector<std::int32_t> entries; ///< entries, in order within a group

  /// @brief Entries of a group.
  std::span<const std::int32_t> operator[](std::size_t group) const
  {
    return {entries.data() + offsets[group],
            entries.data() + offsets[group + 1]};
  }
};

/// @brief Sort entries by their rows, or by their columns.
/// @param[in] places Rows or columns of the entries.
/// @param[in] count Number of rows or columns.
Groups grouped(std::span<const std::int32_t> places, std::size_t count);

/// @brief Product of two matrices without entries that are zero, one for each
/// place, row by row; columns within a row are in order.
/// @param[in] A First factor.
/// @param[in] B Second factor.
/// @param[in] num_rows Number of rows of the first one.
/// @param[in] num_inner Number of columns of the first one, rows of the second.
/// @param[in] num_columns Number of columns of the second one.
Triplets product(const Triplets& A, const Triplets& B, std::size_t num_rows,
                 std::size_t num_inner, std::size_t num_columns);

/// @brief Make a matrix with one entry for each place, and none that are zero;
/// row by row, columns in order.
/// @param[in] A Matrix.
/// @param[in] num_rows Number of its rows.
/// @param[in] num_columns Number of its columns.
Triplets merged(const Triplets& A, std::size_t num_rows,
                std::size_t num_columns);
} // namespace contactx
