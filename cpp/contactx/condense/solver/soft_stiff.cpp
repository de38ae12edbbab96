// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#include "soft_stiff.h"
#include "../../math/scales.h"
#include <algorithm>
#include <cmath>

using namespace contactx;
using namespace contactx::condense;

namespace
{
// Krylov vectors, and iterations after which a solve is given up
constexpr int restart = 120;
// Number of last Krylov iterations by whose mean reduction the remaining ones
// are estimated
constexpr int rate_window = 10;
// Displacement under a uniform traction, as a fraction of the largest one, that
// a spring's stiffness is limited to
constexpr double min_moved_fraction = 0.1;
} // namespace

bool BlockFactors::update(MatrixPtr change,
                          const std::function<MatrixPtr()>& make,
                          bool is_symmetric, int group, double max_change)
{
  if (_change)
  {
    const MatrixPtr difference = _algebra.copy(*change);
    _algebra.add(*difference, -1, *_change);
    const double size = _algebra.norm(*change);
    const double other = _algebra.norm(*difference);
    // One node that slips where it stuck makes more, and costs iterations
    _is_old = other > math::negligible_part * size;
    if (other <= std::max(max_change, math::negligible_part) * size)
      return false;
  }
  _is_old = false;
  // Factors are the largest part of the memory: those of before go first
  drop();
  MatrixPtr A;
  {
    const Timing timing(_algebra, "condensation");
    A = make();
    const std::size_t n = _algebra.layout(*A).num_rows;
    _b.assign(n, 0);
    _x.assign(n, 0);
  }
  const Timing timing(_algebra, "factorisation");
  _factors = _algebra.factorise(
      std::move(A),
      {.name = _name, .is_symmetric = is_symmetric, .group = group});
  _change = std::move(change);
  return true;
}

void BlockFactors::drop()
{
  _factors.reset();
  _change.reset();
}

void BlockFactors::solve(std::span<const double> values,
                         std::span<double> found)
{
  const std::vector<std::int32_t>& dofs = part.dofs();
  for (std::size_t i = 0; i < dofs.size(); ++i)
    _b[i] = values[dofs[i]];
  _factors->solve(_b, _x);
  for (std::size_t i = 0; i < dofs.size(); ++i)
    found[dofs[i]] = _x[i];
}

bool SoftStiffSolver::tells_apart(CondensedOperator& K_c) const
{
  return mesh::anywhere(K_c.numbering().ranks(),
                        not K_c.parts(*_bodies).stiff.empty());
}

void SoftStiffSolver::reset()
{
  _gmres.reset();
  _model.reset();
  _soft.reset();
  _stiff.reset();
  _per_area.reset();
  _updated_for.reset();
  _built_at = -1;
  _renewal = 0;
  _lost = _rate = 0;
}

int SoftStiffSolver::num_old() const
{
  return int(_soft->is_old()) + int(_stiff and _stiff->is_old());
}

bool SoftStiffSolver::solve(std::shared_ptr<CondensedOperator> K_c,
                            std::span<const double> rhs, std::span<double> v,
                            double target)
{
  _K_c = std::move(K_c);
  double reduction = _K_c->reduction(rhs, v, target);
  if (_updated_for != _K_c)
    update(reduction);
  while (not iterate(rhs, v, target, reduction))
  {
    // What the iterations have reached is a start for those that follow
    reduction = _K_c->reduction(rhs, v, target);
    if (_renewal == 0)
    {
      if (not _stiff or _has_model)
      {
        reset();
        std::ranges::fill(v, 0);
        return false;
      }
      _has_model = true;
      _stiff->drop();
      _rate = 0;
    }
    update(std::nullopt);
  }
  return true;
}

