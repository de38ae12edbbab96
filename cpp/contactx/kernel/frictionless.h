// Copyright (C) 2026 contactx authors
// SPDX-License-Identifier: LGPL-3.0-or-later

#pragma once

#include "registry.h"

namespace contactx::kernel
{
/// @brief Kernels of frictionless node-to-surface contact with multipliers.
///
/// With the pressure p of the slave node and its area A the virtual work is
/// - A p n . (v_s - sum_l N_l v_l). For finite sliding n, N_l and the gap are
/// those of the current configuration, and the derivatives are consistent; for
/// small sliding n and N_l are those that the search has found.
std::vector<Entry> frictionless();
} // namespace contactx::kernel
