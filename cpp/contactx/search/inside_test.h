// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#pragma once

#include "surface_probe.h"

namespace contactx::search
{
/// @brief Tells points that penetrate a body from those outside, where its
/// surface goes around it.
///
/// Behind a thin body that is tagged all around there is a facet that a point
/// faces, from inside of the body: as if the point had come through all of it.
class InsideTest
{
public:
  /// @brief Find out whether the surface goes around its body, in the reference
  /// configuration; all ranks must take part.
  /// @param[in] halo Nodes of this rank.
  /// @param[in] offsets First node of each facet that this rank has, and end.
  /// @param[in] nodes Nodes of these facets.
  InsideTest(std::shared_ptr<mesh::Halo> halo,
             std::span<const std::int32_t> offsets,
             std::span<const std::int32_t> nodes);

  /// @brief True if the surface encloses a volume; else no point is outside.
  bool is_around() const { return _is_around; }

  /// @brief Find which points are outside; all ranks must take part.
  /// @param[in] x Positions of all nodes (shape=(num_nodes, gdim)), row-major.
  /// @param[in] points Points (shape=(n, gdim)), row-major.
  /// @param[in] depth Depth of each below the facet that it faces, negative
  /// where it is in front of that (shape=(n)).
  /// @param[in] size Size of that facet (shape=(n)).
  /// @param[in] within_depth Whether only facets nearer than that count: a
  /// point that stands for all of a facet may be beside the body while the
  /// facet is not.
  /// @return Which ones (shape=(n)).
  std::vector<std::int8_t> find(std::span<const double> x,
                                std::span<const double> points,
                                std::span<const double> depth,
                                std::span<const double> size,
                                bool within_depth = false);

  /// @brief Looks at the surface.
  SurfaceProbe& probe() { return _probe; }

private:
  std::shared_ptr<mesh::Halo> _halo;
  SurfaceProbe _probe;
  bool _is_around;
};
} // namespace contactx::search
