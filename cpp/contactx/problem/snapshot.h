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
  /// @brief Copy the state of now.
  /// @param[in] system The system.
  /// @param[in] results Results of each of its contacts, null for none.
  Snapshot(std::shared_ptr<solve::System> system,
           std::vector<std::shared_ptr<results::Results>> results);

  /// @brief Return to it, bit for bit; collective.
  void restore() const;

private:
  std::shared_ptr<solve::System> _system;
  std::vector<std::shared_ptr<results::Results>> _results;
  std::vector<results::Results> _copies;
  // Displacements, and those of the starts of this step and of the last one
  std::vector<double> _displacements, _start, _last;
  std::vector<double> _fields;
  std::vector<std::vector<contact::Saved>> _contacts;
};
} // namespace contactx::problem
