// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#include "assemble.h"
#include "../check.h"
#include "registry.h"
#include <algorithm>
#include <array>
#include <limits>
#include <stdexcept>
#include <string>

using namespace contactx;
using namespace contactx::kernel;
using contactx::kernel::Pairs;

namespace
{
constexpr std::array<std::string_view, 4> vectors{"gap", "normal", "slip",
                                                  "residual"};
constexpr std::array<std::string_view, 3> matrices{"stiffness", "traction",
                                                   "constraint"};

[[noreturn]] void fail(const std::string& message)
{
  throw std::invalid_argument(message);
}

bool contains(std::span<const std::string_view> terms, std::string_view term)
{
  return std::ranges::find(terms, term) != terms.end();
}

void check_pairs(const Pairs& pairs, int gdim)
{
  check::dimension(gdim);
  check::between(pairs.num_slaves, 1, 9, "pairs.num_slaves");
  check::between(pairs.num_nodes, 0, 9, "pairs.num_nodes");
  const std::size_t n = pairs.size();
  check::rows(pairs.slaves.size(), n, pairs.num_slaves, "pairs.slaves", "pair");
  check::rows(pairs.nodes.size(), n, pairs.num_slaves + pairs.num_nodes,
              "pairs.nodes", "pair");
  const int size = pair_values(pairs.num_slaves, pairs.num_nodes, gdim);
  if (pairs.data_size != size)
    fail("pairs.data_size must be " + std::to_string(size) + ", not "
         + std::to_string(pairs.data_size));
  check::rows(pairs.data.size(), n, size, "pairs.data", "pair");
}

/// The kernel of a term; none where it vanishes.
const Entry* entry_of(Law law, std::string_view sliding, std::string_view term,
                      const Pairs& pairs, int gdim)
{
  if (!contains(vectors, term) and !contains(matrices, term))
    fail("there is no term " + std::string(term));
  check_pairs(pairs, gdim);
  if (pairs.is_movement)
  {
    if (law == Law::frictionless)
      fail("pairs that measure movement are for vector multipliers");
    // The kernels of a tie measure movement
    law = Law::tied;
  }
  // Every kind of pairs has forces
  find(law, sliding, "residual", pairs.num_nodes, gdim, pairs.num_slaves);
  if (pairs.is_movement and term != "slip" and term != "constraint")
    return nullptr;
  return find_if_any(law, sliding, term, pairs.num_nodes, gdim,
                     pairs.num_slaves);
}

/// Coefficients of one pair after another, as its kernel reads them, and what
/// the kernel gives.
class Tabulation
{
public:
  Tabulation(const Entry& entry, const Pairs& pairs, const NodalArrays& arrays)
      : shape(kernel::shape(entry)), _entry(entry), _pairs(pairs),
        _w(coefficient_values(entry.law, entry.num_nodes, entry.gdim,
                              entry.num_slaves)),
        _tensor(shape.rows * shape.columns)
  {
    // In the order of Coefficient
    const std::array<std::span<const double>, num_coefficients> all{
        arrays.displacement,
        arrays.position,
        pairs.data,
        pairs.slip,
        arrays.multiplier,
        arrays.area,
        arrays.gap_derivative,
        arrays.slip_derivative,
        arrays.normal_derivative};
    const auto table = coefficients(entry.law, entry.num_nodes, entry.gdim,
                                    entry.num_slaves);
    for (const Coefficient c : entry.active)
    {
      const CoefficientInfo& info = table[static_cast<int>(c)];
      const auto values = all[static_cast<int>(c)];
      const std::string name(info.name);
      if (info.site == Site::pair)
        check::rows(values.size(), pairs.size(), info.size, "pairs." + name,
                    "pair");
      else
      {
        if (values.size() % info.size != 0)
          fail(name + " must have rows of " + std::to_string(info.size)
               + " values, not " + std::to_string(values.size()) + " in all");
        check::numbers(info.site == Site::nodes ? pairs.nodes : pairs.slaves,
                       values.size() / info.size,
                       info.site == Site::nodes ? "pairs.nodes"
                                                : "pairs.slaves",
                       "rows of " + name);
      }
      _sources[_num_sources++] = {values.data(), info.site, info.size,
                                  _w.data()
                                      + offset(entry.law, c, entry.num_nodes,
                                               entry.gdim, entry.num_slaves)};
    }
  }

  /// Call the kernel for a pair.
  std::span<const double> operator()(std::size_t pair)
  {
    const auto nodes = nodes_of(pair), slaves = slaves_of(pair);
    for (int i = 0; i < _num_sources; ++i)
    {
      const Source& s = _sources[i];
      double* to = s.to;
      if (s.site == Site::pair)
        std::copy_n(s.values + s.size * pair, s.size, to);
      else
        for (const std::int32_t row : s.site == Site::nodes ? nodes : slaves)
          to = std::copy_n(s.values + std::size_t(s.size) * row, s.size, to);
    }
    std::ranges::fill(_tensor, 0.0);
    _entry.function(_tensor.data(), _w.data(), nullptr, nullptr, nullptr,
                    nullptr, nullptr);
    return _tensor;
  }

