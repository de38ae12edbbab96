// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#include "numbering.h"
#include <cmath>
#include <numeric>

using namespace contactx;
using namespace contactx::condense;

Numbering::Numbering(const mesh::Halo& halo, Algebra& algebra)
    : _halo(halo), _algebra(algebra),
      _num_owned(std::size_t(halo.num_owned()) * halo.gdim()),
      _num_local(std::size_t(halo.num_nodes()) * halo.gdim())
{
  const int g = halo.gdim();
  std::vector<std::int32_t> nodes(halo.num_nodes());
  std::iota(nodes.begin(), nodes.end(), 0);
  _numbers.reserve(_num_local);
  for (const std::int64_t node : halo.numbers(nodes))
    for (int k = 0; k < g; ++k)
      _numbers.push_back(g * node + k);
}

std::vector<std::int64_t>
Numbering::picked(std::span<const std::int64_t> numbers,
                  std::span<const std::int32_t> which) const
{
  std::vector<std::int64_t> some;
  some.reserve(which.size());
  for (const std::int32_t i : which)
    some.push_back(numbers[i]);
  return some;
}

std::vector<std::int64_t>
Numbering::numbers(std::span<const std::int32_t> dofs) const
{
  return picked(_numbers, dofs);
}

std::vector<double> Numbering::forward(std::span<const double> values) const
{
  std::vector<double> all(_num_local);
  std::ranges::copy(values.first(_num_owned), all.begin());
  _halo.forward(std::span<double>(all), gdim());
  return all;
}

std::vector<double> Numbering::reverse(std::vector<double> values) const
{
  _halo.reverse(values, gdim());
  values.resize(_num_owned);
  return values;
}

std::vector<std::int64_t>
Numbering::places(std::span<const std::int32_t> dofs) const
{
  // Rows of masters may be another rank's; hosts leave negative numbers out
  std::vector<std::int64_t> place(_num_local, -1);
  std::int64_t next = mesh::total_before(ranks(), dofs.size());
  for (const std::int32_t dof : dofs)
    place[dof] = next++;
  _halo.forward(std::span<std::int64_t>(place), gdim());
  return place;
}

MatrixPtr Numbering::matrix(const Triplets& entries) const
{
  return _algebra.matrix(_num_owned, _num_owned, numbers(entries.rows),
                         numbers(entries.columns), entries.values);
}

MatrixPtr Numbering::rows(const Triplets& entries,
                          std::span<const std::int32_t> rows) const
{
  return _algebra.matrix(rows.size(), _num_owned,
                         picked(places(rows), entries.rows),
                         numbers(entries.columns), entries.values);
}

MatrixPtr Numbering::square(const Triplets& entries,
                            std::span<const std::int32_t> dofs) const
{
  const std::vector<std::int64_t> place = places(dofs);
  return _algebra.matrix(dofs.size(), dofs.size(), picked(place, entries.rows),
                         picked(place, entries.columns), entries.values);
}

std::vector<std::int64_t> contactx::condense::successive(std::int64_t first,
                                                         std::size_t count)
{
  std::vector<std::int64_t> numbers(count);
  std::iota(numbers.begin(), numbers.end(), first);
  return numbers;
}

MatrixPtr contactx::condense::diagonal_matrix(Algebra& algebra,
                                              mesh::Ranks& ranks,
                                              std::span<const double> values)
{
  const std::vector<std::int64_t> places
      = successive(mesh::total_before(ranks, values.size()), values.size());
  return algebra.matrix(values.size(), values.size(), places, places, values);
}

double contactx::condense::dot(mesh::Ranks& ranks, std::span<const double> x,
                               std::span<const double> y)
{
  return mesh::total(ranks,
                     std::inner_product(x.begin(), x.end(), y.begin(), 0.0));
}

double contactx::condense::norm(mesh::Ranks& ranks, std::span<const double> x)
{
  return std::sqrt(dot(ranks, x, x));
}
