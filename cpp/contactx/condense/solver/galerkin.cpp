// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#include "galerkin.h"
#include <algorithm>
#include <iterator>
#include <utility>

using namespace contactx;
using namespace contactx::condense;

namespace
{
// Changed eliminated dofs, as a fraction of all of them, up to which a
// hierarchy is kept as it is
constexpr double max_changed_fraction = 0.25;
} // namespace

Galerkin::Galerkin(const Numbering& numbering, MatrixPtr slave_rows,
                   std::vector<MatrixPtr> prolongations)
    : _algebra(numbering.algebra()), _ranks(numbering.ranks()),
      _prolongations(std::move(prolongations)), _rows{std::move(slave_rows)},
      _added(_prolongations.size())
{
  for (const MatrixPtr& Q : _prolongations)
    _rows.push_back(_algebra.product(*_rows.back(), *Q));
}

bool Galerkin::nearly_serves(const ContactUpdate& update) const
{
  std::vector<std::int32_t> changed;
  std::ranges::set_symmetric_difference(update.places, _eliminated,
                                        std::back_inserter(changed));
  std::array counts{static_cast<std::int64_t>(changed.size()),
                    static_cast<std::int64_t>(update.places.size())};
  _ranks.reduce(std::span<std::int64_t>(counts), mesh::Reduction::sum);
  return not update.springs
         and static_cast<double>(counts[0])
                 <= max_changed_fraction * static_cast<double>(counts[1]);
}

void Galerkin::update(const ContactUpdate& update,
                      std::span<const MatrixPtr> matrices)
{
  MatrixPtr X = update.right, springs = update.springs;
  std::vector<std::int64_t> chosen;
  for (const std::int32_t place : update.places)
    chosen.push_back(_algebra.layout(*_rows.front()).first_row + place);
  for (std::size_t level = 0; level < matrices.size(); ++level)
  {
    const Matrix& Q = *_prolongations[level];
    const Matrix& rows = *_rows[level + 1];
    X = _algebra.product(*X, Q);
    if (level == 0 and update.chains)
      add_terms(_algebra, *X, *update.chains, false);
    const Layout layout = _algebra.layout(rows);
    const MatrixPtr Y = _algebra.submatrix(
        rows, chosen, successive(layout.first_column, layout.num_columns));
    _algebra.add(*Y, 0.5, *_algebra.product(*update.block, *X));
    const MatrixPtr change = _algebra.transposed_product(*X, *Y);
    _algebra.add(*change, 1, *_algebra.transpose(*change));
    if (springs)
    {
      springs = _algebra.projection(*springs, Q);
      _algebra.add(*change, 1, *springs);
    }
    const MatrixPtr before
        = std::exchange(_added[level], _algebra.copy(*change));
    if (before)
      _algebra.add(*change, -1, *before);
    _algebra.add(*matrices[level], 1, *change);
  }
  _eliminated = update.places;
}
