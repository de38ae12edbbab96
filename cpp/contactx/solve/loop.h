// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#pragma once

#include "active_set.h"
#include "balance_guard.h"
#include "convergence.h"
#include "interior_point.h"
#include "step_length.h"
#include <functional>

namespace contactx::solve
{
/// @brief Verdict on an accepted iterate.
enum class Verdict : std::int8_t
{
  goes_on,                ///< the Jacobian's turn
  solution,               ///< bulk, contacts and active set are in equilibrium
  not_finite,             ///< the residual is not
  frozen_pair_penetrates, ///< frozen pairs hide a penetration, and cannot be
                          ///< released
  unbounded_motion,       ///< it would be, but for a body without supports that
                          ///< has left the scene
  large_rotation,         ///< it would be, but for a body without supports that
                          ///< has turned farther than its linear strains allow
  unbalanced,             ///< nothing can balance the loads on a body
  stuck ///< line search failed: the last steps made no progress
};

/// @brief An accepted iterate, as all ranks see it.
struct Iterate
{
  double residual = 0;     ///< norm of the residual
  double tolerance = 0;    ///< bound of the residual
  double forces = 0;       ///< forces that the bound is relative to
  double defect = 0;       ///< largest difference from a Dirichlet value
  std::int64_t closed = 0; ///< slave nodes in contact
  Changes changes{};       ///< of the last update
  bool is_frozen = false;  ///< whether kinematics are
};

/// @brief Semismooth Newton method, the primal-dual active set strategy
/// (Alart & Curnier 1991; Hueeber & Wohlmuth 2005), but for the linear solves.
///
/// Pairs and the active set (the closed nodes, and which of them stick) change
/// once an accepted iterate, in `judge`, never inside a line search. The
/// residual that is compared is that of the new pairs and the new active set.
/// So a small residual means equilibrium and complementarity at once.
///
/// A solver calls, in each load step,
///
///     loop.begin_step(damped);
///     loop.settle_first();
///     for (Verdict v = loop.judge(b, ...); v == goes_on; v = loop.judge(...))
///     {
///       // solve J dx = b, with loop.springs() on J's diagonal
///       if (loop.corrects(dx)) ...            // solve J dx = b anew
///       system.take(x - loop.limit(dx, correction) * dx);
///     }
///     contacts accept; loop.accept();
///
/// All ranks must call its functions without const.
class Loop
{
public:
  /// @brief Take a problem.
  /// @param[in] system Bulk and contacts.
  /// @param[in] bodies Bodies of the mesh.
  Loop(std::shared_ptr<System> system,
       std::shared_ptr<const mesh::Bodies> bodies);
  // Its own functions give it the forces
  Loop(const Loop&) = delete;
  Loop& operator=(const Loop&) = delete;

  /// @brief The system.
  const std::shared_ptr<System>& system() const { return _system; }

  /// @brief Pairs and status.
  const ActiveSet& active_set() const { return _active_set; }

  /// @brief Springs and closed nodes that keep bodies without supports
  /// solvable.
  const FreeBodies& free_bodies() const { return *_bodies; }

  /// @brief When residuals are small.
  Convergence& convergence() { return _convergence; }

  /// @brief Start a step: loads, constants and coefficients may have changed.
  /// @param[in] damped Whether steps are damped.
  /// @return Whether the bulk's residual is finite; the step has not begun if
  /// not.
  bool begin_step(bool damped);

  /// @brief Update pairs and the active set at the step's start.
  void settle_first();

  /// @brief Start from another state, as a Newton step without a linear solve,
  /// if its residual is smaller than that of the step's start.
  ///
  /// Slip is still counted from the step's start. Linear problems, of which a
  /// Newton step knows as much, do not take it. Call it after `settle_first`.
  /// @param[in] increment What it adds to the unknowns, multipliers in units of
  /// their own (shape=(size)). Dirichlet values are set to those of now.
  void predict(std::span<const double> increment);

  /// @brief Update pairs and the active set at an accepted iterate, and judge
  /// the residual that they give.
  ///
  /// The iterate itself may change: where the active set cycles a part of the
  /// last step is taken back, and free bodies that have drifted are taken back.
  /// @param[in] is_start Whether no step was taken since `settle_first`.
  /// @param[in] rtol Tolerance relative to the forces.
  /// @param[in] atol Absolute tolerance.
  /// @param[out] b Residual of the iterate (shape=(System::size)).
  Verdict judge(bool is_start, double rtol, double atol, std::span<double> b);

