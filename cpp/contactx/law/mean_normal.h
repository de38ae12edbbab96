// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#pragma once

#include <cstdint>
#include <span>
#include <vector>

namespace contactx::law
{
/// @brief Unit normals n = M m / |M m| of means m over facets, and the slip
/// s = M (I - n n^T) w of a movement w.
///
/// The laws are written for n and s, forms assemble m and w. M drops directions
/// that cannot move: across a plane of symmetry, whose other half would lean
/// the other way. Vectors are of shape=(n, gdim), row-major.
class MeanNormal
{
public:
  /// @brief Create them.
  /// @param[in] num_nodes Number of slave nodes, n.
  /// @param[in] gdim Geometric dimension.
  MeanNormal(std::int32_t num_nodes, int gdim);

  /// @brief Scale means to unit length; zero stays zero.
  /// @param[in,out] normal Means, then unit normals.
  /// @param[in] mobile 1 in directions that can move, else 0.
  void normalise(std::span<double> normal, std::span<const double> mobile);

  /// @brief Take the part of movements along the surface.
  /// @param[in] normal Unit normals.
  /// @param[in,out] slip Movements, then slip.
  /// @param[in] mobile 1 in directions that can move, else 0.
  void project(std::span<const double> normal, std::span<double> slip,
               std::span<const double> mobile);

  /// @brief Turn derivatives by slip and normal into those by movement and
  /// mean.
  /// @param[in] normal Unit normals.
  /// @param[in,out] by_slip Derivatives by the slip (shape=(n, gdim, gdim)).
  /// @param[in,out] by_normal Derivatives by the normal (shape=(n, gdim,
  /// gdim)).
  void chain(std::span<const double> normal, std::span<double> by_slip,
             std::span<double> by_normal) const;

private:
  int _gdim;
  std::vector<double> _length;   // |M m|, 1 where it is zero
  std::vector<double> _kept;     // M of the normal
  std::vector<double> _movement; // w
  std::vector<double> _mobile;   // M of the slip
};
} // namespace contactx::law
