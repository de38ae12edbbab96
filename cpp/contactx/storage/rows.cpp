// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#include "rows.h"
#include <algorithm>
#include <array>
#include <compare>
#include <cstring>
#include <limits>
#include <numeric>
#include <stdexcept>

using namespace contactx;
using namespace contactx::storage;

namespace
{
constexpr int half = 32;
constexpr std::uint64_t low_half = 0xffffffffu;

std::vector<std::uint64_t> hashes_of(std::span<const std::int64_t> keys,
                                     int width)
{
  const auto bytes = std::as_bytes(keys);
  const std::size_t row = sizeof(std::int64_t) * width;
  std::vector<std::uint64_t> hashes;
  for (std::size_t at = 0; at < bytes.size(); at += row)
    hashes.push_back(hash(bytes.subspan(at, row)));
  return hashes;
}

Digest digest_of(mesh::Ranks& ranks, const std::vector<std::uint64_t>& hashes)
{
  // Sums of halves do not overflow
  std::array<std::int64_t, 3> sums{std::ssize(hashes), 0, 0};
  for (const std::uint64_t h : hashes)
  {
    sums[1] += static_cast<std::int64_t>(h >> half);
    sums[2] += static_cast<std::int64_t>(h & low_half);
  }
  if (ranks.size() > 1)
    ranks.reduce(std::span<std::int64_t>(sums), mesh::Reduction::sum);
  return {sums[0], sums[1], sums[2]};
}

/// Messages that come in; what a rank sends to itself has no copy.
mesh::Messages exchanged(mesh::Ranks& ranks, mesh::Messages out)
{
  auto mine = out.extract(ranks.rank());
  ranks.agree(
      [&]
      {
        for (const auto& [to, bytes] : out)
          if (bytes.size() > std::numeric_limits<std::int32_t>::max())
            throw std::length_error(
                "an array of the checkpoint has more than 2 GiB for one rank: "
                "take more ranks");
      });
  mesh::Messages in = ranks.exchange(out);
  in.insert(std::move(mine));
  return in;
}
} // namespace

std::uint64_t contactx::storage::hash(std::span<const std::byte> bytes)
{
  std::uint64_t h = 14695981039346656037u;
  for (const std::byte b : bytes)
    h = (h ^ std::to_integer<std::uint64_t>(b)) * 1099511628211u;
  // The last step of MurmurHash3
  h = (h ^ (h >> 33)) * 0xff51afd7ed558ccdu;
  h = (h ^ (h >> 33)) * 0xc4ceb9fe1a85ec53u;
  return h ^ (h >> 33);
}

Digest contactx::storage::digest(mesh::Ranks& ranks,
                                 std::span<const std::int64_t> keys, int width)
{
  return digest_of(ranks, hashes_of(keys, width));
}

Rows::Rows(mesh::Ranks& ranks, std::span<const std::int64_t> keys, int width)
    : _ranks(&ranks), _size(keys.size() / width)
{
  const std::vector<std::uint64_t> mine = hashes_of(keys, width);
  _digest = digest_of(ranks, mine);
  mesh::Messages out;
  for (std::size_t i = 0; i < mine.size(); ++i)
  {
    const auto to = static_cast<int>((mine[i] >> half) * ranks.size() >> half);
    mesh::pack(out[to], keys.subspan(i * width, width));
    _sent[to].push_back(static_cast<std::int32_t>(i));
  }
  std::vector<std::int64_t> share;
  for (const auto& [from, bytes] : exchanged(ranks, std::move(out)))
  {
    std::span<const std::byte> left = bytes;
    const auto theirs
        = mesh::unpack<std::int64_t>(left, bytes.size() / sizeof(std::int64_t));
    share.insert(share.end(), theirs.begin(), theirs.end());
    _received.emplace_back(from, theirs.size() / width);
  }

  const std::vector<std::uint64_t> theirs = hashes_of(share, width);
  const auto compare = [&](std::int32_t a, std::int32_t b)
  {
    const auto of_key = [&](std::int32_t i)
    { return share.begin() + std::ptrdiff_t(width) * i; };
    return theirs[a] != theirs[b] ? theirs[a] <=> theirs[b]
                                  : std::lexicographical_compare_three_way(
                                        of_key(a), of_key(a) + width, of_key(b),
                                        of_key(b) + width);
  };
  std::vector<std::int32_t> order(theirs.size());
  std::iota(order.begin(), order.end(), 0);
  // Equal keys, which one rank may have, stay in their order
  std::ranges::stable_sort(order, [&](std::int32_t a, std::int32_t b)
                           { return compare(a, b) < 0; });
  const bool twice
      = std::ranges::adjacent_find(order, [&](std::int32_t a, std::int32_t b)
                                   { return compare(a, b) == 0; })
        != order.end();
  if (ranks.size() > 1 and mesh::anywhere(ranks, twice))
    throw std::invalid_argument(
        "two nodes or cells have the same number in the mesh as it was made: "
        "make the mesh from nodes that are numbered once (mesh.create_mesh), "
        "or use one rank");
  _place.resize(order.size());
  for (std::size_t k = 0; k < order.size(); ++k)
    _place[order[k]] = static_cast<std::int32_t>(k);
  _first = mesh::total_before(ranks, std::ssize(order));
}

std::vector<std::byte> Rows::to_share(std::span<const std::byte> rows,
                                      std::size_t width) const
{
  mesh::Messages out;
  for (const auto& [to, mine] : _sent)
  {
    out[to].reserve(mine.size() * width);
    for (const std::int32_t i : mine)
      mesh::pack(out[to], rows.subspan(i * width, width));
  }
  const mesh::Messages in = exchanged(*_ranks, std::move(out));
  std::vector<std::byte> share(_place.size() * width);
  auto place = _place.begin();
  for (const auto& [from, count] : _received)
    for (std::size_t i = 0; i < count; ++i)
      std::memcpy(share.data() + *place++ * width,
                  in.at(from).data() + i * width, width);
  return share;
}

std::vector<std::byte> Rows::from_share(std::span<const std::byte> share,
                                        std::size_t width) const
{
  mesh::Messages out;
  auto place = _place.begin();
  for (const auto& [to, count] : _received)
  {
    out[to].reserve(count * width);
    for (std::size_t i = 0; i < count; ++i)
      mesh::pack(out[to], share.subspan(*place++ * width, width));
  }
  const mesh::Messages in = exchanged(*_ranks, std::move(out));
  std::vector<std::byte> rows(_size * width);
  for (const auto& [from, mine] : _sent)
    for (std::size_t i = 0; i < mine.size(); ++i)
      std::memcpy(rows.data() + mine[i] * width, in.at(from).data() + i * width,
                  width);
  return rows;
}