bool SoftStiffSolver::iterate(std::span<const double> rhs, std::span<double> v,
                              double target, double reduction)
{
  mesh::Ranks& ranks = _K_c->numbering().ranks();
  using End = Iterations::End;
  const double goal = std::max(target, math::round_off * norm(ranks, rhs));
  const double otherwise = _renewal + _rate * reduction;
  std::vector<double> residuals;
  // With old factors iterations end where those that are left by their last
  // ones are more than new factors cost and take: what is left then are the
  // slow parts
  const auto test = [&](int count, double residual) -> std::optional<End>
  {
    if (not std::isfinite(residual))
      return End::failed;
    if (residual <= goal)
      return End::converged;
    residuals.push_back(residual);
    if (_renewal > 0 and count >= rate_window)
    {
      const double left = std::log(residual / goal);
      const double reached
          = std::log(residuals[residuals.size() - 1 - rate_window] / residual)
            / rate_window;
      if (left > reached * otherwise)
        return End::failed;
    }
    return std::nullopt;
  };
  const int most = _stiff and not _model ? _tuning.max_iterations : restart;
  Iterations done;
  {
    const Timing timing(_algebra, "Krylov");
    done = _gmres->solve(rhs, v, test, most);
  }
  _iterations += done.count;
  if (done.converged())
  {
    if (_renewal == 0)
    {
      const double rate = done.count / reduction;
      _rate = _rate > 0 ? (_rate + rate) / 2 : rate;
    }
    else
      _lost += std::max(0.0, done.count - _rate * reduction);
    return true;
  }
  if (not std::isfinite(norm(ranks, v)))
    std::ranges::fill(v, 0);
  return false;
}

void SoftStiffSolver::update(std::optional<double> reduction)
{
  // Vectors of the iterations before go first: factors are made where memory is
  // fullest
  _gmres.reset();
  BlockChange change;
  std::optional<Transforms> transforms;
  {
    const Timing timing(_algebra, "condensation");
    transforms = _K_c->transforms();
    split();
    change = _soft->part.change(*transforms);
  }
  const bool keeps = reduction and _lost <= _renewal;
  const DofBlock& part = _soft->part;
  _factorisations += _soft->update(
      change.added,
      [&] { return part.with(*change.added, _K_c->eliminated()); },
      change.is_symmetric and _algebra.is_symmetric(), part.group(),
      keeps ? _tuning.max_change / *reduction : 0);
  if (_stiff)
    _factorisations += update_stiff(
        *transforms, keeps ? _tuning.max_change / *reduction : 0);
  _renewal = _tuning.renewal_cost * num_old();
  if (_renewal == 0)
    _lost = 0;
  _updated_for = _K_c;
  _work.resize(_K_c->numbering().num_owned());
  _gmres = _algebra.flexible_gmres(
      _work.size(), [this](std::span<const double> x, std::span<double> y)
      { _K_c->multiply(x, y); },
      [this](std::span<const double> r, std::span<double> z)
      { precondition(r, z); }, restart);
}

bool SoftStiffSolver::update_stiff(const Transforms& transforms,
                                   double max_change)
{
  const DofBlock& part = _stiff->part;
  BlockChange change;
  {
    const Timing timing(_algebra, "condensation");
    change = part.change(transforms);
    if (_has_model and not _model)
      _model = CoarseModel::of(*_numbering, _soft->part, _K_c->slave_dofs());
    if (not _model)
    {
      const std::vector<double> all = springs();
      std::vector<double> own;
      for (const std::int32_t dof : part.dofs())
        own.push_back(all[dof]);
      _algebra.add(*change.added, 1,
                   *diagonal_matrix(_algebra, _K_c->numbering().ranks(), own));
    }
  }
  const auto make = [&]
  {
    MatrixPtr A = part.with(*change.added, _K_c->eliminated());
    return _model ? _model->block(std::move(A), *transforms.right, part,
                                  _K_c->eliminated())
                  : A;
  };
  return _stiff->update(
      change.added, make, change.is_symmetric and _algebra.is_symmetric(),
      _model ? std::min(part.group(), _model->group()) : part.group(),
      max_change);
}

