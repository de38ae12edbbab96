// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#pragma once

#include "../math/vec.h"
#include <optional>

namespace contactx::geometry
{
/// @brief The nearest point of what half-spaces have in common, seen from a
/// point outside: on one of their planes, or on the ridge or the apex where
/// several planes meet.
struct Meeting
{
  int count = 0;              ///< number of planes that meet there, 1 to gdim
  std::array<int, 3> plane{}; ///< which ones
  std::array<double, 3> share{}; ///< the offset is their normals times these
  /// Along the i-th one only the distance from the i-th plane changes
  std::array<Vector<3>, 3> dual{};
  Vector<3> offset{}; ///< from the nearest point to the point outside
};

/// @brief Nearest point of what half-spaces have in common.
///
/// With equal distances from all planes the vector is the axis of the narrowest
/// cone that holds their normals.
/// @param[in] normal Outward unit normals of the planes, zero of those that
/// bound nothing (shape=(n)).
/// @param[in] distance Distance of the point from each plane, the largest of
/// them positive (shape=(n)).
/// @param[in] gdim Geometric dimension, 2 or 3: so many planes meet at most.
/// @return Nothing where the half-spaces have no point in common.
std::optional<Meeting> meeting(std::span<const Vector<3>> normal,
                               std::span<const double> distance, int gdim);
} // namespace contactx::geometry
