// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#include "operator.h"
#include "../../math/scales.h"
#include "../master_springs.h"
#include "../multigrid.h"
#include "../residual_weights.h"
#include "../stiff_bodies.h"
#include <algorithm>
#include <cmath>

using namespace contactx;
using namespace contactx::condense;

CondensedOperator::CondensedOperator(
    std::shared_ptr<const Numbering> numbering,
    std::shared_ptr<const Condensation> condensation, Springs springs)
    : _numbering(std::move(numbering)), _algebra(_numbering->algebra()),
      _condensation(std::move(condensation)), _springs(std::move(springs)),
      _K(_algebra.bulk())
{
  const Elimination& elimination = _condensation->elimination();
  const mesh::Halo& halo = _numbering->halo();
  _right = _numbering->rows(elimination.right(), constrained());
  _is_transposed = condense::is_symmetric(elimination, halo);
  _is_symmetric = _algebra.is_symmetric() and _is_transposed;

  Triplets left = elimination.left();
  left.join(elimination.rows());
  std::array counts{
      static_cast<std::int64_t>(_condensation->stiffness().size()),
      static_cast<std::int64_t>(left.size()),
      static_cast<std::int64_t>(elimination.law().size()),
      static_cast<std::int64_t>(elimination.is_soft())};
  _numbering->ranks().reduce(std::span<std::int64_t>(counts),
                             mesh::Reduction::largest);
  if (counts[0] > 0)
    _S = _numbering->matrix(_condensation->stiffness());
  if (counts[1] > 0 and not _is_transposed)
    _left = _numbering->matrix(left);
  if (counts[2] > 0)
    _law = _numbering->matrix(elimination.law());
  if (counts[3] > 0)
    _soft = _numbering->matrix(
        elastic(elimination, halo, elimination.springs(), {}));

  _chains = dependent_constraints(elimination, halo);
  _of_right = Chains::of(*_numbering, _chains.right, constrained());
  if (not _is_transposed)
  {
    std::vector<std::int32_t> recovered = elimination.recovered();
    std::ranges::sort(recovered);
    _of_left = Chains::of(*_numbering, _chains.left, recovered);
  }
  _bulk_diagonal = _algebra.diagonal(*_K);
  for (const std::int32_t dof : eliminated())
    // Coarse levels know nothing of the rows of eliminated displacements: what
    // they make of them must never come back as a residual
    _diagonal.push_back(math::weak_spring * std::abs(_bulk_diagonal[dof]));
  _some.resize(constrained().size());
  const std::size_t n = _numbering->num_owned();
  for (auto* work : {&_z, &_w, &_work})
    work->resize(n);
}

void CondensedOperator::multiply(std::span<const double> v, std::span<double> y,
                                 const Coupling& couple)
{
  expand(v, _z);
  multiply_bulk(_z, _w);
  if (couple)
    couple(_z, _w);
  combine(_w, y);
  add_law(_z, y, 1);
  if (_soft)
    add_product(*_soft, v, y);
  for (std::size_t i = 0; i < _diagonal.size(); ++i)
    y[eliminated()[i]] = _diagonal[i] * v[eliminated()[i]];
}

void CondensedOperator::multiply_bulk(std::span<const double> z,
                                      std::span<double> w)
{
  _algebra.multiply(*_K, z, w);
  if (_S)
    add_product(*_S, z, w);
  if (_springs)
    for (std::size_t i = 0; i < w.size(); ++i)
      w[i] += (*_springs)[i] * z[i];
}

void CondensedOperator::expand(std::span<const double> v, std::span<double> z)
{
  std::ranges::copy(v, z.begin());
  for (const std::int32_t dof : eliminated())
    z[dof] = 0;
  _algebra.multiply(*_right, z, _some);
  if (_of_right)
    _of_right->solve(_some);
  for (std::size_t i = 0; i < _some.size(); ++i)
    z[constrained()[i]] += _some[i];
}

