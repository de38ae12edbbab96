// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#include "prescribed.h"
#include "../math/matrix.h"
#include "../math/scales.h"
#include <Eigen/LU>
#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

using namespace contactx;
using namespace contactx::condense;
using Eigen::Matrix3d;

namespace
{
/// Inverts D_pp over the area, zero elsewhere; false where it is singular.
/// Matrices of fewer multipliers have zeros behind them.
bool inverted(const Matrix3d& D, const std::array<bool, 3>& p, Matrix3d& G)
{
  G.setIdentity();
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j)
      if (p[i] and p[j])
        G(i, j) = D(i, j);
  const Eigen::PartialPivLU<Matrix3d> factors(G);
  if (std::abs(factors.determinant()) < math::equal_rel_tol)
    return false;
  G = factors.inverse();
  for (int i = 0; i < 3; ++i)
    if (not p[i])
      G(i, i) = 0;
  return true;
}

/// Chooses which multipliers the law gives, of those that may: the others stay
/// with no more than rounding errors in the law of those that neither give nor
/// stay. False where there are more.
bool choose(Matrix3d D, std::array<bool, 3>& gives, std::array<bool, 3>& stays)
{
  stays = std::exchange(gives, {});
  const auto others = [&](int i) { return not gives[i] and not stays[i]; };
  while (true)
  {
    int pivot = -1;
    for (int i = 0; i < 3; ++i)
      if (stays[i] and std::abs(D(i, i)) > math::negligible_part
          and (pivot < 0 or std::abs(D(i, i)) > std::abs(D(pivot, pivot))))
        pivot = i;
    if (pivot < 0)
      break;
    D -= (D.col(pivot) * D.row(pivot) / D(pivot, pivot)).eval();
    gives[pivot] = true;
    stays[pivot] = false;
  }
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j)
      if (stays[i] and others(j)
          and std::max(std::abs(D(i, j)), std::abs(D(j, i))) > math::round_off)
        return false;
  return true;
}

/// Gives the entries whose number has a place to a function of the entry and
/// the place, and the others to others.
template <class Use>
void split(const Triplets& all, std::span<const std::int32_t> numbers,
           std::span<const std::int32_t> place, Triplets& others, Use use)
{
  for (std::size_t e = 0; e < all.size(); ++e)
    if (const std::int32_t at = place[numbers[e]]; at >= 0)
      use(e, at);
    else
      others.add(all.rows[e], all.columns[e], all.values[e]);
}

/// Mean size of the diagonal where displacements are free.
double mean_size(std::span<const double> diagonal,
                 std::span<const std::int8_t> free)
{
  double sum = 0;
  int count = 0;
  for (std::size_t i = 0; i < diagonal.size(); ++i)
    if (free[i])
    {
      sum += std::abs(diagonal[i]);
      ++count;
    }
  return sum > 0 ? sum / count : 1;
}
} // namespace

Prescribed::Prescribed(std::span<const Nodes> contacts, Blocks blocks,
                       std::span<const std::int8_t> free, int gdim,
                       std::span<const double> diagonal, bool holds)
    : _blocks(std::move(blocks))
{
  const std::size_t count = num_multipliers(contacts);
  _own.assign(count, 1);
  mark_springs(contacts, free, gdim);
  // D between retained multipliers, by their places
  Triplets held_law;
  std::size_t first = 0;
  for (const Nodes& nodes : contacts)
  {
    const int k = nodes.size;
    auto& by = _by_multiplier.emplace_back(nodes.by_multiplier.begin(),
                                           nodes.by_multiplier.end());
    for (std::size_t s = 0; s < nodes.count(); ++s, first += k)
    {
      if (not nodes.is_closed(s))
        continue;
      std::int8_t* own = _own.data() + first;
      bool is_concerned = false;
      for (int i = 0; i < k; ++i)
      {
        if (k > 1)
          own[i] = free[nodes.slaves[s] * gdim + i] != 0;
        is_concerned = is_concerned or own[i] == 0;
      }
      if (not is_concerned)
        continue;

      Eigen::Map<math::Small> law(by.data() + s * k * k, k, k);
      Matrix3d D = Matrix3d::Zero(), G;
      D.topLeftCorner(k, k) = law;
      const Matrix3d relative = D / nodes.area[s];
      std::array<bool, 3> gives{}, stays{};
      for (int i = 0; i < k; ++i)
        gives[i] = own[i] == 0;
      if (not inverted(relative, gives, G)
          and (not holds or k == 1 or not choose(relative, gives, stays)
               or not inverted(relative, gives, G)))
        throw NotCondensable(
            "a slave node with a prescribed displacement moves its master");
      G /= nodes.area[s];
      const Matrix3d DG = D * G, GD = G * D, DGD = DG * D;
      const auto place = static_cast<std::int32_t>(_multipliers.size());
      std::array<std::int32_t, 3> number{};
      for (int i = 0; i < k; ++i)
      {
        _is_given.push_back(gives[i]);
        if (not stays[i])
          continue;
        number[i] = static_cast<std::int32_t>(_retained.dofs.size());
        _retained.multipliers.push_back(static_cast<std::int32_t>(first) + i);
        _retained.dofs.push_back(nodes.slaves[s] * gdim + i);
      }
      for (int i = 0; i < k; ++i)
        for (int j = 0; j < k; ++j)
          if (stays[i] and stays[j])
            held_law.add(number[i], number[j], D(i, j) - DGD(i, j));
      for (int i = 0; i < k; ++i)
      {
        _multipliers.push_back(static_cast<std::int32_t>(first) + i);
        for (int j = 0; j < k; ++j)
        {
          // D - D G D is zero in the rows and columns of p
          const bool is_left = own[i] != 0 and own[j] != 0;
          law(i, j) = is_left ? D(i, j) - DGD(i, j) : 0;
          _law.add(place + i, place + j, D(i, j));
          _inverse.add(place + i, place + j, G(i, j));
          _rows.add(place + i, place + j, -DG(i, j));
          _columns.add(place + i, place + j, -GD(i, j));
        }
      }
    }
  }
  if (not _multipliers.empty())
    take_out(count, free.size());
  if (not _retained.dofs.empty())
    hold(held_law, free, diagonal);
}

