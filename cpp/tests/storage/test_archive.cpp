// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#include "generator.h"
#include "thread_ranks.h"
#include <contactx/storage/archive.h>
#include <contactx/version.h>

using namespace contactx;
using namespace contactx::storage;

namespace
{
/// A file in the memory that all threads have.
struct Memory
{
  std::vector<std::byte> bytes;
  std::mutex mutex;
};

class MemoryFile final : public File
{
public:
  explicit MemoryFile(Memory& memory) : _memory(&memory) {}

  std::int64_t size() override { return std::ssize(_memory->bytes); }
  void write(std::int64_t at, std::span<const std::byte> bytes) override
  {
    const std::lock_guard lock(_memory->mutex);
    if (bytes.empty())
      return;
    _memory->bytes.resize(
        std::max(_memory->bytes.size(), std::size_t(at) + bytes.size()));
    std::ranges::copy(bytes, _memory->bytes.begin() + at);
  }
  void read(std::int64_t at, std::span<std::byte> bytes) override
  {
    if (std::size_t(at) + bytes.size() > _memory->bytes.size())
      throw std::logic_error("read beyond the end");
    std::copy_n(_memory->bytes.begin() + at, bytes.size(), bytes.begin());
  }

private:
  Memory* _memory;
};

constexpr std::int64_t count = 30;

std::vector<std::int64_t> keys_of(const mesh::Ranks& ranks)
{
  std::vector<std::int64_t> keys;
  for (std::int64_t i = 0; i < count; ++i)
    if (i * i % ranks.size() == ranks.rank())
      keys.push_back(i);
  return keys;
}

/// Arrays of a rank, whose values follow from its keys.
std::vector<Array> arrays_of(const Rows& rows,
                             const std::vector<std::int64_t>& keys)
{
  std::vector<double> x;
  std::vector<std::int8_t> status;
  for (const std::int64_t k : keys)
  {
    x.insert(x.end(), {std::sqrt(double(k)), 1.0 / (1 + k)});
    status.push_back(static_cast<std::int8_t>(k % 3));
  }
  return {{"some x", &rows, 2, x},
          {"status", &rows, 0, status},
          {"same", nullptr, 0, std::vector<std::int32_t>{4, 5, 6}},
          {"nothing", nullptr, 0, std::vector<double>{}}};
}

std::vector<std::byte> written_on(int size)
{
  Memory memory;
  tests::on_ranks(size,
                  [&](mesh::Ranks& ranks)
                  {
                    MemoryFile file(memory);
                    const auto keys = keys_of(ranks);
                    const Rows rows(ranks, keys, 1);
                    write(ranks, file, arrays_of(rows, keys));
                  });
  return memory.bytes;
}

/// What reading says; empty if all is as it was written.
std::string said(const std::vector<std::byte>& bytes, int size = 1)
{
  Memory memory;
  memory.bytes = bytes;
  return tests::said_on(
      size,
      [&](mesh::Ranks& ranks)
      {
        MemoryFile file(memory);
        const auto keys = keys_of(ranks);
        const Rows rows(ranks, keys, 1);
        const Reader reader(ranks, file);
        for (const Array& expected : arrays_of(rows, keys))
        {
          Array read = expected;
          std::visit([](auto& values) { values.assign(1, 7); }, read.values);
          reader.read(read);
          EXPECT_TRUE(read.values == expected.values) << read.name;
        }
      });
}

/// What is said where one array is asked for as another one.
std::string asked(Array array, std::vector<std::int64_t> keys = {})
{
  Memory memory;
  memory.bytes = written_on(2);
  mesh::OneRank ranks;
  const Rows rows(ranks, keys, 1);
  if (not keys.empty())
    array.rows = &rows;
  MemoryFile file(memory);
  const Reader reader(ranks, file);
  return tests::refusal([&] { reader.read(array); });
}
} // namespace

TEST(Archive, isTheSameOnAnyNumberOfRanks)
{
  const auto one = written_on(1);
  EXPECT_EQ(said(one), "");
  for (const int size : {2, 3, 4})
  {
    EXPECT_TRUE(written_on(size) == one) << size << " ranks";
    EXPECT_EQ(said(one, size), "") << size << " ranks";
  }
}

TEST(Archive, saysWhatIsInIt)
{
  Memory memory;
  memory.bytes = written_on(3);
  MemoryFile file(memory);
  mesh::OneRank ranks;
  const Reader reader(ranks, file);
  ASSERT_EQ(reader.entries().size(), 4u);
  EXPECT_EQ(reader.find("none"), nullptr);
  const Entry& x = *reader.find("some x");
  EXPECT_EQ(x.type, "f8");
  EXPECT_EQ(x.width, 2);
  EXPECT_EQ(x.keys.count, count);
  EXPECT_EQ(x.at % 8, 0);
  EXPECT_EQ(reader.find("status")->type, "i1");
  EXPECT_EQ(reader.find("same")->keys.count, 3);
}

TEST(Archive, thatIsTruncatedIsRefused)
{
  const auto whole = written_on(1);
  for (std::size_t size = 0; size < whole.size(); ++size)
    tests::expect_says(said({whole.begin(), whole.begin() + size}),
                       "it is truncated");
  tests::expect_says(said({whole.begin(), whole.end() - 1}, 3),
                     "bytes of " + std::to_string(whole.size()));
}

TEST(Archive, ofOtherBitsIsRefused)
{
  const auto whole = written_on(1);
  tests::Generator random(3);
  std::size_t harmless = 0;
  for (std::size_t at = 0; at < whole.size(); ++at)
  {
    auto bytes = whole;
    bytes[at] ^= std::byte(1 << int(random(0, 8)));
    harmless += said(bytes).empty();
  }
  // Those between two arrays
  EXPECT_LE(harmless, 4u * 7);
}

TEST(Archive, ofAnotherVersionSaysWhich)
{
  const auto whole = written_on(1);
  const auto begins = [&](std::string text)
  {
    auto bytes = whole;
    std::ranges::copy(std::as_bytes(std::span(text)), bytes.begin());
    return said(bytes);
  };
  tests::expect_says(begins("PK\x03\x04"), "of an older contactx for Python");
  tests::expect_says(begins("\x89HDF"), "of an older contactx for C++");
  tests::expect_says(begins("contactx check"), "");
  tests::expect_says(begins("anything else "), "no checkpoint at all");
  auto bytes = whole;
  bytes[48] = std::byte(7);
  const std::string now = std::string("contactx ") + version;
  tests::expect_says(said(bytes), now + " wrote it in format 7, and " + now
                                      + " reads format 6");
}

TEST(Archive, ofAnotherProblemIsRefused)
{
  using Doubles = std::vector<double>;
  tests::expect_says(asked({"another", nullptr, 0, Doubles()}),
                     "'another' is missing in the file");
  tests::expect_says(asked({"some x", nullptr, 1, Doubles()}),
                     "'some x' has 2 values of type f8 a row in the file, but "
                     "1 of type f8 here");
  tests::expect_says(asked({"status", nullptr, 0, Doubles()}),
                     "of type i1 a row in the file, but 0 of type f8 here");
  tests::expect_says(asked({"some x", nullptr, 2, Doubles()}, {1, 2}),
                     "'some x' has 30 rows in the file, but 2 here");
  std::vector<std::int64_t> keys(count);
  for (std::int64_t i = 0; i < count; ++i)
    keys[i] = i + 1;
  tests::expect_says(asked({"some x", nullptr, 2, Doubles()}, keys),
                     "'some x' has other nodes or cells in the file");
}
