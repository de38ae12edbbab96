// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#pragma once

#include "../audit/audit.h"
#include "../solve/loop.h"
#include "audit_report.h"
#include "snapshot.h"
#include "step_log.h"
#include "step_plan.h"
#include "values.h"
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace contactx::problem
{
/// @brief No solution is to be expected any more in a step.
class ConvergenceError : public std::runtime_error
{
public:
  using std::runtime_error::runtime_error;
};

/// @brief An accepted iterate after its pairs and its active set were updated,
/// as all ranks see it.
struct Settled : solve::Iterate
{
  int number = 0;   ///< linear solves so far
  double scale = 0; ///< forces that the tolerance is relative to
  /// Whether it is a solution: the residual of the updated pairs and status is
  /// below the tolerance, and the audit has found no fault
  bool converged = false;
  /// Whether damped steps would fail as well
  bool is_final = false;
  /// Why no solution is to be expected any more, and what to do; empty while
  /// one is
  std::string failure;
};

/// @brief Solves with the Jacobian of a problem's iterates, see
/// solve::System for its unknowns. A host provides it; all ranks take part.
class LinearSolver
{
public:
  virtual ~LinearSolver() = default;

  /// @brief Take the Jacobian of the iterate that was judged last, with the
  /// springs of free bodies (solve::Loop::free_bodies) on its diagonal.
  virtual void update() = 0;

  /// @brief Solve.
  /// @param[in] b Right-hand side (shape=(size)).
  /// @param[out] x Solution (shape=(size)).
  /// @throws solve::NotFinite if there is none.
  virtual void solve(std::span<const double> b, std::span<double> x) = 0;
};

/// @brief When Newton's method ends.
struct Tolerances
{
  double rtol = 1e-11; ///< relative to the forces of the problem
  double atol = 0;     ///< absolute, a force
  int max_it = 50;     ///< most linear solves of an attempt
};

/// @brief What has come of an attempt at a step.
enum class Outcome : std::int8_t
{
  converged, ///< a solution
  failed,    ///< none; damped steps may find one
  is_final   ///< none, and damped steps would not find one either
};

/// @brief Report of a step; the same on all ranks.
struct Report
{
  std::vector<Settled> history; ///< one for each iterate, the start first
  bool converged = false;       ///< whether the step was accepted
  bool damped = false;          ///< whether Newton steps were damped
  int discarded = 0;            ///< linear solves of attempts that failed
  AuditReport audit;            ///< of the converged iterate
  /// What an accepted solution is warned of, a sentence each
  std::vector<std::string> warnings;
  std::map<std::string, double> seconds; ///< wall seconds of parts

  std::int64_t slaves = 0;       ///< slave nodes of all contacts
  std::int64_t pairs = 0;        ///< of these, with a master in reach
  std::int64_t immobile = 0;     ///< of these, that cannot move to it
  std::int64_t frozen_pairs = 0; ///< pairs that were frozen
  double frozen_gap = 0;         ///< smallest gap that these hide
  std::int64_t slipping = 0;     ///< slave nodes that slip against friction
  double slip = 0;               ///< sum of the slip of this step, a length
  double dissipation = 0;        ///< work of friction of all steps
  int interior = 0;              ///< iterates of the interior point
  int limited = 0;               ///< steps that cells have limited
  int shortened = 0;             ///< steps that were damped
  int cycles = 0;                ///< how often a status has come back
  std::int64_t corners = 0;      ///< nodes that close several contacts
  std::int64_t free_modes = 0;   ///< rigid modes that are left free
  /// Force that holds bodies along such modes, over those of all contacts
  double held_force = 0;
  /// Nodes that were closed to balance a free body
  std::int64_t closed_for_balance = 0;
  std::int64_t skipped_searches = 0; ///< searches that were not needed
};

/// @brief Drives a load step of a bulk and its contacts, but for the linear
/// solves: begins it, updates pairs and active set at accepted iterates, judges
/// and audits them, accepts the solution, or returns to the step's start.
///
/// A host (an adapter of a finite element library) owns the user's functions
/// and the linear algebra. A step is
///
///     problem.begin_step();
///     while (true)
///     {
///       const Settled& found = problem.settle(rtol, atol, max_it);
///       if (found.converged or not found.failure.empty()) break;
///       // solve J dx = -b
///       problem.update(dx, problem.limit(dx));
///     }
///     problem.accept();               // or problem.restore()
///
/// or `solve` for all of that. A host whose solver has a loop of its own, such
/// as SNES, calls `prepare`, `start`, `judge` and `moved` instead. All ranks
/// must call all functions without const, in the same order.
class Problem
{
public:
  /// @brief Take a system.
  /// @param[in] system Bulk and contacts.
  /// @param[in] bodies Bodies of the mesh.
  /// @param[in] parts What is beside each contact.
  /// @param[in] refuses Whether what the audit finds fails a step; else it is
  /// warned of.
  /// @throws std::invalid_argument if there are not as many parts as contacts.
  Problem(std::shared_ptr<solve::System> system,
          std::shared_ptr<const mesh::Bodies> bodies, std::vector<Part> parts,
          bool refuses = true);

  /// @brief Bulk and contacts.
  const std::shared_ptr<solve::System>& system() const { return _system; }

  /// @brief Newton's method.
  solve::Loop& loop() { return _loop; }

  /// @brief Report of the step.
  const Report& report() const { return _report; }

  /// @brief The iterate that was judged last; nothing before there is one.
  const std::optional<Settled>& found() const { return _found; }

  /// @brief Linear solves of the step so far.
  int number() const { return _number; }

  /// @brief How often a step was started so far, attempts counted one by one.
  int starts() const { return _starts; }

  /// @brief How often a step was taken back so far.
  int restores() const { return _restores; }

  /// @brief The bodies.
  const std::shared_ptr<const mesh::Bodies>& bodies() const { return _bodies; }

  /// @brief True if a step has begun, and was neither accepted nor restored.
  bool has_begun() const { return _has_begun; }

  /// @brief True if the iterate that was judged last is a solution and no step
  /// was taken since.
  bool converged() const
  {
    return _found and _found->converged and not _has_moved;
  }

  /// @brief Do not warn of contacts that no slave node is in reach of: bodies
  /// may leave one another for good.
  void allow_flight() { _may_fly = true; }

  /// @brief Take what the next step is an attempt at. Where it goes on from the
  /// step before, it starts from an extrapolation of that one, see
  /// solve::Loop::predict. Where a shorter one may follow, it ends once that is
  /// cheaper, and is not repeated with damped steps.
  /// @param[in] attempt The attempt.
  void set_attempt(const Attempt& attempt) { _next = attempt; }

  /// @brief Call a function where a step is prepared, before its state is
  /// checked and saved.
  /// @param[in] function The function. All ranks call it.
  void before_step(std::function<void()> function)
  {
    _before_step = std::move(function);
  }

  /// @brief Call a function once a step has converged, before it is accepted:
  /// time steps find their velocities then.
  /// @param[in] function Returns why the step is refused, the same on all
  /// ranks; empty if it is not. All ranks call it.
  void before_accept(std::function<std::string()> function)
  {
    _before_accept = std::move(function);
  }

  /// @brief Check that a call is in order: all ranks make the same one, with
  /// the same numbers, and a step has begun, or an iterate was settled, where
  /// that is needed.
  /// @param[in] call "begin_step", "settle", "residual", "jacobian", "set_up",
  /// "limit", "update" or "accept".
  /// @param[in] numbers Its numbers by their names, at most three.
  /// @throws std::logic_error on all ranks if it is not its turn.
  /// @throws std::invalid_argument on all ranks if numbers differ.
  void enter(std::string_view call,
             const std::vector<std::pair<std::string, double>>& numbers = {});

  /// @brief Take a whole load step from the displacements of now, with the
  /// loads and Dirichlet values of now: begin it, iterate, once more with
  /// damped steps where full ones do not converge, and accept it.
  /// @param[in] solver Solves with the Jacobian.
  /// @param[in] tolerances When iterations end.
  /// @throws ConvergenceError if it does not converge; all is then as it was
  /// before.
  /// @throws std::invalid_argument as `prepare` does.
  void solve(LinearSolver& solver, const Tolerances& tolerances = {});

  /// @brief Take the next step of a plan: shorter and shorter ones, as the plan
  /// says, until one converges.
  /// @param[in,out] plan The plan; at the end at the accepted step.
  /// @param[in] update Sets loads and Dirichlet values for a t; called before
  /// each attempt, and where none converges once more for the last accepted t.
  /// @param[in] solver Solves with the Jacobian.
  /// @param[in] tolerances When iterations end.
  /// @param[in] log Called with each attempt.
  /// @throws ConvergenceError if the shortest one does not converge; plan and
  /// state are then those of before.
  void advance(StepPlan& plan, const std::function<void(double t)>& update,
               LinearSolver& solver, const Tolerances& tolerances = {},
               const StepLog& log = {});

  /// @brief Attempt a step that was prepared, and once more with damped steps
  /// where full ones have failed and these may do better.
  /// @param[in] attempt Starts the step with `start(damped)` and iterates.
  /// @return Whether an attempt has converged; if not the state is that of the
  /// last one.
  bool attempt(const std::function<Outcome(bool damped)>& attempt);

  /// @brief Start a load step from the displacements of now, with the loads and
  /// Dirichlet values of now. If that throws, all is as it was before.
  /// @throws std::invalid_argument as `prepare` does.
  /// @throws solve::NotFinite as `start` does.
  void begin_step();

  /// @brief Check the state that a step starts from, and save it.
  /// @throws std::invalid_argument on all ranks if displacements or Dirichlet
  /// values are not finite, values of a contact or an obstacle do not fit,
  /// Dirichlet conditions keep slave nodes inside a rigid obstacle, or an
  /// obstacle that is touched with friction has moved without saying how.
  void prepare();

  /// @brief Start a step that was prepared, or once more one that has failed
  /// and was restored.
  /// @param[in] damped Whether steps are damped.
  /// @throws solve::NotFinite if the residual is not finite.
  void start(bool damped = false);

  /// @brief Read what a user may have changed since the last call, update pairs
  /// and active set at an accepted iterate, and judge its residual.
  ///
  /// The iterate may change by a little: where the active set cycles, part of
  /// the last step is taken back, and so is what free bodies have drifted by.
  /// @param[in] rtol Tolerance relative to the forces of the problem.
  /// @param[in] atol Absolute tolerance, a force.
  /// @param[in] max_it Most linear solves of the step.
  /// @throws std::invalid_argument if values of a contact do not fit.
  const Settled& settle(double rtol, double atol, int max_it);

  /// @brief Do the same without reading anew and counting, for solvers with a
  /// loop of their own.
  /// @param[in] rtol Tolerance relative to the forces of the problem.
  /// @param[in] atol Absolute tolerance, a force.
  /// @param[out] b Residual of the iterate (shape=(size)).
  const Settled& judge(double rtol, double atol, std::span<double> b);

  /// @brief Read what a user may have changed since the last call.
  void read();

  /// @brief Part of a step that may be taken, see solve::Loop::limit; zero
  /// where the iterate stays and the next residual is another one: of the
  /// corrector of an interior point, by the same Jacobian, or with bodies that
  /// are held.
  /// @param[in] dx Increment, which is added to the unknowns (shape=(size)).
  double limit(std::span<const double> dx);

  /// @brief Add a step to the unknowns.
  /// @param[in] dx The step (shape=(size)).
  /// @param[in] part Part of it.
  /// @throws std::invalid_argument if the part is not finite.
  void update(std::span<const double> dx, double part = 1);

  /// @brief Count a linear solve, after which the state is another one.
  void moved();

  /// @brief Take the solution as the start of the next step: history is
  /// committed, and the report completed.
  /// @throws ConvergenceError if the function of `before_accept` refuses it;
  /// all is then as it was before the step.
  /// @throws std::invalid_argument as `prepare` does of obstacles.
  void accept();

  /// @brief Write the figures of the step so far into the report.
  void summarise();

  /// @brief Return to where the last step began, bit for bit, with all
  /// contacts and their results.
  void restore();

  /// @brief Copy the state of now, to return to.
  Snapshot snapshot() const;

  /// @brief Evaluate the results of all contacts for the state of now, which
  /// another run has left.
  void update_results() const;

  /// @brief Find the rigid modes of free bodies as they are, as the first step
  /// does: those of bodies without stress.
  void find_rigid_modes();

  /// @brief Say why iterations came to nothing, if that is not for the
  /// contacts: a wrong Jacobian, or rounding errors.
  /// @param[in] direction The last step (shape=(size)).
  /// @return Empty if it is none of these.
  std::string why_slow(std::span<const double> direction);

  /// @brief Say that iterations did not converge, and what may help.
  /// @param[in] count Number of iterations, or what limits it.
  /// @param[in] limit Name of the limit.
  std::string no_convergence(std::string_view count,
                             std::string_view limit) const;

private:
  std::string loose_bodies() const;

  /// True if damped steps may converge where the last run has failed: not where
  /// steps solve what they solve exactly.
  bool damping_may_help() const;
  std::vector<std::shared_ptr<results::Results>> results() const;
  AttemptRecord record(std::string failure) const;
  bool iterate(LinearSolver& solver, const Tolerances& tolerances);
  void read_values();
  void check_finite();
  void check_prescribed();
  void check_kept();
  void check_drag();
  void check_refusal();
  std::optional<std::vector<double>> extrapolated();
  AuditReport audit();
  std::string warning_of(std::size_t contact);
  void complete();

  std::shared_ptr<solve::System> _system;
  std::shared_ptr<mesh::Halo> _halo;
  std::shared_ptr<const mesh::Bodies> _bodies;
  std::vector<Part> _parts;
  bool _refuses, _may_fly = false;
  solve::Loop _loop;
  std::function<void()> _before_step;
  std::function<std::string()> _before_accept;
  std::optional<audit::Audit> _audit;
  double _size; // of the scene
  // What the next step and that of now are attempts at, if it is known
  std::optional<Attempt> _next, _attempt;
  // Displacements at the end of the last step, and what it would add to the
  // unknowns if it went on, multipliers in units of their own
  std::vector<double> _end;
  std::optional<std::vector<double>> _increment;
  std::optional<Snapshot> _before;
  Report _report;
  std::optional<Settled> _found;
  int _number = 0, _num_accepted = 0;
  int _starts = 0, _restores = 0;
  // Whether the values of the contacts have been read, a step has begun, a part
  // of it was taken since the last iterate was judged, and a step was accepted
  bool _has_values = false, _has_begun = false, _has_moved = false,
       _has_modes = false;
};
} // namespace contactx::problem
