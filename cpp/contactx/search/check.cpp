// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#include "check.h"
#include <algorithm>
#include <stdexcept>

using namespace contactx::search;

namespace
{
[[noreturn]] void fail(const std::string& message)
{
  throw std::invalid_argument(message);
}
} // namespace

void check::positions(std::size_t size, std::int32_t num_nodes, int gdim,
                      const std::string& name)
{
  if (size % gdim != 0 or size / gdim < static_cast<std::size_t>(num_nodes))
    fail(name + " must hold " + std::to_string(gdim)
         + " coordinates for each of " + std::to_string(num_nodes)
         + " nodes or more: it has " + std::to_string(size) + " values");
}

void check::rows(std::size_t size, std::size_t rows, int width,
                 const std::string& name, const std::string& of)
{
  if (size != rows * width)
    fail(name + " must have " + std::to_string(rows * width) + " values, "
         + std::to_string(width) + " for each " + of + ", not "
         + std::to_string(size));
}

void check::facets(std::span<const std::int32_t> facets, std::int32_t count,
                   const std::string& name)
{
  const auto bad
      = std::ranges::find_if(facets, [count](std::int32_t facet)
                             { return facet < -1 or facet >= count; });
  if (bad != facets.end())
    fail(name + " must be numbers of facets, of which there are "
         + std::to_string(count) + ": there is " + std::to_string(*bad));
}
