// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#include "galerkin.h"
#include <algorithm>
#include <array>
#include <iterator>
#include <utility>

using namespace contactx;
using namespace contactx::condense;

Galerkin::Galerkin(const Numbering& numbering, MatrixPtr slave_rows,
                   std::vector<MatrixPtr> prolongations)
    : _algebra(numbering.algebra()), _ranks(numbering.ranks()),
      _prolongations(std::move(prolongations))
{
  if (not _prolongations.empty())
    _rows = _algebra.product(*slave_rows, *_prolongations.front());
}

bool Galerkin::serves(const ContactUpdate& update, double max_change) const
{
  std::vector<std::int32_t> others;
  std::ranges::set_symmetric_difference(update.places, _constrained,
                                        std::back_inserter(others));
  std::array counts{std::ssize(others), std::ssize(update.places),
                    std::ptrdiff_t(update.springs or _has_springs)};
  _ranks.reduce(std::span<std::int64_t>(counts), mesh::Reduction::sum);
  return counts[2] == 0
         and static_cast<double>(counts[0])
                 <= max_change * static_cast<double>(counts[1]);
}

void Galerkin::update(const ContactUpdate& update,
                      std::span<const MatrixPtr> matrices)
{
  _constrained = update.places;
  _has_springs = update.springs != nullptr;
  if (matrices.empty())
    return;
  const Layout layout = _algebra.layout(*_rows);
  std::vector<std::int64_t> chosen;
  for (const std::int32_t place : update.places)
    chosen.push_back(layout.first_row + place);
  const Matrix& Q = *_prolongations.front();
  const MatrixPtr X = _algebra.product(*update.right, Q);
  if (update.chains)
    add_terms(_algebra, *X, *update.chains, false);
  const MatrixPtr Y = _algebra.submatrix(
      *_rows, chosen, successive(layout.first_column, layout.num_columns));
  _algebra.add(*Y, 0.5, *_algebra.product(*update.block, *X));
  MatrixPtr change = _algebra.transposed_product(*X, *Y);
  _algebra.add(*change, 1, *_algebra.transpose(*change));
  if (update.springs)
    _algebra.add(*change, 1, *_algebra.projection(*update.springs, Q));
  const MatrixPtr before = std::exchange(_added, _algebra.copy(*change));
  if (before)
    _algebra.add(*change, -1, *before);
  for (std::size_t level = 0; level < matrices.size(); ++level)
  {
    if (level > 0)
      change = _algebra.projection(*change, *_prolongations[level]);
    _algebra.add(*matrices[level], 1, *change);
  }
}
