// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#pragma once

#include "../mesh/ranks.h"
#include <cstddef>
#include <cstdint>
#include <map>
#include <span>
#include <utility>
#include <vector>

/// @brief Arrays of all ranks in one file, of which no rank has more than its
/// share.
namespace contactx::storage
{
/// @brief Number of keys of all ranks, and the sums of the halves of their
/// hashes: others where the keys are.
struct Digest
{
  std::int64_t count = 0, high = 0, low = 0;

  bool operator==(const Digest&) const = default;
};

/// @brief A hash of some bytes: FNV-1a, whose bits are then mixed, since the
/// highest ones choose a rank.
std::uint64_t hash(std::span<const std::byte> bytes);

/// @brief Digest of the keys of all ranks, in whatever order; collective.
/// @param[in] ranks The ranks.
/// @param[in] keys Keys of this rank (shape=(n, width)).
/// @param[in] width Numbers a key.
Digest digest(mesh::Ranks& ranks, std::span<const std::int64_t> keys,
              int width);

/// @brief Rows of all ranks, told apart by keys that are the same on any number
/// of ranks, and their order in a file: that of their hashes.
///
/// Each rank has a share of the file: the rows whose hashes are in its part of
/// the range of all hashes. The shares are as large as each other, but for what
/// chance does to a few rows. So the key alone says which rank reads and writes
/// a row, and neither the order nor the file depends on the number of ranks.
class Rows
{
public:
  /// @brief Find the order; collective.
  /// @param[in] ranks The ranks; they must outlive this.
  /// @param[in] keys Keys that no other row has, on this rank or another one
  /// (shape=(n, width)).
  /// @param[in] width Numbers a key, the same on all ranks.
  /// @throws std::invalid_argument on all ranks if there are several and two
  /// rows have the same key.
  Rows(mesh::Ranks& ranks, std::span<const std::int64_t> keys, int width);

  /// @brief Digest of the keys.
  const Digest& digest() const { return _digest; }

  /// @brief Number of rows of this rank.
  std::size_t size() const { return _size; }

  /// @brief Place of the first row of this rank's share in the order of all.
  std::int64_t first() const { return _first; }

  /// @brief Number of rows of this rank's share.
  std::size_t share() const { return _place.size(); }

  /// @brief Bring rows to the shares that they belong to; collective.
  /// @param[in] rows Rows of this rank.
  /// @param[in] width Bytes a row, the same on all ranks.
  /// @return Rows of this rank's share, in their order.
  std::vector<std::byte> to_share(std::span<const std::byte> rows,
                                  std::size_t width) const;

  /// @brief Bring rows from the shares to the ranks that have them; collective.
  /// @param[in] share Rows of this rank's share, in their order.
  /// @param[in] width Bytes a row, the same on all ranks.
  /// @return Rows of this rank.
  std::vector<std::byte> from_share(std::span<const std::byte> share,
                                    std::size_t width) const;

private:
  mesh::Ranks* _ranks;
  std::size_t _size;
  Digest _digest;
  std::int64_t _first = 0;
  // Rows of this rank by the rank whose share they are of, and numbers of rows
  // that came from others; place of each of those in the share
  std::map<int, std::vector<std::int32_t>> _sent;
  std::vector<std::pair<int, std::size_t>> _received;
  std::vector<std::int32_t> _place;
};
} // namespace contactx::storage
