// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#include "problem.h"
#include "../check.h"
#include "../law/law.h"
#include "../mesh/extent.h"
#include "../mesh/found_nodes.h"
#include "../solve/derivative_check.h"
#include "../solve/not_finite.h"
#include "../text.h"
#include "messages.h"
#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <numbers>
#include <stdexcept>
#include <utility>

using namespace contactx;
using namespace contactx::problem;
using solve::Verdict;

namespace
{
constexpr std::array<std::string_view, 8> calls{
    "begin_step", "settle", "residual", "jacobian",
    "set_up",     "limit",  "update",   "accept"};
/// Largest number of arguments of a call
constexpr std::size_t max_numbers = 3;
/// Successive iterates whose residual of the bulk stagnates, and the ratio of
/// the largest of their residuals to the smallest
constexpr std::size_t stagnant_iterates = 4;
constexpr double stagnant_residual_ratio = 4;

/// Adds the wall time of a scope to a part of a report.
class Timer
{
public:
  Timer(Report& report, const char* part)
      : _seconds(report.seconds[part]), _start(Clock::now())
  {
  }
  ~Timer()
  {
    _seconds += std::chrono::duration<double>(Clock::now() - _start).count();
  }
  Timer(const Timer&) = delete;
  Timer& operator=(const Timer&) = delete;

private:
  using Clock = std::chrono::steady_clock;
  double& _seconds;
  Clock::time_point _start;
};

std::string join(const std::vector<std::string>& texts, const char* between)
{
  std::string all;
  for (const std::string& text : texts)
    all += (all.empty() ? "" : between) + text;
  return all;
}
} // namespace

Problem::Problem(std::shared_ptr<solve::System> system,
                 std::shared_ptr<const mesh::Bodies> bodies,
                 std::vector<Part> parts, bool refuses)
    : _system(std::move(system)), _halo(_system->halo()),
      _bodies(std::move(bodies)), _parts(std::move(parts)), _refuses(refuses),
      _loop(_system, _bodies),
      _size(std::ranges::max(
          mesh::extent(_halo->ranks(),
                       _halo->reference().first(_system->num_displacements()),
                       _halo->gdim())))
{
  if (_parts.size() != _system->contacts().size())
    throw std::invalid_argument("there must be a part for each contact");
  // The audit needs the offsets
  read_values();
  _audit.emplace(_halo, _system->contacts());
}

void Problem::enter(std::string_view call,
                    const std::vector<std::pair<std::string, double>>& numbers)
{
  const auto which = std::ranges::find(calls, call) - calls.begin();
  std::array<double, 1 + max_numbers> mine{static_cast<double>(which)};
  for (std::size_t k = 0; k < numbers.size(); ++k)
    mine.at(1 + k) = numbers[k].second;
  const auto all = mesh::gathered<double>(_halo->ranks(), mine);
  const auto of = [&](std::size_t rank, std::size_t k)
  { return all[rank * mine.size() + k]; };
  const std::size_t ranks = all.size() / mine.size();
  const auto differ = [&](std::size_t k)
  {
    // NaN is unlike itself
    for (std::size_t r = 1; r < ranks; ++r)
      if (of(r, k) != of(0, k)
          and not(std::isnan(of(r, k)) and std::isnan(of(0, k))))
        return true;
    return false;
  };
  const auto each = [&](const auto& text)
  {
    std::vector<std::string> texts;
    for (std::size_t r = 0; r < ranks; ++r)
      texts.push_back(text(r));
    return join(texts, ", ");
  };
  if (differ(0))
    throw std::logic_error(
        "all ranks must call the same method of a ContactAssembler: "
        + each(
            [&](std::size_t r)
            {
              const auto theirs = static_cast<std::size_t>(of(r, 0));
              return std::string(calls.at(theirs)) + "() on rank "
                     + std::to_string(r);
            }));
  const std::string name = std::string(call) + "()";
  for (std::size_t k = 0; k < numbers.size(); ++k)
    if (differ(1 + k))
      throw std::invalid_argument(
          numbers[k].first + " of " + name + " differs between ranks, "
          + each([&](std::size_t r) { return exact_text(of(r, 1 + k)); })
          + ": give the same on all");
  if (call != "begin_step" and not _has_begun)
    throw std::logic_error(name
                           + " before begin_step(): no step has begun, call "
                             "begin_step() first");
  const bool needs_settled
      = call == "set_up" or call == "limit" or call == "accept";
  if (needs_settled and (_has_moved or not _found))
    throw std::logic_error(name
                           + " before settle(): pairs and active set are not "
                             "those of the iterate, call settle() first");
  if (call == "accept" and not converged())
    throw std::logic_error("accept() of an iterate that is no solution: go on "
                           "until settle() says converged, or restore()");
}

