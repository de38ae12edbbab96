// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#include "elimination.h"
#include "../law/normal.h"
#include "../math/scales.h"
#include <Eigen/LU>
#include <Eigen/SVD>
#include <algorithm>
#include <array>
#include <string>

using namespace contactx;
using namespace contactx::condense;

namespace
{
constexpr auto nothing_free
    = "all displacements of a slave node are prescribed";

/// Stiffness, over the bulk's diagonal, in series with the spring of a soft
/// node: Krylov iterations are the same from 0.03 to 0.3, see the manual
constexpr double series_stiffness = 0.1;

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

/// What the law of a sticking node has of its own multipliers beyond round-off:
/// nothing unless it is soft.
/// @param by The law's derivatives without multipliers that the law gives
std::array<double, 9> soft_law(const Nodes& nodes, std::size_t s,
                               const double* by,
                               std::span<const std::int8_t> own)
{
  const int k = nodes.size;
  std::array<double, 9> D{};
  double most = 0, size = nodes.area[s];
  for (int i = 0; i < k; ++i)
    for (int j = 0; j < k; ++j)
    {
      const std::size_t at = (s * k + i) * k + j;
      size = std::max(size, std::abs(nodes.by_multiplier[at]));
      if (own[i] != 0 and own[j] != 0)
        D[3 * i + j] = by[at];
      most = std::max(most, std::abs(D[3 * i + j]));
    }
  return most > math::round_off * size ? D : std::array<double, 9>{};
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

/// Entries of soft nodes, (dof, dof)
struct Elimination::SoftNodes
{
  /// Add a node.
  /// @param dofs Its displacements, -1 for none
  /// @param compliance Relative displacement by forces, k^-1, that of the
  /// identity where there is no displacement
  void add(const std::array<std::int32_t, 3>& dofs,
           const Eigen::Matrix3d& compliance);

  std::span<const double> bulk; ///< diagonal of the bulk's matrix

  /// Parts Q of g(v) in g(u), for rows of `right` and for columns of `left`
  Triplets right, left;
  Triplets springs; ///< Q k Q
  Triplets squares; ///< Q Q, of `left`
  Triplets forces;  ///< Q Q k
};

void Elimination::SoftNodes::add(const std::array<std::int32_t, 3>& dofs,
                                 const Eigen::Matrix3d& compliance)
{
  const Eigen::PartialPivLU<Eigen::Matrix3d> factors(compliance);
  if (factors.determinant() == 0)
    throw NotCondensable("the law of a soft slave node is singular");
  const Eigen::Matrix3d k = factors.inverse();
  Eigen::Vector3d root = Eigen::Vector3d::Ones();
  for (int i = 0; i < 3; ++i)
    if (dofs[i] >= 0)
      root[i] = std::sqrt(std::abs(bulk[dofs[i]]));
  const Eigen::Vector3d inverse = root.cwiseInverse();
  const Eigen::Matrix3d relative
      = inverse.asDiagonal() * k * inverse.asDiagonal();
  const Eigen::JacobiSVD<Eigen::Matrix3d> modes(
      relative, Eigen::ComputeFullU | Eigen::ComputeFullV);
  const Eigen::Vector3d part
      = (1 + modes.singularValues().array() / series_stiffness).rsqrt();
  const auto &U = modes.matrixU(), &V = modes.matrixV();
  const Eigen::Matrix3d of_right
      = inverse.asDiagonal() * (V * part.asDiagonal() * V.transpose())
        * root.asDiagonal(),
      of_left = root.asDiagonal() * (U * part.asDiagonal() * U.transpose())
                * inverse.asDiagonal();
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j)
      if (dofs[i] >= 0 and dofs[j] >= 0)
        for (const auto& [entries, block] :
             {std::pair<Triplets*, Eigen::Matrix3d>{&right, of_right},
              {&left, of_left},
              {&springs, of_left * k * of_right},
              {&squares, of_left * of_left},
              {&forces, of_left * of_left * k}})
          entries->add(dofs[i], dofs[j], block(i, j));
}

Elimination::Elimination(std::span<const Nodes> contacts,
                         const Prescribed& contact,
                         std::span<const std::int8_t> free, int gdim,
                         std::span<const double> diagonal)
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
  SoftNodes soft;
  soft.bulk = diagonal;

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
        const std::span<const std::int32_t> entries = traction[multiplier];
        const Pivot own = pivot(C, constraint[multiplier], first, free, gdim);
        add_scalar(C, constraint[multiplier], multiplier, own);
        const double factor = sum_at(T, entries, own.dof);
        add_force(T, entries, own.dof, multiplier, factor);
        if (by[s] == 0)
          _eliminated.push_back(own.dof);
        else
        {
          Eigen::Matrix3d compliance = Eigen::Matrix3d::Identity();
          compliance(0, 0) = -by[s] / (own.coefficient * factor);
          soft.add({own.dof, -1, -1}, compliance);
        }
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
        add_stick(multiplier, first, own, rows, soft_law(nodes, s, by, own),
                  factors, soft);
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
  _constrained = _eliminated;
  if (soft.springs.size() > 0)
    soften(soft);
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
                             std::int32_t multiplier, const Pivot& own)
{
  if (own.dof < 0)
    throw NotCondensable(nothing_free);
  for (const std::int32_t e : entries)
    _right.add(own.dof, C.columns[e], -C.values[e] / own.coefficient);
  _shift.add(own.dof, multiplier, 1 / own.coefficient);
}

