// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#pragma once

#include <cstdint>

namespace contactx::contact
{
/// @brief Method of a contact.
enum class Method : std::int8_t
{
  node_to_surface,   ///< slave nodes and the facets that they project on
  surface_to_surface ///< parts of slave facets and the facets in front of them
};

/// @brief True if a contact integrates its gap over facets, with dual
/// functions: by the method surface-to-surface, but for an obstacle where the
/// displacement is quadratic, in front of which nodes are constrained.
/// @param[in] method Method that was asked for.
/// @param[in] is_rigid Whether the master is an obstacle.
/// @param[in] is_quadratic Whether the displacement is quadratic.
constexpr bool integrates_facets(Method method, bool is_rigid,
                                 bool is_quadratic)
{
  return method == Method::surface_to_surface
         and not(is_rigid and is_quadratic);
}
} // namespace contactx::contact
