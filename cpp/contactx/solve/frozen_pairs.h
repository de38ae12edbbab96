// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#pragma once

#include "../contact/master.h"
#include "../mesh/ranks.h"
#include <span>
#include <vector>

namespace contactx::solve
{
/// @brief What pairs hide that have alternated between facets, and are frozen
/// until the step's end.
struct HiddenPenetration
{
  std::vector<double> gaps; ///< smallest one of each contact
  bool is_deep = false;     ///< whether one is more than the mesh explains
};

/// @brief What frozen pairs hide on all ranks; collective.
/// @param[in] ranks The ranks.
/// @param[in] found What those of each contact hide on this rank.
HiddenPenetration hidden_penetration(mesh::Ranks& ranks,
                                     std::span<const contact::HiddenGap> found);
} // namespace contactx::solve
