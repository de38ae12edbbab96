// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#pragma once

#include <optional>
#include <span>
#include <vector>

namespace contactx::problem
{
/// @brief An attempt at a step.
struct Attempt
{
  double start = 0; ///< t at its start
  double end = 0;   ///< t at its end
  double ratio = 0; ///< its length over that of the step before; zero if none
  /// Linear solves after which a shorter one is cheaper, and follows; nothing
  /// where there is none, or no step to measure it against
  std::optional<int> budget;
};

/// @brief Load steps from 0 to the last given t: halved where one fails, and
/// doubled again once the steps since have cost as many linear solves as the
/// failure did. So what fails costs no more than what is accepted, whatever
/// the length that a scene takes.
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
  /// @param[in] easy Linear solves up to which an accepted step is followed by
  /// a longer one; nothing for the rule above.
  /// @throws std::invalid_argument if there is no t, they do not increase, or a
  /// number is out of its range.
  StepPlan(std::vector<double> given, int max_cuts = 6,
           std::optional<int> easy = {});

  /// @brief Equal steps.
  /// @param[in] count Their number.
  /// @param[in] t_end Where the last one ends.
  /// @return The t at which each ends.
  static std::vector<double> equal(int count, double t_end = 1);

  /// @brief The given t.
  const std::vector<double>& given() const { return _given; }

  /// @brief How often a given step may be halved.
  int max_cuts() const { return _max_cuts; }

  /// @brief Linear solves up to which an accepted step is followed by a longer
  /// one, if they were given.
  std::optional<int> easy() const { return _easy; }

  /// @brief True if the last given t has been reached.
  bool finished() const { return _number == _given.size(); }

  /// @brief The last accepted t.
  double t() const { return finished() ? _start : at(_done); }

  /// @brief The t to attempt.
  double next() const { return at(share()); }

  /// @brief The next attempt.
  Attempt attempt() const;

  /// @brief Go on behind an accepted step.
  /// @param[in] iterations Linear solves that it took.
  void accept(int iterations);

  /// @brief Halve the step that has failed.
  /// @param[in] iterations Linear solves that it took.
  /// @return Whether it may be shorter; nothing has changed if not.
  bool cut(int iterations);

  /// @brief The state of the plan, for a checkpoint (shape=(7)).
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
  std::optional<int> shorter() const;

  std::vector<double> _given;
  int _max_cuts;
  std::optional<int> _easy;
  // How many given t have been reached, where the current step begins, which
  // share of it was accepted, how often it is halved, and how often a longer
  // step from this place has failed
  std::size_t _number = 0;
  double _start = 0, _done = 0;
  int _cuts = 0;
  int _failures = 0;
  // Linear solves of the last failure that accepted steps have not yet made up
  // for, and of the last accepted step
  int _debt = 0, _cost = 0;
  double _length = 0; // of the last accepted step
};
} // namespace contactx::problem