/// Sticking or tied node: the constraints give its displacements
void Elimination::add_stick(std::int32_t multiplier, std::int32_t first,
                            std::span<const std::int8_t> own, const Rows& rows,
                            const std::array<double, 9>& D,
                            const std::array<double, 3>& factors,
                            SoftNodes& soft)
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
  const Eigen::PartialPivLU<Eigen::Matrix3d> solver(block);
  if (solver.determinant() == 0)
    throw NotCondensable(
        "the constraints of a slave node do not give its displacements");
  const Eigen::Matrix3d inverse = solver.inverse();
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
  const bool is_soft = std::ranges::any_of(D, [](double x) { return x != 0; });
  _sticks = _sticks or (given > 1 and (has_others or is_soft));
  std::array<std::int32_t, 3> dofs{-1, -1, -1};
  // Rows and columns of what the law gives are those of the identity
  Eigen::Matrix3d compliance
      = -inverse * Eigen::Matrix3d::Map(D.data()).transpose();
  for (int i = 0; i < 3; ++i)
    if (i >= g or own[i] == 0)
      compliance.col(i) = Eigen::Vector3d::Unit(i);
    else
    {
      dofs[i] = first + i;
      compliance.col(i) /= factors[i];
      _right.add(first + i, first + i, -1);
      if (not is_soft)
        _eliminated.push_back(first + i);
      for (int j = 0; j < g; ++j)
        _shift.add(first + i, multiplier + j, inverse(i, j));
    }
  if (is_soft)
    soft.add(dofs, compliance);
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

/// From transforms that take soft nodes for rigid ones to those of springs
void Elimination::soften(const SoftNodes& soft)
{
  const std::size_t n = _num_local, m = _num_multipliers;
  _rigid_right = _right;
  _rigid_left = _left;
  const Groups rows = grouped(soft.springs.rows, n);
  for (std::size_t i = 0; i < n; ++i)
    if (not rows[i].empty())
    {
      const auto dof = static_cast<std::int32_t>(i);
      _constrained.push_back(dof);
      _left.add(dof, dof, -1);
    }
  std::ranges::sort(_constrained);
  const Triplets forces = product(_left, soft.springs, n, n, n);
  _springs = product(forces, _right, n, n, n);
  _preload.join(product(forces, _shift, n, n, m), -1);
  _by_defect.join(soft.squares, -1);
  _by_displacement.join(product(soft.forces, _right, n, n, n), -1);
  _by_constraint.join(product(soft.forces, _shift, n, n, m), -1);
  _left.join(product(_left, soft.left, n, n, n), -1);
  _right.join(product(soft.right, _right, n, n, n), -1);
  _right = merged(_right, n, n);
  _shift.join(product(soft.right, _shift, n, n, m), -1);
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

std::vector<double> Elimination::preload(std::span<const double> d) const
{
  std::vector<double> preload(_num_local, 0);
  _preload.multiply(d, preload);
  return preload;
}

std::vector<double>
Elimination::open_multipliers(std::span<const double> d) const
{
  std::vector<double> multipliers(_num_multipliers, 0);
  for (std::size_t i = 0; i < _open.size(); ++i)
    multipliers[_open[i]] = d[_open[i]] / _diagonal[i];
  return multipliers;
}

void Elimination::recover(std::span<const double> d,
                          std::span<const double> defect,
                          std::span<const double> u,
                          std::span<double> multipliers) const
{
  // Both the defect and the law give the force of a spring. Of a stiff one the
  // law multiplies round-off, of a soft one the defect leaves its residual in
  // the law: so it is Q Q times the law's and 1 - Q Q times the defect's
  std::vector<double> forces(defect.begin(), defect.end());
  _by_defect.multiply(defect, forces);
  _by_displacement.multiply(u, forces);
  _by_constraint.multiply(d, forces);
  for (std::size_t i = 0; i < _given.size(); ++i)
    multipliers[_given[i]] = forces[_recovered[i]] / _factors[i];
}
