// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#pragma once

#include "registry.h"

namespace contactx::kernel
{
/// @brief Kernels of surface-to-surface contact with a rigid obstacle: the
/// gap, evaluated at points of a slave facet, is integrated with its dual basis
/// functions before the kernels are called.
std::vector<Entry> rigid_mortar();
} // namespace contactx::kernel