void Problem::begin_step()
{
  enter("begin_step");
  prepare();
  try
  {
    start();
  }
  catch (...)
  {
    restore();
    throw;
  }
}

void Problem::solve(LinearSolver& solver, const Tolerances& tolerances)
{
  prepare();
  std::string reason;
  int discarded = 0;
  try
  {
    const bool converged = attempt(
        [&](bool damped)
        {
          start(damped);
          _report.discarded = discarded;
          const bool found = iterate(solver, tolerances);
          discarded += _number;
          return found ? Outcome::converged : Outcome::failed;
        });
    if (not converged)
      reason = _found->failure;
  }
  catch (const solve::NotFinite& error)
  {
    reason = error.what();
  }
  catch (const check::Undefined& error)
  {
    // Where the step starts it is no fault of an iterate
    reason = error.what();
    if (not _has_begun)
    {
      restore();
      throw;
    }
  }
  catch (...)
  {
    restore();
    throw;
  }
  summarise();
  if (not reason.empty())
  {
    restore();
    throw ConvergenceError(reason);
  }
  accept();
}

void Problem::advance(StepPlan& plan, const std::function<void(double)>& update,
                      LinearSolver& solver, const Tolerances& tolerances,
                      const StepLog& log)
{
  const Snapshot before = snapshot();
  StepPlan attempted = plan;
  int discarded = 0, attempt = 0;
  auto begin = std::chrono::steady_clock::now();
  const auto set = [&](double t) { _halo->ranks().agree([&] { update(t); }); };
  const auto note = [&](double t, const std::string& failure)
  {
    if (not log)
      return;
    const auto now = std::chrono::steady_clock::now();
    AttemptRecord record = this->record(failure);
    record.attempt = ++attempt;
    record.start = plan.t();
    record.end = t;
    record.seconds
        = std::chrono::duration<double>(now - std::exchange(begin, now))
              .count();
    _halo->ranks().agree([&] { log(record); });
  };
  // Loads of the last accepted step; what is said where that fails, too
  const auto set_back = [&]() -> std::string
  {
    try
    {
      set(plan.t());
      return "";
    }
    catch (const std::exception& error)
    {
      return ". Setting the loads of t = " + number_text(plan.t(), 6)
             + " again failed: " + error.what();
    }
  };
  while (true)
  {
    const double t = attempted.next();
    bool is_set = false;
    try
    {
      set(t);
      set_attempt(attempted.attempt());
      is_set = true;
      solve(solver, tolerances);
      note(t, "");
      break;
    }
    catch (const ConvergenceError& error)
    {
      before.restore();
      note(t, error.what());
      discarded += _report.discarded + _number;
      if (attempted.cut(_report.discarded + _number))
        continue;
      const std::string also = set_back();
      throw ConvergenceError(
          std::string(error.what()) + ". No step from t = "
          + number_text(plan.t(), 6) + " converged; the last attempt, to t = "
          + number_text(t, 6) + ", was the shortest that max_cuts = "
          + std::to_string(plan.max_cuts())
          + " allows. Where a structure buckles or snaps, dynamics leads on "
            "(manual: howto/snap)"
          + also);
    }
    catch (...)
    {
      before.restore();
      if (is_set)
        set_back();
      throw;
    }
  }
  _report.discarded += discarded;
  attempted.accept(_number);
  plan = std::move(attempted);
}

/// What came of the last attempt, without times and t.
/// @param[in] failure Why it failed; empty where it was accepted.
AttemptRecord Problem::record(std::string failure) const
{
  AttemptRecord record;
  record.step = _num_accepted + (failure.empty() ? 0 : 1);
  record.solves = _report.discarded + _number;
  record.slipping = _report.slipping;
  if (not _report.history.empty())
  {
    const Settled& last = _report.history.back();
    record.closed = last.closed;
    record.residual = last.residual;
    record.tolerance = last.tolerance;
  }
  record.failure = std::move(failure);
  return record;
}

