// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#include "coarse_model.h"
#include "../../math/scales.h"
#include "multigrid_solver.h"
#include <algorithm>
#include <cmath>
#include <iterator>

using namespace contactx;
using namespace contactx::condense;

namespace
{
// Stiffness of a spring, relative to the diagonal of the soft body's matrix
// where it acts: of 0.02, 0.05, 0.1 and 0.3 the one with the fewest iterations
// on slabs of a dam's face
constexpr double spring_stiffness = 0.1;
} // namespace

CoarseModel::CoarseModel(const Numbering& numbering, MatrixPtr stiffness,
                         MatrixPtr P, const DofBlock& soft,
                         std::vector<std::int32_t> slaves)
    : _numbering(numbering), _rows(numbering.numbers(slaves)),
      _stiffness(std::move(stiffness)), _P(std::move(P))
{
  const std::vector<double> diagonal = soft.diagonal();
  for (const std::int32_t place : soft.places(slaves))
    _springs.push_back(spring_stiffness * diagonal[place]);
  const Layout layout = numbering.algebra().layout(*_stiffness);
  const bool is_grouped = layout.num_rows % soft.group() == 0;
  _group = mesh::everywhere(numbering.ranks(), is_grouped) ? soft.group() : 1;
}

std::unique_ptr<CoarseModel>
CoarseModel::of(const Numbering& numbering, const DofBlock& soft,
                std::span<const std::int32_t> slave_dofs)
{
  Algebra& algebra = numbering.algebra();
  const int g = numbering.gdim();
  // Of whole nodes: prescribed displacements of slave nodes are in the other
  // block
  std::vector<std::int32_t> dofs;
  for (const std::int32_t dof : soft.dofs())
    if (dofs.empty() or dof / g != dofs.back() / g)
      for (int k = 0; k < g; ++k)
        dofs.push_back(g * (dof / g) + k);
  const std::span<const double> X = numbering.halo().reference();
  const auto marks = algebra.prescribed();
  std::vector<double> x;
  std::vector<std::int8_t> prescribed;
  for (const std::int32_t dof : dofs)
  {
    x.push_back(X[dof]);
    prescribed.push_back(marks[dof]);
  }
  const std::vector<std::int64_t> every = numbering.numbers(dofs);
  std::optional<Aggregates> coarse
      = algebra.aggregate(algebra.submatrix(*algebra.bulk_copy(), every, every),
                          rigid_modes(numbering.ranks(), x, prescribed, g), g);
  if (not coarse)
    return nullptr;
  std::vector<std::int32_t> slaves;
  std::ranges::set_intersection(soft.dofs(), slave_dofs,
                                std::back_inserter(slaves));
  const Layout layout = algebra.layout(*coarse->prolongation);
  std::vector<std::int64_t> rows;
  for (const std::int32_t slave : slaves)
    rows.push_back(layout.first_row
                   + (std::ranges::lower_bound(dofs, slave) - dofs.begin()));
  MatrixPtr P
      = algebra.submatrix(*coarse->prolongation, rows,
                          successive(layout.first_column, layout.num_columns));
  std::vector<double> diagonal = algebra.diagonal(*coarse->stiffness);
  // A body that contact alone supports leaves no singular block
  for (double& value : diagonal)
    value *= 1 + math::weak_spring;
  algebra.set_diagonal(*coarse->stiffness, diagonal);
  return std::unique_ptr<CoarseModel>(
      new CoarseModel(numbering, std::move(coarse->stiffness), std::move(P),
                      soft, std::move(slaves)));
}

MatrixPtr CoarseModel::block(MatrixPtr A, const Matrix& right,
                             const DofBlock& stiff,
                             std::span<const std::int32_t> eliminated) const
{
  Algebra& algebra = _numbering.algebra();
  MatrixPtr R = algebra.submatrix(right, _rows, stiff.numbers());
  const std::vector<std::int32_t> counts = algebra.entries_of_rows(*R);
  // A group of which one is active is taken as a whole
  std::vector<std::int64_t> rows_of_R, rows_of_P;
  std::vector<double> roots;
  const Layout of_R = algebra.layout(*R), of_P = algebra.layout(*_P);
  for (std::size_t first = 0; first < counts.size(); first += _group)
  {
    const auto group = std::span(counts).subspan(first, _group);
    if (std::ranges::all_of(group, [](std::int32_t n) { return n == 0; }))
      continue;
    for (std::size_t i = first; i < first + _group; ++i)
    {
      const auto at = static_cast<std::int64_t>(i);
      rows_of_R.push_back(of_R.first_row + at);
      rows_of_P.push_back(of_P.first_row + at);
      roots.push_back(counts[i] > 0 ? std::sqrt(_springs[i]) : 0);
    }
  }
  R = algebra.submatrix(*R, rows_of_R,
                        successive(of_R.first_column, of_R.num_columns));
  const MatrixPtr P = algebra.submatrix(
      *_P, rows_of_P, successive(of_P.first_column, of_P.num_columns));
  std::vector<double> kept(of_R.num_columns, 1);
  for (const std::int32_t place : stiff.places(eliminated))
    kept[place] = 0;
  algebra.scale(*R, roots, kept);
  std::vector<double> negative = roots;
  for (double& root : negative)
    root = -root;
  algebra.scale(*P, negative, std::vector<double>(of_P.num_columns, 1));
  const MatrixPtr forces = diagonal_matrix(
      algebra, _numbering.ranks(), std::vector<double>(roots.size(), -1));
  return algebra.join({{std::move(A), nullptr, algebra.transpose(*R)},
                       {nullptr, _stiffness, algebra.transpose(*P)},
                       {R, P, forces}});
}
