// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#pragma once

#include "registry.h"

namespace contactx::kernel
{
/// @brief Kernels of frictionless contact with a rigid obstacle: the virtual
/// work - A p n . v_s of the slave node alone, no master side (Zhou et al.
/// 2015, eq. 16).
///
/// Gap, normal and their derivatives are coefficients, so that any obstacle is
/// served by the same kernels.
std::vector<Entry> rigid_frictionless();
} // namespace contactx::kernel