bool Problem::attempt(const std::function<Outcome(bool damped)>& attempt)
{
  const Outcome first = attempt(false);
  if (first != Outcome::failed or not damping_may_help())
    return first == Outcome::converged;
  restore();
  return attempt(true) == Outcome::converged;
}

/// Iterates from the start of a step; false where no solution is found.
bool Problem::iterate(LinearSolver& solver, const Tolerances& tolerances)
{
  const std::size_t n = _system->size();
  std::vector<double> b(n), dx(n), x(n), force(n), correction(n);
  const auto take = [&](double part)
  {
    std::vector<double> there(n);
    for (std::size_t i = 0; i < n; ++i)
      there[i] = x[i] - part * dx[i];
    _system->take(there);
  };
  while (true)
  {
    judge(tolerances.rtol, tolerances.atol, b);
    if (_found->converged)
      return true;
    if (_found->failure.empty() and _number >= tolerances.max_it)
    {
      _found->failure = why_slow(dx);
      _found->is_final = not _found->failure.empty();
      if (not _found->is_final)
        _found->failure
            = no_convergence(std::to_string(tolerances.max_it), "max_it");
    }
    if (not _found->failure.empty())
      return false;
    try
    {
      solver.update();
      solver.solve(b, dx);
      if (_loop.corrects(dx))
      {
        _system->residual(b);
        solver.solve(b, dx);
      }
    }
    catch (const solve::NotFinite& error)
    {
      _found->failure = error.what();
      return false;
    }
    _system->unknowns(x);
    take(_loop.limit(dx,
                     [&](double part)
                     {
                       take(part);
                       _system->residual(force);
                       const bool is_finite = std::ranges::all_of(
                           force, [](double f) { return std::isfinite(f); });
                       if (not mesh::everywhere(_halo->ranks(), is_finite))
                         return std::numeric_limits<double>::infinity();
                       solver.solve(force, correction);
                       return _loop.size_of(correction);
                     }));
    moved();
  }
}

void Problem::prepare()
{
  _before.reset();
  _has_begun = false;
  _attempt = std::exchange(_next, {});
  _system->bulk()->read();
  if (_before_step)
    _before_step();
  check_finite();
  check_prescribed();
  read_values();
  check_kept();
  check_drag();
  _before.emplace(snapshot());
  _increment = extrapolated();
}

void Problem::check_finite()
{
  const std::span<const double> u = _system->bulk()->displacements();
  std::vector<std::int32_t> nodes;
  std::int64_t count = 0;
  for (std::size_t i = 0; i < u.size(); ++i)
    if (not std::isfinite(u[i]))
    {
      ++count;
      nodes.push_back(static_cast<std::int32_t>(i / _halo->gdim()));
    }
  count = mesh::total(_halo->ranks(), count);
  const auto found = mesh::found_nodes(*_halo, nodes, _halo->reference());
  if (count > 0)
    throw std::invalid_argument(
        "the displacement u is not finite at " + std::to_string(count)
        + " dofs, first at node " + std::to_string(found.first)
        + " of the mesh as it was made: repair the mesh or the initial guess "
          "(manual: errors/values-not-finite)");
}

void Problem::check_prescribed()
{
  const auto bad = mesh::total<std::int64_t>(
      _halo->ranks(),
      std::ranges::count_if(_system->bulk()->defect(),
                            [](double d) { return not std::isfinite(d); }));
  if (bad > 0)
    throw std::invalid_argument(
        "bcs prescribe displacements that are not finite, at "
        + std::to_string(bad)
        + " dofs: give finite numbers; the function that sets them, as update "
          "of LoadSteps, may be wrong (manual: errors/values-not-finite)");
}

