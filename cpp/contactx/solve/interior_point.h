// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#pragma once

#include "active_set.h"
#include "system.h"
#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace contactx::solve
{
/// @brief Primal-dual interior-point method on Signorini's and Coulomb's cones,
/// with Mehrotra's predictor and corrector.
///
/// Where a plain active set creeps, a step is solved from its displacements on
/// with all pairs inside their cones (law::Interior). Each iterate takes two
/// linear solves with one Jacobian: the affine step, which asks for
/// complementarity at once, and the corrector, which stays near the path. As
/// the mean product of pairs falls, the affine step tells which nodes close and
/// stick; an exact active set ends the step (finite termination). All ranks
/// must call its functions without const.
class InteriorPoint
{
public:
  /// @brief Take the system.
  explicit InteriorPoint(std::shared_ptr<System> system);

  /// @brief Start a load step from the state of now.
  /// @param[in] is_barred Whether the active set goes on alone.
  void begin_step(bool is_barred);

  /// @brief Take the state of now as the step's start.
  void take_start() { _system->unknowns(_start); }

  /// @brief Let the active set go on alone in this step.
  void bar() { _is_barred = true; }

  /// @brief Leave the path, as the step has ended.
  void drop();

  /// @brief True while nodes are on the path.
  bool is_on() const { return _is_on; }

  /// @brief True while an exact active set is tried.
  bool is_trial() const { return _is_trial; }

  /// @brief Take note of a step of the active set, for the scales of gaps and
  /// pressures.
  /// @param[in] dx Step, which is taken off the unknowns (shape=(size)).
  void note(std::span<const double> dx);

  /// @brief Decide whether the path begins at an iterate of the active set.
  /// @param[in] changes What the active set has changed there.
  /// @param[in] closed Number of closed nodes.
  /// @param[in] way Largest component of what any node has moved by in this
  /// step.
  bool begins(const Changes& changes, std::int64_t closed, double way);

  /// @brief Go to the path, with the multipliers of the step's start.
  void start();

  /// @brief Begin once more where the path has led nowhere, from the
  /// displacements of the step's start and with products that are all alike.
  /// @return Whether it did: it does so once.
  bool begins_again();

  /// @brief Take what a step changes of pressures and slacks; the displacements
  /// have been taken.
  void take();

  /// @brief Bring nodes up to the kinematics of the iterate, and ask for the
  /// affine step.
  void predict();

  /// @brief True if the next step is the affine one, which is not taken.
  bool is_predictor() const { return _is_on and _is_predictor; }

  /// @brief Take the affine step, and ask for the corrector.
  /// @param[in] dx Step, which is taken off the unknowns (shape=(size)).
  void correct(std::span<const double> dx);

  /// @brief Part of the corrector that keeps the slacks inside their cones.
  /// @param[in] dx Step, which is taken off the unknowns (shape=(size)).
  double limit(std::span<const double> dx);

  /// @brief Take a part of what `limit` has allowed, at most 1.
  void shorten(double part);

  /// @brief Decide whether an exact active set is tried from this iterate.
  /// @param[in] residual Residual of the displacements, over the forces.
  bool may_end(double residual);

  /// @brief Try the active set that the last affine step has shown.
  void leave();

  /// @brief True if a trial has failed: its active set changes too much.
  bool is_refused(std::int64_t changes, std::int64_t closed);

  /// @brief Return to the iterate that the trial began at.
  void resume();

  /// @brief True if the path leads nowhere: the product of pairs does not fall,
  /// or iterates have been too many.
  bool is_stuck() const;

  /// @brief Return to the iterate of the active set that the path was left for,
  /// for the rest of the step.
  void give_up();

  /// @brief How far bodies may have to go until contact balances them: not
  /// farther than iterates that have not run away; any way if none has.
  double reach() const;

  /// @brief Iterates on the path in this step.
  int iterations() const { return _iterations; }

private:
  /// Changes of a contact's nodes by a step.
  struct Step
  {
    std::vector<double> pressure, traction, slack, slip_length, slip;
  };

  mesh::Ranks& ranks() const { return _system->halo()->ranks(); }
  std::vector<Step> increments(std::span<const double> dx) const;
  void add(const std::vector<Step>& steps, double primal, double dual);
  std::array<double, 2> lengths(const std::vector<Step>& steps) const;
  std::array<double, 3> means() const;
  void judge(const std::vector<Step>& steps);
  void begin();
  double unbalanced() const;
  double area() const;
  bool has_run_away() const;
  void place();

  std::shared_ptr<System> _system;
  double _extent; // of the scene
  bool _is_on = false, _is_trial = false, _is_predictor = false;
  // Numbers of iterates: of the active set, on the path, and of a trial
  int _count = 0, _iterations = 0, _trial = 0;
  // Nodes that opened or closed in the last iterates
  std::array<std::int64_t, 3> _passed{};
  bool _has_stepped = false;
  // Of the iterate before
  double _residual = 0, _before_product = 0;
  // Whether the bulk is far from linear, so that all shares one step length
  bool _is_curved = false;
  // Scales of gap and pressure at the start, the mean product of pairs, and the
  // product of the means
  double _gap_scale = 0, _pressure_scale = 0, _product = 0, _scale = 0;
  // Product below which the next trial begins at the latest
  double _level = 0;
  std::vector<double> _start; // unknowns at the step's start
  // Ways since the step's start: the shortest one of the active set's iterates,
  // and that of the last one
  double _shortest_way = 0, _last_way = 0;
  std::vector<double> _kept; // those at the trial
  // Unknowns and status where the path was taken
  std::vector<double> _before;
  std::vector<std::vector<std::int8_t>> _status;
  bool _is_barred = false, _is_second = false;
  std::int64_t _most_closed = 0;
  int _tried = -1; // iterate of the last trial
  int _poor = 0;   // iterates without progress
  std::vector<std::optional<law::Interior>> _saved;
  std::vector<std::vector<std::int8_t>> _shown; // status
  std::int64_t _doubtful = 0, _closed = 0, _differ = 0;
  double _part = 0; // of the nodes that may be in doubt
  std::vector<Step> _steps;
  std::array<double, 2> _lengths{};
};
} // namespace contactx::solve
