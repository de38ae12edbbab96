// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#include "chains.h"
#include "../elimination.h"

using namespace contactx;
using namespace contactx::condense;

namespace
{
// Number of terms of a Neumann series after the first one
constexpr int num_series_terms = 2;
} // namespace

Chains::Chains(const Numbering& numbering, const Triplets& entries,
               std::vector<std::int32_t> dofs)
    : _dofs(std::move(dofs)), _C(numbering.square(entries, _dofs))
{
  Algebra& algebra = numbering.algebra();
  Triplets all;
  all.join(entries, -1);
  for (const std::int32_t dof : _dofs)
    all.add(dof, dof, 1);
  _factors = algebra.factorise(numbering.square(all, _dofs),
                               {.name = "chains", .is_rough = false});
  if (not _factors->is_good())
    throw NotCondensable("slave nodes that are masters hold one another");
}

std::unique_ptr<Chains> Chains::of(const Numbering& numbering,
                                   const Triplets& entries,
                                   const std::vector<std::int32_t>& dofs)
{
  if (not mesh::anywhere(numbering.ranks(), entries.size() > 0))
    return nullptr;
  return std::make_unique<Chains>(numbering, entries, dofs);
}

void Chains::solve(std::span<double> x, bool transposed)
{
  _b.assign(x.begin(), x.end());
  _factors->solve(_b, x, transposed);
}

void Chains::solve_at(std::span<double> values, bool transposed)
{
  std::vector<double> x;
  for (const std::int32_t dof : _dofs)
    x.push_back(values[dof]);
  solve(x, transposed);
  for (std::size_t i = 0; i < _dofs.size(); ++i)
    values[_dofs[i]] = x[i];
}

void contactx::condense::add_terms(Algebra& algebra, Matrix& X, const Matrix& C,
                                   bool is_left)
{
  MatrixPtr term = algebra.copy(X);
  for (int k = 0; k < num_series_terms; ++k)
  {
    term = is_left ? algebra.product(*term, C) : algebra.product(C, *term);
    algebra.add(X, 1, *term);
  }
}
