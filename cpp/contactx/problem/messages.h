// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#pragma once

#include "../solve/loop.h"
#include <cstdint>
#include <string>
#include <string_view>

/// @brief A load step of bodies in contact, from its start to its end.
namespace contactx::problem
{
/// @brief Why no solution is to be expected after an iterate, and what to do.
/// @param[in] verdict What the loop says of it.
/// @param[in] moved Length, or angle in degrees, that a body which nothing
/// supports has moved by.
/// @return Empty where the loop goes on or has found a solution.
std::string failure_of(solve::Verdict verdict, double moved);

/// @brief Say that iterations did not converge, and what may help.
/// @param[in] count Number of iterations, or what limits it.
/// @param[in] limit Name of the limit.
/// @param[in] is_homogeneous Whether a smaller load is the same problem,
/// scaled.
std::string no_convergence(std::string_view count, std::string_view limit,
                           bool is_homogeneous);

/// @brief Say which bodies nothing holds, at the end of a failure.
/// @param[in] count Their number.
/// @param[in] place Where one of them is, in the reference configuration.
std::string loose_bodies(std::int64_t count, const std::string& place);

/// @brief Say that bodies are held along motions that nothing but the corners
/// between facets resists.
/// @param[in] motions Number of these motions, and of those that nothing
/// resists.
/// @param[in] force Force that holds them, over those of all contacts.
std::string held_bodies(std::int64_t motions, double force);
} // namespace contactx::problem