/// Pressures of soft nodes that have no displacement of their slave node for
/// themselves
void Prescribed::mark_springs(std::span<const Nodes> contacts,
                              std::span<const std::int8_t> free, int gdim)
{
  const Triplets& C = _blocks.constraint;
  const Groups constraint = grouped(C.rows, _own.size());
  std::vector<std::int8_t> taken(free.size(), 0);
  for (const bool is_soft : {false, true})
  {
    std::int32_t multiplier = 0;
    for (const Nodes& nodes : contacts)
      for (std::size_t s = 0; s < nodes.count(); ++s, multiplier += nodes.size)
      {
        const std::int32_t first = nodes.slaves[s] * gdim;
        const bool is_scalar = nodes.size == 1;
        if (not nodes.is_closed(s)
            or is_soft != (is_scalar and nodes.by_multiplier[s] != 0))
          continue;
        if (not is_scalar)
          std::fill_n(taken.begin() + first, gdim, 1);
        else if (const std::int32_t dof
                 = pivot(C, constraint[multiplier], first, free, gdim).dof;
                 not is_soft)
        {
          if (dof >= 0)
            taken[dof] = 1;
        }
        else
          _own[multiplier] = dof >= 0 and not std::exchange(taken[dof], 1);
      }
  }
}

void Prescribed::hold(const Triplets& law, std::span<const std::int8_t> free,
                      std::span<const double> diagonal)
{
  const std::size_t n = _retained.dofs.size();
  std::vector<std::int32_t> place(_own.size(), -1);
  for (std::size_t i = 0; i < n; ++i)
    place[_retained.multipliers[i]] = static_cast<std::int32_t>(i);
  const Triplets &T = _blocks.traction, &C = _blocks.constraint;
  std::vector<double> of_traction(n, 0), of_constraint(n, 0);
  // Of C_h^2 and of C_h^2 / diag(K), where masters are this rank's, too
  std::vector<double> squares(n, 0), compliance(n, 0);
  for (std::size_t e = 0; e < C.size(); ++e)
    if (const std::int32_t at = place[C.rows[e]]; at >= 0)
    {
      const std::size_t dof = C.columns[e];
      of_constraint[at] = std::max(of_constraint[at], std::abs(C.values[e]));
      if (dof >= diagonal.size() or not free[dof] or diagonal[dof] == 0)
        continue;
      squares[at] += C.values[e] * C.values[e];
      compliance[at] += C.values[e] * C.values[e] / std::abs(diagonal[dof]);
    }
  for (std::size_t e = 0; e < T.size(); ++e)
    if (const std::int32_t at = place[T.columns[e]]; at >= 0)
      of_traction[at] = std::max(of_traction[at], std::abs(T.values[e]));
  const double mean_stiffness = mean_size(diagonal, free);
  double rows = 0, columns = 0;
  int count = 0;
  for (std::size_t i = 0; i < n; ++i)
  {
    _retained.row_scale.push_back(0);
    _retained.scale.push_back(0);
    // One whose master is prescribed, too, is in the law of another one alone
    if (of_traction[i] == 0 or of_constraint[i] == 0)
      continue;
    const double stiffness
        = compliance[i] > 0 ? squares[i] / compliance[i] : mean_stiffness;
    rows += _retained.row_scale[i] = stiffness / of_constraint[i];
    columns += _retained.scale[i] = stiffness / of_traction[i];
    ++count;
  }
  if (count == 0)
    throw NotCondensable("no displacement of a master that a prescribed one of "
                         "its slave node holds is free");
  std::ranges::replace(_retained.row_scale, 0.0, rows / count);
  std::ranges::replace(_retained.scale, 0.0, columns / count);
  Blocks left;
  left.stiffness = std::move(_blocks.stiffness);
  // The bulk's row of a prescribed displacement has a one
  for (const std::int32_t dof : _retained.dofs)
    left.stiffness.add(dof, dof, -1);
  split(C, C.rows, place, left.constraint,
        [&](std::size_t e, std::int32_t at)
        {
          left.stiffness.add(_retained.dofs[at], C.columns[e],
                             _retained.row_scale[at] * C.values[e]);
        });
  split(T, T.columns, place, left.traction,
        [&](std::size_t e, std::int32_t at)
        {
          left.stiffness.add(T.rows[e], _retained.dofs[at],
                             _retained.scale[at] * T.values[e]);
        });
  for (std::size_t e = 0; e < law.size(); ++e)
    left.stiffness.add(_retained.dofs[law.rows[e]],
                       _retained.dofs[law.columns[e]],
                       _retained.row_scale[law.rows[e]] * law.values[e]
                           * _retained.scale[law.columns[e]]);
  _blocks = std::move(left);
}

