// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#pragma once

#include "registry.h"

namespace contactx::kernel
{
/// @brief Kernels of the movement between slave nodes and the points of the
/// master that were in front of them: slip of surface-to-surface contact, and
/// its ties.
///
/// The movement of a slave node is x_s - sum_l W_sl x_l / area_s less the mean
/// gap along the slave facets' normals, which turn; the weights W are those of
/// a configuration before.
std::vector<Entry> mortar_tied();
} // namespace contactx::kernel
