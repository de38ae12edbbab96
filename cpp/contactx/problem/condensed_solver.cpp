// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#include "condensed_solver.h"
#include "../condense/contact_block.h"
#include <algorithm>

using namespace contactx;
using namespace contactx::problem;
using condense::CondensedOperator;

namespace
{
// Reasons, as reports say them
constexpr const char* slow_multigrid = "multigrid is slow here";
constexpr const char* by_option = "condensed_pc_type asks for it";
constexpr const char* retained_multipliers
    = "a slave node with a prescribed displacement moves its master";
// Residual of a predicted solution over the tolerance of a solve, up to which
// it is taken: Newton's method leaves as much
constexpr double max_predicted_residual = 300;
// Failures after which a solver is not tried again: what does not converge
// twice will not, and each attempt is dear
constexpr int max_failures = 2;

bool has_path(const solve::System& system)
{
  return std::ranges::any_of(system.contacts(), [](const auto& c)
                             { return c->history() != nullptr; });
}
} // namespace

CondensedSolver::CondensedSolver(Problem& problem,
                                 std::shared_ptr<condense::Algebra> algebra)
    : _problem(problem), _algebra(std::move(algebra)),
      _accuracy(has_path(*problem.system())), _multigrid(*_algebra, tuning),
      _soft_stiff(*_algebra, problem.bodies(), tuning),
      _field_split(*_algebra, _multigrid, tuning),
      _factorised(*_algebra, tuning)
{
}

void CondensedSolver::reset()
{
  _failures = _failures_before;
  _numbering.reset();
  _halo_version = -1;
  _predictor.reset();
  _multigrid.reset();
  _soft_stiff.reset();
  _field_split.reset();
  _factorised.reset();
  _accuracy.reset();
}

/// Brings it up to the problem's step and iterate.
void CondensedSolver::follow()
{
  if (_problem.restores() != _restores)
  {
    _restores = _problem.restores();
    reset();
  }
  if (_problem.starts() != _starts)
  {
    _starts = _problem.starts();
    _number = -1;
    _failures_before = _failures;
    std::vector<double> now(_problem.system()->size());
    _problem.system()->unknowns(now);
    _predictor.begin_step(std::move(now));
    _multigrid.begin_step();
    _soft_stiff.begin_step();
    _field_split.begin_step();
    _factorised.begin_step();
    _accuracy.begin_step();
    _statistics = {};
    _algebra->seconds.clear();
    _is_predicted = false;
  }
}

CondensedSolver::Statistics CondensedSolver::statistics()
{
  follow();
  Statistics found = _statistics;
  found.iterations = _multigrid.iterations() + _soft_stiff.iterations()
                     + _field_split.iterations() + _factorised.iterations();
  found.hierarchies = _multigrid.hierarchies();
  found.seconds = _algebra->seconds;
  found.factorised = _factorised.factorisations();
  found.factorisations = _soft_stiff.factorisations()
                         + _field_split.factorisations() + found.factorised;
  return found;
}

void CondensedSolver::solve(std::span<const double> b, std::span<double> x)
{
  follow();
  if (_problem.number() != _number)
  {
    _number = _problem.number();
    const solve::Loop& loop = _problem.loop();
    const solve::Iterate& now = loop.iterate();
    if (_is_predicted)
      _accuracy.skip();
    if (loop.path().is_on())
    {
      _accuracy.skip();
      _accuracy.set(now.tolerance, now.tolerance, 0, now.forces);
    }
    else
      _accuracy.set(now.residual, now.tolerance, loop.changing(), now.forces,
                    loop.active_set().cycles() > 0);
  }
  ++_statistics.solves;
  _is_predicted = false;
  if (_failures.bodies == max_failures)
    return solve_directly(b, x, slow_multigrid);
  try
  {
    if (not solve_condensed(b, x))
      solve_directly(b, x, slow_multigrid);
  }
  catch (const condense::NotCondensable& reason)
  {
    solve_directly(b, x, reason.what());
  }
}

/// What the norm of the residual of the next solve must fall below.
double CondensedSolver::target() const
{
  return (_accuracy.is_last() ? 1 : tuning.roughness) * _accuracy.target();
}

const condense::Springs& CondensedSolver::springs() const
{
  return _problem.loop().free_bodies().springs();
}

