// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#pragma once

#include <cstdint>
#include <functional>
#include <limits>
#include <string>

namespace contactx::problem
{
/// @brief What came of an attempt at a load step.
struct AttemptRecord
{
  int step = 0;            ///< number of the step, from 1
  int attempt = 0;         ///< number of the attempt at it, from 1
  double start = 0;        ///< t at its start
  double end = 0;          ///< t at its end
  int solves = 0;          ///< linear solves, those of a damped retry included
  std::int64_t closed = 0; ///< slave nodes in contact at the last iterate
  std::int64_t slipping = 0; ///< of these, that slip against friction
  /// Of the last iterate, and what it must fall below; NaN where there is none
  double residual = std::numeric_limits<double>::quiet_NaN();
  double tolerance = std::numeric_limits<double>::quiet_NaN();
  double seconds = 0; ///< wall time
  /// Why it failed, and a shorter one follows; empty where it was accepted
  std::string failure;
};

/// @brief Called with each attempt, on all ranks.
using StepLog = std::function<void(const AttemptRecord&)>;

/// @brief Headings of the columns of `step_log_line`.
std::string step_log_heading();

/// @brief An attempt in one line, for a log that is read while a run goes on.
/// @param[in] record What came of the attempt.
std::string step_log_line(const AttemptRecord& record);
} // namespace contactx::problem
