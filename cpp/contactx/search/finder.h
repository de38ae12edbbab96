// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#pragma once

#include "select.h"

namespace contactx::search
{
/// @brief What a search finds for a point.
struct Found
{
  std::optional<Projection> nearest;  ///< closest point that faces it
  std::optional<Projection> selected; ///< what contact is measured with
};

/// @brief Finds the place of a master surface that a point is in contact with,
/// without memory.
class Finder
{
public:
  /// @brief Create the finder.
  /// @param[in] offsets First node of each facet and the end.
  /// @param[in] nodes Nodes of the facets.
  /// @param[in] gdim Geometric dimension, 2 or 3.
  Finder(std::vector<std::int32_t> offsets, std::vector<std::int32_t> nodes,
         int gdim);

  /// @brief Master surface.
  const Surface& surface() const { return _surface; }

  /// @brief Take over moved nodes; needed before the first search.
  /// @param[in] x Node coordinates (shape=(num_nodes, gdim)), row-major.
  void refit(std::span<const double> x);

  /// @brief Search.
  /// @param[in] x Node coordinates of the last `refit`.
  /// @param[in] p Point.
  /// @param[in] normal Outward normal at the point; a zero vector accepts every
  /// facet.
  /// @param[in] reach Largest distance.
  /// @param[in] hint A facet that may be near, -1 for none.
  Found find(std::span<const double> x, const Vector<3>& p,
             const Vector<3>& normal, double reach,
             std::int32_t hint = -1) const;

private:
  Surface _surface;
  std::optional<BoxTree> _tree;
};
} // namespace contactx::search