/// Eliminates the multipliers.
std::shared_ptr<CondensedOperator> CondensedSolver::condensed(Spans b)
{
  const condense::Timing timing(*_algebra, "condensation");
  const solve::System& system = *_problem.system();
  const mesh::Halo& halo = *system.halo();
  if (_halo_version != halo.version())
  {
    _halo_version = halo.version();
    _numbering = std::make_shared<condense::Numbering>(halo, *_algebra);
  }
  const std::vector<std::int8_t> prescribed = system.markers();
  std::vector<std::int8_t> free;
  for (const std::int8_t p : prescribed)
    free.push_back(p == 0);
  std::vector<condense::Nodes> nodes;
  for (const auto& contact : system.contacts())
    nodes.push_back(condense::nodes_of(*contact));
  std::shared_ptr<const condense::Condensation> made;
  _algebra->update_bulk();
  const std::vector<double> diagonal = _algebra->diagonal(*_algebra->bulk());
  try
  {
    halo.ranks().agree(
        [&]
        {
          const condense::ContactBlock block(system.contacts(), prescribed,
                                             false,
                                             b.subspan(system.num_bulk()));
          made = std::make_shared<condense::Condensation>(
              block.entries(), nodes, free, halo.gdim(), diagonal, true);
        });
  }
  catch (const std::runtime_error& reason)
  {
    // Other ranks than the one that has found it have no more than its words
    throw condense::NotCondensable(reason.what());
  }
  _condensation = made;
  return std::make_shared<CondensedOperator>(_numbering, std::move(made),
                                             springs());
}

bool CondensedSolver::solve_condensed(Spans b, std::span<double> x)
{
  solve::Fields* fields = _problem.system()->bulk()->fields();
  const std::shared_ptr<CondensedOperator> K_c = condensed(b);
  const condense::Condensation& condensation = *_condensation;
  const solve::System& system = *_problem.system();
  const bool is_retained
      = mesh::anywhere(_numbering->ranks(), not K_c->retained().dofs.empty());
  if (fields and is_retained)
    throw condense::NotCondensable(retained_multipliers);
  // Displacements, then other fields
  const std::size_t n = _numbering->num_owned(), num_bulk = system.num_bulk();
  const Spans given = b.first(n), constraints = b.subspan(num_bulk);
  const auto prescribed = _algebra->prescribed();
  if (fields)
    _field_split.update(K_c, fields->offsets());

  auto right = condensation.right_hand_side(constraints);
  std::vector<double> w = _numbering->reverse(std::move(right.forces));
  const std::vector<double> preload
      = _numbering->reverse(std::move(right.preload));
  for (std::size_t i = 0; i < n; ++i)
    w[i] += given[i];
  for (std::size_t i = 0; i < K_c->retained().dofs.size(); ++i)
    w[K_c->retained().dofs[i]] = right.retained[i];
  std::vector<double> balance = w, h(right.shift.begin(),
                                     right.shift.begin() + std::ptrdiff_t(n));
  K_c->place(h);
  std::vector<double> work(n), rhs(num_bulk), v(num_bulk, 0);
  K_c->multiply_bulk(h, work);
  for (std::size_t i = 0; i < n; ++i)
    w[i] -= work[i];
  const std::span<double> of_displacements = std::span(rhs).first(n);
  K_c->combine(w, of_displacements);
  K_c->add_law(h, of_displacements, -1);
  for (std::size_t i = 0; i < n; ++i)
    rhs[i] += right.extra[i] + preload[i];
  for (const std::int32_t dof : K_c->eliminated())
    rhs[dof] = 0;
  if (fields)
  {
    const std::vector<double> rows = _field_split.rows(h, Spans(v).subspan(n));
    for (std::size_t i = n; i < num_bulk; ++i)
      rhs[i] = b[i] - rows[i - n];
  }
  else if (auto predicted = _predictor.start(*K_c, system.factors(), b, rhs, v,
                                             max_predicted_residual * target()))
  {
    _is_predicted = true;
    std::ranges::copy(*predicted, x.begin());
    return true;
  }
  double target = this->target();
  if (not _accuracy.is_last())
  {
    // A small part of what loads a stiff body is much for a soft one
    const double weight = K_c->residual_weight(*_problem.bodies(), given);
    target *= std::min(1., weight);
  }
  // Newton's residual may be far larger than what is left of it here
  target = std::min(target, condense::one_digit
                                * condense::norm(_numbering->ranks(), rhs));
  if (not(fields ? iterate_with_fields(rhs, v, target)
                 : iterate(K_c, is_retained, rhs, v, target)))
    return false;
  const Spans moved = Spans(v).first(n), others = Spans(v).subspan(n);
  K_c->expand(moved, work);
  for (std::size_t i = 0; i < n; ++i)
    h[i] += work[i];
  K_c->multiply_bulk(h, work);
  if (fields)
    _field_split.add_forces(others, 1, work);
  for (std::size_t i = 0; i < n; ++i)
    balance[i] -= work[i];
  K_c->release(balance);
  condensation.recover(constraints, balance, _numbering->forward(h),
                       right.multipliers);
  for (std::size_t i = 0; i < n; ++i)
    x[i] = prescribed[i] ? given[i] : h[i];
  std::ranges::copy(others, x.begin() + std::ptrdiff_t(n));
  for (std::size_t i = 0; i < right.multipliers.size(); ++i)
    x[num_bulk + i] = right.multipliers[i] / system.factors()[i];
  return true;
}

