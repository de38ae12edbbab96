// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#pragma once

#include "registry.h"

namespace contactx::kernel
{
/// @brief Kernels of contact with a rigid obstacle, for every law: the virtual
/// work - A lambda . v_s of the slave node alone, no master side (Zhou et al.
/// 2015, eq. 16).
///
/// Gap, normal, slip and their derivatives are coefficients, so that any
/// obstacle is served by the same kernels.
std::vector<Entry> rigid();
} // namespace contactx::kernel
