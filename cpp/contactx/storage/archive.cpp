// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#include "archive.h"
#include <algorithm>
#include <array>
#include <contactx/version.h>
#include <cstring>
#include <iomanip>
#include <sstream>
#include <stdexcept>
#include <string_view>

using namespace contactx;
using namespace contactx::storage;

namespace
{
constexpr std::string_view mark = "contactx checkpoint\n";
constexpr std::int64_t format = 6;
// MPI counts bytes by int
constexpr std::size_t most_at_once = std::size_t(1) << 30;

/// The first bytes of a file.
struct Start
{
  std::array<char, 24> mark{};
  std::array<char, 24> version{};
  std::int64_t format = 0;
  std::int64_t table = 0; // bytes of the table
  std::int64_t size = 0;  // bytes of the file
  std::uint64_t sum = 0;  // of all this and the table
};
static_assert(sizeof(Start) == 80);

template <class T>
std::string type_of()
{
  return (std::is_floating_point_v<T> ? "f" : "i") + std::to_string(sizeof(T));
}

std::string type_of(const Values& values)
{
  return std::visit([]<class T>(const std::vector<T>&) { return type_of<T>(); },
                    values);
}

std::span<const std::byte> bytes_of(const Values& values)
{
  return std::visit([](const auto& v) { return std::as_bytes(std::span(v)); },
                    values);
}

/// Bytes of a row.
std::int64_t row_size(const Entry& e)
{
  return std::int64_t(e.type[1] - '0') * std::max(e.width, 1);
}

/// Where an array may begin: each does where numbers of eight bytes may.
std::int64_t padded(std::int64_t size) { return (size + 7) / 8 * 8; }

/// Checksum of rows, the first of which has a number.
std::uint64_t sum_of(std::span<const std::byte> rows, std::int64_t width,
                     std::int64_t first)
{
  std::uint64_t sum = 0;
  std::uint64_t factor = 2 * static_cast<std::uint64_t>(first) + 1;
  for (; not rows.empty(); rows = rows.subspan(width), factor += 2)
    sum += factor * hash(rows.first(width));
  return sum;
}

std::uint64_t total(mesh::Ranks& ranks, std::uint64_t sum)
{
  std::array halves{static_cast<std::int64_t>(sum >> 32),
                    static_cast<std::int64_t>(sum & 0xffffffffu)};
  if (ranks.size() > 1)
    ranks.reduce(std::span<std::int64_t>(halves), mesh::Reduction::sum);
  return (static_cast<std::uint64_t>(halves[0]) << 32)
         + static_cast<std::uint64_t>(halves[1]);
}

/// Calls use(place, some of the bytes) as often on each rank.
template <class Byte, class Use>
void in_parts(mesh::Ranks& ranks, std::int64_t at, std::span<Byte> bytes,
              Use use)
{
  const std::size_t parts
      = mesh::largest(ranks, (bytes.size() + most_at_once - 1) / most_at_once);
  for (std::size_t k = 0; k < parts; ++k)
  {
    const std::size_t from = std::min(k * most_at_once, bytes.size());
    use(at + static_cast<std::int64_t>(from),
        bytes.subspan(from, std::min(most_at_once, bytes.size() - from)));
  }
}

std::string table_of(const std::vector<Entry>& entries)
{
  std::ostringstream table;
  for (const Entry& e : entries)
    // What is not known at first has a length that is
    table << e.name << '\t' << e.type << '\t' << e.width << '\t' << e.keys.count
          << '\t' << e.keys.high << '\t' << e.keys.low << '\t' << std::setw(20)
          << e.at << '\t' << std::setw(20) << e.sum << '\n';
  return table.str();
}

std::vector<Entry> entries_of(const std::string& table)
{
  std::vector<Entry> entries;
  std::istringstream in(table);
  for (Entry e; std::getline(in, e.name, '\t');)
  {
    in >> e.type >> e.width >> e.keys.count >> e.keys.high >> e.keys.low >> e.at
        >> e.sum;
    in.ignore();
    entries.push_back(e);
  }
  return entries;
}

/// Checksum of the beginning of a file, but for the place of its own.
std::uint64_t sum_of(Start start, const std::string& table)
{
  start.sum = 0;
  return hash(std::as_bytes(std::span(&start, 1)))
         + 3 * hash(std::as_bytes(std::span(table)));
}

/// Why bytes are not those of a checkpoint that can be read; empty if they are.
std::string fault_of(const Start& start, std::int64_t size)
{
  const std::string_view begin(start.mark.data(), start.mark.size());
  const std::string reads
      = ", and contactx " + std::string(version) + " reads format "
        + std::to_string(format)
        + ": finish that run with the contactx that began it";
  if (begin.starts_with("PK\x03\x04"))
    return "it is of an older contactx for Python, with NumPy's arrays in "
           "format "
           "5 or before"
           + reads;
  if (begin.starts_with("\x89HDF"))
    return "it is of an older contactx for C++, with HDF5 in format 2 or before"
           + reads;
  if (not begin.starts_with(mark) or size < std::int64_t(sizeof(Start)))
    return "it is truncated, or no checkpoint at all";
  if (start.format != format)
  {
    const std::string_view by(start.version.data(), start.version.size());
    return "contactx " + std::string(by.substr(0, by.find('\0')))
           + " wrote it in format " + std::to_string(start.format) + reads;
  }
  if (start.size != size)
    return "it is truncated: it has " + std::to_string(size) + " bytes of "
           + std::to_string(start.size);
  if (start.table < 0 or start.table > size - std::int64_t(sizeof(Start)))
    return "it is damaged: its table is longer than the file";
  return {};
}
} // namespace

