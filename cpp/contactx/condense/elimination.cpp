// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#include "elimination.h"
#include "../law/normal.h"
#include <Eigen/LU>
#include <algorithm>
#include <array>
#include <string>

using namespace contactx;
using namespace contactx::condense;

namespace
{
constexpr auto nothing_free
    = "all displacements of a slave node are prescribed";

/// Sum of the entries of one row
double sum_at(const Triplets& T, std::span<const std::int32_t> entries,
              std::int32_t row)
{
  double sum = 0;
  for (const std::int32_t e : entries)
    if (T.rows[e] == row)
      sum += T.values[e];
  return sum;
}
} // namespace

/// Rows of one node's multipliers, one entry for each place
class Elimination::Rows
{
public:
  explicit Rows(std::size_t size) : _slot(size, -1) {}

  /// Forget all entries.
  void clear()
  {
    for (const std::int32_t place : _places)
      _slot[place] = -1;
    _places.clear();
    _values.clear();
  }

  /// Add an entry of one of the node's multipliers.
  void add(int component, std::int32_t place, double value)
  {
    std::int32_t& slot = _slot[place];
    if (slot < 0)
    {
      slot = static_cast<std::int32_t>(_places.size());
      _places.push_back(place);
      _values.push_back({});
    }
    _values[slot][component] += value;
  }

  std::size_t size() const { return _places.size(); }
  std::int32_t place(std::size_t i) const { return _places[i]; }

  /// Entries of all components.
  const std::array<double, 3>& values(std::size_t i) const
  {
    return _values[i];
  }

  /// Entries at a place, zero where there are none.
  std::array<double, 3> at(std::int32_t place) const
  {
    return _slot[place] < 0 ? std::array<double, 3>{} : _values[_slot[place]];
  }

private:
  std::vector<std::int32_t> _slot, _places;
  std::vector<std::array<double, 3>> _values;
};

Elimination::Elimination(std::span<const Nodes> contacts,
                         const Prescribed& contact,
                         std::span<const std::int8_t> free, int gdim)
    : _gdim(gdim), _num_local(free.size()),
      _num_multipliers(condense::num_multipliers(contacts))
{
  const Triplets &T = contact.blocks().traction,
                 &C = contact.blocks().constraint;
  const Groups traction = grouped(T.columns, _num_multipliers);
  const Groups constraint = grouped(C.rows, _num_multipliers);
  _left.reserve(T.size());
  _right.reserve(C.size());
  Rows rows(_num_local);

  std::int32_t multiplier = 0;
  for (std::size_t k = 0; k < contacts.size(); ++k)
  {
    const Nodes& nodes = contacts[k];
    const int size = nodes.size;
    const double* by = contact.by_multiplier(k).data();
    for (std::size_t s = 0; s < nodes.count(); ++s, multiplier += size)
    {
      const std::int32_t first = nodes.slaves[s] * gdim;
      const std::span own = contact.own().subspan(multiplier, size);
      if (not nodes.is_closed(s))
      {
        for (int i = 0; i < size; ++i)
        {
          _open.push_back(multiplier + i);
          _diagonal.push_back(nodes.by_multiplier[(s * size + i) * size + i]);
        }
        continue;
      }
      if (std::ranges::all_of(own,
                              [](std::int8_t is_own) { return is_own == 0; }))
        continue;

      if (size == 1)
      {
        add_scalar(C, constraint[multiplier], multiplier, first, free);
        const std::span<const std::int32_t> entries = traction[multiplier];
        const std::int32_t row = _shift.rows.back();
        add_force(T, entries, row, multiplier, sum_at(T, entries, row));
        continue;
      }
      rows.clear();
      for (int i = 0; i < size; ++i)
        for (const std::int32_t e : constraint[multiplier + i])
          rows.add(i, C.columns[e], C.values[e]);
      std::array<double, 3> factors{};
      for (int i = 0; i < size; ++i)
        if (own[i] != 0)
          factors[i] = sum_at(T, traction[multiplier + i], first + i);
      if (nodes.status[s] == law::stick)
        add_stick(multiplier, first, own, rows);
      else
        add_slip(multiplier, first, own, nodes.normal.data() + s * size,
                 by + s * size * size, factors, rows);
      for (int i = 0; i < size; ++i)
        if (own[i] != 0)
          add_force(T, traction[multiplier + i], first + i, multiplier + i,
                    factors[i]);
    }
  }

  std::ranges::sort(_eliminated);
  std::vector<std::int32_t> some = _recovered;
  std::ranges::sort(some);
  if (std::ranges::adjacent_find(some) != some.end())
    throw NotCondensable("a node is slave in several contacts that are closed");

  some.clear();
  for (const Nodes& nodes : contacts)
    some.insert(some.end(), nodes.slaves.begin(), nodes.slaves.end());
  std::ranges::sort(some);
  some.erase(std::unique(some.begin(), some.end()), some.end());
  for (const std::int32_t node : some)
    for (int i = 0; i < gdim; ++i)
      _slave_dofs.push_back(node * gdim + i);
}

/// Other rows, as those of the master, take over that of the slave node
void Elimination::add_force(const Triplets& T,
                            std::span<const std::int32_t> entries,
                            std::int32_t row, std::int32_t multiplier,
                            double factor)
{
  for (const std::int32_t e : entries)
    if (T.rows[e] != row)
      _left.add(T.rows[e], row, -T.values[e] / factor);
  _given.push_back(multiplier);
  _recovered.push_back(row);
  _factors.push_back(factor);
}