/// Dirichlet conditions must keep no slave node inside a rigid obstacle.
void Problem::check_kept()
{
  solve::Bulk& bulk = *_system->bulk();
  const std::span<const double> u = bulk.displacements(),
                                X = _halo->reference();
  const std::vector<double> own(u.begin(), u.end());
  const std::span<const double> defect = bulk.defect();
  std::vector<double> x(own.size());
  for (std::size_t i = 0; i < x.size(); ++i)
    x[i] = X[i] + own[i] - defect[i];
  for (std::size_t k = 0; k < _parts.size(); ++k)
  {
    contact::Contact& contact = *_system->contacts()[k];
    const auto found
        = mesh::found_nodes(*_halo, contact.constrained_inside(x), X);
    if (found.count == 0)
      continue;
    const double size = std::ranges::max(mesh::extent(
        _halo->ranks(), contact.slaves().owned(), X, _halo->gdim()));
    throw std::invalid_argument(
        _parts[k].name + " is over-constrained: Dirichlet conditions constrain "
        + std::to_string(found.count)
        + " slave nodes inside the rigid obstacle, first node "
        + std::to_string(found.first) + " of the mesh as it was made, at "
        + point_text(found.at, size)
        + ". Take them out of the slave surface, release them along the "
          "obstacle's normal or prescribe values outside of it (manual: "
          "errors/over-constrained)");
  }
}

/// No obstacle may move along with what touches it, unless it tells how.
void Problem::check_drag()
{
  for (std::size_t k = 0; k < _parts.size(); ++k)
    if (_system->contacts()[k]->has_unknown_motion())
      throw std::invalid_argument(
          _parts[k].name
          + ": the LevelSet moves while it is touched, and its function does "
            "not tell how its material moves along its surface, which slip and "
            "ties are measured from. Take a Sphere, Plane or Cylinder, which "
            "drag what touches them, or give it a velocity, or friction=0; or "
            "let it come from where nothing touches it to where it stays "
            "(manual: errors/level-set-moves)");
}

/// Takes friction and offsets as they are now.
void Problem::read_values()
{
  _halo->ranks().agree(
      [&]
      {
        for (std::size_t k = 0; k < _parts.size(); ++k)
        {
          Values& values = *_parts[k].values;
          if (_has_values and not values.vary())
            continue;
          contact::Contact& contact = *_system->contacts()[k];
          if (const auto friction = values.friction())
            if (auto* law = dynamic_cast<law::Coulomb*>(contact.law().get()))
              law->set_friction(*friction);
          contact.set_offset(values.offset());
        }
      });
  _has_values = true;
}

void Problem::start(bool damped)
{
  ++_starts;
  _has_begun = _has_moved = false;
  _found.reset();
  _number = 0;
  _report = {};
  _report.damped = damped;
  bool is_finite = false;
  {
    const Timer timer(_report, "bulk stiffness");
    is_finite = _loop.begin_step(damped);
  }
  if (not is_finite)
    throw solve::NotFinite(
        "the residual is not finite: the material fails at the start of the "
        "step, or a load or coefficient of F is NaN or infinite. Take smaller "
        "load steps, or repair what sets it (manual: "
        "errors/residual-not-finite)");
  _audit->begin_step();
  const Timer timer(_report, "settle");
  _loop.settle_first();
  if (_increment and not damped)
    _loop.predict(*_increment);
  _has_begun = true;
}

/// What the last step would add to the unknowns if it went on, multipliers in
/// units of their own; none where this one does not follow it.
std::optional<std::vector<double>> Problem::extrapolated()
{
  if (not _attempt or not(_attempt->ratio > 0) or _may_fly)
    return {};
  const auto now = _system->bulk()->displacements();
  const std::vector<double>& before = _halo->before();
  // Users may have changed them since
  if (mesh::anywhere(
          _halo->ranks(),
          before.size() != now.size()
              or (not _end.empty() and not std::ranges::equal(now, _end))))
    return {};
  std::vector<double> x(_system->size());
  for (std::size_t i = 0; i < now.size(); ++i)
    x[i] = _attempt->ratio * (now[i] - before[i]);
  std::size_t at = _system->num_bulk();
  for (const auto& contact : _system->contacts())
  {
    const law::NodeState& nodes = *contact->nodes();
    for (std::size_t i = 0; i < nodes.before.size(); ++i)
      x[at++] = _attempt->ratio * (nodes.multiplier[i] - nodes.before[i]);
  }
  return x;
}

void Problem::read()
{
  _system->bulk()->read();
  _system->begin_step();
}

