// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#pragma once

#include "registry.h"

namespace contactx::kernel
{
/// @brief Kernels of surface-to-surface contact: a slave and a master facet,
/// with dual multipliers.
///
/// The constraint of a slave node is the integral of its dual basis function
/// against the gap. A. Popp, M. Gitterle, M. W. Gee and W. A. Wall, Int. J.
/// Numer. Meth. Engng 83, 2010; S. Hueeber and B. I. Wohlmuth, Comput. Methods
/// Appl. Mech. Engrg. 194, 2005. A node's slave side is diagonal once all parts
/// of its facets are assembled, so each pair gives its share of the diagonal.
std::vector<Entry> mortar();
} // namespace contactx::kernel
