// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#pragma once

#include <algorithm>

namespace contactx::contact
{
/// @brief Fraction of a straight path at which the gap becomes zero.
/// @param[in] before Gap at the start.
/// @param[in] after Gap at the end.
/// @return The part, from 0 to 1; 0 where it was not open before.
inline double touching(double before, double after)
{
  return before > 0 and after < before
             ? std::clamp(before / (before - after), 0.0, 1.0)
             : 0.0;
}
} // namespace contactx::contact