  /// @brief The iterate that was judged.
  const Iterate& iterate() const { return _iterate; }

  /// @brief True if a smaller load is the same problem, scaled: from a start
  /// without displacements and gaps, with linear bodies, small sliding and no
  /// other law of friction than Coulomb's. Known once `settle_first` was
  /// called.
  bool is_homogeneous() const { return _is_homogeneous; }

  /// @brief True unless one Newton step solves the problem for a given active
  /// set.
  bool is_curved() const;

  /// @brief Counts how often what the Jacobian depends on has changed, the
  /// displacements of linear solves apart.
  std::int64_t version() const { return _version; }

  /// @brief Take a step for the affine one of an interior point: the residual
  /// of now, by the same Jacobian, is then that of the corrector, which is to
  /// be solved for.
  ///
  /// Where a solver does not ask, `limit` does, and allows nothing of the step.
  /// @param[in] dx Step, which is taken off the unknowns (shape=(size)).
  /// @return Whether it was one.
  bool corrects(std::span<const double> dx);

  /// @brief The interior-point method.
  const InteriorPoint& path() const { return _path; }

  /// @brief Let the active set go on alone in this step: a solver with a line
  /// search of its own does not take steps in full.
  void bar_path() { _path.bar(); }

  /// @brief Size of the next correction, by the same Jacobian, after a part of
  /// a step, see `size_of`; infinite if the residual is not finite there.
  using Correction = std::function<double(double part)>;

  /// @brief Part of a step that is to be taken, at most 1: no cell turns inside
  /// out, and where steps are damped corrections become shorter.
  /// @param[in] dx Step, which is taken off the unknowns (shape=(size)).
  /// @param[in] correction Called where steps are damped; steps are not if it
  /// is empty.
  double limit(std::span<const double> dx, const Correction& correction = {});

  /// @brief Largest part of a step, at most 1, that turns no cell inside out.
  /// @param[in] dx Step, which is taken off the unknowns (shape=(size)).
  double within_cells(std::span<const double> dx) const;

  /// @brief The rule of the part of a step that is taken.
  StepLength& length() { return _length; }

  /// @brief Size of a step: norm of its displacements.
  /// @param[in] dx Step (shape=(size)).
  double size_of(std::span<const double> dx) const;

  /// @brief Largest component of what any node has moved by in this step.
  double max_increment();

  /// @brief Angle that a body without supports has turned by, radians, see
  /// FreeBodies::turned.
  double turned() const { return _bodies->turned(); }

  /// @brief Part of the nodes in contact whose status or pair has changed.
  double changing() const;

  /// @brief Take the converged state as the start of the next step.
  void accept() { _convergence.accept(); }

  /// @brief Find the free rigid modes of the bodies as they are.
  void find_rigid_modes() { _bodies->begin_step(); }

  /// @brief Drop the rigid modes: a failed step may have found them of a spoilt
  /// stiffness.
  void reset() { _bodies->reset(); }

  /// @brief Leave the path of an interior point, as a step has failed.
  void leave_path() { _path.drop(); }

private:
  void make_room();
  void update_active_set(bool is_first);
  void foresee(std::span<const double> dx);
  void look_ahead();
  bool find_homogeneous();
  double residual_at(std::vector<double>& x);
  void take_back();
  void take_off_drift();
  Verdict judge_path(double rtol, double atol, std::span<double> b);
  bool compare(double rtol, double atol, std::span<double> b);
  std::vector<double> stiffness();
  void set_factors(std::span<const double> stiffness);

  std::shared_ptr<System> _system;
  Convergence _convergence;
  std::shared_ptr<FreeBodies> _bodies;
  ActiveSet _active_set;
  InteriorPoint _path;
  // Whether the iterate is judged again as it is: a step was not taken
  bool _stays = false;
  Forces _forces;
  StepLength _length;
  BalanceGuard _balance;
  Iterate _iterate;
  std::int64_t _version = 0;
  bool _has_stepped = false, _is_homogeneous = false, _has_made_room = false;
  // Displacements at the step's start
  std::vector<double> _start;
  // Where the first Newton step would lead in full
  std::vector<double> _ahead;
  // The iterate before
  std::optional<std::vector<double>> _last;
};
} // namespace contactx::solve
