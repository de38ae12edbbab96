// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#pragma once

#include "../contact/saved.h"
#include "../results/results.h"
#include "../solve/system.h"

namespace contactx::problem
{
/// @brief Copy of the unknowns of a system, of all that the next step of its
/// contacts depends on, and of their results.
class Snapshot
{
public:
  /// @brief What outlives a step, as arrays of this rank.
  struct State
  {
    std::vector<double> displacements; ///< those of solve::Bulk
    std::vector<double> start; ///< displacements of the step's start, likewise
    /// Those of the last step's start, likewise
    std::vector<double> before;
    std::vector<double> fields; ///< those of solve::Fields
    /// Those of each contact, see contact::save
    std::vector<std::vector<contact::Saved>> contacts;
  };

  /// @brief Copy the state of now.
  /// @param[in] system The system.
  /// @param[in] results Results of each of its contacts, null for none.
  Snapshot(std::shared_ptr<solve::System> system,
           std::vector<std::shared_ptr<results::Results>> results);

  /// @brief Take the state of another run, whose results are evaluated anew.
  /// @param[in] system The system.
  /// @param[in] results Results of each of its contacts, null for none.
  /// @param[in] state The state, of contacts in the order of the system's.
  Snapshot(std::shared_ptr<solve::System> system,
           std::vector<std::shared_ptr<results::Results>> results, State state);

  /// @brief Return to it, bit for bit; collective.
  /// @throws std::invalid_argument on all ranks if the state of another run
  /// does not fit.
  void restore() const;

private:
  std::shared_ptr<solve::System> _system;
  std::vector<std::shared_ptr<results::Results>> _results;
  State _state;
  std::vector<results::Results> _copies; // none of another run
};
} // namespace contactx::problem
