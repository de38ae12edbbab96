// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#pragma once

#include "../contact/saved.h"
#include "../newton/system.h"

namespace contactx::problem
{
/// @brief Copy of the unknowns of a system and of all that the next step of its
/// contacts depends on.
class Snapshot
{
public:
  /// @brief Copy the state of now.
  explicit Snapshot(std::shared_ptr<newton::System> system);

  /// @brief Return to it, bit for bit; collective.
  void restore() const;

private:
  std::shared_ptr<newton::System> _system;
  std::vector<double> _displacements, _fields;
  std::vector<std::vector<contact::Saved>> _contacts;
};
} // namespace contactx::problem