void Prescribed::take_out(std::size_t num_multipliers, std::size_t num_local)
{
  const std::size_t m = _multipliers.size();
  std::vector<std::int32_t> place(num_multipliers, -1);
  for (std::size_t i = 0; i < m; ++i)
    place[_multipliers[i]] = static_cast<std::int32_t>(i);

  Blocks left;
  const Triplets &T = _blocks.traction, &C = _blocks.constraint;
  split(T, T.columns, place, left.traction, [&](std::size_t e, std::int32_t at)
        { _T.add(T.rows[e], at, T.values[e]); });
  split(C, C.rows, place, left.constraint, [&](std::size_t e, std::int32_t at)
        { _C.add(at, C.columns[e], C.values[e]); });

  // Of the multipliers concerned only the others are left
  auto is_left = [this](std::int32_t i) { return _is_given[i] == 0; };
  Triplets rows, columns;
  for (std::size_t e = 0; e < _rows.size(); ++e)
  {
    if (is_left(_rows.rows[e]))
      rows.add(_rows.rows[e], _rows.columns[e], _rows.values[e]);
    if (is_left(_columns.columns[e]))
      columns.add(_columns.rows[e], _columns.columns[e], _columns.values[e]);
  }
  for (std::size_t i = 0; i < m; ++i)
    if (const auto at = static_cast<std::int32_t>(i); is_left(at))
    {
      rows.add(at, at, 1);
      columns.add(at, at, 1);
    }
  left.traction = merged(left.traction, num_local, num_multipliers);
  left.constraint = merged(left.constraint, num_multipliers, num_local);
  Triplets changed = product(_T, columns, num_local, m, m);
  for (std::int32_t& column : changed.columns)
    column = _multipliers[column];
  left.traction.join(changed);
  changed = product(rows, _C, m, m, num_local);
  for (std::int32_t& row : changed.rows)
    row = _multipliers[row];
  left.constraint.join(changed);

  _springs.join(product(product(_T, _inverse, num_local, m, m), _C, num_local,
                        m, num_local),
                -1);
  left.stiffness = std::move(_blocks.stiffness);
  left.stiffness.join(_springs);
  _blocks = std::move(left);
}

void Prescribed::right_hand_side(std::span<double> d, std::span<double> forces,
                                 std::vector<double>& retained) const
{
  const std::size_t m = _multipliers.size();
  std::vector<double> given(m), known(m, 0), change(m, 0);
  for (std::size_t i = 0; i < m; ++i)
    given[i] = d[_multipliers[i]];
  _inverse.multiply(given, known);
  _T.multiply(known, forces, -1);
  _rows.multiply(given, change);
  // Nothing is left in the rows of what the law gives
  for (std::size_t i = 0; i < m; ++i)
    d[_multipliers[i]] = _is_given[i] == 0 ? given[i] + change[i] : 0;
  for (std::size_t i = 0; i < _retained.dofs.size(); ++i)
    retained.push_back(_retained.row_scale[i]
                       * std::exchange(d[_retained.multipliers[i]], 0));
}

void Prescribed::recover(std::span<const double> d, std::span<const double> u,
                         std::span<double> multipliers) const
{
  for (std::size_t i = 0; i < _retained.dofs.size(); ++i)
    multipliers[_retained.multipliers[i]]
        = _retained.scale[i] * u[_retained.dofs[i]];
  const std::size_t m = _multipliers.size();
  std::vector<double> left(m), others(m), found(m, 0);
  for (std::size_t i = 0; i < m; ++i)
  {
    left[i] = d[_multipliers[i]];
    others[i] = multipliers[_multipliers[i]];
  }
  _C.multiply(u, left, -1);
  _law.multiply(others, left, -1);
  _inverse.multiply(left, found);
  for (std::size_t i = 0; i < m; ++i)
    multipliers[_multipliers[i]] += found[i];
}
