// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#include "check.h"
#include <algorithm>
#include <limits>
#include <stdexcept>
#include <string>

using namespace contactx;

namespace
{
[[noreturn]] void fail(const std::string& message)
{
  throw std::invalid_argument(message);
}

std::string text(std::ptrdiff_t value) { return std::to_string(value); }
} // namespace

void check::require(bool fits, const char* message)
{
  if (not fits)
    throw std::invalid_argument(message);
}

void check::dimension(int gdim)
{
  if (gdim != 2 and gdim != 3)
    fail("gdim must be 2 or 3, not " + text(gdim));
}

void check::facets(std::span<const std::int32_t> offsets,
                   std::span<const std::int32_t> nodes, int gdim,
                   std::string_view of)
{
  dimension(gdim);
  const std::string which(of), name = which + "offsets";
  if (offsets.empty() or offsets.front() != 0)
    fail(name + " must begin with 0");
  if (offsets.back() != std::ssize(nodes))
    fail(name + " must end at " + text(std::ssize(nodes)) + ", the number of "
         + which + "nodes, not at " + text(offsets.back()));
  for (std::size_t f = 0; f + 1 < offsets.size(); ++f)
  {
    const std::int64_t n = std::int64_t(offsets[f + 1]) - offsets[f];
    if (gdim == 2 ? n != 2 : (n != 3 and n != 4))
      fail(name + " must give a facet two nodes in 2D, and three or four in "
           + "3D: facet " + text(std::ptrdiff_t(f)) + " has " + text(n) + " in "
           + text(gdim) + "D");
  }
  constexpr std::int32_t most = std::numeric_limits<std::int32_t>::max();
  const auto bad = std::ranges::find_if(nodes, [](std::int32_t node)
                                        { return node < 0 or node == most; });
  if (bad != nodes.end())
    fail(which + "nodes must be node numbers, from 0 to " + text(most - 1)
         + ": there is " + text(*bad));
}

std::int32_t check::num_nodes(std::span<const std::int32_t> nodes)
{
  return nodes.empty() ? 0 : std::ranges::max(nodes) + 1;
}

void check::positions(std::ptrdiff_t size, std::int32_t num_nodes, int gdim,
                      std::string_view name)
{
  if (size % gdim != 0 or size / gdim < num_nodes)
    fail(std::string(name) + " must hold " + text(gdim)
         + " coordinates for each of " + text(num_nodes)
         + " nodes or more: it has " + text(size) + " values");
}

void check::surface(std::span<const std::int32_t> offsets,
                    std::span<const std::int32_t> nodes, std::ptrdiff_t size,
                    int gdim)
{
  facets(offsets, nodes, gdim);
  positions(size, num_nodes(nodes), gdim);
}

void check::rows(std::ptrdiff_t size, std::ptrdiff_t rows, int width,
                 std::string_view name, std::string_view of)
{
  if (width < 0 or size != rows * width)
    fail(std::string(name) + " must have " + text(rows * width) + " values, "
         + text(width) + " for each " + std::string(of) + ", not "
         + text(size));
}

void check::numbers(std::span<const std::int32_t> values, std::ptrdiff_t count,
                    std::string_view name, std::string_view of, int first)
{
  const auto bad
      = std::ranges::find_if(values, [=](std::int32_t value)
                             { return value < first or value >= count; });
  if (bad != values.end())
    fail(std::string(name) + " must be numbers of " + std::string(of)
         + ", of which there are " + text(count) + ": there is " + text(*bad));
}

void check::between(int value, int low, int high, std::string_view name)
{
  if (value < low or value > high)
    fail(std::string(name) + " must be from " + text(low) + " to " + text(high)
         + ", not " + text(value));
}