const Settled& Problem::settle(double rtol, double atol, int max_it)
{
  enter("settle", {{"rtol", rtol},
                   {"atol", atol},
                   {"max_it", static_cast<double>(max_it)}});
  read();
  std::vector<double> b(_system->size());
  judge(rtol, atol, b);
  if (_found->failure.empty() and not _found->converged and _number >= max_it)
    _found->failure = no_convergence(std::to_string(max_it), "max_it");
  return *_found;
}

const Settled& Problem::judge(double rtol, double atol, std::span<double> b)
{
  const bool is_start = _number == 0;
  if (not is_start)
    read_values();
  Verdict verdict{};
  {
    const Timer timer(_report, "settle");
    verdict = _loop.judge(is_start, rtol, atol, b);
  }
  double moved = 0;
  if (verdict == Verdict::unbounded_motion)
    moved = _loop.max_increment();
  else if (verdict == Verdict::large_rotation)
    moved = _loop.turned() * 180 / std::numbers::pi;
  std::string failure = failure_of(verdict, moved);
  if (not failure.empty())
    failure += loose_bodies();
  if (verdict == Verdict::solution)
  {
    const Timer timer(_report, "audit");
    _report.audit = audit();
    if (_refuses)
      failure = join(_report.audit.faults, "; ");
  }
  const bool is_costly = verdict == Verdict::goes_on and _attempt
                         and _attempt->budget and _number >= *_attempt->budget;
  if (is_costly)
    failure = no_convergence(std::to_string(_number), "max_it");
  // Shorter steps may do better where these have made no progress
  const bool is_slow
      = verdict == Verdict::not_finite or verdict == Verdict::stuck;
  _found = Settled{_loop.iterate(),
                   _number,
                   _loop.convergence().scale(),
                   verdict == Verdict::solution and failure.empty(),
                   not failure.empty() and not is_slow,
                   failure};
  _report.history.push_back(*_found);
  _has_moved = false;
  return *_found;
}

/// Looks at the geometry, which the residual does not see.
AuditReport Problem::audit()
{
  AuditReport report;
  const auto findings = _audit->find();
  for (std::size_t k = 0; k < findings.size(); ++k)
    add(report, _parts[k].name, *_system->contacts()[k], findings[k], _size);
  solve::Bulk& bulk = *_system->bulk();
  // A linear material does not notice cells inside out, nor do contacts of
  // small sliding
  const bool matters
      = not bulk.is_linear()
        or std::ranges::any_of(
            _system->contacts(), [](const auto& contact)
            { return contact->sliding() == contact::Sliding::finite; });
  if (matters)
    add(report, deformed_cells(*_halo, bulk), bulk.is_linear(), _size);
  if (not _refuses)
    report.warnings.insert(report.warnings.end(), report.faults.begin(),
                           report.faults.end());
  return report;
}

double Problem::limit(std::span<const double> dx)
{
  enter("limit");
  std::vector<double> step(dx.begin(), dx.end());
  for (double& s : step)
    s = -s;
  return _loop.limit(step);
}

void Problem::update(std::span<const double> dx, double part)
{
  enter("update", {{"part", part}});
  if (not std::isfinite(part))
    throw std::invalid_argument("part is " + number_text(part, 6)
                                + ": give a number of at most 1");
  std::vector<double> x(_system->size());
  _system->unknowns(x);
  for (std::size_t i = 0; i < x.size(); ++i)
    x[i] += part * dx[i];
  _system->take(x);
  if (part != 0)
    moved();
  // The corrector of an interior point is of the same iterate
  _has_moved = true;
}

void Problem::moved()
{
  _has_moved = true;
  ++_number;
}

void Problem::accept()
{
  check_drag();
  check_refusal();
  _report.converged = true;
  const auto u = _system->bulk()->displacements();
  _end.assign(u.begin(), u.end());
  _loop.accept();
  _has_modes = true;
  for (const auto& contact : _system->contacts())
    contact->accept();
  for (const Part& part : _parts)
    if (part.results)
      part.results->update();
  {
    const Timer timer(_report, "audit");
    _audit->accept();
  }
  complete();
  ++_num_accepted;
  _has_begun = false;
}

/// Calls what may still refuse a step that has converged.
void Problem::check_refusal()
{
  if (not _before_accept)
    return;
  try
  {
    if (const std::string reason = _before_accept(); not reason.empty())
      throw ConvergenceError(reason);
  }
  catch (...)
  {
    restore();
    throw;
  }
}