/// Solves with other fields; whether iterations converged.
bool CondensedSolver::iterate_with_fields(Spans rhs, std::span<double> x,
                                          double target)
{
  solve::Loop& loop = _problem.loop();
  const std::vector<double> weights = loop.convergence().weights_of_fields(
      _field_split.sizes(rhs.first(_numbering->num_owned())),
      loop.iterate().residual);
  if (_field_split.solve(rhs, weights, x, target))
    return true;
  ++_failures.bodies;
  return false;
}

/// Solves the condensed system, by multigrid where it is fast; whether
/// iterations converged.
bool CondensedSolver::iterate(std::shared_ptr<CondensedOperator> K_c,
                              bool is_retained, Spans rhs, std::span<double> v,
                              double target)
{
  const bool is_asked = _algebra->preconditioner() == "bodies";
  const auto is_mixed = [&] { return _soft_stiff.tells_apart(*K_c); };
  const auto is_proven = [&] { return _multigrid_serves or not is_mixed(); };
  if (not is_asked and _failures.multigrid < max_failures
      and (not is_retained
           or (_failures.retained < max_failures and is_proven())))
  {
    // Where bodies can be told apart the other solver is fast, and where
    // multipliers are left multigrid may be slow: one slow solve tells enough,
    // and in its first digit
    const bool is_sure = not is_retained and is_proven();
    if ((is_sure or not is_slow(K_c, rhs, v))
        and _multigrid.solve(K_c, rhs, v, target))
    {
      _multigrid_serves = _multigrid_serves or not is_retained;
      return true;
    }
    if (is_retained)
      ++_failures.retained;
    else
      _failures.multigrid += is_mixed() ? max_failures : 1;
  }
  const bool is_solved = _soft_stiff.solve(K_c, rhs, v, target);
  if (is_solved)
    _statistics.by_bodies.push_back(is_retained ? retained_multipliers
                                    : is_asked  ? by_option
                                                : slow_multigrid);
  else
    ++_failures.bodies;
  return is_solved;
}

/// Whether multigrid is slow in the first digit, which it gives else.
bool CondensedSolver::is_slow(std::shared_ptr<CondensedOperator> K_c, Spans rhs,
                              std::span<double> v)
{
  std::vector<double> found(v.begin(), v.end());
  _multigrid.prepare(std::move(K_c));
  if (_multigrid.solve_roughly(rhs, found))
  {
    std::ranges::copy(found, v.begin());
    return false;
  }
  _multigrid.reset();
  return true;
}

void CondensedSolver::solve_directly(Spans b, std::span<double> x,
                                     std::string reason)
{
  _statistics.direct.push_back(std::move(reason));
  // With factors one more digit costs nothing
  const double target = (_accuracy.is_last() ? 0.1 : 1.0) * this->target();
  _factorised.solve(b, x, target, springs(), _accuracy.is_last());
}

void CondensedSolver::multiply(std::span<const double> x, std::span<double> y)
{
  const solve::System& system = *_problem.system();
  const condense::ContactBlock block(system.contacts(), system.markers());
  system.multiply(block, x, y);
  const std::size_t n = system.num_displacements();
  _algebra->update_bulk();
  std::vector<double> w(n);
  _algebra->multiply(*_algebra->bulk(), x.first(n), w);
  if (system.bulk()->fields())
  {
    const std::size_t m = system.num_bulk() - n;
    const condense::FieldBlocks blocks = _algebra->field_blocks();
    std::vector<double> forces(n), rows(m);
    _algebra->multiply(*blocks.uf, x.subspan(n, m), forces);
    std::ranges::transform(forces, w, w.begin(), std::plus());
    for (const auto& [A, of] : {std::pair(blocks.fu, x.first(n)),
                                std::pair(blocks.ff, x.subspan(n, m))})
    {
      _algebra->multiply(*A, of, rows);
      for (std::size_t i = 0; i < m; ++i)
        y[n + i] += rows[i];
    }
  }
  for (std::size_t i = 0; i < n; ++i)
    y[i] += w[i];
  if (const condense::Springs& own = springs())
    for (std::size_t i = 0; i < n; ++i)
      y[i] += (*own)[i] * x[i];
}
