// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#pragma once

#include "../results/results.h"
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace contactx::problem
{
/// @brief What a host gives of a contact that may change from one iterate to
/// the next: n is the number of its slave nodes on this rank.
class Values
{
public:
  virtual ~Values() = default;

  /// @brief True if they may change.
  virtual bool vary() const = 0;

  /// @brief Coefficients of friction (shape=(n)); nothing where the law takes
  /// none.
  virtual std::optional<std::vector<double>> friction() = 0;

  /// @brief Lengths that are taken off the gap (shape=(n)).
  virtual std::vector<double> offset() = 0;
};

/// @brief A contact as its problem knows it.
struct Part
{
  std::string name;               ///< what messages call it
  std::shared_ptr<Values> values; ///< what may change
  /// Results, which are updated where a step is accepted and restored where one
  /// fails; null where they are of no interest
  std::shared_ptr<results::Results> results = nullptr;
};
} // namespace contactx::problem