void Problem::summarise()
{
  const solve::ActiveSet& active_set = _loop.active_set();
  const solve::FreeBodies& bodies = _loop.free_bodies();
  const auto& gaps = active_set.hidden_gaps();
  _report.frozen_gap = gaps.empty() ? 0 : std::ranges::min(gaps);
  _report.interior = _loop.path().iterations();
  _report.limited = _loop.length().limited();
  _report.shortened = _loop.length().damped();
  _report.cycles = active_set.cycles();
  _report.corners = active_set.num_corners();
  _report.free_modes = bodies.free_modes();
  _report.held_force = bodies.held_force();
  _report.closed_for_balance = bodies.closed_for_balance();
  _report.slipping = active_set.num_slipping();
  _report.skipped_searches = 0;
  for (const auto& contact : _system->contacts())
    _report.skipped_searches += contact->skipped_searches();
}

/// Writes the totals of an accepted step, and what it is warned of.
void Problem::complete()
{
  std::array<std::int64_t, 4> counts{};
  std::array<double, 2> sums{};
  for (const auto& contact : _system->contacts())
  {
    const auto marked = [](const auto& marks)
    { return std::ranges::count_if(marks, [](auto m) { return m != 0; }); };
    counts[0] += contact->nodes()->num_nodes();
    counts[1] += marked(contact->master()->paired());
    counts[2] += marked(contact->nodes()->immobile);
    counts[3] += std::ssize(contact->master()->frozen_pairs());
    if (const auto& history = contact->history())
    {
      const int g = history->gdim();
      const std::vector<double>& slip = history->slip();
      for (std::size_t i = 0; i < slip.size(); i += g)
      {
        double square = 0;
        for (int k = 0; k < g; ++k)
          square += slip[i + k] * slip[i + k];
        sums[0] += std::sqrt(square);
      }
      for (const double work : history->dissipation())
        sums[1] += work;
    }
  }
  mesh::Ranks& ranks = _halo->ranks();
  ranks.reduce(std::span<std::int64_t>(counts), mesh::Reduction::sum);
  ranks.reduce(std::span<double>(sums), mesh::Reduction::sum);
  _report.slaves = counts[0];
  _report.pairs = counts[1];
  _report.immobile = counts[2];
  _report.frozen_pairs = counts[3];
  _report.slip = sums[0];
  _report.dissipation = sums[1];
  if (_report.held_force > 0)
    _report.warnings.push_back(
        held_bodies(_report.free_modes, _report.held_force));
  for (std::size_t k = 0; k < _parts.size(); ++k)
    if (std::string text = warning_of(k); not text.empty())
      _report.warnings.push_back(std::move(text));
  _report.warnings.insert(_report.warnings.end(),
                          _report.audit.warnings.begin(),
                          _report.audit.warnings.end());
}

/// What a solution is warned of for a contact, such as a gap that frozen pairs
/// hide; empty for nothing.
std::string Problem::warning_of(std::size_t k)
{
  contact::Contact& contact = *_system->contacts()[k];
  contact::Master& master = *contact.master();
  mesh::Ranks& ranks = _halo->ranks();
  const std::string& name = _parts[k].name;
  // A surface need not meet itself
  const bool is_expected
      = contact.is_active() and not _may_fly and not contact.is_self();
  const auto paired = master.paired();
  if (is_expected
      and not mesh::anywhere(
          ranks, std::ranges::any_of(paired, [](auto p) { return p != 0; })))
  {
    // Where its nodes were paired, or should have been
    const bool is_small = contact.sliding() == contact::Sliding::small;
    const auto X = _halo->reference();
    const double distance = mesh::least(
        ranks,
        master.distance(is_small ? std::vector<double>(X.begin(), X.end())
                                 : _halo->now()->x));
    std::string text = name + " transmits no force: it has no slave node ";
    if (distance > master.reach())
      text += "within reach of its master; the nearest is "
              + number_text(distance, 3) + " away"
              + (is_small ? " in the reference configuration" : "")
              + ", and the search reaches " + number_text(master.reach(), 3);
    else
      text += "that faces its master, although the nearest is "
              + number_text(distance, 3)
              + " away: check that the tags are those of surfaces that face "
                "each other";
    if (is_small and not master.is_rigid())
      text += ". sliding=\"small\" pairs nodes in the reference "
              "configuration, once: give a larger search_distance, or take "
              "sliding=\"finite\"";
    return text + " (manual: errors/no-force)";
  }
  const auto& gaps = _loop.active_set().hidden_gaps();
  if (k >= gaps.size() or not(gaps[k] < 0))
    return {};
  const auto frozen
      = mesh::total<std::int64_t>(ranks, std::ssize(master.frozen_pairs()));
  return name + ": " + std::to_string(frozen)
         + " pairs went back and forth between facets and were frozen; they "
           "hide a penetration of "
         + number_text(-gaps[k], 3)
         + ". Refine the coarser surface there or take smaller steps (manual: "
           "errors/frozen-pairs)";
}

