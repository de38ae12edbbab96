// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#pragma once

#include "../math/vec.h"
#include "nodal.h"

/// @brief Checks of a converged iterate before it is accepted.
namespace contactx::geometry
{
/// @brief Rotation and translation: x becomes after + rotation (x - before).
struct RigidMotion
{
  std::array<Vector<3>, 3> rotation; ///< rows
  Vector<3> before, after;

  /// @brief Turn a vector back.
  template <int D>
  Vector<D> turned_back(const Vector<D>& v) const
  {
    Vector<D> y{};
    for (int i = 0; i < D; ++i)
      for (int k = 0; k < D; ++k)
        y[k] += rotation[i][k] * v[i];
    return y;
  }

  /// @brief Move a point back.
  template <int D>
  Vector<D> moved_back(Vector<D> p) const
  {
    for (int k = 0; k < D; ++k)
      p[k] -= after[k];
    p = turned_back<D>(p);
    for (int k = 0; k < D; ++k)
      p[k] += before[k];
    return p;
  }
};

/// @brief Sums over the nodes of all facets that the motion follows from; those
/// of parts of a surface add up to those of the whole.
///
/// Number of nodes; sums of positions at the start and at the end, three
/// each; sums of their squares; sums of their products, three rows.
using Moments = std::array<double, 18>;

/// @brief Sums of a surface or of a part of it.
/// @param[in] facets Facets.
/// @param[in] x0, x1 Node coordinates at the start and at the end
/// (shape=(num_nodes, gdim)), row-major.
/// @param[in] gdim Geometric dimension, 2 or 3.
/// @param[in] origin0, origin1 Points that positions are taken from: near
/// the surface, so that no digits go to the distance from the origin.
Moments moments(const FacetList& facets, std::span<const double> x0,
                std::span<const double> x1, int gdim, const Vector<3>& origin0,
                const Vector<3>& origin1);

/// @brief The rigid motion that is nearest to that of a surface; a translation
/// where the surface has not moved like a rigid body.
/// @param[in] m Sums of the whole surface.
/// @param[in] gdim Geometric dimension, 2 or 3.
/// @param[in] origin0, origin1 As for `moments`.
RigidMotion rigid_motion(const Moments& m, int gdim, const Vector<3>& origin0,
                         const Vector<3>& origin1);
} // namespace contactx::geometry