void CondensedOperator::combine(std::span<const double> w, std::span<double> y)
{
  if (_is_transposed)
  {
    for (std::size_t i = 0; i < _some.size(); ++i)
      _some[i] = w[constrained()[i]];
    if (_of_right)
      _of_right->solve(_some, true);
    _algebra.multiply_transposed(*_right, _some, y);
  }
  else if (_left and _of_left)
  {
    std::ranges::copy(w, _work.begin());
    release(_work);
    _algebra.multiply(*_left, _work, y);
  }
  else if (_left)
    _algebra.multiply(*_left, w, y);
  else
    std::ranges::fill(y, 0);
  for (std::size_t i = 0; i < y.size(); ++i)
    y[i] += w[i];
  for (const std::int32_t dof : eliminated())
    y[dof] = 0;
}

void CondensedOperator::add_law(std::span<const double> z, std::span<double> y,
                                double sign)
{
  if (_law)
    add_product(*_law, z, y, sign);
}

void CondensedOperator::add_product(const Matrix& A, std::span<const double> x,
                                    std::span<double> y, double factor)
{
  _algebra.multiply(A, x, _work);
  for (std::size_t i = 0; i < y.size(); ++i)
    y[i] += factor * _work[i];
}

void CondensedOperator::place(std::span<double> values)
{
  if (_of_right)
    _of_right->solve_at(values);
}

void CondensedOperator::release(std::span<double> values)
{
  if (Chains* chains = _is_transposed ? _of_right.get() : _of_left.get())
    chains->solve_at(values, _is_transposed);
}

std::vector<double>
CondensedOperator::unknowns(std::span<const double> x,
                            std::span<const double> factors) const
{
  const std::size_t n = _numbering->num_owned();
  std::vector<double> v(x.begin(), x.begin() + std::ptrdiff_t(n));
  for (const std::int32_t dof : eliminated())
    v[dof] = 0;
  for (std::size_t i = 0; i < retained().dofs.size(); ++i)
  {
    const std::int32_t m = retained().multipliers[i];
    v[retained().dofs[i]] = x[n + m] * factors[m] / retained().scale[i];
  }
  return v;
}

std::span<const double> CondensedOperator::free_diagonal()
{
  if (_free_diagonal.empty())
  {
    _free_diagonal = _bulk_diagonal;
    const auto prescribed = _algebra.prescribed();
    for (std::size_t i = 0; i < _free_diagonal.size(); ++i)
      if (prescribed[i])
        _free_diagonal[i] = 0;
  }
  return _free_diagonal;
}

SoftAndStiff CondensedOperator::parts(const mesh::Bodies& bodies)
{
  const std::vector<std::int8_t> of_body
      = stiff_bodies(*_condensation, bodies, free_diagonal());
  const int g = _numbering->gdim();
  std::vector<std::int8_t> is_stiff(_numbering->num_owned());
  for (std::size_t i = 0; i < is_stiff.size(); ++i)
    is_stiff[i] = of_body[bodies.number()[i / g]];
  // Where multipliers may be, whose rows are constraints of their masters
  if (std::ranges::find(of_body, 1) != of_body.end())
  {
    const auto prescribed = _algebra.prescribed();
    for (const std::int32_t dof : slave_dofs())
      if (prescribed[dof])
        is_stiff[dof] = 1;
  }
  SoftAndStiff parts;
  for (std::size_t i = 0; i < is_stiff.size(); ++i)
    (is_stiff[i] ? parts.stiff : parts.soft)
        .push_back(static_cast<std::int32_t>(i));
  return parts;
}

double CondensedOperator::residual_weight(const mesh::Bodies& bodies,
                                          std::span<const double> residual)
{
  return condense::residual_weight(bodies, free_diagonal(), residual,
                                   _numbering->gdim());
}

std::vector<double>
CondensedOperator::master_springs(std::span<const double> stiffness) const
{
  return _numbering->reverse(
      condense::master_springs(*_condensation, _numbering->forward(stiffness)));
}

