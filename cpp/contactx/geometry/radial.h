// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#pragma once

#include "../math/vec.h"

namespace contactx::geometry
{
/// @brief A surface at a constant distance from a point or a line, seen from
/// one point.
struct Radial
{
  double gap;
  Vector<3> normal;                   ///< of unit length; the gap's gradient
  std::array<Vector<3>, 3> curvature; ///< derivative of the normal

  /// @brief See it. Where the vector is zero there is no normal, and it is
  /// zero, too: nothing faces it.
  /// @param[in] d Vector from the point or line, at right angles to the line.
  /// @param[in] gdim Geometric dimension; derivatives are those within the span
  /// of all such vectors.
  /// @param[in] radius The distance.
  /// @param[in] hollow Whether bodies are inside.
  Radial(const Vector<3>& d, int gdim, double radius, bool hollow) : curvature{}
  {
    const double sign = hollow ? -1 : 1;
    const double distance = norm(d), inverse = distance > 0 ? 1 / distance : 0;
    gap = distance - radius;
    if (hollow)
      gap = -gap;
    const Vector<3> unit = inverse * d;
    normal = sign * unit;
    for (int i = 0; i < gdim; ++i)
      for (int j = 0; j < gdim; ++j)
        curvature[i][j] = sign * ((i == j) - unit[i] * unit[j]) * inverse;
  }
};

/// @brief Advice where a whole body is inside.
inline constexpr const char* usual_mistake_of_radial
    = "Perhaps hollow is the wrong way round: bodies within need hollow=True";
} // namespace contactx::geometry