void contactx::storage::write(mesh::Ranks& ranks, File& file,
                              const std::vector<Array>& arrays)
{
  std::vector<Entry> entries;
  for (const Array& a : arrays)
  {
    Entry e{a.name, type_of(a.values), a.width, {}, 0, 0};
    e.keys.count = std::ssize(bytes_of(a.values)) / row_size(e);
    if (a.rows)
      e.keys = a.rows->digest();
    entries.push_back(std::move(e));
  }
  Start start{.format = format};
  std::ranges::copy(mark, start.mark.begin());
  std::ranges::copy(std::string_view(version), start.version.begin());
  start.table = std::ssize(table_of(entries));
  std::int64_t at = sizeof(Start) + start.table;
  for (Entry& e : entries)
  {
    // An array without values does not make the file longer
    e.at = e.keys.count > 0 ? padded(at) : at;
    at = e.at + e.keys.count * row_size(e);
  }
  start.size = at;

  for (std::size_t k = 0; k < arrays.size(); ++k)
  {
    const Array& a = arrays[k];
    Entry& e = entries[k];
    const std::int64_t width = row_size(e);
    std::vector<std::byte> moved;
    std::span<const std::byte> share;
    if (a.rows)
      share = moved = a.rows->to_share(bytes_of(a.values), width);
    else if (ranks.rank() == 0)
      share = bytes_of(a.values);
    const std::int64_t first = a.rows ? a.rows->first() : 0;
    e.sum = total(ranks, sum_of(share, width, first));
    in_parts(ranks, e.at + first * width, share,
             [&](std::int64_t to, std::span<const std::byte> part)
             { file.write(to, part); });
  }
  // Last, so that what was left half-written has no beginning
  const std::string table = table_of(entries);
  start.sum = sum_of(start, table);
  std::vector<std::byte> head;
  if (ranks.rank() == 0)
  {
    mesh::pack(head, std::span<const Start>(&start, 1));
    mesh::pack(head, std::span<const char>(table));
  }
  file.write(0, head);
}

Reader::Reader(mesh::Ranks& ranks, File& file) : _ranks(&ranks), _file(&file)
{
  const std::int64_t size = file.size();
  Start start;
  const auto begin = std::as_writable_bytes(std::span<Start>(&start, 1));
  file.read(0, begin.first(std::min<std::int64_t>(size, sizeof(Start))));
  if (const std::string fault = fault_of(start, size); not fault.empty())
    throw std::invalid_argument(fault);
  std::string table(start.table, '\0');
  file.read(sizeof(Start), std::as_writable_bytes(std::span(table)));
  if (sum_of(start, table) != start.sum)
    throw std::invalid_argument(
        "it is damaged: its table has another checksum");
  _entries = entries_of(table);
}

const Entry* Reader::find(const std::string& name) const
{
  const auto at = std::ranges::find(_entries, name, &Entry::name);
  return at == _entries.end() ? nullptr : &*at;
}

void Reader::read(Array& array) const
{
  const std::string name = "'" + array.name + "'";
  const Entry* const e = find(array.name);
  if (e == nullptr)
    throw std::invalid_argument(name + " is missing in the file");
  if (e->type != type_of(array.values) or e->width != array.width)
    throw std::invalid_argument(
        name + " has " + std::to_string(e->width) + " values of type " + e->type
        + " a row in the file, but " + std::to_string(array.width) + " of type "
        + type_of(array.values)
        + " here: were options of the contacts others?");
  const Rows* const rows = array.rows;
  if (rows and e->keys.count != rows->digest().count)
    throw std::invalid_argument(
        name + " has " + std::to_string(e->keys.count)
        + " rows in the file, but " + std::to_string(rows->digest().count)
        + " here: is it of another mesh or other surfaces?");
  if (rows and e->keys != rows->digest())
    throw std::invalid_argument(
        name
        + " has other nodes or cells in the file: is it "
          "of another mesh or other surfaces?");
  const std::int64_t width = row_size(*e), first = rows ? rows->first() : 0;
  std::vector<std::byte> bytes(
      width * (rows ? std::int64_t(rows->share()) : e->keys.count));
  in_parts(*_ranks, e->at + first * width, std::span(bytes),
           [&](std::int64_t from, std::span<std::byte> part)
           { _file->read(from, part); });
  std::uint64_t sum = sum_of(bytes, width, first);
  if (rows)
    sum = total(*_ranks, sum);
  if (sum != e->sum)
    throw std::invalid_argument("it is damaged: " + name
                                + " has another checksum");
  if (rows)
    bytes = rows->from_share(bytes, width);
  std::visit(
      [&]<class T>(std::vector<T>& values)
      {
        std::span<const std::byte> left = bytes;
        values = mesh::unpack<T>(left, bytes.size() / sizeof(T));
      },
      array.values);
}