Snapshot Problem::snapshot() const { return {_system, results()}; }

void Problem::update_results() const
{
  for (const Part& part : _parts)
    if (part.results)
      part.results->update();
}

/// Results of each contact, null for none.
std::vector<std::shared_ptr<results::Results>> Problem::results() const
{
  std::vector<std::shared_ptr<results::Results>> results;
  for (const Part& part : _parts)
    results.push_back(part.results);
  return results;
}

void Problem::restore()
{
  ++_restores;
  _loop.leave_path();
  if (_before)
    _before->restore();
  _has_begun = false;
  _found.reset();
  // A failed step may have found the rigid modes of a spoilt stiffness
  if (not _has_modes)
    _loop.reset();
}

void Problem::find_rigid_modes()
{
  _has_modes = true;
  _system->bulk()->read();
  _loop.find_rigid_modes();
}

bool Problem::damping_may_help() const
{
  const bool is_cut_instead = _attempt and _attempt->budget;
  return _loop.is_curved() and not is_cut_instead
         and not(_found and _found->is_final);
}

std::string Problem::why_slow(std::span<const double> direction)
{
  const double error = solve::least_derivative_error(
      *_system, direction.first(_system->num_displacements()),
      _loop.convergence().scales().length);
  if (error > solve::wrong_derivative)
    return "the Jacobian is not the derivative of F: along the last step it "
           "differs by "
           + number_text(100 * error, 2)
           + " % from a difference quotient of F. "
           + (_system->bulk()->has_own_jacobian()
                  ? "Correct J, or leave it out to have it derived"
                  : "F has what ufl.derivative cannot see, such as a "
                    "coefficient that depends on u: give J")
           + " (manual: errors/wrong-jacobian)";
  const std::vector<Settled>& rows = _report.history;
  if (rows.size() < stagnant_iterates)
    return {};
  const auto last = std::span(rows).last(stagnant_iterates);
  double least = last[0].residual, most = least;
  // What falls all the time, if slowly, is not round-off
  bool falls = true, changes = false;
  for (std::size_t k = 0; k < stagnant_iterates; ++k)
  {
    least = std::min(least, last[k].residual);
    most = std::max(most, last[k].residual);
    falls = falls and (k == 0 or last[k].residual < last[k - 1].residual);
    changes = changes or last[k].changes.status + last[k].changes.pairs > 0;
  }
  const double rounding
      = math::round_off * _loop.convergence().scales().deforming_force();
  if (not(most <= stagnant_residual_ratio * least) or falls or changes
      or least > rounding)
    return {};
  return "the residual stagnates at " + number_text(least, 3)
         + " while no node changes its status, and the tolerance is "
         + number_text(last.back().tolerance, 3)
         + ": forces that cancel may leave that much by rounding. Raise "
           "snes_rtol, or set snes_atol to a force that may be neglected "
           "(manual: errors/residual-stagnates)";
}

/// What an error says of bodies that nothing holds; collective.
std::string Problem::loose_bodies() const
{
  const auto found = _loop.free_bodies().loose();
  return found.count == 0 ? std::string{}
                          : problem::loose_bodies(
                                found.count, point_text(found.middle, _size));
}

std::string Problem::no_convergence(std::string_view count,
                                    std::string_view limit) const
{
  return problem::no_convergence(count, limit, _loop.is_homogeneous())
         + loose_bodies();
}
