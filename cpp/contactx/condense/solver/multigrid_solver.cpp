// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#include "multigrid_solver.h"
#include <algorithm>
#include <cmath>

using namespace contactx;
using namespace contactx::condense;

std::vector<std::vector<double>>
contactx::condense::rigid_modes(mesh::Ranks& ranks, std::span<const double> x,
                                std::span<const std::int8_t> prescribed,
                                int gdim)
{
  // About the origin of a far body rotations are all but translations, and lost
  // in round-off
  std::vector<double> middle(gdim + 1, 0);
  for (std::size_t i = 0; i < x.size(); ++i)
    middle[i % gdim] += x[i];
  middle[gdim] = static_cast<double>(x.size()) / gdim;
  ranks.reduce(std::span<double>(middle), mesh::Reduction::sum);

  std::vector<std::vector<double>> modes;
  const auto free = [&](std::size_t i) { return prescribed[i] ? 0.0 : 1.0; };
  for (int k = 0; k < gdim; ++k)
  {
    auto& mode = modes.emplace_back(x.size(), 0);
    for (std::size_t i = k; i < x.size(); i += gdim)
      mode[i] = free(i);
  }
  for (int axis = 0; axis < (gdim == 2 ? 1 : 3); ++axis)
  {
    // Rotations in the planes (0, 1), (1, 2) and (0, 2)
    const int a = axis % 2, b = std::min(axis + 1, 2);
    auto& mode = modes.emplace_back(x.size(), 0);
    for (std::size_t i = 0; i < x.size(); i += gdim)
    {
      mode[i + a] = free(i + a) * (middle[b] / middle[gdim] - x[i + b]);
      mode[i + b] = free(i + b) * (x[i + a] - middle[a] / middle[gdim]);
    }
  }
  for (auto& mode : modes)
    if (const double size = norm(ranks, mode); size > 0)
      for (double& value : mode)
        value /= size;
  return modes;
}

bool MultigridSolver::solve(std::shared_ptr<CondensedOperator> K_c,
                            std::span<const double> rhs, std::span<double> v,
                            double target)
{
  return solve_with(std::move(K_c), [&] { return iterate(rhs, v, target); });
}

void MultigridSolver::prepare(std::shared_ptr<CondensedOperator> K_c)
{
  _K_c = std::move(K_c);
  if (_lost > _tuning.renewal_cost)
    reset();
  if (not _hierarchy)
    build();
  if (_updated_for != _K_c)
  {
    const ContactUpdate change = _K_c->contact_update();
    _serves = _galerkin->serves(change, _tuning.max_change);
    update(change, not _serves);
  }
}

bool MultigridSolver::solve_with(std::shared_ptr<CondensedOperator> K_c,
                                 const std::function<bool()>& iterate)
{
  prepare(std::move(K_c));
  if (iterate())
    return true;
  if (_serves)
  {
    _serves = false;
    update(_K_c->contact_update(), true);
    if (iterate())
      return true;
  }
  if (_built_at != _algebra.assemblies())
  {
    build();
    update(_K_c->contact_update(), true);
    if (iterate())
      return true;
  }
  reset();
  return false;
}

bool MultigridSolver::solve_roughly(std::span<const double> rhs,
                                    std::span<double> v)
{
  const double size = norm(_K_c->numbering().ranks(), rhs);
  const int most = static_cast<int>(_tuning.slow_rate * -std::log(one_digit));
  const Iterations done
      = run(rhs, v, _K_c->is_symmetric(), one_digit * size, most);
  if (done.end == Iterations::End::indefinite)
    std::ranges::fill(v, 0);
  return done.end != Iterations::End::failed;
}

void MultigridSolver::reset()
{
  _hierarchy.reset();
  _galerkin.reset();
  _updated_for.reset();
}

bool MultigridSolver::iterate(std::span<const double> rhs, std::span<double> v,
                              double target)
{
  const double reduction = _K_c->reduction(rhs, v, target);
  const int most = 20 + static_cast<int>(_tuning.slow_rate * reduction);
  // Pressures on turning normals and bodies without support may leave a matrix
  // indefinite
  for (bool symmetric = _K_c->is_symmetric();; symmetric = false)
  {
    const Iterations done = run(rhs, v, symmetric, target, most);
    count(done.count, reduction);
    if (done.converged())
      return true;
    std::ranges::fill(v, 0);
    if (not symmetric or done.end != Iterations::End::indefinite)
      return false;
  }
}

Iterations MultigridSolver::run(std::span<const double> rhs,
                                std::span<double> v, bool is_symmetric,
                                double target, int most)
{
  const Timing timing(_algebra, "Krylov");
  const Iterations done = _hierarchy->solve(rhs, v, is_symmetric, target, most);
  _iterations += done.count;
  return done;
}

void MultigridSolver::count(int iterations, double reduction)
{
  if (_built_at == _algebra.assemblies())
    _rate = std::max(_rate, iterations / reduction);
  else
    _lost += std::max(0.0, iterations - _rate * reduction);
}

void MultigridSolver::build()
{
  const Timing timing(_algebra, "hierarchy");
  reset();
  const Numbering& numbering = _K_c->numbering();
  const int g = numbering.gdim();
  // Before the bulk is lent, of which a host may keep half then
  MatrixPtr rows = _algebra.bulk_rows(_K_c->slave_dofs());
  // Rows of prescribed displacements have a one and no neighbours
  _hierarchy = _algebra.hierarchy(
      _algebra.lent_bulk(),
      rigid_modes(numbering.ranks(),
                  numbering.halo().reference().first(numbering.num_owned()),
                  _algebra.prescribed(), g),
      g, [this](std::span<const double> v, std::span<double> y)
      { _K_c->multiply(v, y); });
  _galerkin = std::make_unique<Galerkin>(numbering, std::move(rows),
                                         _hierarchy->prolongations());
  _built_at = _algebra.assemblies();
  _rate = _lost = 0;
  ++_hierarchies;
}

void MultigridSolver::update(const ContactUpdate& change, bool coarse)
{
  const Timing timing(_algebra, "condensation");
  _updated_for = _K_c;
  _hierarchy->set_diagonal(change.bound);
  if (not coarse or _hierarchy->matrices().empty())
    return;
  _galerkin->update(change, _hierarchy->matrices());
  _hierarchy->update();
}
