// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#pragma once

#include "../math/vec.h"
#include <span>
#include <string>
#include <vector>

/// @brief Values of an obstacle's parameters, checked when they are used: each
/// function throws std::invalid_argument, which names the parameter.
namespace contactx::geometry
{
/// @brief Numbers for a message, as "[0.5, nan]".
std::string text(std::span<const double> values);

/// @brief A point.
/// @param[in] value Its coordinates (shape=(gdim)).
/// @param[in] gdim Geometric dimension.
/// @param[in] name Name of the parameter.
/// @return The same, the third coordinate zero in 2D.
Vector<3> vector(std::span<const double> value, int gdim, const char* name);

/// @brief A direction of any length, as a unit vector.
/// @param[in] value Its components (shape=(gdim)).
/// @param[in] gdim Geometric dimension.
/// @param[in] name Name of the parameter.
Vector<3> direction(std::span<const double> value, int gdim, const char* name);

/// @brief Angle that an obstacle has spun by, in radians.
/// @param[in] value Angle, or rotation vector; empty if it does not.
/// @param[in] size Numbers that there must be, if there are any.
/// @param[in] name Name of the parameter.
/// @return The same.
std::vector<double> spun(std::span<const double> value, int size,
                         const char* name);

/// @brief A positive number.
double positive(double value, const char* name);
} // namespace contactx::geometry