void SoftStiffSolver::split()
{
  SoftAndStiff dofs = _K_c->parts(*_bodies);
  mesh::Ranks& ranks = _K_c->numbering().ranks();
  if (not mesh::everywhere(ranks, _soft and dofs.soft == _soft->part.dofs()))
    _per_area.reset();
  else if (_built_at == _algebra.assemblies())
    return;
  _model.reset();
  _soft.reset();
  _stiff.reset();
  _numbering = _K_c->shared_numbering();
  const MatrixPtr K = _algebra.bulk_copy();
  const bool has_stiff = mesh::anywhere(ranks, not dofs.stiff.empty());
  _soft = std::make_unique<BlockFactors>(
      _algebra, DofBlock(*_numbering, std::move(dofs.soft), *K), "bodies_soft");
  if (has_stiff)
    _stiff = std::make_unique<BlockFactors>(
        _algebra, DofBlock(*_numbering, std::move(dofs.stiff), *K),
        "bodies_stiff");
  _built_at = _algebra.assemblies();
}

/// Springs that stand for soft bodies at their masters (shape=(num_owned)).
std::vector<double> SoftStiffSolver::springs()
{
  if (not _per_area)
  {
    const Timing timing(_algebra, "factorisation");
    _per_area = stiffness_per_area();
  }
  return _K_c->master_springs(*_per_area);
}

/// Stiffness of soft bodies for each unit of area, between that of long and
/// short waves: zero in stiff bodies and where it is not known
/// (shape=(num_owned)).
std::vector<double> SoftStiffSolver::stiffness_per_area()
{
  const Numbering& numbering = _K_c->numbering();
  mesh::Ranks& ranks = numbering.ranks();
  const int g = numbering.gdim();
  const DofBlock& part = _soft->part;
  const std::vector<std::int32_t>& dofs = part.dofs();
  const std::vector<double> every = _K_c->areas(), diagonal = part.diagonal();
  std::vector<double> areas;
  const auto prescribed = _algebra.prescribed();
  std::array closed{0.0, 0.0};
  for (std::size_t i = 0; i < dofs.size(); ++i)
  {
    const std::int32_t dof = dofs[i];
    areas.push_back(prescribed[dof] ? 0 : every[dof]);
    if (areas.back() > 0)
      closed[0] += diagonal[i];
    closed[1] += areas.back();
  }
  ranks.reduce(std::span<double>(closed), mesh::Reduction::sum);
  const double shortest = closed[1] > 0 ? closed[0] / closed[1] : 0;
  const std::unique_ptr<Factors> factors = _algebra.factorise(
      _algebra.copy(part.K()), {.name = "bodies_soft",
                                .is_symmetric = _algebra.is_symmetric(),
                                .group = part.group()});
  std::vector<double> stiffness(numbering.num_owned(), 0);
  std::vector<double> f(dofs.size()), u(dofs.size());
  for (int axis = 0; axis < g; ++axis)
  {
    for (std::size_t i = 0; i < dofs.size(); ++i)
      f[i] = dofs[i] % g == axis ? areas[i] : 0;
    factors->solve(f, u);
    double most = 0;
    for (std::size_t i = 0; i < dofs.size(); ++i)
      if (dofs[i] % g == axis and std::isfinite(u[i]))
        most = std::max(most, u[i]);
    most = mesh::largest(ranks, most);
    for (std::size_t i = 0; i < dofs.size(); ++i)
      if (dofs[i] % g == axis and std::isfinite(u[i]) and u[i] > 0)
      {
        // Near supports no traction moves much, though short waves are no
        // stiffer there
        const double longest = 1 / std::max(u[i], min_moved_fraction * most);
        stiffness[dofs[i]] = std::pow(longest, 1 - _tuning.short_wave_exponent)
                             * std::pow(std::max(shortest, longest),
                                        _tuning.short_wave_exponent);
      }
  }
  return stiffness;
}

/// Solves M z = r.
void SoftStiffSolver::precondition(std::span<const double> r,
                                   std::span<double> z)
{
  std::ranges::fill(z, 0);
  if (not _stiff)
  {
    _soft->solve(r, z);
    return;
  }
  _stiff->solve(r, z);
  _K_c->multiply(z, _work);
  for (std::size_t i = 0; i < _work.size(); ++i)
    _work[i] = r[i] - _work[i];
  _soft->solve(_work, z);
}
