// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#pragma once

#include <span>
#include <string>

namespace contactx
{
/// @brief A number as printf's %.<digits>g has it, in any locale.
/// @param[in] value Number.
/// @param[in] digits Significant digits, 1 to 17.
std::string number_text(double value, int digits);

/// @brief Shortest text that reads back as the same number, or "nan" whatever
/// its sign.
std::string exact_text(double value);

/// @brief Coordinates of a point in six digits, without what round-off has left
/// of a zero.
/// @param[in] x Point (shape=(gdim)).
/// @param[in] size Size of what it is a part of.
std::string point_text(std::span<const double> x, double size);
} // namespace contactx
