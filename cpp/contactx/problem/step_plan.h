// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#pragma once

#include <optional>
#include <span>
#include <vector>

namespace contactx::problem
{
/// @brief Load steps from 0 to the last given t: halved where one fails, and
/// doubled again where they are easy.
///
/// Positions within a given step are multiples of a power of two, exact in
/// floating point: every given t is met, and no sliver of a step is left before
/// it.
class StepPlan
{
public:
  /// @brief Start at 0.
  /// @param[in] given The given t, increasing and above 0.
  /// @param[in] max_cuts How often a given step may be halved, at most 40.
  /// @param[in] easy Linear solves up to which an accepted step counts as easy.
  /// @throws std::invalid_argument if there is no t, they do not increase, or a
  /// number is out of its range.
  StepPlan(std::vector<double> given, int max_cuts = 6, int easy = 10);

  /// @brief Equal steps.
  /// @param[in] count Their number.
  /// @param[in] t_end Where the last one ends.
  /// @return The t at which each ends.
  static std::vector<double> equal(int count, double t_end = 1);

  /// @brief The given t.
  const std::vector<double>& given() const { return _given; }

  /// @brief How often a given step may be halved.
  int max_cuts() const { return _max_cuts; }

  /// @brief Linear solves up to which an accepted step counts as easy.
  int easy() const { return _easy; }

  /// @brief True if the last given t has been reached.
  bool finished() const { return _number == _given.size(); }

  /// @brief The last accepted t.
  double t() const { return finished() ? _start : at(_done); }

  /// @brief The t to attempt.
  double next() const { return at(share()); }

  /// @brief Go on behind an accepted step: after an easy one the next one is
  /// twice as long, unless such a step has just failed.
  /// @param[in] iterations Linear solves that it took.
  void accept(int iterations);

  /// @brief Halve the step that has failed.
  /// @return Whether it may be shorter; nothing has changed if not.
  bool cut();

  /// @brief The state of the plan, for a checkpoint (shape=(4)).
  std::vector<double> place() const;

  /// @brief Go on from a saved place.
  /// @param[in] given Given t of the plan that was saved; where this one has
  /// others, it goes on to the first of them that is larger than the saved t.
  /// @param[in] place What `place` gave.
  /// @throws std::invalid_argument if the saved t is beyond the last given one;
  /// nothing has changed.
  void load(std::span<const double> given, std::span<const double> place);

  bool operator==(const StepPlan&) const = default;

private:
  double share() const;
  double at(double share) const;

  std::vector<double> _given;
  int _max_cuts, _easy;
  // How many given t have been reached, where the current step begins, which
  // share of it was accepted, how often it is halved, and whether a longer step
  // from this place has failed
  std::size_t _number = 0;
  double _start = 0, _done = 0;
  int _cuts = 0;
  bool _has_failed = false;
};
} // namespace contactx::problem
