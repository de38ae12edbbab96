// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#include "field_split.h"
#include "../../math/scales.h"
#include <algorithm>
#include <cmath>

using namespace contactx;
using namespace contactx::condense;

namespace
{
// Krylov vectors that are kept: with half of them iterations are a tenth more,
// with all of them a tenth less
constexpr int restart = 60;
} // namespace

void FieldSplitSolver::update(std::shared_ptr<CondensedOperator> K_c,
                              std::vector<std::size_t> offsets)
{
  _K_c = std::move(K_c);
  _offsets = std::move(offsets);
  const std::size_t n = _K_c->numbering().num_owned(), m = _offsets.back();
  if (not _gmres)
    _gmres = _algebra.flexible_gmres(
        n + m, [this](Span x, std::span<double> y) { multiply(x, y); },
        [this](Span r, std::span<double> z) { precondition(r, z); }, restart);
  _z.resize(n);
  _forces.resize(n);
  _rows.resize(m);
  _weights.assign(m, 1);
  _blocks = _algebra.field_blocks();
  _multigrid.prepare(_K_c);
  if (_updated_at != _algebra.assemblies())
    factorise();
}

void FieldSplitSolver::reset()
{
  _gmres.reset();
  _schur.reset();
  _blocks = {};
  _updated_at = -1;
}

std::vector<double> FieldSplitSolver::sizes(Span rhs)
{
  std::vector<double> v(rhs.size());
  _multigrid.cycle(rhs, v);
  _K_c->expand(v, _z);
  _algebra.multiply(*_blocks.fu, _z, _rows);
  std::vector<double> sums;
  for (std::size_t f = 0; f + 1 < _offsets.size(); ++f)
  {
    double sum = 0;
    for (std::size_t i = _offsets[f]; i < _offsets[f + 1]; ++i)
      sum += _rows[i] * _rows[i];
    sums.push_back(sum);
  }
  _K_c->numbering().ranks().reduce(std::span<double>(sums),
                                   mesh::Reduction::sum);
  for (double& sum : sums)
    sum = std::sqrt(sum);
  return sums;
}

bool FieldSplitSolver::solve(Span rhs, Span weights, std::span<double> x,
                             double target)
{
  mesh::Ranks& ranks = _K_c->numbering().ranks();
  for (std::size_t f = 0; f < weights.size(); ++f)
    std::fill(_weights.begin() + std::ptrdiff_t(_offsets[f]),
              _weights.begin() + std::ptrdiff_t(_offsets[f + 1]), weights[f]);
  std::vector<double> b(rhs.begin(), rhs.end());
  const std::size_t n = _z.size();
  for (std::size_t i = 0; i < _weights.size(); ++i)
    b[n + i] *= _weights[i];
  const double size = norm(ranks, b);
  const double goal = std::max(target, math::round_off * size);
  const double reduction
      = size > goal and goal > 0 ? std::max(1.0, std::log(size / goal)) : 1;
  const auto iterate = [&]
  {
    std::ranges::fill(x, 0);
    const Timing timing(_algebra, "Krylov");
    const Iterations done = _gmres->solve(
        b, x,
        [goal](int, double residual) -> std::optional<Iterations::End>
        {
          if (not std::isfinite(residual))
            return Iterations::End::failed;
          if (residual <= goal)
            return Iterations::End::converged;
          return std::nullopt;
        },
        20 + static_cast<int>(_tuning.slow_rate * reduction));
    _iterations += done.count;
    _multigrid.count(done.count, reduction);
    return done.converged();
  };
  return _multigrid.solve_with(_K_c, iterate);
}

void FieldSplitSolver::add_forces(Span f, double factor, std::span<double> w)
{
  _algebra.multiply(*_blocks.uf, f, _forces);
  for (std::size_t i = 0; i < w.size(); ++i)
    w[i] += factor * _forces[i];
}

std::vector<double> FieldSplitSolver::rows(Span u, Span f)
{
  std::vector<double> rows(f.size());
  _algebra.multiply(*_blocks.fu, u, rows);
  _algebra.multiply(*_blocks.ff, f, _rows);
  for (std::size_t i = 0; i < rows.size(); ++i)
    rows[i] += _rows[i];
  return rows;
}