  std::span<const std::int32_t> nodes_of(std::size_t pair) const
  {
    const int width = _pairs.num_slaves + _pairs.num_nodes;
    return {_pairs.nodes.data() + width * pair, std::size_t(width)};
  }

  std::span<const std::int32_t> slaves_of(std::size_t pair) const
  {
    return {_pairs.slaves.data() + _pairs.num_slaves * pair,
            std::size_t(_pairs.num_slaves)};
  }

  const Shape shape; ///< of what a call gives

private:
  struct Source
  {
    const double* values;
    Site site;
    int size;
    double* to;
  };

  const Entry& _entry;
  const Pairs& _pairs;
  std::vector<double> _w, _tensor;
  std::array<Source, num_coefficients> _sources;
  int _num_sources = 0;
};
} // namespace

bool kernel::has_term(Law law, std::string_view sliding, std::string_view term,
                      const Pairs& pairs, int gdim)
{
  return entry_of(law, sliding, term, pairs, gdim) != nullptr;
}

void kernel::add_vector(Law law, std::string_view sliding,
                        std::string_view term, const Pairs& pairs,
                        const NodalArrays& arrays, int gdim,
                        std::span<double> b)
{
  if (!contains(vectors, term))
    fail("the term must be gap, normal, slip or residual, not "
         + std::string(term));
  const Entry* entry = entry_of(law, sliding, term, pairs, gdim);
  if (!entry)
    return;
  Tabulation tabulate(*entry, pairs, arrays);
  const bool over_nodes = term == "residual";
  const int width = over_nodes ? gdim : tabulate.shape.rows / pairs.num_slaves;
  if (b.size() % width != 0)
    fail("b must have rows of " + std::to_string(width) + " values, not "
         + std::to_string(b.size()) + " in all");
  const std::size_t rows = b.size() / width;
  if (over_nodes)
    check::numbers(pairs.nodes, rows, "pairs.nodes", "rows of b");
  else if (std::ranges::any_of(pairs.slaves,
                               [](std::int32_t i) { return i < 0; }))
    fail("pairs.slaves must not be negative");
  for (std::size_t p = 0; p < pairs.size(); ++p)
  {
    const auto tensor = tabulate(p);
    const double* from = tensor.data();
    for (const std::int32_t row :
         over_nodes ? tabulate.nodes_of(p) : tabulate.slaves_of(p))
    {
      if (std::size_t(row) < rows)
        for (int k = 0; k < width; ++k)
          b[std::size_t(width) * row + k] += from[k];
      from += width;
    }
  }
}

void kernel::for_each_pair(Law law, std::string_view sliding,
                           std::string_view term, const Pairs& pairs,
                           const NodalArrays& arrays, int gdim,
                           std::span<const std::int8_t> which,
                           const UsePair& use)
{
  if (!contains(matrices, term))
    fail("the term must be stiffness, traction or constraint, not "
         + std::string(term));
  const Entry* entry = entry_of(law, sliding, term, pairs, gdim);
  if (!entry)
    return;
  Tabulation tabulate(*entry, pairs, arrays);
  // A kernel need not read what its rows or columns are numbered by
  const int size = law == Law::frictionless ? 1 : gdim;
  constexpr std::size_t most = std::numeric_limits<std::int32_t>::max();
  check::numbers(pairs.slaves, most / size, "pairs.slaves", "slave nodes");
  check::numbers(pairs.nodes, most / gdim, "pairs.nodes", "nodes");
  for (std::size_t p = 0; p < pairs.size(); ++p)
  {
    const auto nodes = tabulate.nodes_of(p), slaves = tabulate.slaves_of(p);
    if (which.empty()
        or std::ranges::any_of(
            slaves, [which](std::int32_t i)
            { return std::size_t(i) < which.size() and which[i]; }))
      use(term == "constraint" ? slaves : nodes,
          term == "traction" ? slaves : nodes, tabulate(p));
  }
}

Triplets kernel::assemble_matrix(Law law, std::string_view sliding,
                                 std::string_view term, const Pairs& pairs,
                                 const NodalArrays& arrays, int gdim,
                                 std::span<const std::int8_t> which)
{
  const int size = law == Law::frictionless ? 1 : gdim;
  const int row_width = term == "constraint" ? size : gdim;
  const int column_width = term == "traction" ? size : gdim;
  Triplets result;
  for_each_pair(law, sliding, term, pairs, arrays, gdim, which,
                [&](std::span<const std::int32_t> rows,
                    std::span<const std::int32_t> columns,
                    std::span<const double> values)
                {
                  const double* value = values.data();
                  for (const std::int32_t row : rows)
                    for (int k = 0; k < row_width; ++k)
                      for (const std::int32_t column : columns)
                        for (int l = 0; l < column_width; ++l)
                          result.add(row_width * row + k,
                                     column_width * column + l, *value++);
                });
  return result;
}
