// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#include "dof_block.h"
#include "../../math/scales.h"
#include <cmath>

using namespace contactx;
using namespace contactx::condense;

namespace
{
/// Whether L = R^T but for round-off, or both are empty
bool is_transposed(Algebra& algebra, const Matrix& L, const Matrix& R)
{
  if (algebra.num_entries(L) == 0 and algebra.num_entries(R) == 0)
    return true;
  const double size = std::max(algebra.norm(L), algebra.norm(R));
  const MatrixPtr difference = algebra.transpose(R);
  algebra.add(*difference, -1, L);
  return algebra.norm(*difference) <= math::round_off * size;
}
} // namespace

DofBlock::DofBlock(const Numbering& numbering, std::vector<std::int32_t> dofs,
                   const Matrix& K)
    : _numbering(numbering), _algebra(numbering.algebra()),
      _dofs(std::move(dofs)), _places(numbering.num_owned(), -1),
      _numbers(numbering.numbers(_dofs)),
      _K(_algebra.submatrix(K, _numbers, _numbers))
{
  const int g = numbering.gdim();
  bool is_whole = _dofs.size() % g == 0;
  for (std::size_t i = 0; i < _dofs.size(); ++i)
  {
    _places[_dofs[i]] = static_cast<std::int32_t>(i);
    // The first one of a node, and the others behind it
    const auto axis = static_cast<std::int32_t>(i % g);
    is_whole = is_whole and _dofs[i - axis] % g == 0
               and _dofs[i] == _dofs[i - axis] + axis;
  }
  _group = mesh::everywhere(numbering.ranks(), is_whole) ? g : 1;
}

std::vector<std::int32_t>
DofBlock::places(std::span<const std::int32_t> dofs) const
{
  std::vector<std::int32_t> found;
  for (const std::int32_t dof : dofs)
    if (_places[dof] >= 0)
      found.push_back(_places[dof]);
  return found;
}

std::vector<double> DofBlock::diagonal() const
{
  std::vector<double> values = _algebra.diagonal(*_K);
  for (double& value : values)
    value = std::abs(value);
  return values;
}

MatrixPtr DofBlock::part(const MatrixPtr& A) const
{
  return _algebra.submatrix(*A, _numbers, _numbers);
}

BlockChange DofBlock::change(const Transforms& transforms) const
{
  const MatrixPtr R = part(transforms.right), L = part(transforms.left),
                  law = part(transforms.law), S = part(transforms.stiffness);
  const bool has_R = _algebra.num_entries(*R) > 0,
             has_L = _algebra.num_entries(*L) > 0,
             has_law = _algebra.num_entries(*law) > 0,
             has_S = _algebra.num_entries(*S) > 0;
  // Rows and columns of what is eliminated are those of the identity; a
  // displacement itself is no other one
  BlockChange change{_algebra.copy(*S),
                     not has_law and is_transposed(_algebra, *L, *R)};
  Matrix& added = *change.added;
  _algebra.add(added, 1, *part(transforms.springs));
  if (has_R)
  {
    // Without the sum K + S, which would be a second K
    _algebra.add(added, 1, *_algebra.product(*_K, *R));
    if (has_S)
      _algebra.add(added, 1, *_algebra.product(*S, *R));
  }
  if (has_L)
  {
    const MatrixPtr product = _algebra.product(*L, *_K);
    if (has_S)
      _algebra.add(*product, 1, *_algebra.product(*L, *S));
    if (has_R)
      _algebra.add(*product, 1, *_algebra.product(*product, *R));
    _algebra.add(added, 1, *product);
  }
  if (has_law)
  {
    if (has_R)
      _algebra.add(*law, 1, *_algebra.product(*law, *R));
    _algebra.add(added, 1, *law);
  }
  return change;
}

MatrixPtr DofBlock::with(const Matrix& added,
                         std::span<const std::int32_t> eliminated) const
{
  const MatrixPtr A = _algebra.copy(*_K);
  _algebra.add(*A, 1, added);
  const std::vector<std::int32_t> taken = places(eliminated);
  const std::int64_t first = _algebra.layout(*A).first_row;
  _algebra.set_identity(*A,
                        [&]
                        {
                          std::vector<std::int64_t> rows;
                          for (const std::int32_t place : taken)
                            rows.push_back(first + place);
                          return rows;
                        }());
  const std::vector<double> own = this->diagonal();
  std::vector<double> diagonal = _algebra.diagonal(*A);
  for (const std::int32_t place : taken)
    diagonal[place] = own[place];
  _algebra.set_diagonal(*A, diagonal);
  return A;
}