std::vector<double> CondensedOperator::areas() const
{
  const Triplets& traction = _condensation->traction();
  std::vector<double> areas(_numbering->num_local(), 0);
  for (std::size_t e = 0; e < traction.size(); ++e)
    areas[traction.rows[e]] += std::abs(traction.values[e]);
  areas.resize(_numbering->num_owned());
  return areas;
}

double CondensedOperator::reduction(std::span<const double> rhs,
                                    std::span<const double> v, double target)
{
  mesh::Ranks& ranks = _numbering->ranks();
  const double size = norm(ranks, rhs);
  double start = size;
  if (norm(ranks, v) > 0)
  {
    std::vector<double> residual(rhs.size());
    multiply(v, residual);
    for (std::size_t i = 0; i < rhs.size(); ++i)
      residual[i] -= rhs[i];
    start = norm(ranks, residual);
  }
  const double goal = std::max(target, math::round_off * size);
  return start > goal and goal > 0 ? std::max(1.0, std::log(start / goal)) : 1;
}

Transforms CondensedOperator::transforms() const
{
  const Elimination& elimination = _condensation->elimination();
  Transforms made;
  made.right = _numbering->matrix(elimination.right());
  if (_of_right)
    add_terms(_algebra, *made.right, *_numbering->matrix(_chains.right), false);
  Triplets left = elimination.left();
  left.join(elimination.rows());
  made.left = _numbering->matrix(left);
  if (_is_transposed ? _of_right != nullptr : _of_left != nullptr)
    add_terms(_algebra, *made.left, *_numbering->matrix(_chains.left), true);
  made.law = _numbering->matrix(elimination.law());
  made.stiffness = _numbering->matrix(_condensation->stiffness());
  made.springs = _numbering->matrix(elimination.springs());
  if (_springs)
    _algebra.add(*made.stiffness, 1,
                 *diagonal_matrix(_algebra, _numbering->ranks(), *_springs));
  return made;
}

ContactUpdate CondensedOperator::contact_update()
{
  ContactUpdate update;
  for (std::size_t i = 0, k = 0; i < slave_dofs().size(); ++i)
    if (k < constrained().size() and slave_dofs()[i] == constrained()[k])
    {
      update.places.push_back(static_cast<std::int32_t>(i));
      ++k;
    }
  const MatrixPtr rows = _algebra.bulk_rows(slave_dofs());
  std::vector<std::int64_t> chosen;
  for (const std::int32_t place : update.places)
    chosen.push_back(_algebra.layout(*rows).first_row + place);
  update.right = _right;
  update.chains = _of_right ? &_of_right->C() : nullptr;
  update.block
      = _algebra.submatrix(*rows, chosen, _numbering->numbers(constrained()));
  // The same on all ranks
  if (_springs or _soft)
  {
    Triplets soft = _condensation->elimination().springs();
    if (_soft)
      soft.join(_condensation->springs());
    update.springs = _numbering->matrix(
        elastic(_condensation->elimination(), _numbering->halo(), soft,
                _springs ? std::span<const double>(*_springs)
                         : std::span<const double>()));
  }
  update.bound = bound();
  return update;
}

std::vector<double> CondensedOperator::bound()
{
  std::vector<double> D = _bulk_diagonal;
  for (double& d : D)
    d = std::abs(d);
  D = condense::bound(_condensation->elimination(), _numbering->halo(), D);
  for (const MatrixPtr& added : {_S, _soft})
    if (added)
    {
      const std::vector<double> sums = _algebra.absolute_sums(*added);
      for (std::size_t i = 0; i < D.size(); ++i)
        D[i] += sums[i];
    }
  if (_springs)
    for (std::size_t i = 0; i < D.size(); ++i)
      D[i] += (*_springs)[i];
  for (std::size_t i = 0; i < _diagonal.size(); ++i)
    D[eliminated()[i]] = _diagonal[i];
  return D;
}