void FieldSplitSolver::multiply(Span x, std::span<double> y)
{
  const std::size_t n = _z.size();
  const Span f = x.subspan(n);
  std::vector<double> rows;
  _K_c->multiply(x.first(n), y.first(n),
                 [&](Span z, std::span<double> w)
                 {
                   add_forces(f, 1, w);
                   rows = this->rows(z, f);
                 });
  for (std::size_t i = 0; i < rows.size(); ++i)
    y[n + i] = _weights[i] * rows[i];
}

/// Solves with the upper block triangle, M z = r.
void FieldSplitSolver::precondition(Span r, std::span<double> z)
{
  const std::size_t n = _z.size();
  const std::span<double> f = z.subspan(n);
  for (std::size_t i = 0; i < _rows.size(); ++i)
    _rows[i] = r[n + i] / _weights[i];
  _schur->solve(_rows, f);
  std::vector<double> left(n, 0), own(n);
  add_forces(f, -1, left);
  _K_c->combine(left, own);
  for (std::size_t i = 0; i < n; ++i)
    own[i] += r[i];
  _multigrid.cycle(own, z.first(n));
}

/// Factorises what stands for the Schur complement.
void FieldSplitSolver::factorise()
{
  const Timing timing(_algebra, "factorisation");
  _schur.reset();
  MatrixPtr S = _algebra.copy(*_blocks.ff);
  std::vector<double> diagonal;
  {
    std::vector<double> inverse = _algebra.diagonal(*_algebra.bulk());
    for (double& d : inverse)
      d = 1 / d;
    const MatrixPtr scaled = _algebra.copy(*_blocks.uf);
    _algebra.scale(*scaled, inverse, std::vector<double>(_rows.size(), 1));
    diagonal = _algebra.diagonal(*_algebra.product(*_blocks.fu, *scaled));
  }
  const std::vector<double> own = _algebra.diagonal(*S);
  for (std::size_t i = 0; i < own.size(); ++i)
    if (own[i] * diagonal[i] > 0)
      diagonal[i] = 0;
  const double c = mean_eigenvalue(diagonal);
  for (double& d : diagonal)
    d *= -c;
  _algebra.add(*S, 1,
               *diagonal_matrix(_algebra, _K_c->numbering().ranks(), diagonal));
  _schur = _algebra.factorise(std::move(S), {.name = "fields"});
  ++_factorisations;
  _updated_at = _algebra.assemblies();
}

/// Mean eigenvalue of K_fu K_c^-1 K_uf over the diagonal that stands for it: by
/// one vector of random signs (M. F. Hutchinson, Communications in Statistics
/// 19, 1990).
double FieldSplitSolver::mean_eigenvalue(Span diagonal)
{
  mesh::Ranks& ranks = _K_c->numbering().ranks();
  const std::size_t n = _z.size();
  const std::int64_t first = _algebra.layout(*_blocks.fu).first_row;
  std::vector<double> signs(diagonal.size(), 0);
  for (std::size_t i = 0; i < signs.size(); ++i)
    if (diagonal[i] != 0)
    {
      // Bits that look random, the same on any number of ranks
      const double phase = 1e4 * std::sin(double(first) + double(i));
      signs[i] = (phase - std::floor(phase) < 0.5 ? -1 : 1)
                 / std::sqrt(std::abs(diagonal[i]));
    }
  std::vector<double> forces(n, 0), rhs(n), v(n, 0);
  add_forces(signs, 1, forces);
  _K_c->combine(forces, rhs);
  _multigrid.solve_roughly(rhs, v);
  _K_c->expand(v, _z);
  _algebra.multiply(*_blocks.fu, _z, _rows);
  std::array sums{0.0, 0.0};
  for (std::size_t i = 0; i < signs.size(); ++i)
  {
    sums[0] += signs[i] * _rows[i];
    sums[1] += signs[i] * diagonal[i] * signs[i];
  }
  ranks.reduce(std::span<double>(sums), mesh::Reduction::sum);
  const double mean = sums[1] != 0 ? sums[0] / sums[1] : 0;
  return std::isfinite(mean) and mean > 0 ? mean : 1;
}
