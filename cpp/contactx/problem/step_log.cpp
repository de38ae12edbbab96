// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#include "step_log.h"
#include "../text.h"
#include <algorithm>
#include <initializer_list>

using namespace contactx;

namespace
{
/// Texts in columns, each on the right
std::string columns(std::initializer_list<std::string> texts)
{
  constexpr std::size_t width[] = {4, 7, 11, 10, 6, 7, 8, 9, 9, 8};
  std::string line;
  const auto* w = width;
  for (std::string text : texts)
  {
    if (text.size() < *w)
      text.insert(0, *w - text.size(), ' ');
    line += line.empty() ? text : " " + text;
    ++w;
  }
  return line;
}
} // namespace

std::string problem::step_log_heading()
{
  return columns({"step", "attempt", "t", "dt", "solves", "closed", "slipping",
                  "residual", "tolerance", "seconds"})
         + "  outcome";
}

std::string problem::step_log_line(const AttemptRecord& record)
{
  std::string outcome
      = record.failure.empty() ? "accepted" : "failed: " + record.failure;
  std::ranges::replace(outcome, '\n', ' ');
  return columns(
             {std::to_string(record.step), std::to_string(record.attempt),
              number_text(record.end, 6),
              number_text(record.end - record.start, 4),
              std::to_string(record.solves), std::to_string(record.closed),
              std::to_string(record.slipping), number_text(record.residual, 3),
              number_text(record.tolerance, 3), number_text(record.seconds, 3)})
         + "  " + outcome;
}
