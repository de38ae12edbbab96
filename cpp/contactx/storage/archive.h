// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#pragma once

#include "rows.h"
#include <string>
#include <variant>

namespace contactx::storage
{
/// @brief A file that all ranks have open; all must call all functions.
class File
{
public:
  virtual ~File() = default;

  /// @brief Number of its bytes.
  virtual std::int64_t size() = 0;

  /// @brief Write bytes, on each rank its own, or none.
  /// @param[in] at Place of the first one.
  /// @param[in] bytes The bytes.
  virtual void write(std::int64_t at, std::span<const std::byte> bytes) = 0;

  /// @brief Read bytes that are there, on each rank its own, or none.
  /// @param[in] at Place of the first one.
  /// @param[out] bytes The bytes.
  virtual void read(std::int64_t at, std::span<std::byte> bytes) = 0;
};

using Values
    = std::variant<std::vector<double>, std::vector<std::int8_t>,
                   std::vector<std::int32_t>, std::vector<std::int64_t>>;

/// @brief Values with a name.
struct Array
{
  std::string name;
  const Rows* rows; ///< its rows; null if it is the same on all ranks
  int width;        ///< values a row, 0 for one value a row (shape=(n))
  Values values;    ///< values of this rank's rows
};

/// @brief What a file says of an array.
struct Entry
{
  std::string name;
  std::string type;      ///< f8, i1, i4 or i8: kind and bytes of a value
  int width = 0;         ///< values a row, 0 for one value a row
  Digest keys;           ///< digest of the rows' keys; a number if all are same
  std::int64_t at = 0;   ///< place of its first byte
  std::uint64_t sum = 0; ///< checksum of its rows
};

/// @brief Write arrays, each rank its share of the rows; collective.
///
/// A file begins with its mark, the number of its format, the version of
/// contactx, the sizes of its table and of the whole, and a checksum. The table
/// has a line an entry. Then come the arrays, whose rows are in the order of
/// Rows.
/// @param[in] ranks The ranks.
/// @param[in] file An empty file.
/// @param[in] arrays Arrays with the same names, types and widths on all ranks.
void write(mesh::Ranks& ranks, File& file, const std::vector<Array>& arrays);

/// @brief Reads a file that `write` has written on any number of ranks.
class Reader
{
public:
  /// @brief Read what is in it; collective.
  /// @param[in] ranks The ranks; they must outlive this.
  /// @param[in] file The file; likewise.
  /// @throws std::invalid_argument on all ranks if it is truncated, damaged, of
  /// another format or something else.
  Reader(mesh::Ranks& ranks, File& file);

  /// @brief What is in it, in the order in which it was written.
  const std::vector<Entry>& entries() const { return _entries; }

  /// @brief The entry of a name, null if there is none.
  const Entry* find(const std::string& name) const;

  /// @brief Read an array; collective.
  /// @param[in,out] array Name, rows and width, and values of the type that
  /// the file must have.
  /// @throws std::invalid_argument on all ranks if the array is missing,
  /// damaged, or of another type or width, or of other rows.
  void read(Array& array) const;

private:
  mesh::Ranks* _ranks;
  File* _file;
  std::vector<Entry> _entries;
};
} // namespace contactx::storage