/// Frictionless node: the pressure follows from one row of the slave node
void Elimination::add_scalar(const Triplets& C,
                             std::span<const std::int32_t> entries,
                             std::int32_t multiplier, std::int32_t first,
                             std::span<const std::int8_t> free)
{
  // Coefficients of the slave node's displacements in its constraint
  std::array<double, 3> own{};
  for (const std::int32_t e : entries)
    if (const std::int32_t i = C.columns[e] - first; i >= 0 and i < _gdim)
      own[i] += C.values[e];
  int k = -1;
  for (int i = 0; i < _gdim; ++i)
    if (free[first + i] != 0 and own[i] != 0
        and (k < 0 or std::abs(own[i]) > std::abs(own[k])))
      k = i;
  if (k < 0)
    throw NotCondensable(nothing_free);
  for (const std::int32_t e : entries)
    _right.add(first + k, C.columns[e], -C.values[e] / own[k]);
  _shift.add(first + k, multiplier, 1 / own[k]);
  _eliminated.push_back(first + k);
}

/// Sticking or tied node: the constraints give its displacements
void Elimination::add_stick(std::int32_t multiplier, std::int32_t first,
                            std::span<const std::int8_t> own, const Rows& rows)
{
  const int g = _gdim;
  // In the plane a row and a column are those of the identity
  Eigen::Matrix3d block = Eigen::Matrix3d::Identity();
  for (int j = 0; j < g; ++j)
  {
    const auto values = rows.at(first + j);
    for (int i = 0; i < g; ++i)
      block(i, j) = values[i] + (i == j and own[i] == 0 ? 1 : 0);
  }
  const Eigen::PartialPivLU<Eigen::Matrix3d> factors(block);
  if (factors.determinant() == 0)
    throw NotCondensable(
        "the constraints of a slave node do not give its displacements");
  const Eigen::Matrix3d inverse = factors.inverse();
  bool has_others = false;
  for (std::size_t c = 0; c < rows.size(); ++c)
  {
    const std::int32_t column = rows.place(c);
    if (column >= first and column < first + g)
      continue;
    has_others = true;
    const auto& values = rows.values(c);
    for (int i = 0; i < g; ++i)
    {
      if (own[i] == 0)
        continue;
      double value = 0;
      for (int j = 0; j < g; ++j)
        value -= inverse(i, j) * values[j];
      _right.add(first + i, column, value);
    }
  }
  const auto given = std::ranges::count_if(own, [](std::int8_t is_own)
                                           { return is_own != 0; });
  _sticks = _sticks or (given > 1 and has_others);
  for (int i = 0; i < g; ++i)
  {
    if (own[i] == 0)
      continue;
    _right.add(first + i, first + i, -1);
    _eliminated.push_back(first + i);
    for (int j = 0; j < g; ++j)
      _shift.add(first + i, multiplier + j, inverse(i, j));
  }
}

/// Slipping node: the normal row gives a displacement, the others are the law's
void Elimination::add_slip(std::int32_t multiplier, std::int32_t first,
                           std::span<const std::int8_t> own,
                           const double* normal, const double* by,
                           const std::array<double, 3>& factors,
                           const Rows& rows)
{
  const int g = _gdim;
  _slips = true;
  int k = 0;
  for (int i = 1; i < g; ++i)
    if (std::abs(normal[i]) * own[i] > std::abs(normal[k]) * own[k])
      k = i;
  const std::int32_t pivot = first + k;
  auto along = [&](const std::array<double, 3>& values)
  {
    double sum = 0;
    for (int j = 0; j < g; ++j)
      sum += normal[j] * values[j];
    return sum;
  };
  const double factor = along(rows.at(pivot));
  if (factor == 0)
    throw NotCondensable(nothing_free);
  for (std::size_t c = 0; c < rows.size(); ++c)
    _right.add(pivot, rows.place(c), -along(rows.values(c)) / factor);
  _eliminated.push_back(pivot);
  for (int j = 0; j < g; ++j)
    _shift.add(pivot, multiplier + j, normal[j] / factor);

  for (int step = 1; step < g; ++step)
  {
    const int i = (k + step) % g;
    if (own[i] == 0)
      continue;
    const std::int32_t row = first + i;
    // tau has one at i and this at k
    const double back = -normal[i] / normal[k];
    for (int j = 0; j < g; ++j)
      if (own[j] != 0)
        // C_l times the multiplier that the row gives
        _rows.add(row, first + j,
                  -(by[g * i + j] + back * by[g * k + j]) / factors[j]
                      - (i == j ? 1 : 0));
    for (std::size_t c = 0; c < rows.size(); ++c)
    {
      const auto& values = rows.values(c);
      _law.add(row, rows.place(c), values[i] + back * values[k]);
    }
    _extra.add(row, multiplier + i, 1);
    _extra.add(row, multiplier + k, back);
  }
}

std::vector<double> Elimination::shift(std::span<const double> d) const
{
  std::vector<double> shift(_num_local, 0);
  _shift.multiply(d, shift);
  return shift;
}

std::vector<double> Elimination::extra(std::span<const double> d) const
{
  std::vector<double> extra(_num_local, 0);
  _extra.multiply(d, extra);
  return extra;
}

std::vector<double>
Elimination::open_multipliers(std::span<const double> d) const
{
  std::vector<double> multipliers(_num_multipliers, 0);
  for (std::size_t i = 0; i < _open.size(); ++i)
    multipliers[_open[i]] = d[_open[i]] / _diagonal[i];
  return multipliers;
}

void Elimination::recover(std::span<const double> defect,
                          std::span<double> multipliers) const
{
  for (std::size_t i = 0; i < _given.size(); ++i)
    multipliers[_given[i]] = defect[_recovered[i]] / _factors[i];
}
