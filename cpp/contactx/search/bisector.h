// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#pragma once

#include "surface.h"

namespace contactx::search
{
/// @brief The vertex of a plane surface that a point is half way over, with
/// the normal half way between its facets.
///
/// Over the middle of a ridge or a valley both facets are as good. The normal
/// of either leans to a side, and where two meshes match it is the same side
/// at all nodes: a ring would be turned round in another one by a moment that
/// nothing balances. Edges of more than 45 degrees are no curves that facets
/// approximate, and remain to their facets.
/// @param[in] surface Master surface; nothing is found in 3D.
/// @param[in] x Node coordinates (shape=(num_nodes, gdim)), row-major.
/// @param[in] p Point.
/// @param[in] q Projection of `p` on the interior of a facet.
/// @return Nothing where `p` is higher over one facet than over the other, or
/// where they are in line.
std::optional<Projection> bisector(const Surface& surface,
                                   std::span<const double> x,
                                   const Vector<3>& p, const Projection& q);
} // namespace contactx::search
