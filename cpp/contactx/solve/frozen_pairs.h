// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#pragma once

#include "../contact/master.h"
#include "../mesh/ranks.h"
#include <span>
#include <vector>

namespace contactx::solve
{
/// @brief Releases frozen pairs where they hide a penetration at what would be
/// the solution.
///
/// A pair that alternates between facets is frozen until the step's end.
class FrozenPairs
{
public:
  /// @brief Start a load step: pairs have not been released yet.
  void begin_step() { *this = {}; }

  /// @brief True if frozen pairs hide more penetration than the mesh explains;
  /// collective.
  /// @param[in] ranks The ranks.
  /// @param[in] found What those of each contact hide on this rank.
  bool hide_penetration(mesh::Ranks& ranks,
                        std::span<const contact::HiddenGap> found);

  /// @brief Decide whether the pairs are released, close to the solution:
  /// unless that was tried often enough in this step.
  bool release();

  /// @brief Smallest gap that frozen pairs of each contact hide, when last
  /// searched.
  const std::vector<double>& gaps() const { return _gaps; }

private:
  int _times = 0;
  std::vector<double> _gaps;
};
} // namespace contactx::solve
